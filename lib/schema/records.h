// records.h: the structs that a node's attributes are read into. The rows of schema_list.h name their fields.
#pragma once

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

// A force applier or barrier. Bounds that are not set are NaN.
typedef struct ForceAttrs {
    PhysForce force;
    double fixed; // value of the attribute `fixed`, which replaces both bounds; NaN: not set
    Value from;   // id of the first particle of a distance force
    Value to;     // id of the second particle of a distance force
} ForceAttrs;

// !counter
typedef struct CounterAttrs {
    Value state;
    Value initial;
    Value rate;
    Value time;
    Value minimum; // lower limit of the value; null: none
    Value maximum; // upper limit of the value; null: none
    Value reset;
} CounterAttrs;

// !pointer, !key
typedef struct InputAttrs {
    Value state;
    Value name;
} InputAttrs;

// The graphics state of a canvas, inherited down the tree.
typedef struct GraphicsState {
    double color[4];
    double stroke_width;
    double font_size;
    double weight;
    const char *family;
    int width; // font width, a value of FONT_WIDTH (word_list.h)
    int slant;
    int join;
    int cap;
    int composite;
    bool antialias;
    // Settings made by earlier drawing nodes: numbers of settings (display_list_build.h); DISPLAY_NONE: none.
    uint32_t source; // paint that replaces the colour
    uint32_t filter;
    uint32_t effect; // path effect
} GraphicsState;

// The graphics state of a 3-D scene (canvas3d_list.h): the attributes of materials, render groups and cameras.
typedef struct GraphicsState3D {
    double color[3];
    double emissive[3];
    double roughness;
    double metal;
    double ior;
    double ao;
    double transparency;
    double translucency;
    const char *ids[6]; // ids of pictures: color, metal, roughness, ao, emissive, transparency; NULL or empty: none
    double max_lights;
    bool depth_sort;
    bool depth_test;
    bool face_cull;
    int cull_face;
    int composite;
    double fov;
    int fov_ref;
    double near;
    double far; // NaN: the width of the picture
    bool orthographic;
    double width; // NaN: the width of the picture
    double samples;
    double colorbits;
    double fog_min;
    double fog_max;
    double fog_color[3];
    double fog_curve;
    bool monochrome;
    double tint[3];
} GraphicsState3D;
