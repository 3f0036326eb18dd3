// show.c: what a frame holds, as text: state, nodes, particles, and expressions that are watched.
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/motion.h"
#include "cli/table.h"
#include "repl/repl.h"

enum { AROUND = 3 }; // lines of the screen that a long output leaves: the command, the closing line, the prompt

// Looks through the lines of a section of the frame's text.
typedef struct Filter {
    Repl *repl;
    const char *wanted;
    size_t depth; // of the node whose subtree is being written, SIZE_MAX outside
    size_t found;
    size_t lines; // that were to be written, of which the first `most` are
    size_t most;
    void (*take)(struct Filter *filter, const char *line, size_t length);
} Filter;

static bool collect_unless_stopped(void *bytes, const char *text, size_t length) {
    return bytes_collect(bytes, text, length) && !repl_interrupted();
}

// Writes a section through a filter; returns how much it has found.
static size_t print_filtered(Repl *repl, unsigned section, Filter *filter) {
    SCOPED_BYTES text = {0};
    Str line;
    size_t at = 0;
    filter->depth = SIZE_MAX;
    repl_busy(repl);
    petri_print(repl->session, section, collect_unless_stopped, &text);
    bytes_line(&text, &at, &line); // the frame's `@` line
    while (bytes_line(&text, &at, &line) && filter->repl->output.error == 0 && !repl_interrupted()) {
        filter->take(filter, line.bytes, line.len + 1);
    }
    repl_idle(repl);
    return filter->found;
}

static void write_line(Filter *filter, const char *line, size_t length) {
    if (filter->lines++ < filter->most) {
        output_write(&filter->repl->output, line, length);
    }
}

// What was left out, and how it is seen: `asked` is what was typed, without a number of lines.
static void tell_rest(const Filter *filter, const char *command, const char *asked) {
    if (filter->lines > filter->most) {
        repl_say(filter->repl, "%zu more lines; %s%s%s all shows all", filter->lines - filter->most, command,
                 asked[0] == '\0' ? "" : " ", asked);
    }
}

