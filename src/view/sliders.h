// sliders.h: the panel of sliders over the picture, with which the pointer changes the script's parameters.
#pragma once

#include "petri-draw.h"
#include "petri.h"

#include <stdbool.h>
#include <stddef.h>

enum { MAX_SLIDERS = 16, LABELS_PER_SLIDER = 3 };

// A parameter whose range has two ends.
typedef struct Slider {
    size_t parameter; // number of the parameter, as in petri_parameter
    char text[120];   // name and value
    double fraction;  // position of the value in the range, from 0 to 1
} Slider;

typedef struct Sliders {
    bool shown;
    size_t count;
    Slider items[MAX_SLIDERS];
} Sliders;

// Reads the values of the parameters. Returns true if the panel has changed. A panel that is not shown has no sliders.
bool sliders_update(Sliders *sliders, PetriSession *session);
// Writes the labels of the panel to `labels`, which has space for MAX_SLIDERS * LABELS_PER_SLIDER, and returns their
// number. The texts are borrowed.
size_t sliders_layout(const Sliders *sliders, PetriLabel *labels);
// Returns the index of the slider at a position in units of text. Returns -1 if there is none.
int sliders_find(const Sliders *sliders, double x, double y);
// Returns the fraction of the range that a horizontal position selects.
double sliders_fraction(double x);
