// particles.c: see particles.h.
#include "cli/particles.h"

#include "base/number.h"
#include "cli/memory.h"

#include <inttypes.h>
#include <string.h>

// Collects rows, so that the host gets few and long texts.
typedef struct RowWriter {
    uint32_t dimensions;
    PetriWriteCallback *write;
    void *host;
    size_t used; // bytes in the buffer
    char buffer[1 << 12];
} RowWriter;

static void flush(RowWriter *writer) {
    writer->write(writer->host, writer->buffer, writer->used);
    writer->used = 0;
}

// A PetriWriteCallback.
static bool add_text(void *user_data, const char *text, size_t length) {
    RowWriter *writer = user_data;
    if (writer->used + length > sizeof writer->buffer)
        flush(writer);
    if (length > sizeof writer->buffer)
        return writer->write(writer->host, text, length);
    memcpy(writer->buffer + writer->used, text, length);
    writer->used += length;
    return true;
}

static void add_number(RowWriter *writer, double x) {
    if (writer->used + 1 + NUMBER_TEXT > sizeof writer->buffer)
        flush(writer);
    writer->buffer[writer->used++] = ',';
    writer->used += number_format(x, writer->buffer + writer->used);
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

static void add_vector(RowWriter *writer, const PetriSystem *system, PetriColumn column, uint32_t particle) {
    for (uint32_t k = 0; k < writer->dimensions; k++)
        if (k < system->dimensions)
            add_number(writer, column.data[particle * column.stride + k]);
        else
            add_text(writer, ",", 1);
}

// Adds the id of a particle. `ids` is the column of numeric ids, or empty. Returns false if out of memory.
static bool add_id(RowWriter *writer, PetriSession *session, size_t system, PetriColumn ids, uint32_t particle) {
    double number = ids.data ? ids.data[particle * ids.stride] : -1;
    if (number >= 0) { // not a symbol
        add_number(writer, number);
        return true;
    }
    const char *id = petri_format_value(session, petri_particle_id(session, system, particle));
    if (!id)
        return false;
    add_text(writer, ",", 1);
    csv_write(str_from(id), add_text, writer);
    return true;
}

uint32_t particles_dimensions(PetriSession *session) {
    PetriSystem system;
    uint32_t max_dimensions = 1;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++)
        max_dimensions = system.dimensions > max_dimensions ? system.dimensions : max_dimensions;
    return max_dimensions;
}

void particles_header(uint32_t dimensions, bool energies, PetriWriteCallback *write, void *user_data) {
    SCOPED_TEXT line = {0};
    text_add_c(&line, "frame,time,system,id,anchor");
    for (const char *name = "xv"; *name != '\0'; name++)
        for (uint32_t k = 1; k <= dimensions; k++)
            text_add_format(&line, ",%c%" PRIu32, *name, k);
    text_add_format(&line, ",radius,mass,charge%s\n", energies ? ",kinetic_energy,potential_energy" : "");
    write(user_data, line.bytes, line.len);
}

// A PetriWriteCallback.
static bool add_to_head(void *head, const char *text, size_t length) {
    text_add(head, (Str){text, length});
    return true;
}

// Adds the rows of a system. `head` is the text before the ids.
static bool add_rows(RowWriter *writer, PetriSession *session, size_t number, const PetriSystem *system, Str head,
                     const ParticlesEnergies *energies) {
    PetriColumn ids = petri_particle_ids(session, number);
    for (uint32_t i = 0; i < system->particle_count; i++) {
        add_text(writer, head.bytes, head.len);
        if (!add_id(writer, session, number, ids, i))
            return false;
        add_text(writer, system->anchor[i * system->anchor_stride] ? ",1" : ",0", 2);
        add_vector(writer, system, system->position, i);
        add_vector(writer, system, system->velocity, i);
        add_number(writer, system->radius.data[i * system->radius.stride]);
        add_number(writer, system->mass.data[i * system->mass.stride]);
        add_number(writer, system->charge.data[i * system->charge.stride]);
        if (energies) {
            add_number(writer, energies->kinetic);
            add_number(writer, energies->potential);
        }
        add_text(writer, "\n", 1);
    }
    return true;
}

bool particles_rows(PetriSession *session, uint32_t dimensions, const ParticlesEnergies *energies,
                    PetriWriteCallback *write, void *user_data) {
    RowWriter writer = {.dimensions = dimensions, .write = write, .host = user_data};
    PetriFrame frame;
    petri_frame(session, &frame, sizeof frame);
    PetriSystem system;
    bool complete = true;
    for (size_t s = 0; complete && petri_system(session, s, &system, sizeof system); s++) {
        SCOPED_TEXT head = {0};
        text_add_format(&head, "%" PRId64 ",", frame.number);
        text_add_number(&head, frame.time);
        text_add_c(&head, ",");
        csv_write(str_from(system.name), add_to_head, &head);
        complete = add_rows(&writer, session, s, &system, text_str(&head), energies ? &energies[s] : NULL);
    }
    flush(&writer);
    return complete;
}
