// records.h: what the attributes of a node are read into: plain structs, whose fields the rows of schema_list.h name.
#ifndef PETRI_SCHEMA_RECORDS_H
#define PETRI_SCHEMA_RECORDS_H

#include "physics/system.h"
#include "value/value.h"

// !physics
typedef struct SystemAttrs {
    Value state;
    double dimensions;
    double time;
    double resolution;
    double run;
    double speed_of_light;
} SystemAttrs;

// !particle, !anchor
typedef struct BodyAttrs {
    Value id;
    PhysParticle numbers;
} BodyAttrs;

// A force applier or barrier. Bounds that are not given are nan.
typedef struct ForceAttrs {
    PhysForce force;
    double fixed; // both bounds
    Value from;   // ids
    Value to;
} ForceAttrs;

// !counter
typedef struct CounterAttrs {
    Value state;
    Value initial;
    Value rate;
    Value time;
    Value minimum; // null: none
    Value maximum;
    Value reset;
} CounterAttrs;

// !pointer, !key
typedef struct InputAttrs {
    Value state;
    Value name;
} InputAttrs;

// How things look in a canvas: inherited down the tree.
typedef struct Look {
    double color[4];
    double stroke_width;
    double font_size;
    double weight;
    const char *family;
    int width; // of letters
    int slant;
    int join;
    int cap;
    int composite;
    bool antialias;
    // What nodes among those that draw have set: numbers in the list that is built.
    uint32_t source; // in place of the colour
    uint32_t filter;
    uint32_t dashes;
    uint32_t dash_count;
    double dash_offset;
} Look;

#endif
