// turbulence.h: model of lib/spec/canvas.md 5.5: the noise of SVG's feTurbulence, as described in Filter Effects 1.
#pragma once

#include <math.h>
#include <stddef.h>

typedef struct Turbulence {
    int lattice[514];
    double gradient[4][514][2];
} Turbulence;

static inline long turbulence_random(long seed) {
    long result = 16807 * (seed % 127773) - 2836 * (seed / 127773);
    return result <= 0 ? result + 2147483647 : result;
}

static inline void turbulence_init(Turbulence *t, long seed) {
    if (seed <= 0)
        seed = -(seed % 2147483646) + 1;
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 256; i++) {
            t->lattice[i] = i;
            for (int j = 0; j < 2; j++) {
                seed = turbulence_random(seed);
                t->gradient[k][i][j] = (double)((seed % 512) - 256) / 256;
            }
            double s = hypot(t->gradient[k][i][0], t->gradient[k][i][1]);
            t->gradient[k][i][0] /= s;
            t->gradient[k][i][1] /= s;
        }
    for (int i = 255; i > 0; i--) {
        seed = turbulence_random(seed);
        int j = (int)(seed % 256), kept = t->lattice[i];
        t->lattice[i] = t->lattice[j];
        t->lattice[j] = kept;
    }
    for (int i = 0; i < 258; i++) {
        t->lattice[256 + i] = t->lattice[i];
        for (int k = 0; k < 4; k++)
            memcpy(t->gradient[k][256 + i], t->gradient[k][i], sizeof t->gradient[k][i]);
    }
}

// `wrap`: number of noise cells per tile in this octave; 0: the noise does not repeat.
static inline double turbulence_noise(const Turbulence *t, int channel, double x, double y, const int wrap[2]) {
    double at[2] = {x + 4096, y + 4096}, r0[2], r1[2];
    int b0[2], b1[2];
    for (int k = 0; k < 2; k++) {
        b0[k] = (int)at[k];
        b1[k] = b0[k] + 1;
        r0[k] = at[k] - b0[k];
        r1[k] = r0[k] - 1;
        if (wrap[k] > 0) {
            b0[k] -= b0[k] >= 4096 + wrap[k] ? wrap[k] * ((b0[k] - 4096) / wrap[k]) : 0;
            b1[k] -= b1[k] >= 4096 + wrap[k] ? wrap[k] * ((b1[k] - 4096) / wrap[k]) : 0;
        }
        b0[k] &= 255;
        b1[k] &= 255;
    }
    int i = t->lattice[b0[0]], j = t->lattice[b1[0]];
    const double *g00 = t->gradient[channel][t->lattice[i + b0[1]]], *g10 = t->gradient[channel][t->lattice[j + b0[1]]];
    const double *g01 = t->gradient[channel][t->lattice[i + b1[1]]], *g11 = t->gradient[channel][t->lattice[j + b1[1]]];
    double sx = r0[0] * r0[0] * (3 - 2 * r0[0]), sy = r0[1] * r0[1] * (3 - 2 * r0[1]);
    double u = r0[0] * g00[0] + r0[1] * g00[1], v = r1[0] * g10[0] + r0[1] * g10[1], a = u + sx * (v - u);
    u = r0[0] * g01[0] + r1[1] * g01[1], v = r1[0] * g11[0] + r1[1] * g11[1];
    double b = u + sx * (v - u);
    return a + sy * (b - a);
}
