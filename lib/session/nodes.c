// nodes.c: the kinds of nodes and their attributes, for help and completion.
#include "session/session.h"

// The scene's kinds from this one on stand in windows, with whose kinds they are listed.
enum { FIRST_IN_WINDOW = KIND_POINTER };

bool petri_node_kind(size_t number, PetriNodeKind *out) {
    CanvasHelp help;
    size_t physics = FIRST_IN_WINDOW;
    if (number < physics) {
        *out = (PetriNodeKind){schema_kind_name((SceneKind)number), "physics", schema_kind_help((SceneKind)number)};
        return true;
    }
    if (!canvas_help_kind(number - physics, &help))
        return false;
    *out = (PetriNodeKind){help.name, "canvas", help.help};
    return true;
}

bool petri_node_attribute(size_t kind, size_t number, PetriNodeAttribute *out) {
    CanvasHelp help;
    size_t physics = FIRST_IN_WINDOW;
    if (kind < physics) {
        SchemaHelp row;
        if (!schema_attribute_help((SceneKind)kind, number, &row))
            return false;
        *out = (PetriNodeAttribute){row.name, row.type, row.fallback, row.help};
        return true;
    }
    if (!canvas_help_attribute(kind - physics, number, &help))
        return false;
    *out = (PetriNodeAttribute){help.name, help.type, help.fallback, help.help};
    return true;
}
