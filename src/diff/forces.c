// forces.c: the first particle that differs, and the first of its forces that differs.
//
// If the last frames are the same, each difference in this frame begins with the motion of some particle in some step.
// So the particles that differ are explained (petri_explain_force), step by step, until a contribution differs.
#include "base/number.h"
#include "cli/contributions.h"
#include "diff/diff.h"
#include "petri-inspect.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

// Explaining takes time in proportion to the number of particles. The first one that differs usually has the cause.
enum { MAX_PARTICLES = 100, MAX_STEPS = 1000 };

// A particle that differs, in the system with the same name on each side.
typedef struct Candidate {
    char *key;
    size_t systems[2];
    uint32_t particles[2];
} Candidate;

typedef struct Candidates {
    Candidate items[MAX_PARTICLES];
    size_t count;
} Candidates;

typedef struct RowList {
    ForceRow *items;
    size_t count;
} RowList;

static void free_row(ForceRow *row) {
    free(row->name);
    free(row->partner);
    free(row->vector);
    free(row->position);
    *row = (ForceRow){0};
}

static void free_rows(RowList *list) {
    for (size_t i = 0; i < list->count; i++)
        free_row(&list->items[i]);
    free(list->items);
    *list = (RowList){0};
}

static void add_row(RowList *list, ForceRow row) {
    if ((list->count & (list->count + 1)) == 0) // there is room for the next power of two
        list->items = memory_realloc(list->items, 2 * (list->count + 1) * sizeof *list->items);
    list->items[list->count++] = row;
}

// --- particles

// Returns true if the position or velocity of the particle with this key differs, and marks them.
static bool differs(const StateDifferences *differences, const char *key) {
    SCOPED_TEXT velocity = {0};
    text_add_format(&velocity, "%s;:velocity", key);
    StateDifference *found[] = {state_find_difference(differences, str_from(key)),
                                state_find_difference(differences, text_str(&velocity))};
    for (int i = 0; i < 2; i++)
        if (found[i])
            found[i]->of_particle = true;
    return found[0] || found[1];
}

// Finds the system of the other side with this name.
static bool find_system(PetriSession *session, const char *name, size_t *number) {
    PetriSystem system;
    for (*number = 0; petri_system(session, *number, &system, sizeof system); ++*number)
        if (strcmp(system.name, name) == 0)
            return true;
    return false;
}

// Finds the particle of a side with the id of the candidate on the first of the sides.
static bool find_other(const Side *sides, int base, Candidate *candidate, const char *name) {
    int other = 1 - base;
    PetriValue id = petri_particle_id(sides[base].session, candidate->systems[base], candidate->particles[base]);
    return sides[other].session && find_system(sides[other].session, name, &candidate->systems[other]) &&
           petri_find_particle(sides[other].session, candidate->systems[other], id, &candidate->particles[other]);
}

// Returns the key of a particle in the state. The caller frees it.
static char *key_of(PetriSession *session, size_t number, const PetriSystem *system, uint32_t particle) {
    const char *id = petri_format_value(session, petri_particle_id(session, number, particle));
    Text key = {0};
    text_add_format(&key, "%s;%s", system->name, id ? id : "");
    return key.bytes;
}

// Marks the entries of all particles of a side.
static void mark_particles(PetriSession *session, const StateDifferences *differences) {
    PetriSystem system;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++)
        for (uint32_t i = 0; i < system.particle_count; i++) {
            SCOPED_STRING key = key_of(session, s, &system, i);
            differs(differences, key);
        }
}

// Collects the first particles that differ, in document order, and marks the entries of all particles. `base` is the
// side whose systems are searched.
static void find_candidates(const Side *sides, int base, const StateDifferences *differences, Candidates *found) {
    PetriSession *session = sides[base].session;
    PetriSystem system;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++)
        for (uint32_t i = 0; i < system.particle_count; i++) {
            SCOPED_STRING key = key_of(session, s, &system, i);
            if (!differs(differences, key) || found->count == MAX_PARTICLES)
                continue;
            Candidate *candidate = &found->items[found->count];
            candidate->systems[base] = s;
            candidate->particles[base] = i;
            if (sides[1 - base].session && !find_other(sides, base, candidate, system.name))
                continue; // the particle exists only on one side
            candidate->key = key;
            key = NULL;
            found->count++;
        }
}

// --- contributions of a side

static char *take_text(Text *text) {
    return text->bytes ? text->bytes : memory_strdup("");
}

