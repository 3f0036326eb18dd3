// repl_show.c: what a frame holds, as text: state, nodes, particles, energies.
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "repl.h"
#include "repl_table.h"

// Text that comes in pieces, cut into lines for a filter.
typedef struct Filter {
    Repl *repl;
    const char *wanted;
    size_t depth; // of the node whose subtree is being written, SIZE_MAX outside
    size_t found;
    bool header; // the `@` line is still to come
    Bytes line;
    void (*take)(struct Filter *filter, const char *line, size_t length);
} Filter;

static bool filter_lines(void *host, const char *text, size_t length) {
    Filter *filter = host;
    while (length > 0) {
        const char *end = memchr(text, '\n', length);
        size_t taken = end == NULL ? length : (size_t)(end - text) + 1;
        bytes_add(&filter->line, text, taken);
        text += taken;
        length -= taken;
        if (end != NULL) {
            if (!filter->header) {
                filter->take(filter, filter->line.data, filter->line.length);
            }
            filter->header = false;
            filter->line.length = 0;
        }
    }
    return filter->repl->output.error == 0 && !repl_interrupted();
}

// Writes a section of the frame's text through a filter; returns how much it has found.
static size_t print_filtered(Repl *repl, unsigned section, Filter *filter) {
    filter->repl = repl;
    filter->header = true;
    filter->depth = SIZE_MAX;
    repl_busy(repl);
    petri_print(repl->session, section, filter_lines, filter);
    repl_idle(repl);
    bytes_free(&filter->line);
    return filter->found;
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
        output_write(&filter->repl->output, line, length);
    }
}

bool repl_show_state(Repl *repl, const char *prefix) {
    prefix += prefix[0] == '$';
    bool enclosed = prefix[0] == '(';
    char *wanted = memory_copied(prefix + enclosed, strlen(prefix + enclosed));
    size_t length = strlen(wanted);
    if (enclosed && length > 0 && wanted[length - 1] == ')') {
        wanted[length - 1] = '\0';
    }
    Filter filter = {.wanted = wanted, .take = take_entry};
    if (print_filtered(repl, PETRI_PRINT_STATE, &filter) == 0) {
        repl_say(repl, wanted[0] == '\0' ? "the state is empty" : "nothing in the state is under %s", wanted);
    }
    free(wanted);
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
        output_write(&filter->repl->output, line + cut, length - cut);
    }
}

bool repl_show_tree(Repl *repl, const char *kind) {
    kind += kind[0] == '!';
    repl_busy(repl);
    PetriStatus status = petri_preview(repl->session);
    repl_idle(repl);
    if (!repl_status(repl, status)) {
        return false;
    }
    Filter filter = {.wanted = kind, .take = take_node};
    if (print_filtered(repl, PETRI_PRINT_TREE, &filter) == 0) {
        repl_say(repl, kind[0] == '\0' ? "the frame has no nodes" : "the frame has no node !%s", kind);
    }
    return true;
}

static bool is_meant(const char *name, const char *wanted) {
    return wanted[0] == '\0' || strcmp(name, wanted) == 0 || (name[0] == ':' && strcmp(name + 1, wanted) == 0);
}

// Calls `show` for each system that is meant.
static bool each_system(Repl *repl, const char *wanted, void (*show)(Repl *, size_t, const PetriSystem *)) {
    PetriSystem system;
    size_t count = 0, shown = 0;
    for (; petri_system(repl->session, count, &system); count++) {
        char *name = memory_copied(system.name, strlen(system.name)); // the next call takes it
        system.name = name;
        if (is_meant(name, wanted)) {
            show(repl, count, &system);
            shown++;
        }
        free(name);
    }
    if (count == 0) {
        repl_say(repl, "no particle system was updated in this frame");
    } else if (shown == 0) {
        return repl_fail(repl, "there is no system '%.40s'", wanted);
    }
    return true;
}

