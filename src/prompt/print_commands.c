// print_commands.c: commands that print the frame as text: state, nodes, particles and watched expressions.
#include "cli/motion.h"
#include "cli/text_table.h"
#include "petri-inspect.h"
#include "prompt/prompt.h"

#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { RESERVED_LINES = 3 }; // screen lines reserved for the command, the closing note and the prompt

// A filter for the lines of one section of petri_print.
typedef struct Filter {
    Prompt *prompt;
    const char *wanted; // key or node kind to select; "": all
    size_t depth;       // depth of the node whose subtree is being written; SIZE_MAX: none
    size_t found;       // number of matching entries or nodes
    size_t lines;       // number of selected lines
    size_t rows;        // their height on the screen
    size_t columns;     // width of the screen; 0: lines are counted, whatever their length
    size_t omitted;     // number of selected lines that were not written
    size_t max_lines;   // maximum height of the lines that are written
    void (*handle_line)(struct Filter *filter, const char *line, size_t length);
} Filter;

typedef struct Collector {
    Prompt *prompt;
    Text text;
} Collector;

static bool collect_unless_stopped(void *user_data, const char *text, size_t length) {
    Collector *collector = user_data;
    return text_collect(&collector->text, text, length) && !collector->prompt->host->interrupted(collector->prompt);
}

// Passes each line of a section to the filter, which writes the lines that it selects. Returns filter->found.
static size_t print_filtered(Prompt *prompt, unsigned section, Filter *filter) {
    Collector printed = {.prompt = prompt};
    Str line;
    size_t at = 0;
    filter->depth = SIZE_MAX;
    prompt_busy(prompt);
    petri_print(prompt->session, section, collect_unless_stopped, &printed);
    text_next_line(&printed.text, &at, &line); // skip the frame's `@` line
    while (text_next_line(&printed.text, &at, &line) && prompt->output->error == 0 &&
           !prompt->host->interrupted(prompt))
        filter->handle_line(filter, line.bytes, line.len + 1);
    prompt_idle(prompt);
    text_free(&printed.text);
    return filter->found;
}

static void write_line(Filter *filter, const char *line, size_t length) {
    // A long line takes several lines of the screen. The first line is always written.
    size_t columns = filter->columns,
           rows = columns == 0 ? 1 : (utf8_length((Str){line, length - 1}) + columns - 1) / columns;
    filter->rows += rows > 1 ? rows : 1;
    if (filter->lines++ == 0 || filter->rows <= filter->max_lines)
        output_write(filter->prompt->output, line, length);
    else
        filter->omitted++;
}

// Writes a note about the number of omitted lines and how to see them. `asked` is the operand without its number of
// lines.
static void note_remaining(const Filter *filter, const char *command, const char *asked) {
    if (filter->omitted > 0) {
        prompt_note(filter->prompt, "%zu more lines; '%s%s%s all' shows all lines", filter->omitted, command,
                    asked[0] == '\0' ? "" : " ", asked);
    }
}

// Selects the entries whose key is the wanted key or begins with the wanted key. For example, `:cells` and `cells`
// select both `$:cells = …` and `$(:cells;0) = …`.
static void filter_entry(Filter *filter, const char *line, size_t length) {
    const char *key = line + 1 + (line[1] == '(');
    key += key[0] == ':' && filter->wanted[0] != ':';
    size_t wanted = strlen(filter->wanted), rest = length - (size_t)(key - line);
    bool under = wanted == 0 || (rest > wanted && memcmp(key, filter->wanted, wanted) == 0 &&
                                 (key[wanted] == ';' || key[wanted] == ')' || key[wanted] == ' '));
    if (under) {
        filter->found++;
        write_line(filter, line, length);
    }
}

