// parameters.c: see parameters.h.
#include "cli/parameters.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "cli/table.h"

enum { COLUMNS = 4 };

bool is_wrong_definition(const PetriDiagnostic *diagnostic) {
    return diagnostic->level == PETRI_ERROR && diagnostic->code != NULL &&
           strcmp(diagnostic->code, "bad-definition") == 0;
}

bool parameter_find(PetriSession *session, const char *name, PetriParameter *parameter) {
    for (size_t i = 0; petri_parameter(session, i, parameter) && parameter->settable; i++) {
        if (strcmp(parameter->name, name) == 0) {
            return true;
        }
    }
    return false;
}

static void add_number(Bytes *out, double x) {
    if (isfinite(x)) {
        bytes_format(out, "%.12g", x);
    }
}

void parameter_range(Bytes *out, const PetriParameter *parameter) {
    if (isinf(parameter->least) && isinf(parameter->most)) {
        return;
    }
    add_number(out, parameter->least);
    bytes_format(out, "..");
    add_number(out, parameter->most);
    if (parameter->step > 0) {
        bytes_format(out, "|%.12g", parameter->step);
    }
}

void parameter_describe(Bytes *out, const PetriParameter *parameter) {
    SCOPED_BYTES about = {0};
    parameter_range(&about, parameter);
    if (parameter->defined) {
        bytes_format(&about, "%sdefault %s", about.length == 0 ? "" : ", ", parameter->fallback);
    }
    bytes_format(out, "%s = %s", parameter->name, parameter->value);
    if (about.length > 0) {
        bytes_format(out, "  (%s)", about.data);
    }
}

static void add_row(Table *table, const PetriParameter *parameter) {
    SCOPED_BYTES value = {0}, range = {0};
    bytes_add_text(&value, parameter->defined ? parameter->value : parameter->fallback);
    if (parameter->defined) {
        bytes_format(&value, " (default %s)", parameter->fallback);
    }
    bytes_add_text(&range, ""); // so that there is a text
    parameter_range(&range, parameter);
    const char *const cells[COLUMNS] = {parameter->name, value.data, range.data, parameter->comment};
    for (int i = 0; i < COLUMNS; i++) {
        table_add(table, cells[i]);
    }
}

// Rows from *next on that are of one file, where they cannot be set.
static void add_rows(PetriSession *session, Table *table, size_t *next) {
    PetriParameter parameter;
    char file[1000];
    bool settable = true;
    for (size_t first = *next; petri_parameter(session, *next, &parameter); ++*next) {
        if (*next == first) {
            settable = parameter.settable;
            snprintf(file, sizeof file, "%s", parameter.file);
        }
        if (parameter.settable != settable || (!settable && strncmp(parameter.file, file, sizeof file - 1) != 0)) {
            return;
        }
        add_row(table, &parameter);
    }
}

size_t parameters_list(PetriSession *session, Output *output) {
    PetriParameter parameter;
    size_t next = 0, own = 0;
    while (petri_parameter(session, next, &parameter)) {
        if (!parameter.settable) {
            output_format(output, "%s%s, a module: it sees no definitions, so that its defaults stay\n",
                          next == 0 ? "" : "\n", parameter.file);
        }
        bool settable = parameter.settable;
        SCOPED_TABLE table = table_new(COLUMNS);
        add_rows(session, &table, &next);
        table_write(&table, output);
        own = settable ? next : own;
    }
    return own;
}
