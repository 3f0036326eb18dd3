// particles.c: see particles.h.
#include "cli/particles.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct Sheet {
    uint32_t dimensions;
    PetriWrite *write;
    void *host;
} Sheet;

// Numbers and short words.
__attribute__((format(printf, 2, 3))) static void add(const Sheet *sheet, const char *format, ...) {
    char text[64];
    va_list list;
    va_start(list, format);
    int length = vsnprintf(text, sizeof text, format, list);
    va_end(list);
    sheet->write(sheet->host, text, (size_t)length);
}

// Quoted where it must be: ids may hold commas and quotes.
static void add_text(const Sheet *sheet, const char *text) {
    size_t length = strlen(text);
    sheet->write(sheet->host, ",", 1);
    if (strpbrk(text, ",\"\r\n") == NULL) {
        sheet->write(sheet->host, text, length);
        return;
    }
    sheet->write(sheet->host, "\"", 1);
    for (const char *c = text; *c != '\0'; c++) {
        sheet->write(sheet->host, *c == '"' ? "\"\"" : c, *c == '"' ? 2 : 1);
    }
    sheet->write(sheet->host, "\"", 1);
}

static void add_vector(const Sheet *sheet, const PetriSystem *system, PetriColumn column, uint32_t particle) {
    for (uint32_t k = 0; k < sheet->dimensions; k++) {
        if (k < system->dimensions) {
            add(sheet, ",%.17g", column.data[particle * column.stride + k]);
        } else {
            add(sheet, ",");
        }
    }
}

static void add_number(const Sheet *sheet, PetriColumn column, uint32_t particle) {
    add(sheet, ",%.17g", column.data[particle * column.stride]);
}

uint32_t particles_dimensions(PetriSession *session) {
    PetriSystem system;
    uint32_t most = 1;
    for (size_t s = 0; petri_system(session, s, &system); s++) {
        most = system.dimensions > most ? system.dimensions : most;
    }
    return most;
}

void particles_header(uint32_t dimensions, PetriWrite *write, void *host) {
    const Sheet sheet = {dimensions, write, host};
    add(&sheet, "frame,time,system,id,anchor");
    for (const char *name = "xv"; *name != '\0'; name++) {
        for (uint32_t k = 1; k <= dimensions; k++) {
            add(&sheet, ",%c%" PRIu32, *name, k);
        }
    }
    add(&sheet, ",radius,mass,charge\n");
}

bool particles_rows(PetriSession *session, uint32_t dimensions, PetriWrite *write, void *host) {
    const Sheet sheet = {dimensions, write, host};
    PetriFrame frame = petri_frame(session);
    PetriSystem system;
    for (size_t s = 0; petri_system(session, s, &system); s++) {
        for (uint32_t i = 0; i < system.particle_count; i++) {
            const char *id = petri_text(session, petri_id(session, s, i));
            if (id == NULL) {
                return false;
            }
            add(&sheet, "%" PRId64 ",%.17g", frame.number, frame.time);
            add_text(&sheet, system.name);
            add_text(&sheet, id);
            add(&sheet, ",%d", system.anchor[i * system.anchor_stride] ? 1 : 0);
            add_vector(&sheet, &system, system.position, i);
            add_vector(&sheet, &system, system.velocity, i);
            add_number(&sheet, system.radius, i);
            add_number(&sheet, system.mass, i);
            add_number(&sheet, system.charge, i);
            add(&sheet, "\n");
        }
    }
    return true;
}
