// schema_list.h: the nodes that drive something, their attributes and defaults (spec physics.md section 1).
//
// KIND(ID, "node kind") and, for each, ATTR(KIND, ID, "attribute", default). The default is that of a float; vectors
// default to zero unless the code that reads them says otherwise (buoyancy's gravity).
// clang-format off
#ifndef ATTR
#define ATTR(kind, id, text, fallback)
#endif
#ifndef KIND
#define KIND(id, text)
#endif

KIND(PHYSICS, "physics")
ATTR(PHYSICS, STATE, "state", 0)
ATTR(PHYSICS, DIMENSIONS, "dimensions", 0)
ATTR(PHYSICS, TIME, "time", 0)
ATTR(PHYSICS, RESOLUTION, "resolution", 0)          // default 1/fps
ATTR(PHYSICS, RUN, "run", 0)
ATTR(PHYSICS, SPEED_OF_LIGHT, "speed_of_light", 0)  // 0: no limit

KIND(PARTICLE, "particle")
ATTR(PARTICLE, ID, "id", 0)
ATTR(PARTICLE, POSITION, "position", 0)
ATTR(PARTICLE, VELOCITY, "velocity", 0)
ATTR(PARTICLE, FORCE, "force", 0)
ATTR(PARTICLE, EASE, "ease", 0)
ATTR(PARTICLE, RADIUS, "radius", 0)
ATTR(PARTICLE, MASS, "mass", 1)
ATTR(PARTICLE, CHARGE, "charge", 0)

KIND(ANCHOR, "anchor")
ATTR(ANCHOR, ID, "id", 0)
ATTR(ANCHOR, POSITION, "position", 0)
ATTR(ANCHOR, VELOCITY, "velocity", 0)
ATTR(ANCHOR, FORCE, "force", 0)
ATTR(ANCHOR, EASE, "ease", 0)
ATTR(ANCHOR, RADIUS, "radius", 0)
ATTR(ANCHOR, MASS, "mass", 1)
ATTR(ANCHOR, CHARGE, "charge", 0)

KIND(GROUP, "group")

KIND(CONSTANT, "constant")
ATTR(CONSTANT, FORCE, "force", 0)
ATTR(CONSTANT, ACCELERATION, "acceleration", 0)
ATTR(CONSTANT, STRENGTH, "strength", 1)
ATTR(CONSTANT, EASE, "ease", 0)

KIND(RANDOM, "random")
ATTR(RANDOM, STRENGTH, "strength", 1)
ATTR(RANDOM, EASE, "ease", 0)

KIND(FIELD, "field")
ATTR(FIELD, DIRECTION, "direction", 0)
ATTR(FIELD, STRENGTH, "strength", 1)
ATTR(FIELD, EASE, "ease", 0)

KIND(DISTANCE, "distance")
ATTR(DISTANCE, FROM, "from", 0)
ATTR(DISTANCE, TO, "to", 0)
ATTR(DISTANCE, FIXED, "fixed", 0)
ATTR(DISTANCE, MINIMUM, "minimum", 0)
ATTR(DISTANCE, MIN, "min", 0)
ATTR(DISTANCE, MAXIMUM, "maximum", 0)
ATTR(DISTANCE, MAX, "max", 0)
ATTR(DISTANCE, POWER, "power", 1)
ATTR(DISTANCE, STRENGTH, "strength", 1)
ATTR(DISTANCE, EASE, "ease", 0)

KIND(COLLISION, "collision")
ATTR(COLLISION, POWER, "power", 1)
ATTR(COLLISION, STRENGTH, "strength", 1)
ATTR(COLLISION, EASE, "ease", 0)
ATTR(COLLISION, MAX_DISTANCE, "max_distance", 0)

KIND(GRAVITY, "gravity")
ATTR(GRAVITY, STRENGTH, "strength", 1)
ATTR(GRAVITY, EASE, "ease", 0)
ATTR(GRAVITY, MAX_DISTANCE, "max_distance", 0)

KIND(ELECTROSTATIC, "electrostatic")
ATTR(ELECTROSTATIC, STRENGTH, "strength", 1)
ATTR(ELECTROSTATIC, EASE, "ease", 0)
ATTR(ELECTROSTATIC, MAX_DISTANCE, "max_distance", 0)

KIND(ADHESION, "adhesion")
ATTR(ADHESION, OVERLAP, "overlap", 0.25)
ATTR(ADHESION, STRENGTH, "strength", 1)
ATTR(ADHESION, EASE, "ease", 0)
ATTR(ADHESION, MAX_DISTANCE, "max_distance", 0)

KIND(DRAG, "drag")
ATTR(DRAG, FLOW, "flow", 0)
ATTR(DRAG, STRENGTH, "strength", 1)
ATTR(DRAG, EASE, "ease", 0)

KIND(BUOYANCY, "buoyancy")
ATTR(BUOYANCY, GRAVITY, "gravity", 0)
ATTR(BUOYANCY, DENSITY, "density", 1)
ATTR(BUOYANCY, STRENGTH, "strength", 1)
ATTR(BUOYANCY, EASE, "ease", 0)

KIND(BARRIER, "barrier")
ATTR(BARRIER, POSITION, "position", 0)
ATTR(BARRIER, NORMAL, "normal", 0)
ATTR(BARRIER, RESTITUTION, "restitution", 1)
ATTR(BARRIER, FIXED, "fixed", 0)
ATTR(BARRIER, MINIMUM, "minimum", 0)
ATTR(BARRIER, MIN, "min", 0)
ATTR(BARRIER, MAXIMUM, "maximum", 0)
ATTR(BARRIER, MAX, "max", 0)
ATTR(BARRIER, POWER, "power", 1)
ATTR(BARRIER, STRENGTH, "strength", 1)
ATTR(BARRIER, EASE, "ease", 0)

KIND(COUNTER, "counter")
ATTR(COUNTER, STATE, "state", 0)
ATTR(COUNTER, INITIAL, "initial", 0)
ATTR(COUNTER, RATE, "rate", 1)
ATTR(COUNTER, TIME, "time", 0)
ATTR(COUNTER, MINIMUM, "minimum", 0)
ATTR(COUNTER, MIN, "min", 0)
ATTR(COUNTER, MAXIMUM, "maximum", 0)
ATTR(COUNTER, MAX, "max", 0)
ATTR(COUNTER, RESET, "reset", 0)

// In a window; help tells of these with the other nodes that stand there (canvas_list.h).
KIND(POINTER, "pointer")
ATTR(POINTER, STATE, "state", 0)

KIND(KEY, "key")
ATTR(KEY, NAME, "name", 0)
ATTR(KEY, STATE, "state", 0)
// clang-format on

#undef KIND
#undef ATTR