static void add_vector(Table *table, const double *vector, uint32_t dimensions) {
    char number[40];
    Bytes cell = {0};
    for (uint32_t k = 0; k < dimensions && vector != NULL; k++) {
        snprintf(number, sizeof number, "%s%.6g", k == 0 ? "" : ";", vector[k]);
        bytes_add(&cell, number, strlen(number));
    }
    table_add(table, vector == NULL ? "-" : cell.data);
    bytes_free(&cell);
}

static void add_number(Table *table, double x) {
    add_vector(table, &x, 1);
}

static double speed_of(const PetriParticle *particle, uint32_t dimensions) {
    double sum = 0;
    for (uint32_t k = 0; k < dimensions; k++) {
        sum += particle->velocity[k] * particle->velocity[k];
    }
    return sqrt(sum);
}

static uint32_t count_anchors(const Repl *repl, size_t number) {
    PetriParticle particle;
    uint32_t anchors = 0;
    for (uint32_t i = 0; petri_particle(repl->session, number, i, &particle); i++) {
        anchors += particle.anchor;
    }
    return anchors;
}

static void show_particles(Repl *repl, size_t number, const PetriSystem *system) {
    Table table = table_new(5);
    PetriParticle particle;
    uint32_t anchors = count_anchors(repl, number), moving = system->particle_count - anchors;
    output_format(&repl->output, "%s: %" PRIu32 " particle%s", system->name, moving, moving == 1 ? "" : "s");
    if (anchors > 0) {
        output_format(&repl->output, ", %" PRIu32 " anchor%s", anchors, anchors == 1 ? "" : "s");
    }
    output_write(&repl->output, "\n", 1);
    const char *const heads[] = {"id", "position", "velocity", "speed", "force"};
    for (size_t i = 0; i < 5; i++) {
        table_add(&table, heads[i]);
    }
    for (uint32_t i = 0; petri_particle(repl->session, number, i, &particle); i++) {
        table_add(&table, particle.id);
        add_vector(&table, particle.position, system->dimensions);
        add_vector(&table, particle.velocity, system->dimensions);
        add_number(&table, speed_of(&particle, system->dimensions));
        if (particle.anchor) {
            table_add(&table, "anchor");
        } else {
            add_vector(&table, particle.force, system->dimensions);
        }
    }
    table_write(&table, &repl->output);
    table_free(&table);
}

bool repl_show_particles(Repl *repl, const char *wanted) {
    return each_system(repl, wanted, show_particles);
}

static void show_energy(Repl *repl, size_t number, const PetriSystem *system) {
    PetriParticle particle;
    double *momentum = memory_zeroed(system->dimensions * sizeof *momentum);
    double energy = 0, fastest = -1;
    uint32_t moving = 0;
    Bytes id = {0};
    for (uint32_t i = 0; petri_particle(repl->session, number, i, &particle); i++) {
        if (particle.anchor) {
            continue;
        }
        double speed = speed_of(&particle, system->dimensions);
        moving++;
        energy += 0.5 * particle.mass * speed * speed;
        for (uint32_t k = 0; k < system->dimensions; k++) {
            momentum[k] += particle.mass * particle.velocity[k];
        }
        if (speed > fastest) {
            fastest = speed;
            id.length = 0;
            bytes_add(&id, particle.id, strlen(particle.id));
        }
    }
    output_format(&repl->output, "%s: %" PRIu32 " particle%s, %" PRIu64 " step%s\n", system->name, moving,
                  moving == 1 ? "" : "s", system->steps, system->steps == 1 ? "" : "s");
    if (moving > 0) {
        Table table = table_new(2);
        table_add(&table, "  kinetic energy");
        add_number(&table, energy);
        table_add(&table, "  momentum");
        add_vector(&table, momentum, system->dimensions);
        table_add(&table, "  fastest");
        bytes_format(&id, " at %.6g", fastest);
        table_add(&table, id.data);
        table_write(&table, &repl->output);
        table_free(&table);
    }
    bytes_free(&id);
    free(momentum);
}

bool repl_show_energy(Repl *repl, const char *wanted) {
    return each_system(repl, wanted, show_energy);
}
