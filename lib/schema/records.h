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
typedef struct GraphicsState {
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
    uint32_t effect; // on paths
} GraphicsState;

// Of three dimensions (canvas3d_list.h): a material, a render group and a camera, whatever a node has of these.
typedef struct GraphicsState3D {
    double color[3];
    double emissive[3];
    double roughness;
    double metal;
    double ior;
    double ao;
    double transparency;
    double translucency;
    const char *ids[6]; // of pictures: color, metal, roughness, ao, emissive, transparency; NULL or empty: none
    double max_lights;
    bool depth_sort;
    bool depth_test;
    bool face_cull;
    int cull_face;
    int composite;
    double fov;
    int fov_ref;
    double near;
    double far; // nan: the width of the picture
    bool orthographic;
    double width; // likewise
    double samples;
    double colorbits;
    double fog_min;
    double fog_max;
    double fog_color[3];
    double fog_curve;
    bool monochrome;
    double tint[3];
} GraphicsState3D;

#endif
