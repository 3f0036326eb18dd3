// model.h: an independent model of lib/spec/pictures.md, sections 1, 3, 6 and 7, which was written from that page only.
// It computes single pixels with doubles. Tests compare petri's effects with the model.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { MAX_SIDE = 48, MAX_INPUTS = 3 };

typedef struct Px {
    double c[4]; // r, g, b (premultiplied by a), and a
} Px;

typedef struct Pic {
    int w;
    int h;
    Px at[MAX_SIDE * MAX_SIDE]; // rows from the bottom
} Pic;

// How samples outside a picture are computed: a border colour, the repeated picture, or the nearest edge pixel.
typedef struct Edges {
    double border[4];
    bool repeat[2];
    bool clamped;
    bool nearest;
} Edges;

// A node whose picture the model computes.
typedef struct Work {
    const char *kind;
    const char *attrs; // the attributes as written in the script
    Pic in[MAX_INPUTS];
    int n;
    int w;
    int h;
    Pic last;     // the node's output in the previous frame
    bool past;    // true if the node has a previous frame
    double beats; // beats since the previous frame
} Work;

// Attributes. model_number returns the k-th number; a single number is repeated. model_has returns whether the
// attribute exists, and model_word whether its value is this word.
double model_number(const char *attrs, const char *name, int k, double default_value);
bool model_has(const char *attrs, const char *name);
bool model_word(const char *attrs, const char *name, const char *word);

// Section 1: colours and sampling.
double model_lin(double e);
double model_enc(double c);
double model_lum(const double c[3]);
Px model_sample(const Pic *pic, const Edges *edges, double u, double v);
// Section 3: the sampler settings of a node, the combined inputs, the render target of a pass.
Edges model_edges(const char *attrs, bool clamped);
Px model_merge(const Work *work, const Edges *edges, double u, double v);
void model_target(Pic *pic, int w, int h);
// Section 7: the node's output.
void model_effect(const Work *work, Pic *out);
// Section 7.9: noise.
void model_noise(const Work *work, Pic *out);