// Returns the width of the screen if lines are omitted because they do not fit on it, else 0. `given` is true if the
// user has given a number of lines.
static size_t fitted_columns(Prompt *prompt, bool given) {
    const PromptHost *host = prompt->host;
    return !given && host->columns && host->rows && host->rows(prompt) != SIZE_MAX ? host->columns(prompt) : 0;
}

static bool run_state(Prompt *prompt, const char *rest) {
    SCOPED_STRING asked = memory_strdup(rest);
    // If the operand is only a number, the number is the wanted key, not the number of lines.
    bool counted = strpbrk(asked, " \t") || strcmp(asked, "all") == 0;
    size_t max_lines = argument_lines(prompt, counted ? asked : (char[]){""}, RESERVED_LINES);
    const char *prefix = asked + (asked[0] == '$');
    bool enclosed = prefix[0] == '(';
    size_t length = strlen(prefix) - enclosed;
    length -= enclosed && length > 0 && prefix[length] == ')';
    SCOPED_STRING wanted = memory_strndup(prefix + enclosed, length);
    Filter filter = {.wanted = wanted,
                     .prompt = prompt,
                     .handle_line = filter_entry,
                     .max_lines = max_lines,
                     .columns = fitted_columns(prompt, strlen(asked) < strlen(rest))};
    if (print_filtered(prompt, PETRI_PRINT_STATE, &filter) == 0)
        prompt_note(prompt, wanted[0] == '\0' ? "the state is empty" : "the state has no entry under %s", wanted);
    note_remaining(&filter, ".state", asked);
    return true;
}

static void filter_node(Filter *filter, const char *line, size_t length) {
    size_t depth = strspn(line, " "), wanted = strlen(filter->wanted);
    if (filter->depth == SIZE_MAX || depth <= filter->depth) {
        const char *kind = line + depth + 1;
        bool same = wanted == 0 || (strncmp(kind, filter->wanted, wanted) == 0 && strchr(" \n", kind[wanted]));
        filter->depth = same ? depth : SIZE_MAX;
        filter->found += same;
    }
    if (filter->depth != SIZE_MAX) {
        size_t cut = wanted == 0 ? 0 : filter->depth;
        write_line(filter, line + cut, length - cut);
    }
}

static bool run_tree(Prompt *prompt, const char *rest) {
    SCOPED_STRING asked = memory_strdup(rest);
    size_t max_lines = argument_lines(prompt, asked, RESERVED_LINES);
    const char *kind = asked + (asked[0] == '!');
    prompt_busy(prompt);
    PetriStatus status = petri_preview(prompt->session);
    prompt_idle(prompt);
    Filter filter = {.prompt = prompt,
                     .wanted = kind,
                     .handle_line = filter_node,
                     .max_lines = max_lines,
                     .columns = fitted_columns(prompt, strlen(asked) < strlen(rest))};
    if (status == PETRI_OK && print_filtered(prompt, PETRI_PRINT_TREE, &filter) == 0)
        prompt_note(prompt, kind[0] == '\0' ? "the frame has no nodes" : "the frame has no node !%s", kind);
    note_remaining(&filter, ".tree", asked);
    return prompt_status(prompt, status);
}

static bool matches_name(const char *name, const char *wanted) {
    return wanted[0] == '\0' || strcmp(name, wanted) == 0 || (name[0] == ':' && strcmp(name + 1, wanted) == 0);
}

// Operands of a command that prints systems.
typedef struct SystemRequest {
    const char *system; // name; "": all systems
    size_t max_lines;   // rows per system
} SystemRequest;

// Calls `show` for each requested system.
static bool print_systems(Prompt *prompt, const SystemRequest *request,
                          void (*show)(Prompt *, size_t, const PetriSystem *, const SystemRequest *)) {
    PetriSystem system;
    const char *wanted = request->system;
    size_t count = 0, shown = 0;
    prompt_complete_frame(prompt);
    for (; petri_system(prompt->session, count, &system, sizeof system); count++) {
        if (matches_name(system.name, wanted)) {
            show(prompt, count, &system, request);
            shown++;
        }
    }
    if (count == 0)
        prompt_note(prompt, "%s", particle_none(prompt));
    else if (shown == 0)
        return prompt_fail(prompt, "no such system: '%.40s'", wanted);
    return true;
}

