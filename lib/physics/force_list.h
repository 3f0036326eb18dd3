// force_list.h: all forces, one row each. A new force needs a row here, a formula with its potential (pair_formulas.h
// or single_formulas.h), a node under the same KIND (schema/schema_list.h) and tests. Enums, tables and dispatch are
// generated from the rows: the compiler reports a missing part. Numbers in parentheses are sections of spec physics.md.
//
//   PAIR(KIND, name, sign, source, reach)   between every two particles that interact (4.1)
//       sign     of K in the formula: +1 if a positive strength attracts, -1 if it repels
//       source   quantity that must not be 0 in either particle: RADIUS, MASS, CHARGE or NOTHING
//       reach    CONTACT: only if the distance is below the sum of the radii (`source` is then RADIUS);
//                FAR: at any distance up to `max_distance`, if it is set;
//                INVERSE_SQUARE: as FAR, and without contact K is strength · source₁ · source₂ / distance². Then
//                `theta` works, which needs a THETA_ROW in the schema. `source` is MASS or CHARGE
//   LINK(KIND, name)                        between two given particles (4.1)
//   SINGLE(KIND, name, need)                on each particle (4.2)
//   BARRIER(KIND, name, need)               on each particle (4.4)
//       need     CHARGE: its charge; SECTION: radius^(n-1); VOLUME: radius^n; STREAM: random numbers; or NOTHING
//
// The order of the rows does not matter: forces act in the order of the script.
#pragma once

// clang-format off
#define PHYS_FORCES(AS_PAIR, AS_LINK, AS_SINGLE, AS_BARRIER)                                                           \
    AS_PAIR(COLLISION, collision, -1, RADIUS, CONTACT)                                                                 \
    AS_PAIR(GRAVITY, gravity, +1, MASS, INVERSE_SQUARE)                                                                \
    AS_PAIR(ELECTROSTATIC, electrostatic, -1, CHARGE, INVERSE_SQUARE)                                                  \
    AS_PAIR(ADHESION, adhesion, +1, RADIUS, CONTACT)                                                                   \
    AS_LINK(DISTANCE, distance)                                                                                        \
    AS_SINGLE(CONSTANT, constant, NOTHING)                                                                             \
    AS_SINGLE(RANDOM, random, STREAM)                                                                                  \
    AS_SINGLE(FIELD, field, CHARGE)                                                                                    \
    AS_SINGLE(DRAG, drag, SECTION)                                                                                     \
    AS_SINGLE(BUOYANCY, buoyancy, VOLUME)                                                                              \
    AS_BARRIER(BARRIER, barrier, NOTHING)
// clang-format on

// Argument of PHYS_FORCES for the kinds that a use ignores.
#define PHYS_NO_ROW(...)
