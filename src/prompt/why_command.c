// why_command.c: the command .why, which prints the forces that act on a particle.
#include "cli/contributions.h"
#include "cli/text_table.h"
#include "petri-inspect.h"
#include "prompt/prompt.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

// The particle that the user asks for.
typedef struct Question {
    ParticleName name;
    bool each;        // print single contributions instead of one row per force
    size_t max_lines; // maximum number of contributions to print
} Question;

// The forces on the particle, with which the rows of a table are filled.
typedef struct Answer {
    PetriSession *session;
    size_t number; // number of the system
    const PetriSystem *system;
    PetriExplanation found;
} Answer;

static const double *vector_of(const Answer *answer, uint32_t contribution) {
    return answer->found.vector + (size_t)contribution * answer->system->dimensions;
}

static void add_cells(TextTable *table, const char *name, const char *from, const char *vector, const char *position) {
    text_table_add(table, name);
    text_table_add(table, from);
    text_table_add(table, vector);
    text_table_add(table, position);
}

static void add_row(TextTable *table, const Answer *answer, uint32_t force, const char *from, const double *vector) {
    SCOPED_TEXT name = {0};
    SCOPED_TEXT value = {0};
    SCOPED_TEXT position = {0};
    contribution_add_name(answer->session, answer->number, force, &name);
    contribution_add_vector(answer->session, vector, answer->system->dimensions, &value);
    contribution_add_position(answer->session, answer->number, force, &position);
    add_cells(table, name.bytes, from, value.bytes, position.bytes);
}

// Adds a row for each of the first `count` contributions.
static void add_contributions(TextTable *table, const Answer *answer, uint32_t count) {
    for (uint32_t c = 0; c < count; c++) {
        SCOPED_TEXT from = {0};
        contribution_add_partner(answer->session, answer->number, answer->found.partner[c], &from);
        add_row(table, answer, answer->found.force[c], from.bytes, vector_of(answer, c));
    }
}

// Adds a row with the sum of all contributions of the force whose first contribution is `first`.
static void add_force(TextTable *table, const Answer *answer, uint32_t first, double *sum) {
    const PetriExplanation *found = &answer->found;
    uint32_t count = 0, dimensions = answer->system->dimensions;
    SCOPED_TEXT from = {0};
    for (uint32_t c = first; c < found->count; c++)
        for (uint32_t k = 0; k < dimensions && found->force[c] == found->force[first]; k++) {
            count += k == 0;
            sum[k] = c == first ? vector_of(answer, c)[k] : sum[k] + vector_of(answer, c)[k];
        }
    if (count == 1)
        contribution_add_partner(answer->session, answer->number, found->partner[first], &from);
    else
        text_add_format(&from, "%" PRIu32 " particles", count);
    add_row(table, answer, found->force[first], from.bytes, sum);
}

// Adds a row for each force, in the order of their first contributions. Returns the number of forces.
static uint32_t add_forces(TextTable *table, const Answer *answer) {
    const PetriSystem *system = answer->system;
    double *sum = memory_calloc(system->dimensions * sizeof *sum);
    bool *listed = memory_calloc((system->force_count + (size_t)1) * sizeof *listed); // the last is the own force
    uint32_t count = 0;
    for (uint32_t c = 0; c < answer->found.count; c++) {
        uint32_t force = answer->found.force[c];
        bool *known = &listed[force == PETRI_OWN_FORCE ? system->force_count : force];
        if (!*known)
            add_force(table, answer, c, sum);
        count += !*known;
        *known = true;
    }
    free(listed);
    free(sum);
    return count;
}

static void print_answer(Prompt *prompt, const Question *question, const Answer *answer) {
    const PetriExplanation *found = &answer->found;
    SCOPED_TEXT_TABLE table = text_table_new(4);
    SCOPED_TEXT sum = {0};
    uint32_t shown = question->max_lines < found->count ? (uint32_t)question->max_lines : found->count;
    add_cells(&table, "force", "from", "contribution", "script");
    if (question->each)
        add_contributions(&table, answer, shown);
    else
        shown = add_forces(&table, answer);
    contribution_add_vector(answer->session, found->sum, answer->system->dimensions, &sum);
    add_cells(&table, "sum", "", sum.bytes, "");
    text_table_write(&table, prompt->output);
    if (shown < found->count && question->each)
        prompt_note(prompt, "%" PRIu32 " more contributions; '.why %s all' shows all", found->count - shown,
                    question->name.typed);
    else if (shown < found->count)
        prompt_note(prompt, "'.why %s all' shows the contribution of each particle, in the order of summation",
                    question->name.typed);
}

// Explains the force on one particle in the last step of the frame. Returns false after a message.
static bool explain_particle(Prompt *prompt, const Question *question, Answer *answer, uint32_t particle) {
    const PetriSystem *system = answer->system;
    SCOPED_TEXT title = {0};
    particle_add_key(prompt, answer->number, system, particle, &title);
    if (system->anchor[particle * system->anchor_stride] || !system->force.data) {
        prompt_note(prompt, "%s %s", title.bytes,
                    system->force.data ? "is an anchor, which no force moves" : "took no step in this frame");
        return true;
    }
    prompt_busy(prompt);
    PetriStatus status = petri_explain_force(prompt->session, answer->number, particle, system->steps - 1,
                                             &answer->found, sizeof answer->found);
    prompt_idle(prompt);
    if (!prompt_status(prompt, status))
        return false;
    output_format(prompt->output, "%s: %" PRIu32 " contribution%s in step %" PRIu64 " of %" PRIu64 "\n", title.bytes,
                  answer->found.count, answer->found.count == 1 ? "" : "s", system->steps, system->steps);
    print_answer(prompt, question, answer);
    return true;
}

// Answers the question for each system that has the particle.
static bool explain_in_systems(Prompt *prompt, const Question *question) {
    PetriSystem system;
    size_t count = 0, found = 0;
    bool good = true;
    for (; good && petri_system(prompt->session, count, &system, sizeof system); count++) {
        uint32_t particle;
        if (!particle_find(prompt, &question->name, count, &system, &particle))
            continue;
        found++;
        good = explain_particle(prompt, question, &(Answer){prompt->session, count, &system, {0}}, particle);
    }
    if (count == 0)
        prompt_note(prompt, "%s", particle_none(prompt));
    else if (found == 0)
        return particle_unknown(prompt, &question->name);
    return good;
}

static bool run_why(Prompt *prompt, const char *rest) {
    SCOPED_STRING asked = memory_strdup(rest);
    Question question = {0};
    if (strpbrk(asked, " \t")) // a single number is the id, not the number of contributions
        question.max_lines = argument_lines(prompt, asked, 0);
    question.each = strlen(asked) < strlen(rest);
    bool good = particle_read(prompt, asked, &question.name) && explain_in_systems(prompt, &question);
    text_free(&question.name.value);
    return good;
}

const PromptCommand WHY_COMMANDS[] = {
    {".why", "ID [N|all]", "the id of a particle",
     "print the forces on a particle; `all` or N lists single contributions", run_why, COMPLETE_IDS},
    {0},
};