// Adds the contributions that this process computes. Returns false if there are none for this step.
static bool explain_here(const Side *side, const Candidate *candidate, int number, uint64_t step, RowList *rows) {
    PetriSession *session = side->session;
    size_t system = candidate->systems[number];
    PetriExplanation found;
    PetriSystem about;
    if (petri_explain_force(session, system, candidate->particles[number], step, &found, sizeof found) != PETRI_OK ||
        !petri_system(session, system, &about, sizeof about))
        return false;
    for (uint32_t c = 0; c < found.count; c++) {
        Text name = {0}, partner = {0}, vector = {0}, position = {0};
        contribution_add_name(session, system, found.force[c], &name);
        contribution_add_partner(session, system, found.partner[c], &partner);
        contribution_add_vector(session, found.vector + (size_t)c * about.dimensions, about.dimensions, &vector);
        contribution_add_position(session, system, found.force[c], &position);
        add_row(rows, (ForceRow){take_text(&name), take_text(&partner), take_text(&vector), take_text(&position)});
    }
    return true;
}

// Returns the next cell of a table row, which ends before two spaces, and removes it.
static char *take_cell(Str *line) {
    size_t length = 0;
    while (length < line->len && !(length + 1 < line->len && memcmp(line->bytes + length, "  ", 2) == 0))
        length++;
    char *cell = memory_strndup(line->bytes, length);
    while (length < line->len && line->bytes[length] == ' ')
        length++;
    *line = (Str){line->bytes + length, line->len - length};
    return cell;
}

// Adds the contributions that another program prints for the command .why. They are those of the frame's last step.
static bool explain_there(const Side *side, const Candidate *candidate, RowList *rows) {
    SCOPED_TEXT command = {0};
    text_add_format(&command, ".why %s all", candidate->key);
    SCOPED_STRING answer = side_ask(side, side->frame, command.bytes);
    const Text text = {.bytes = answer, .len = answer ? strlen(answer) : 0};
    bool table = false;
    size_t at = 0;
    for (Str line; text_next_line(&text, &at, &line);) {
        bool sum = line.len > 4 && memcmp(line.bytes, "sum ", 4) == 0;
        if (table && sum)
            return true;
        if (table) {
            ForceRow row = {.name = take_cell(&line)};
            row.partner = take_cell(&line);
            row.vector = take_cell(&line);
            row.position = take_cell(&line);
            add_row(rows, row);
        }
        table = table || (line.len > 6 && memcmp(line.bytes, "force ", 6) == 0);
    }
    return false;
}

static bool explain(const Side *side, const Candidate *candidate, int number, uint64_t step, RowList *rows) {
    return side->session ? explain_here(side, candidate, number, step, rows) : explain_there(side, candidate, rows);
}

// --- comparison

static bool same_source(const ForceRow *a, const ForceRow *b) {
    return strcmp(a->name, b->name) == 0 && strcmp(a->partner, b->partner) == 0;
}

static void take_row(RowList *list, size_t number, ForceRow *row) {
    if (number < list->count) {
        *row = list->items[number];
        list->items[number] = (ForceRow){0};
    }
}

// Finds the first row that differs. If one side lacks a row that the other has, only the latter is set.
static bool compare_rows(RowList *lists, ForceRow *rows) {
    size_t i = 0;
    while (i < lists[0].count && i < lists[1].count && same_source(&lists[0].items[i], &lists[1].items[i]) &&
           strcmp(lists[0].items[i].vector, lists[1].items[i].vector) == 0)
        i++;
    if (i == lists[0].count && i == lists[1].count)
        return false;
    bool both = i < lists[0].count && i < lists[1].count && !same_source(&lists[0].items[i], &lists[1].items[i]);
    bool only_first = both && i + 1 < lists[0].count && same_source(&lists[0].items[i + 1], &lists[1].items[i]);
    bool only_second = both && i + 1 < lists[1].count && same_source(&lists[0].items[i], &lists[1].items[i + 1]);
    if (!only_second)
        take_row(&lists[0], i, &rows[0]);
    if (!only_first)
        take_row(&lists[1], i, &rows[1]);
    return true;
}

// Explains one particle on both sides. Returns true if a contribution differs.
static bool compare_particle(const Side *sides, const Candidate *candidate, uint64_t step, ForceDifference *found) {
    RowList lists[2] = {{0}, {0}};
    bool known = explain(&sides[0], candidate, 0, step, &lists[0]) && explain(&sides[1], candidate, 1, step, &lists[1]);
    bool differing = known && compare_rows(lists, found->rows);
    found->known |= known;
    for (int i = 0; i < 2; i++)
        free_rows(&lists[i]);
    return differing;
}

static double number_of(PetriColumn column, uint32_t particle) {
    return column.data[particle * column.stride];
}

