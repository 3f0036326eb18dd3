// force_list.h: all forces, one row each. A new force needs a row here, a formula (pair_formulas.h or
// single_formulas.h) and a test. Enums, tables and dispatch are generated from the rows, and no switch over forces has
// a `default:`. Numbers in parentheses are sections of spec physics.md.
//
//   PAIR(KIND, name, sign, source, reach)   between every two particles that interact (4.1)
//       sign     of K in the formula: +1 if a positive strength attracts, -1 if it repels
//       source   quantity that must not be 0 in either particle: RADIUS, MASS, CHARGE or NOTHING
//       reach    CONTACT: only if the distance is below the sum of the radii (`source` is then RADIUS);
//                FAR: at any distance up to `max_distance`, if it is set
//   LINK(KIND, name)                        between two given particles (4.1)
//   SINGLE(KIND, name, vectors, need)       on each particle (4.2)
//   BARRIER(KIND, name, vectors, need)      on each particle (4.4)
//       vectors  number of vectors read: PhysForce.vector, then .vector2
//       need     SECTION: radius^(n-1); VOLUME: radius^n; STREAM: random numbers; or NOTHING
//
// The order of the rows does not matter: forces act in the order of the script. The node and attributes of a force are
// in schema/schema_list.h, under the same KIND.
#pragma once

// clang-format off
#define PHYS_FORCES(AS_PAIR, AS_LINK, AS_SINGLE, AS_BARRIER)                                                           \
    AS_PAIR(COLLISION, collision, -1, RADIUS, CONTACT)                                                                 \
    AS_PAIR(GRAVITY, gravity, +1, MASS, FAR)                                                                           \
    AS_PAIR(ELECTROSTATIC, electrostatic, -1, CHARGE, FAR)                                                             \
    AS_PAIR(ADHESION, adhesion, +1, RADIUS, CONTACT)                                                                   \
    AS_LINK(DISTANCE, distance)                                                                                        \
    AS_SINGLE(CONSTANT, constant, 2, NOTHING)                                                                          \
    AS_SINGLE(RANDOM, random, 0, STREAM)                                                                               \
    AS_SINGLE(FIELD, field, 1, NOTHING)                                                                                \
    AS_SINGLE(DRAG, drag, 1, SECTION)                                                                                  \
    AS_SINGLE(BUOYANCY, buoyancy, 1, VOLUME)                                                                           \
    AS_BARRIER(BARRIER, barrier, 2, NOTHING)
// clang-format on

// Argument of PHYS_FORCES for the kinds that a use ignores.
#define PHYS_NO_ROW(...)
