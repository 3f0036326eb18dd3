// xyz.c: see xyz.h.
//
// Extended XYZ has one block per frame with all systems. The format has three dimensions: missing components are 0, and
// components after the third have columns that are named as in CSV. The species is always X, which ASE and OVITO accept
// as "no element". Not all readers accept text in columns, so names of ids and systems are in the second line.
#include "run/xyz.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { XYZ_DIMENSIONS = 3 };

void xyz_free(XyzNames *names) {
    id_numbers_free(&names->ids);
    id_numbers_free(&names->systems);
}

// Percent-encodes blanks, quotes, backslashes and all bytes that are not ASCII, so that readers can split the line.
static void add_encoded(Text *line, const char *text) {
    for (const unsigned char *c = (const unsigned char *)text; *c != '\0'; c++)
        if (*c > ' ' && *c < 0x7f && !strchr("\"\\%", *c))
            text_add_char(line, (char)*c);
        else
            text_add_format(line, "%%%02X", *c);
}

static void add_name(Text *line, int64_t number, const char *name) {
    text_add_format(line, "%s%" PRId64 "=", line->len > 0 ? " " : "", number);
    add_encoded(line, name);
}

static void decode(Text *name, Str encoded) {
    for (size_t i = 0; i < encoded.len; i++) {
        bool coded = encoded.bytes[i] == '%' && i + 2 < encoded.len;
        int high = coded ? str_hex_digit(encoded.bytes[i + 1]) : -1;
        int low = coded ? str_hex_digit(encoded.bytes[i + 2]) : -1;
        bool valid = high >= 0 && low >= 0;
        text_add_char(name, valid ? (char)(16 * high + low) : encoded.bytes[i]);
        i += valid ? 2 : 0;
    }
}

// Reads a list `key="NUMBER=NAME NUMBER=NAME"`, where the number of the K-th new name is first + step * K. Returns
// false if the line has no such list.
static bool read_list(IdNumbers *numbers, const char *line, const char *key, int64_t first, int64_t step) {
    const char *at = strstr(line, key);
    if (!at)
        return false;
    for (at += strlen(key); *at != '"';) {
        char *end;
        int64_t number = strtoll(at, &end, 10);
        size_t length = *end == '=' ? strcspn(end + 1, " \"\n") : 0;
        if (length == 0)
            return false;
        SCOPED_TEXT name = {0};
        decode(&name, (Str){end + 1, length});
        uint32_t position;
        if (!id_numbers_find(numbers, name.bytes, &position) || first + step * (int64_t)position != number)
            return false;
        at = end + 1 + length;
        at += *at == ' ';
    }
    return true;
}

bool xyz_read_names(XyzNames *names, const char *line) {
    return read_list(&names->systems, line, " systems=\"", 0, 1) &&
           (!strstr(line, " id_texts=\"") || read_list(&names->ids, line, " id_texts=\"", -2, -1));
}

// The data of a frame that its second line describes.
typedef struct XyzFrame {
    uint64_t count;      // number of particles
    uint32_t dimensions; // largest number of dimensions of a system
    Text ids;            // int64_t for each particle
    Text system_numbers; // uint32_t for each system
    Text id_texts;       // list of the ids that are not whole numbers
    Text systems;        // list of the systems
    ParticlesEnergies energies;
} XyzFrame;

static void free_frame(XyzFrame *frame) {
    text_free(&frame->ids);
    text_free(&frame->system_numbers);
    text_free(&frame->id_texts);
    text_free(&frame->systems);
}

