// sliders.c: implementation of sliders.h.
#include "view/sliders.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Sizes in units of text. A slider is a bar with name and value, which is filled up to the value.
enum {
    LEFT = 12,
    TOP = 12,
    WIDTH = 240,
    HEIGHT = 26,
    DISTANCE = 32,
    TEXT_SIZE = 13,
    PADDING = 8,
    MIN_FILLED = 12,
    LIMIT = 27
};

// Writes "NAME VALUE", cut to LIMIT characters.
static void describe_slider(Slider *slider, const PetriParameter *parameter) {
    int space = LIMIT - (int)strlen(parameter->value) - 1;
    snprintf(slider->text, sizeof slider->text, "%.*s %.*s", space < 1 ? 1 : space, parameter->name, LIMIT,
             parameter->value);
}

bool sliders_update(Sliders *sliders, PetriSession *session) {
    Sliders now = {.shown = sliders->shown};
    PetriParameter parameter;
    for (size_t i = 0; now.shown && now.count < MAX_SLIDERS; i++) {
        if (!petri_parameter(session, i, &parameter, sizeof parameter) || !parameter.settable)
            break;
        double range = parameter.max - parameter.min;
        if (!isfinite(range) || range <= 0 || isnan(parameter.number))
            continue;
        Slider *slider = &now.items[now.count++];
        slider->parameter = i;
        slider->fraction = fmin(fmax((parameter.number - parameter.min) / range, 0), 1);
        describe_slider(slider, &parameter);
    }
    bool changed = now.count != sliders->count;
    for (size_t i = 0; i < now.count && !changed; i++)
        changed = now.items[i].parameter != sliders->items[i].parameter ||
                  now.items[i].fraction != sliders->items[i].fraction ||
                  strcmp(now.items[i].text, sliders->items[i].text) != 0;
    *sliders = now;
    return changed;
}

size_t sliders_layout(const Sliders *sliders, PetriLabel *labels) {
    static const PetriLabel bar = {.background = {0.14, 0.17, 0.22, 0.88}},
                            filled = {.background = {0.13, 0.42, 0.62, 0.95}},
                            text = {.foreground = {0.96, 0.97, 0.98, 1}};
    const PetriLabel *styles[LABELS_PER_SLIDER] = {&bar, &filled, &text};
    for (size_t i = 0; i < sliders->count; i++) {
        for (size_t k = 0; k < LABELS_PER_SLIDER; k++) {
            PetriLabel *label = &labels[i * LABELS_PER_SLIDER + k];
            *label = *styles[k];
            label->text = styles[k] == &text ? sliders->items[i].text : "";
            label->x = LEFT;
            label->y = TOP + (double)i * DISTANCE;
            label->width = styles[k] == &filled ? fmax(MIN_FILLED, sliders->items[i].fraction * WIDTH) : WIDTH;
            label->height = HEIGHT;
            label->size = label->line_height = TEXT_SIZE;
            label->padding = PADDING;
        }
    }
    return sliders->count * LABELS_PER_SLIDER;
}

int sliders_find(const Sliders *sliders, double x, double y) {
    double row = floor((y - TOP) / DISTANCE);
    bool inside =
        x >= LEFT && x < LEFT + WIDTH && row >= 0 && row < (double)sliders->count && y - TOP - row * DISTANCE < HEIGHT;
    return inside ? (int)row : -1;
}

double sliders_fraction(double x) {
    return fmin(fmax((x - LEFT) / WIDTH, 0), 1);
}
