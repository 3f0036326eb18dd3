// compare.c: properties with a name, about two runs of the same case; see property.h.
//
// `independent of order` reverses the order of nodes next to each other, and of loops over ranges that begin at 0.
#include "base/file.h"
#include "base/number.h"
#include "property/property.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ORDER_FRAMES: frames that are compared with another order. Chaotic motion amplifies differences in the last bit
// later.
enum { ORDER_FRAMES = 10 };

// --- another order

typedef struct Block {
    Str text; // a line and the lines below it that are indented more
    bool moves;
} Block;

static size_t indentation(const char *line) {
    return strspn(line, " \t");
}

// Returns the end of the block that begins at `at`. Empty lines belong to the block before them.
static const char *end_of_block(const char *at, const char *end) {
    size_t indent = indentation(at);
    do {
        const char *next = memchr(at, '\n', (size_t)(end - at));
        at = next ? next + 1 : end;
    } while (at < end && (indentation(at) > indent || at[indentation(at)] == '\n'));
    return at;
}

static void add_reversed(Text *out, const char *at, const char *end, bool in_system);

static void add_blocks(Text *out, const Block *blocks, size_t count) {
    for (size_t i = count; i-- > 0;)
        text_add(out, blocks[i].text);
}

// Adds the lines of a block. The order of its children is reversed if it is part of a system.
static void add_block(Text *out, const char *at, const char *end, bool in_system) {
    const char *line = at + indentation(at), *newline = memchr(at, '\n', (size_t)(end - at));
    const char *below = newline ? newline + 1 : end;
    bool system = in_system || strncmp(line, "!physics", 8) == 0;
    text_add(out, (Str){at, (size_t)(below - at)});
    if (out->len > 0 && out->bytes[out->len - 1] != '\n')
        text_add_c(out, "\n");
    add_reversed(out, below, end, system);
}

// Adds lines with the same indentation, and what is below them. Runs of nodes and loops are reversed within a system.
static void add_reversed(Text *out, const char *at, const char *end, bool in_system) {
    enum { MAX_RUN = 200 };
    Text texts[MAX_RUN];
    Block run[MAX_RUN];
    size_t count = 0;
    while (at < end) {
        const char *next = end_of_block(at, end), *line = at + indentation(at);
        bool moves = in_system && (line[0] == '!' || strncmp(line, "for ", 4) == 0) && count < MAX_RUN;
        if (!moves) {
            add_blocks(out, run, count);
            for (size_t i = 0; i < count; i++)
                text_free(&texts[i]);
            count = 0;
            add_block(out, at, next, in_system);
        } else {
            texts[count] = (Text){0};
            add_block(&texts[count], at, next, in_system);
            run[count] = (Block){.text = text_str(&texts[count])};
            count++;
        }
        at = next;
    }
    add_blocks(out, run, count);
    for (size_t i = 0; i < count; i++)
        text_free(&texts[i]);
}

// Returns the script with its nodes in another order; empty: it cannot be read.
static Text reversed_script(const Properties *properties) {
    SCOPED_TEXT text = {0};
    Text result = {0};
    if (properties->override)
        text_add_c(&text, properties->override);
    else if (text_read_file(&text, properties->script, SIZE_MAX))
        return result;
    if (text.len > 0)
        add_reversed(&result, text.bytes, text.bytes + text.len, false);
    text_add_c(&result, "");
    return result;
}

// --- comparison

// Returns the largest absolute value of a position.
static double extent(PetriSession *session) {
    PetriSystem system;
    double largest = 0;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++)
        for (uint32_t i = 0; i < system.particle_count; i++)
            for (uint32_t k = 0; k < system.dimensions; k++)
                largest = fmax(largest, fabs(system.position.data[(size_t)i * system.position.stride + k]));
    return largest;
}

// Compares the position of a particle with that in the other run. Returns false if they differ.
static bool same_particle(PetriSession *const *sessions, size_t number, uint32_t particle, double limit,
                          Violation *violation) {
    PetriSystem systems[2];
    uint32_t other = 0, dimensions;
    double distance = 0;
    PetriValue id = petri_particle_id(sessions[0], number, particle);
    if (!petri_find_particle(sessions[1], number, id, &other) ||
        !petri_system(sessions[0], number, &systems[0], sizeof systems[0]) ||
        !petri_system(sessions[1], number, &systems[1], sizeof systems[1]))
        return true;
    dimensions = systems[0].dimensions < systems[1].dimensions ? systems[0].dimensions : systems[1].dimensions;
    const double *a = systems[0].position.data + (size_t)particle * systems[0].position.stride;
    const double *b = systems[1].position.data + (size_t)other * systems[1].position.stride;
    for (uint32_t k = 0; k < dimensions; k++)
        distance = fmax(distance, isfinite(a[k]) && isfinite(b[k]) ? fabs(a[k] - b[k]) : 0);
    if (distance <= limit)
        return true;
    text_add_c(&violation->what, "the positions differ by ");
    text_add_number(&violation->what, distance);
    motion_add_key(sessions[0], number, particle, &violation->particle);
    return false;
}

static bool same_positions(PetriSession *const *sessions, double amount, Violation *violation) {
    double limit = amount * fmax(extent(sessions[0]), extent(sessions[1]));
    PetriSystem system;
    for (size_t s = 0; petri_system(sessions[0], s, &system, sizeof system); s++)
        for (uint32_t i = 0; i < system.particle_count; i++)
            if (!same_particle(sessions, s, i, limit, violation))
                return false;
    return true;
}

// Halves the longest step that the first frames have taken.
static void halve_steps(PetriSession *session) {
    PetriSystem system;
    PetriFrame frame;
    if (petri_system(session, 0, &system, sizeof system) && petri_frame(session, &frame, sizeof frame) &&
        system.steps > 0 && frame.fps > 0)
        petri_set_resolution(session, 0.5 / (frame.fps * (double)system.steps));
}

bool compare_holds(Attempt *attempt, const Property *property, Violation *violation) {
    const Properties *properties = attempt->properties;
    bool order = property->kind == PROPERTY_ORDER, holds = true;
    SCOPED_TEXT reversed = order ? reversed_script(properties) : (Text){0};
    PetriSession *sessions[] = {attempt_open(attempt, properties->override),
                                attempt_open(attempt, order ? reversed.bytes : properties->override)};
    int64_t frames = order && properties->frames > ORDER_FRAMES ? ORDER_FRAMES : properties->frames;
    for (int64_t frame = 0; holds && sessions[0] && sessions[1] && frame < frames; frame++) {
        if (petri_step(sessions[0]) != PETRI_OK || petri_step(sessions[1]) != PETRI_OK)
            break;
        if (!order && frame == 1)
            halve_steps(sessions[1]);
        holds = frame == 0 || same_positions(sessions, property->amount, violation);
        violation->frame = frame;
    }
    petri_close(&sessions[0]);
    petri_close(&sessions[1]);
    return holds;
}