static bool read_frame(XyzFrame *frame, XyzNames *names, PetriSession *session, const ParticlesEnergies *energies) {
    PetriSystem system;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++) {
        uint32_t number;
        if (!id_numbers_find(&names->systems, system.name, &number) ||
            !id_numbers_of_system(&names->ids, session, s, &system, &frame->ids))
            return false;
        text_add(&frame->system_numbers, (Str){(const char *)&number, sizeof number});
        add_name(&frame->systems, number, system.name);
        frame->count += system.particle_count;
        frame->energies.kinetic += energies ? energies[s].kinetic : 0;
        frame->energies.potential += energies ? energies[s].potential : 0;
    }
    const int64_t *ids = (const int64_t *)(const void *)frame->ids.bytes;
    for (uint64_t i = 0; i < frame->count; i++) {
        const char *text = id_numbers_text(&names->ids, ids[i]);
        if (text)
            add_name(&frame->id_texts, ids[i], text);
    }
    frame->dimensions = particles_dimensions(session);
    return true;
}

static void write_head(Output *output, PetriSession *session, const XyzFrame *frame, bool energies) {
    PetriFrame now;
    petri_frame(session, &now, sizeof now);
    output_format(output,
                  "%" PRIu64 "\nProperties=species:S:1:pos:R:3:velo:R:3:radius:R:1:mass:R:1:charge:R:1:"
                  "id:I:1:system:I:1:anchor:I:1",
                  frame->count);
    for (const char *name = "xv"; *name != '\0'; name++)
        for (uint32_t k = XYZ_DIMENSIONS + 1; k <= frame->dimensions; k++)
            output_format(output, ":%c%" PRIu32 ":R:1", *name, k);
    if (energies) {
        output_format(output, " kinetic_energy");
        output_number(output, '=', frame->energies.kinetic);
        output_format(output, " potential_energy");
        output_number(output, '=', frame->energies.potential);
    }
    output_format(output, " systems=\"%s\"", frame->systems.len > 0 ? frame->systems.bytes : "");
    if (frame->id_texts.len > 0)
        output_format(output, " id_texts=\"%s\"", frame->id_texts.bytes);
    output_format(output, " Time");
    output_number(output, '=', now.time);
    output_format(output, " Frame=%" PRId64 "\n", now.number);
}

static double column_number(PetriColumn column, uint32_t particle) {
    return column.data[particle * column.stride];
}

// Writes the components from `first` to end - 1.
static void write_vector(Output *output, const PetriSystem *system, PetriColumn column, uint32_t particle,
                         uint32_t first, uint32_t end) {
    for (uint32_t k = first; k < end; k++)
        output_number(output, ' ', k < system->dimensions ? column.data[particle * column.stride + k] : 0);
}

static void write_particle(Output *output, const PetriSystem *system, uint32_t i, int64_t id, uint32_t system_number,
                           uint32_t dimensions) {
    output_write(output, "X", 1);
    write_vector(output, system, system->position, i, 0, XYZ_DIMENSIONS);
    write_vector(output, system, system->velocity, i, 0, XYZ_DIMENSIONS);
    output_number(output, ' ', column_number(system->radius, i));
    output_number(output, ' ', column_number(system->mass, i));
    output_number(output, ' ', column_number(system->charge, i));
    output_number(output, ' ', (double)id); // at most 2^53
    output_number(output, ' ', system_number);
    output_write(output, system->anchor[i * system->anchor_stride] ? " 1" : " 0", 2);
    write_vector(output, system, system->position, i, XYZ_DIMENSIONS, dimensions);
    write_vector(output, system, system->velocity, i, XYZ_DIMENSIONS, dimensions);
    output_write(output, "\n", 1);
}

static void write_particles(Output *output, PetriSession *session, const XyzFrame *frame) {
    const int64_t *ids = (const int64_t *)(const void *)frame->ids.bytes;
    const uint32_t *numbers = (const uint32_t *)(const void *)frame->system_numbers.bytes;
    PetriSystem system;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++)
        for (uint32_t i = 0; i < system.particle_count; i++)
            write_particle(output, &system, i, *ids++, numbers[s], frame->dimensions);
}

bool xyz_add(XyzNames *names, PetriSession *session, const ParticlesEnergies *energies, Output *output) {
    XyzFrame frame = {0};
    bool complete = read_frame(&frame, names, session, energies);
    if (complete) {
        write_head(output, session, &frame, energies);
        write_particles(output, session, &frame);
    }
    free_frame(&frame);
    return complete;
}
