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
    [KIND_GROUP].help = "particles that those in groups beside it do not see, and forces on them alone",
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

// What the names tell of themselves. A row of a kind comes before that of ANY, which holds wherever the name occurs;
// a fallback of NULL is that of the list. Times are in the units of `time`, whatever the script gives there.
enum { ANY = KIND_COUNT_OF };
static const struct {
    int kind;
    const char *name;
    const char *type;
    const char *fallback;
    const char *help;
} meanings[] = {
    {KIND_PHYSICS, "state", "any", "", "the key under which particles are written: $(key;id), $(key;id;:velocity)"},
    {KIND_COUNTER, "state", "any", "", "the key under which the value is written"},
    {KIND_PHYSICS, "time", "number", "the frame's, in seconds", "the clock to follow, such as beat"},
    {KIND_COUNTER, "time", "any numbers", "the frame's, in seconds", "the clock to follow, such as beat"},
    {ANY, "dimensions", "whole number, 1 or more", "", "how many components vectors have"},
    {ANY, "resolution", "number above 0", "1/fps", "longest simulation step, in units of time"},
    {ANY, "run", "whole number", "0", "another number starts the system anew"},
    {ANY, "speed_of_light", "number", "", "highest speed; 0 or less is no limit"},
    {ANY, "id", "any", "", "unique in its system; without it the particle is ignored"},
    {KIND_BARRIER, "position", "vector", "0", "a point of the wall"},
    {KIND_ANCHOR, "position", "vector", "0", "where it is, in each frame"},
    {ANY, "position", "vector", "0", "where it starts"},
    {KIND_ANCHOR, "velocity", "vector", "0", "ignored: anchors are at rest"},
    {ANY, "velocity", "vector", "0", "at the start; length per unit of time"},
    {KIND_CONSTANT, "force", "vector", "0", "the same on each particle"},
    {KIND_CONSTANT, "acceleration", "vector", "0", "added to the force, times the particle's mass"},
    {KIND_ANCHOR, "force", "vector", "0", "ignored: nothing moves an anchor"},
    {ANY, "force", "vector", "0", "a force on this particle alone"},
    {ANY, "radius", "number, 0 or more", NULL, "with 0 it neither collides nor sticks, and no medium holds it"},
    {ANY, "mass", "number, 0 or more", NULL, "with 0 it is never accelerated"},
    {ANY, "charge", "number", NULL, "for !electrostatic and !field"},
    {KIND_PARTICLE, "ease", "number", NULL, "time in which its force grows to its full size, from the system's start"},
    {KIND_ANCHOR, "ease", "number", NULL, "ignored: nothing moves an anchor"},
    {ANY, "ease", "number", NULL, "time in which the strength grows to its full size, from the system's start"},
    {KIND_RANDOM, "strength", "number", NULL, "standard deviation of each component of the force"},
    {ANY, "strength", "number", NULL, "factor of the force"},
    {ANY, "power", "number, 0 or more", NULL, "of the displacement: 1 is a linear spring"},
    {ANY, "direction", "vector", "0", "force on a charge of 1"},
    {ANY, "flow", "vector", "0", "velocity of the medium"},
    {ANY, "gravity", "vector", "0;...;0;-1", "acceleration that a weight has in the void"},
    {ANY, "density", "number", NULL, "mass of the medium that a particle of radius 1 displaces"},
    {ANY, "from", "id of a particle", "", "one end"},
    {ANY, "to", "id of a particle", "", "the other end"},
    {ANY, "max_distance", "number above 0", "", "between particles at least this far apart there is no force"},
    {ANY, "overlap", "number from 0 to 1", NULL,
     "how deep they sink in before they repel: 0 not at all, 1 until one is within the other"},
    {ANY, "normal", "vector", "0", "away from the wall, of any length but 0; without it there is no wall"},
    {ANY, "restitution", "number from 0 to 1", NULL, "part of the speed that a bounce keeps"},
    {ANY, "initial", "any numbers", NULL, "value at the start"},
    {ANY, "rate", "any numbers", NULL, "growth per unit of time"},
    {ANY, "reset", "any", "", "while true, the value is the initial one"},
    {KIND_COUNTER, "minimum", "any numbers", "", "least value"},
    {KIND_COUNTER, "maximum", "any numbers", "", "greatest value"},
    {KIND_COUNTER, "min", "any numbers", "", "the same as minimum, which wins"},
    {KIND_COUNTER, "max", "any numbers", "", "the same as maximum, which wins"},
    {ANY, "fixed", "number", "", "minimum and maximum at once, and wins over both"},
    {ANY, "minimum", "number", "", "distance below which the spring pushes"},
    {ANY, "maximum", "number", "", "distance above which the spring pulls"},
    {ANY, "min", "number", "", "the same as minimum, which wins"},
    {ANY, "max", "number", "", "the same as maximum, which wins"},
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
        *help = (SchemaHelp){rows[i].name, "number", rows[i].fallback, ""};
        for (size_t k = 0; k < sizeof meanings / sizeof meanings[0]; k++) {
            bool meant = meanings[k].kind == (int)kind || meanings[k].kind == ANY;
            if (!meant || strcmp(meanings[k].name, rows[i].name) != 0)
                continue;
            help->type = meanings[k].type;
            help->fallback = meanings[k].fallback ? meanings[k].fallback : rows[i].fallback;
            help->help = meanings[k].help;
            break;
        }
        return true;
    }
    return false;
}