// Notes which attributes of the particle differ.
static void compare_attributes(const Side *sides, const Candidate *candidate, Text *text) {
    PetriSystem systems[2];
    for (int i = 0; i < 2; i++)
        if (!sides[i].session || !petri_system(sides[i].session, candidate->systems[i], &systems[i], sizeof systems[i]))
            return;
    const struct {
        const char *name;
        PetriColumn columns[2];
    } attributes[] = {{"radius", {systems[0].radius, systems[1].radius}},
                      {"mass", {systems[0].mass, systems[1].mass}},
                      {"charge", {systems[0].charge, systems[1].charge}}};
    for (size_t i = 0; i < sizeof attributes / sizeof attributes[0]; i++) {
        double a = number_of(attributes[i].columns[0], candidate->particles[0]);
        double b = number_of(attributes[i].columns[1], candidate->particles[1]);
        if (memcmp(&a, &b, sizeof a) == 0)
            continue;
        text_add_format(text, "%s ", attributes[i].name);
        contribution_add_vector(sides[0].session, &a, 1, text);
        text_add_c(text, " and ");
        contribution_add_vector(sides[1].session, &b, 1, text);
        text_add_c(text, "\n");
    }
}

// Returns the number of steps that a side took in the frame, or 0 if it is unknown.
static uint64_t steps_of(const Side *side, size_t system) {
    PetriSystem found;
    return side->session && petri_system(side->session, system, &found, sizeof found) ? found.steps : 0;
}

// Sets the reason for a difference that no force explains.
static void find_cause(const Side *sides, const Candidate *candidate, Text *cause) {
    PetriExplanation found[2];
    double length[2];
    for (int i = 0; i < 2; i++) {
        if (!sides[i].session || petri_explain_force(sides[i].session, candidate->systems[i], candidate->particles[i],
                                                     0, &found[i], sizeof found[i]) != PETRI_OK)
            return;
        length[i] = found[i].delta;
    }
    if (length[0] == length[1] &&
        steps_of(&sides[0], candidate->systems[0]) == steps_of(&sides[1], candidate->systems[1])) {
        text_add_c(cause, "its motion differs: by its mass, the speed of light or a bounce off a !barrier");
        return;
    }
    for (int i = 0; i < 2; i++) {
        text_add_format(cause, "%s%" PRIu64 " steps, the first of ",
                        i == 0 ? "the runs take different steps: " : " and ",
                        steps_of(&sides[i], candidate->systems[i]));
        text_add_number(cause, length[i]);
    }
}

// Finds the first step, and in that step the first particle, with a contribution that differs.
static bool search_steps(const Side *sides, const Candidates *candidates, ForceDifference *found, size_t *which) {
    bool every_step = sides[0].session && sides[1].session; // other programs explain only the last step
    found->steps = UINT64_MAX;
    for (int i = 0; i < 2; i++) {
        uint64_t steps = steps_of(&sides[i], candidates->items[0].systems[i]);
        found->steps = sides[i].session && steps < found->steps ? steps : found->steps;
    }
    uint64_t first = every_step || found->steps == 0 ? 0 : found->steps - 1;
    for (found->step = first; found->step < found->steps && found->step < first + MAX_STEPS; found->step++)
        for (*which = 0; *which < candidates->count; ++*which)
            if (compare_particle(sides, &candidates->items[*which], found->step, found))
                return true;
    return false;
}

void forces_compare(Side *sides, const StateDifferences *differences, ForceDifference *found) {
    int base = sides[0].session ? 0 : 1;
    Candidates candidates = {.count = 0};
    *found = (ForceDifference){.known = false};
    if (!sides[base].session)
        return;
    find_candidates(sides, base, differences, &candidates);
    if (sides[1 - base].session)
        mark_particles(sides[1 - base].session, differences);
    if (candidates.count == 0)
        return;
    size_t which = 0;
    bool explainable = sides[1 - base].session != NULL || sides[1 - base].with != NULL;
    if (!explainable || !search_steps(sides, &candidates, found, &which)) {
        which = 0;
        if (found->known)
            find_cause(sides, &candidates.items[0], &found->cause);
    }
    text_add_c(&found->first, candidates.items[0].key);
    text_add_c(&found->particle, candidates.items[which].key);
    compare_attributes(sides, &candidates.items[which], &found->attributes);
    for (size_t i = 0; i < candidates.count; i++)
        free(candidates.items[i].key);
}

void forces_free(ForceDifference *found) {
    for (int i = 0; i < 2; i++)
        free_row(&found->rows[i]);
    text_free(&found->first);
    text_free(&found->particle);
    text_free(&found->cause);
    text_free(&found->attributes);
}
