// parameters.c: see parameters.h.
#include "cli/parameters.h"

#include <math.h>
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

size_t parameters_list(PetriSession *session, Output *output) {
    PetriParameter parameter;
    SCOPED_TABLE table = table_new(COLUMNS);
    SCOPED_BYTES file = {0}; // of the module whose rows these are
    size_t own = 0;
    for (size_t i = 0; petri_parameter(session, i, &parameter); i++) {
        own += parameter.settable;
        if (!parameter.settable && (file.length == 0 || strcmp(file.data, parameter.file) != 0)) {
            table_write(&table, output);
            table_free(&table);
            table = table_new(COLUMNS);
            output_format(output, "%s%s, a module: it sees no definitions, so that its defaults stay\n",
                          i == 0 ? "" : "\n", parameter.file);
            bytes_free(&file);
            bytes_add_text(&file, parameter.file);
        }
        add_row(&table, &parameter);
    }
    table_write(&table, output);
    return own;
}