static void add_vector(TextTable *table, const double *vector, uint32_t dimensions) {
    SCOPED_TEXT cell = {0};
    for (uint32_t k = 0; k < dimensions && vector; k++)
        text_add_format(&cell, isnan(vector[k]) ? "%snan" : "%s%.6g", k == 0 ? "" : ";", vector[k]);
    text_table_add(table, !vector ? "-" : cell.bytes);
}

static void add_number(TextTable *table, double x) {
    add_vector(table, &x, 1);
}

static const double *particle_row(PetriColumn column, uint32_t particle) {
    return !column.data ? NULL : column.data + particle * column.stride;
}

static bool is_anchor(const PetriSystem *system, uint32_t particle) {
    return system->anchor[particle * system->anchor_stride];
}

static uint32_t count_anchors(const PetriSystem *system) {
    uint32_t anchors = 0;
    for (uint32_t i = 0; i < system->particle_count; i++)
        anchors += is_anchor(system, i);
    return anchors;
}

static void print_particles(Prompt *prompt, size_t number, const PetriSystem *system, const SystemRequest *request) {
    SCOPED_TEXT_TABLE table = text_table_new(5);
    uint32_t anchors = count_anchors(system), moving = system->particle_count - anchors;
    output_format(prompt->output, "%s: %" PRIu32 " particle%s", system->name, moving, moving == 1 ? "" : "s");
    if (anchors > 0)
        output_format(prompt->output, ", %" PRIu32 " anchor%s", anchors, anchors == 1 ? "" : "s");
    output_write(prompt->output, "\n", 1);
    const char *const heads[] = {"id", "position", "velocity", "speed", "force"};
    for (size_t i = 0; i < 5; i++)
        text_table_add(&table, heads[i]);
    for (uint32_t i = 0; i < request->max_lines && i < system->particle_count; i++) {
        const char *id = petri_format_value(prompt->session, petri_particle_id(prompt->session, number, i));
        text_table_add(&table, !id ? "" : id);
        add_vector(&table, particle_row(system->position, i), system->dimensions);
        add_vector(&table, particle_row(system->velocity, i), system->dimensions);
        add_number(&table, particle_speed(system, i));
        if (is_anchor(system, i))
            text_table_add(&table, "anchor");
        else
            add_vector(&table, particle_row(system->force, i), system->dimensions);
    }
    text_table_write(&table, prompt->output);
    if (system->particle_count > request->max_lines) {
        prompt_note(prompt, "%zu more particles; '.particles%s%s all' shows all",
                    system->particle_count - request->max_lines, request->system[0] == '\0' ? "" : " ",
                    request->system);
    }
}

static bool run_particles(Prompt *prompt, const char *rest) {
    // Screen lines reserved for the command, title, column heads, closing note and prompt.
    enum { RESERVED_TABLE_LINES = 5 };
    SCOPED_STRING system = memory_strdup(rest);
    SystemRequest request = {.system = system, .max_lines = argument_lines(prompt, system, RESERVED_TABLE_LINES)};
    bool good = print_systems(prompt, &request, print_particles);
    return good;
}

static void add_motion_row(void *user_data, const char *name, const char *value) {
    SCOPED_TEXT indented = {0};
    text_add_format(&indented, "  %s", name);
    text_table_add(user_data, indented.bytes);
    text_table_add(user_data, value);
}

