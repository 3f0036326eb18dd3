// framing.c: what the automatic picture shows of space; see automatic.h.
#include "draw/automatic.h"
#include "maths/maths.h"

#include <math.h>
#include <stdlib.h>

static int compare_numbers(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// How far from the middle most bodies are; a few that fly away must not make all others too small to see.
static double reach_of_most(const AutoSystem *system, const double middle[3], double *numbers) {
    for (uint32_t i = 0; i < system->body_count; i++) {
        const double *p = system->bodies[i].position;
        numbers[i] = maths_hypot(maths_hypot(p[0] - middle[0], p[1] - middle[1]), p[2] - middle[2]);
    }
    qsort(numbers, system->body_count, sizeof *numbers, compare_numbers);
    double most = numbers[(system->body_count * 9 + 9) / 10 - 1];
    return most > 0 ? 8 * most : INFINITY;
}

static void find_median(const AutoSystem *system, double middle[3], double *numbers) {
    for (int k = 0; k < 3; k++) {
        for (uint32_t i = 0; i < system->body_count; i++)
            numbers[i] = system->bodies[i].position[k];
        qsort(numbers, system->body_count, sizeof *numbers, compare_numbers);
        middle[k] = numbers[system->body_count / 2];
    }
}

typedef struct Bounds {
    double low[3];
    double high[3];
} Bounds;

// The box around all bodies within reach.
static Bounds find_bounds(const AutoSystem *system, const double middle[3], double reach) {
    Bounds bounds = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < system->body_count; i++) {
        const AutoBody *body = &system->bodies[i];
        const double *p = body->position;
        if (maths_hypot(maths_hypot(p[0] - middle[0], p[1] - middle[1]), p[2] - middle[2]) > reach)
            continue;
        for (int k = 0; k < 3; k++) {
            bounds.low[k] = fmin(bounds.low[k], p[k] - body->radius);
            bounds.high[k] = fmax(bounds.high[k], p[k] + body->radius);
        }
    }
    return bounds;
}

// The next of 1, 1.25, 1.6, 2, 2.5 … : sizes that are chosen again and again stay the same.
static double round_up(double x) {
    double step = ceil(maths_log10(x) * 10 - 1e-9);
    return maths_pow(10, step / 10);
}

void auto_frame(Arena *arena, AutoFrame *frame, const AutoSystem *system) {
    double median[3], half = 0, off = 0;
    if (system->body_count == 0) {
        if (frame->half == 0)
            *frame = (AutoFrame){.half = 1};
        return;
    }
    ArenaMark mark = arena_mark(arena);
    double *numbers = arena_alloc_array(arena, system->body_count, sizeof *numbers);
    find_median(system, median, numbers);
    Bounds bounds = find_bounds(system, median, reach_of_most(system, median, numbers));
    arena_rewind(arena, mark);
    int axes = system->dimensions == 3 ? 3 : 2;
    for (int k = 0; k < axes; k++) {
        half = fmax(half, (bounds.high[k] - bounds.low[k]) / 2);
        off = fmax(off, fmax(frame->middle[k] - bounds.low[k], bounds.high[k] - frame->middle[k]));
    }
    // Where the corners of the box may point towards us.
    double wanted = (axes == 3 ? 1.25 : 1.1) * half;
    if (!(wanted > 1e-9))
        wanted = 1;
    bool fits = off <= frame->half, wasteful = wanted < 0.4 * frame->half;
    if (frame->half > 0 && fits && !wasteful)
        return;
    for (int k = 0; k < 3; k++)
        frame->middle[k] = bounds.low[k] + (bounds.high[k] - bounds.low[k]) / 2;
    if (!(wanted <= frame->half) || wasteful)
        frame->half = round_up(wanted);
}
