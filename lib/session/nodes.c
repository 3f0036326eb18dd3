// nodes.c: descriptions of node kinds and their attributes, for help and completion.
#include "session/session.h"

bool petri_node_kind(size_t number, PetriNodeKind *out) {
    if (!out || number >= KIND_COUNT)
        return false;
    const KindRow *kind = &schema_kinds[number];
    bool solid = number == KIND_CANVAS3D || kind->place == PLACE_SCENE3D;
    *out = (PetriNodeKind){kind->name,
                           kind->place < PLACE_TOP ? "physics"
                           : solid                 ? "canvas3d"
                                                   : "canvas",
                           kind->help, schema_formula((NodeKind)number)};
    return true;
}

bool petri_node_attribute(size_t kind, size_t number, PetriNodeAttribute *out) {
    if (!out)
        return false;
    for (size_t i = 0; i < ROW_COUNT; i++) {
        const SchemaRow *row = &schema_rows[i];
        if (row->kind != kind || number-- > 0)
            continue;
        *out = (PetriNodeAttribute){schema_names[row->name], schema_types[row->type].text, row->default_value.text,
                                    row->help, row->unit};
        return true;
    }
    return false;
}