static void print_energy(Prompt *prompt, size_t number, const PetriSystem *system, const SystemRequest *request) {
    enum { DIGITS = 6 };
    (void)request;
    SCOPED_TEXT_TABLE table = text_table_new(2);
    uint32_t moving = motion_count(system);
    output_format(prompt->output, "%s: %" PRIu32 " particle%s, %" PRIu64 " step%s\n", system->name, moving,
                  moving == 1 ? "" : "s", system->steps, system->steps == 1 ? "" : "s");
    motion_rows(prompt->session, number, system, DIGITS, UINT32_MAX, add_motion_row, &table);
    text_table_write(&table, prompt->output);
}

static bool run_energy(Prompt *prompt, const char *wanted) {
    return print_systems(prompt, &(SystemRequest){.system = wanted}, print_energy);
}

static void print_trust(void *user_data, const PetriTrust *trust) {
    Prompt *prompt = user_data;
    output_format(prompt->output, "%s\n", trust->value[0] != '\0' ? trust->value : "null");
    if (trust->digits >= 0)
        prompt_note(prompt, "error %.2g, spread %.2g, %d digits", trust->error, trust->spread, trust->digits);
    prompt_note(prompt, "%s", trust->sentence);
}

// Runs the script again from frame 0 to the current frame.
static bool run_trust(Prompt *prompt, const char *expression) {
    int64_t frame = petri_frame_number(prompt->session);
    const PetriTrustOptions options = {.size = sizeof options,
                                       .expressions = &expression,
                                       .count = 1,
                                       .frames = frame + 1,
                                       .report = print_trust,
                                       .user_data = prompt};
    if (frame < 0)
        return prompt_fail(prompt, "no frame yet; step first");
    prompt_busy(prompt);
    PetriStatus status = petri_trust(prompt->session, &options);
    prompt_idle(prompt);
    return prompt_status(prompt, status);
}

static bool run_watch(Prompt *prompt, const char *rest) {
    PetriEvaluation result;
    Expression expression;
    for (size_t i = 0; i < prompt->watched.count && rest[0] == '\0'; i++)
        prompt_note(prompt, "%s", prompt->watched.items[i].typed);
    if (rest[0] == '\0')
        return true;
    if (!expression_parse(prompt, rest, &expression))
        return false;
    if (!expression_learn(prompt, &expression)) {
        expression_free(&expression);
        return false;
    }
    SCOPED_TEXT value = {0};
    expression_evaluate(prompt, &expression, &result, &value);
    output_format(prompt->output, "%s = %s\n", rest, value.len > 0 ? value.bytes : "");
    if (expressions_find(&prompt->watched, rest) < prompt->watched.count)
        expression_free(&expression);
    else
        expressions_add(&prompt->watched, &expression);
    return true;
}

static bool run_unwatch(Prompt *prompt, const char *rest) {
    return expressions_remove(&prompt->watched, rest) || prompt_fail(prompt, "not watched: '%s'", rest);
}

const PromptCommand PRINT_COMMANDS[] = {
    {".state", "[KEY] [N|all]", NULL, "print the state, or its entries under KEY, such as :cells; at most N lines",
     run_state, COMPLETE_KEYS},
    {".tree", "[KIND] [N|all]", NULL, "print the frame's nodes, or only those of KIND; at most N lines", run_tree,
     COMPLETE_KINDS},
    {".particles", "[SYSTEM] [N|all]", NULL, "print particles as a table: id, position, velocity, speed, force",
     run_particles, COMPLETE_SYSTEMS},
    {".energy", "[SYSTEM]", NULL, "print energies, momenta and the fastest particle of each system", run_energy,
     COMPLETE_SYSTEMS},
    {".trust", "EXPR", "an expression", "say how many digits of EXPR are true, from other runs to this frame",
     run_trust, COMPLETE_LANGUAGE},
    {".watch", "[EXPR]", NULL, "print EXPR after each step; without EXPR, list the watched expressions", run_watch,
     COMPLETE_LANGUAGE},
    {".unwatch", "[EXPR]", NULL, "stop watching EXPR, or everything", run_unwatch, COMPLETE_WATCHED},
    {0},
};