// `$:cells = …` and `$(:cells;0) = …` are both under `:cells`, and under `$:cells`, `(:cells)` and `cells` as well.
static void take_entry(Filter *filter, const char *line, size_t length) {
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

static bool run_state(Repl *repl, const char *rest) {
    SCOPED_TEXT asked = memory_text(rest);
    // A number alone is a key.
    bool counted = strpbrk(asked, " \t") != NULL || strcmp(asked, "all") == 0;
    size_t most = word_lines(repl, counted ? asked : (char[]){""}, AROUND);
    const char *prefix = asked + (asked[0] == '$');
    bool enclosed = prefix[0] == '(';
    size_t length = strlen(prefix) - enclosed;
    length -= enclosed && length > 0 && prefix[length] == ')';
    SCOPED_TEXT wanted = memory_copied(prefix + enclosed, length);
    Filter filter = {.wanted = wanted, .repl = repl, .take = take_entry, .most = most};
    if (print_filtered(repl, PETRI_PRINT_STATE, &filter) == 0) {
        repl_say(repl, wanted[0] == '\0' ? "the state is empty" : "nothing in the state is under %s", wanted);
    }
    tell_rest(&filter, ".state", asked);
    return true;
}

static void take_node(Filter *filter, const char *line, size_t length) {
    size_t depth = strspn(line, " "), wanted = strlen(filter->wanted);
    if (filter->depth == SIZE_MAX || depth <= filter->depth) {
        const char *kind = line + depth + 1;
        bool same = wanted == 0 || (strncmp(kind, filter->wanted, wanted) == 0 && strchr(" \n", kind[wanted]) != NULL);
        filter->depth = same ? depth : SIZE_MAX;
        filter->found += same;
    }
    if (filter->depth != SIZE_MAX) {
        size_t cut = wanted == 0 ? 0 : filter->depth;
        write_line(filter, line + cut, length - cut);
    }
}

static bool run_tree(Repl *repl, const char *rest) {
    SCOPED_TEXT asked = memory_text(rest);
    size_t most = word_lines(repl, asked, AROUND);
    const char *kind = asked + (asked[0] == '!');
    repl_busy(repl);
    PetriStatus status = petri_preview(repl->session);
    repl_idle(repl);
    Filter filter = {.repl = repl, .wanted = kind, .take = take_node, .most = most};
    if (status == PETRI_OK && print_filtered(repl, PETRI_PRINT_TREE, &filter) == 0) {
        repl_say(repl, kind[0] == '\0' ? "the frame has no nodes" : "the frame has no node !%s", kind);
    }
    tell_rest(&filter, ".tree", asked);
    return repl_status(repl, status);
}

static bool is_meant(const char *name, const char *wanted) {
    return wanted[0] == '\0' || strcmp(name, wanted) == 0 || (name[0] == ':' && strcmp(name + 1, wanted) == 0);
}

// What a table is asked for.
typedef struct Wish {
    const char *system; // "": all of them
    size_t most;        // rows of each
} Wish;

// Calls `show` for each system that is meant.
static bool each_system(Repl *repl, const Wish *wish, void (*show)(Repl *, size_t, const PetriSystem *, const Wish *)) {
    PetriSystem system;
    const char *wanted = wish->system;
    size_t count = 0, shown = 0;
    repl_complete_frame(repl);
    for (; petri_system(repl->session, count, &system); count++) {
        if (is_meant(system.name, wanted)) {
            show(repl, count, &system, wish);
            shown++;
        }
    }
    if (count == 0) {
        repl_say(repl, petri_frame(repl->session).number < 0
                           ? "there are no particles before the first frame; .step makes it"
                           : "no particle system was updated in this frame");
    } else if (shown == 0) {
        return repl_fail(repl, "there is no system '%.40s'", wanted);
    }
    return true;
}

static void add_vector(Table *table, const double *vector, uint32_t dimensions) {
    SCOPED_BYTES cell = {0};
    for (uint32_t k = 0; k < dimensions && vector != NULL; k++) {
        bytes_format(&cell, "%s%.6g", k == 0 ? "" : ";", vector[k]);
    }
    table_add(table, vector == NULL ? "-" : cell.data);
}

static void add_number(Table *table, double x) {
    add_vector(table, &x, 1);
}

static const double *row(PetriColumn column, uint32_t particle) {
    return column.data == NULL ? NULL : column.data + particle * column.stride;
}

static bool is_anchor(const PetriSystem *system, uint32_t particle) {
    return system->anchor[particle * system->anchor_stride];
}

static uint32_t count_anchors(const PetriSystem *system) {
    uint32_t anchors = 0;
    for (uint32_t i = 0; i < system->particle_count; i++) {
        anchors += is_anchor(system, i);
    }
    return anchors;
}

static void show_particles(Repl *repl, size_t number, const PetriSystem *system, const Wish *wish) {
    SCOPED_TABLE table = table_new(5);
    uint32_t anchors = count_anchors(system), moving = system->particle_count - anchors;
    output_format(&repl->output, "%s: %" PRIu32 " particle%s", system->name, moving, moving == 1 ? "" : "s");
    if (anchors > 0) {
        output_format(&repl->output, ", %" PRIu32 " anchor%s", anchors, anchors == 1 ? "" : "s");
    }
    output_write(&repl->output, "\n", 1);
    const char *const heads[] = {"id", "position", "velocity", "speed", "force"};
    for (size_t i = 0; i < 5; i++) {
        table_add(&table, heads[i]);
    }
    for (uint32_t i = 0; i < wish->most && i < system->particle_count; i++) {
        const char *id = petri_text(repl->session, petri_id(repl->session, number, i));
        table_add(&table, id == NULL ? "" : id);
        add_vector(&table, row(system->position, i), system->dimensions);
        add_vector(&table, row(system->velocity, i), system->dimensions);
        add_number(&table, particle_speed(system, i));
        if (is_anchor(system, i)) {
            table_add(&table, "anchor");
        } else {
            add_vector(&table, row(system->force, i), system->dimensions);
        }
    }
    table_write(&table, &repl->output);
    if (system->particle_count > wish->most) {
        repl_say(repl, "%zu more; .particles%s%s all shows all", system->particle_count - wish->most,
                 wish->system[0] == '\0' ? "" : " ", wish->system);
    }
}

static bool run_particles(Repl *repl, const char *rest) {
    enum { AROUND_TABLE = 5 }; // lines of the screen beside the rows: command, title, heads, closing line, prompt
    SCOPED_TEXT system = memory_text(rest);
    Wish wish = {.system = system, .most = word_lines(repl, system, AROUND_TABLE)};
    bool good = each_system(repl, &wish, show_particles);
    return good;
}

static void show_energy(Repl *repl, size_t number, const PetriSystem *system, const Wish *wish) {
    (void)wish;
    Motion motion = motion_measure(system);
    output_format(&repl->output, "%s: %" PRIu32 " particle%s, %" PRIu64 " step%s\n", system->name, motion.moving,
                  motion.moving == 1 ? "" : "s", system->steps, system->steps == 1 ? "" : "s");
    if (motion.moving > 0) {
        SCOPED_BYTES fastest = {0};
        SCOPED_TABLE table = table_new(2);
        table_add(&table, "  kinetic energy");
        add_number(&table, motion.kinetic_energy);
        table_add(&table, "  momentum");
        add_vector(&table, motion.momentum, system->dimensions);
        table_add(&table, "  fastest");
        const char *id = petri_text(repl->session, petri_id(repl->session, number, motion.fastest_particle));
        bytes_format(&fastest, "%s at %.6g", id == NULL ? "" : id, motion.fastest);
        table_add(&table, fastest.data);
        table_write(&table, &repl->output);
    }
    motion_free(&motion);
}

static bool run_energy(Repl *repl, const char *wanted) {
    return each_system(repl, &(Wish){.system = wanted}, show_energy);
}

static bool run_watch(Repl *repl, const char *rest) {
    PetriResult result;
    for (size_t i = 0; i < repl->watched.count && rest[0] == '\0'; i++) {
        repl_say(repl, "%s", repl->watched.items[i]);
    }
    if (rest[0] == '\0') {
        return true;
    }
    SCOPED_BYTES value = {0};
    if (!repl_status(repl, petri_evaluate(repl->session, rest, PETRI_Z, &result, bytes_collect, &value))) {
        return false;
    }
    output_format(&repl->output, "%s = %s\n", rest, value.data);
    if (!texts_hold(&repl->watched, rest)) { // once is enough
        texts_add(&repl->watched, rest);
    }
    return true;
}

static bool run_unwatch(Repl *repl, const char *rest) {
    size_t kept = 0, count = repl->watched.count;
    for (size_t i = 0; i < count; i++) {
        if (rest[0] == '\0' || strcmp(rest, repl->watched.items[i]) == 0) {
            free(repl->watched.items[i]);
        } else {
            repl->watched.items[kept++] = repl->watched.items[i];
        }
    }
    repl->watched.count = kept;
    return rest[0] == '\0' || kept < count || repl_fail(repl, "'%s' is not watched", rest);
}

const ReplCommand SHOW_COMMANDS[] = {
    {".state", "[KEY] [N|all]", NULL, "print the state, or the part of it under a key such as :cells; N lines of it",
     run_state, COMPLETE_KEYS},
    {".tree", "[KIND] [N|all]", NULL, "print the frame's nodes, or those of a kind", run_tree, COMPLETE_KINDS},
    {".particles", "[SYSTEM] [N|all]", NULL, "print particles as a table: id, position, velocity, speed, force",
     run_particles, COMPLETE_SYSTEMS},
    {".energy", "[SYSTEM]", NULL, "print kinetic energy, momentum and the fastest particle of each system", run_energy,
     COMPLETE_SYSTEMS},
    {".watch", "[EXPR]", NULL, "print the expression after each step; alone, list what is watched", run_watch,
     COMPLETE_LANGUAGE},
    {".unwatch", "[EXPR]", NULL, "watch it no more; alone, nothing any more", run_unwatch, COMPLETE_LANGUAGE},
    {0},
};
