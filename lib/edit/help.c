// help.c: help on the language: functions, kinds of nodes with their attributes, numbers as scripts write them.
#include "schema/help.h"

#include "ast/literal.h"
#include "base/host_struct.h"
#include "session/session.h"

bool petri_builtin(size_t index, PetriBuiltin *builtin, size_t size) {
    if (index >= builtin_table_count)
        return false;
    const Builtin *row = &builtin_table[index];
    const PetriBuiltin found = {row->name, row->parameters, row->help};
    return host_struct_write(builtin, size, &found, sizeof found);
}

bool petri_host_function(const PetriSession *session, size_t number, PetriBuiltin *function, size_t size) {
    if (!session || number >= session->functions.count)
        return false;
    const Builtin *row = session->functions.rows[number];
    const PetriBuiltin found = {row->name, row->parameters, row->help};
    return host_struct_write(function, size, &found, sizeof found);
}

bool petri_node_kind(size_t number, PetriNodeKind *out, size_t size) {
    if (number >= KIND_COUNT)
        return false;
    const KindRow *kind = &schema_kinds[number];
    bool solid = number == KIND_CANVAS3D || kind->place == PLACE_SCENE3D;
    const PetriNodeKind found = {kind->name,
                                 kind->place < PLACE_TOP ? "physics"
                                 : solid                 ? "canvas3d"
                                                         : "canvas",
                                 schema_kind_help[number], schema_formula((NodeKind)number),
                                 schema_synonyms((NodeKind)number)};
    return host_struct_write(out, size, &found, sizeof found);
}

bool petri_node_attribute(size_t kind, size_t number, PetriNodeAttribute *out, size_t size) {
    for (size_t i = 0; i < ROW_COUNT; i++) {
        const SchemaRow *row = &schema_rows[i];
        if (row->kind != kind || number-- > 0)
            continue;
        const PetriNodeAttribute found = {schema_names[row->name], schema_types[row->type].text,
                                          schema_help[i].default_text, schema_help[i].help, schema_help[i].unit};
        return host_struct_write(out, size, &found, sizeof found);
    }
    return false;
}

bool petri_parse_number(const char *text, double *x) {
    return text && x && (literal_parse_number(str_from(text), x) || literal_parse_timecode(str_from(text), x));
}
