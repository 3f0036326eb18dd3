// particles.c: see particles.h.
#include "cli/particles.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct RowWriter {
    uint32_t dimensions;
    PetriWriteCallback *write;
    void *host;
} RowWriter;

// Writes formatted text of at most 63 bytes.
__attribute__((format(printf, 2, 3))) static void write_format(const RowWriter *writer, const char *format, ...) {
    char text[64];
    va_list list;
    va_start(list, format);
    int length = vsnprintf(text, sizeof text, format, list);
    va_end(list);
    writer->write(writer->host, text, (size_t)length);
}

void csv_write(Str cell, PetriWriteCallback *write, void *user_data) {
    bool plain = true;
    for (size_t i = 0; i < cell.len; i++)
        plain = plain && !strchr(",\"\r\n", cell.bytes[i]);
    if (plain) {
        write(user_data, cell.bytes, cell.len);
        return;
    }
    write(user_data, "\"", 1);
    for (const char *c = cell.bytes; c < cell.bytes + cell.len; c++)
        write(user_data, *c == '"' ? "\"\"" : c, *c == '"' ? 2 : 1);
    write(user_data, "\"", 1);
}

static void write_vector(const RowWriter *writer, const PetriSystem *system, PetriColumn column, uint32_t particle) {
    for (uint32_t k = 0; k < writer->dimensions; k++)
        if (k < system->dimensions)
            write_format(writer, ",%.17g", column.data[particle * column.stride + k]);
        else
            write_format(writer, ",");
}

static void write_number(const RowWriter *writer, PetriColumn column, uint32_t particle) {
    write_format(writer, ",%.17g", column.data[particle * column.stride]);
}

uint32_t particles_dimensions(PetriSession *session) {
    PetriSystem system;
    uint32_t max_dimensions = 1;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++)
        max_dimensions = system.dimensions > max_dimensions ? system.dimensions : max_dimensions;
    return max_dimensions;
}

void particles_header(uint32_t dimensions, bool energies, PetriWriteCallback *write, void *user_data) {
    const RowWriter writer = {dimensions, write, user_data};
    write_format(&writer, "frame,time,system,id,anchor");
    for (const char *name = "xv"; *name != '\0'; name++)
        for (uint32_t k = 1; k <= dimensions; k++)
            write_format(&writer, ",%c%" PRIu32, *name, k);
    write_format(&writer, ",radius,mass,charge%s\n", energies ? ",kinetic_energy,potential_energy" : "");
}

bool particles_rows(PetriSession *session, uint32_t dimensions, const ParticlesEnergies *energies,
                    PetriWriteCallback *write, void *user_data) {
    const RowWriter writer = {dimensions, write, user_data};
    PetriFrame frame;
    petri_frame(session, &frame, sizeof frame);
    PetriSystem system;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++) {
        for (uint32_t i = 0; i < system.particle_count; i++) {
            const char *id = petri_format_value(session, petri_particle_id(session, s, i));
            if (!id)
                return false;
            write_format(&writer, "%" PRId64 ",%.17g,", frame.number, frame.time);
            csv_write(str_from(system.name), write, user_data);
            write_format(&writer, ",");
            csv_write(str_from(id), write, user_data);
            write_format(&writer, ",%d", system.anchor[i * system.anchor_stride] ? 1 : 0);
            write_vector(&writer, &system, system.position, i);
            write_vector(&writer, &system, system.velocity, i);
            write_number(&writer, system.radius, i);
            write_number(&writer, system.mass, i);
            write_number(&writer, system.charge, i);
            if (energies)
                write_format(&writer, ",%.17g,%.17g", energies[s].kinetic, energies[s].potential);
            write_format(&writer, "\n");
        }
    }
    return true;
}
