// schema_help.c: what help tells of the nodes that drive something; see schema_list.h.
#include "scene/attrs.h"

#include <string.h>

static const struct {
    const char *name;
    const char *help;
} kinds[KIND_COUNT_OF] = {
#define KIND(id, text) [KIND_##id].name = text,
#include "scene/schema_list.h"
    [KIND_PHYSICS].help = "a particle system",
    [KIND_PARTICLE].help = "a particle; its attributes count when it appears, later the state moves it",
    [KIND_ANCHOR].help = "a particle that stays where its attributes put it",
    [KIND_GROUP].help = "particles that others outside of it do not see, and forces on them alone",
    [KIND_CONSTANT].help = "the same force, or acceleration, on all particles",
    [KIND_RANDOM].help = "a random force on each particle",
    [KIND_FIELD].help = "a force that grows with the charge",
    [KIND_DISTANCE].help = "a spring between two particles",
    [KIND_COLLISION].help = "particles that overlap push each other away",
    [KIND_GRAVITY].help = "masses attract each other",
    [KIND_ELECTROSTATIC].help = "equal charges repel each other, others attract",
    [KIND_ADHESION].help = "particles that touch hold on to each other",
    [KIND_DRAG].help = "friction of a medium that may flow",
    [KIND_BUOYANCY].help = "weight in a medium",
    [KIND_BARRIER].help = "a wall",
    [KIND_COUNTER].help = "a clock with a speed of its own, written to the state",
};

static const struct {
    SceneKind kind;
    const char *name;
    const char *fallback;
} rows[] = {
#define ATTR(kind, id, text, fallback) {KIND_##kind, text, #fallback},
#include "scene/schema_list.h"
};

// Attributes of other types than a number; the names mean the same wherever they occur.
static const struct {
    const char *name;
    const char *type;
    const char *fallback;
} types[] = {
    {"id", "any", ""},
    {"state", "any", ""},
    {"from", "id of a particle", ""},
    {"to", "id of a particle", ""},
    {"run", "any", ""},
    {"position", "vector", "0"},
    {"velocity", "vector", "0"},
    {"force", "vector", "0"},
    {"acceleration", "vector", "0"},
    {"direction", "vector", "0"},
    {"flow", "vector", "0"},
    {"normal", "vector", "0"},
    {"gravity", "vector", "0;…;0;-1"},
    {"resolution", "number", "1/fps"},
    {"speed_of_light", "number", ""},
    {"max_distance", "number", ""},
    {"fixed", "number", ""},
    {"minimum", "number", ""},
    {"min", "number", ""},
    {"maximum", "number", ""},
    {"max", "number", ""},
    {"time", "number", "the frame's"},
    {"dimensions", "whole number", ""},
};

const char *schema_kind_name(SceneKind kind) {
    return kinds[kind].name;
}

const char *schema_kind_help(SceneKind kind) {
    return kinds[kind].help;
}

bool schema_attribute_help(SceneKind kind, size_t attribute, SchemaHelp *help) {
    for (size_t i = 0; i < ROW_COUNT; i++) {
        if (rows[i].kind != kind || attribute-- > 0)
            continue;
        *help = (SchemaHelp){rows[i].name, "number", rows[i].fallback};
        for (size_t k = 0; k < sizeof types / sizeof types[0]; k++)
            if (strcmp(types[k].name, rows[i].name) == 0) {
                help->type = types[k].type;
                help->fallback = types[k].fallback;
            }
        return true;
    }
    return false;
}
