// parameters.c: see parameters.h.
#include "cli/parameters.h"

#include "cli/text_table.h"

#include <math.h>
#include <string.h>

enum { COLUMNS = 4 };

bool is_invalid_definition(const PetriDiagnostic *diagnostic) {
    return diagnostic->level == PETRI_ERROR && diagnostic->code && strcmp(diagnostic->code, "bad-definition") == 0;
}

bool parameter_find(PetriSession *session, const char *name, PetriParameter *parameter) {
    for (size_t i = 0; petri_parameter(session, i, parameter, sizeof *parameter) && parameter->settable; i++)
        if (strcmp(parameter->name, name) == 0)
            return true;
    return false;
}

static void add_number(Text *out, double x) {
    if (isfinite(x))
        text_add_format(out, "%.12g", x);
}

// Adds the range, such as `1..500`. Adds nothing if the parameter has no range.
static void parameter_range(Text *out, const PetriParameter *parameter) {
    if (isinf(parameter->min) && isinf(parameter->max))
        return;
    add_number(out, parameter->min);
    text_add_format(out, "..");
    add_number(out, parameter->max);
    if (parameter->step > 0)
        text_add_format(out, "|%.12g", parameter->step);
}

void parameter_describe(Text *out, const PetriParameter *parameter) {
    SCOPED_TEXT about = {0};
    parameter_range(&about, parameter);
    if (parameter->defined)
        text_add_format(&about, "%sdefault %s", about.len == 0 ? "" : ", ", parameter->default_value);
    text_add_format(out, "%s = %s", parameter->name, parameter->value);
    if (about.len > 0)
        text_add_format(out, "  (%s)", about.bytes);
}

static void add_row(TextTable *table, const PetriParameter *parameter) {
    SCOPED_TEXT value = {0}, range = {0};
    text_add_c(&value, parameter->defined ? parameter->value : parameter->default_value);
    if (parameter->defined)
        text_add_format(&value, " (default %s)", parameter->default_value);
    text_add_c(&range, ""); // makes range.bytes a string even without a range
    parameter_range(&range, parameter);
    const char *const cells[COLUMNS] = {parameter->name, value.bytes, range.bytes, parameter->comment};
    for (int i = 0; i < COLUMNS; i++)
        text_table_add(table, cells[i]);
}

size_t parameters_list(PetriSession *session, Output *output) {
    PetriParameter parameter;
    SCOPED_TEXT_TABLE table = text_table_new(COLUMNS);
    SCOPED_TEXT file = {0}; // path of the module whose parameters are being written
    size_t own = 0;
    for (size_t i = 0; petri_parameter(session, i, &parameter, sizeof parameter); i++) {
        own += parameter.settable;
        if (!parameter.settable && (file.len == 0 || strcmp(file.bytes, parameter.file) != 0)) {
            text_table_write(&table, output);
            text_table_free(&table);
            table = text_table_new(COLUMNS);
            output_format(output, "%s%s, a module: -D does not affect it, its parameters have their defaults\n",
                          i == 0 ? "" : "\n", parameter.file);
            text_free(&file);
            text_add_c(&file, parameter.file);
        }
        add_row(&table, &parameter);
    }
    text_table_write(&table, output);
    return own;
}
