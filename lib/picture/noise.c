// noise.c: see noise.h.
#include "picture/noise.h"

#include <math.h>

enum { LATTICE = 256, CHANNELS = 4 };

typedef struct Noise {
    const NOISEOperands *source;
    double frequency[2];
    int tile[2]; // number of cells after which the first octave repeats; 0: it does not repeat
    uint8_t order[LATTICE];
    double slopes[CHANNELS][LATTICE][2];
} Noise;

// Returns the number after `seed` of SVG's random number generator. Results range from 1 to 2³¹ - 2.
static int32_t next_number(int32_t seed) {
    enum { MODULUS = 2147483647, FACTOR = 16807, QUOTIENT = 127773, REST = 2836 };
    int32_t result = FACTOR * (seed % QUOTIENT) - REST * (seed / QUOTIENT);
    return result > 0 ? result : result + MODULUS;
}

static int32_t first_number(double seed) {
    enum { MAX_SEED = 2147483646 };
    double whole = trunc(seed);
    whole = whole <= 0 ? 1 - fmod(whole, MAX_SEED) : whole;
    return (int32_t)(whole < MAX_SEED ? whole : MAX_SEED);
}

static void make_lattice(Noise *noise) {
    int32_t number = first_number(noise->source->seed);
    for (int channel = 0; channel < CHANNELS; channel++)
        for (int i = 0; i < LATTICE; i++) {
            double *slope = noise->slopes[channel][i], length;
            for (int k = 0; k < 2; k++) {
                number = next_number(number);
                slope[k] = (number % (2 * LATTICE) - LATTICE) / (double)LATTICE;
            }
            length = sqrt(slope[0] * slope[0] + slope[1] * slope[1]);
            for (int k = 0; k < 2; k++)
                slope[k] = length > 0 ? slope[k] / length : 0;
        }
    for (int i = 0; i < LATTICE; i++)
        noise->order[i] = (uint8_t)i;
    for (int i = LATTICE - 1; i > 0; i--) {
        number = next_number(number);
        int other = number % LATTICE;
        uint8_t swapped = noise->order[i];
        noise->order[i] = noise->order[other];
        noise->order[other] = swapped;
    }
}

// Adjusts each frequency to the nearest value for which a tile contains a whole number of cells.
static void fit_tiles(Noise *noise) {
    for (int k = 0; k < 2; k++) {
        double side = noise->source->tile[k], frequency = fabs(noise->source->frequency[k]);
        noise->frequency[k] = frequency;
        if (!(side > 0) || !(noise->source->tile[1 - k] > 0) || !(frequency > 0))
            continue;
        double low = floor(side * frequency) / side, high = ceil(side * frequency) / side;
        noise->frequency[k] = low > 0 && frequency / low < high / frequency ? low : high;
        noise->tile[k] = (int)fmin(side * noise->frequency[k] + 0.5, 1 << 30);
    }
}

// The position of a coordinate x or y in the lattice.
typedef struct LatticePoint {
    int cell;    // index of the cell that contains the coordinate
    int next;    // index of the next cell
    double part; // position within the cell, 0 to 1
    double ease; // `part`, smoothed for interpolation
} LatticePoint;

static int in_lattice(double cell, double tile) {
    if (tile > 0)
        cell -= tile * floor(cell / tile);
    return (int)(cell - LATTICE * floor(cell / LATTICE)) & (LATTICE - 1);
}

static LatticePoint lattice_point_of(double x, double tile) {
    double cell = floor(x), part = x - cell;
    return (LatticePoint){in_lattice(cell, tile), in_lattice(cell + 1, tile), part, part * part * (3 - 2 * part)};
}

static double interpolate(double fraction, double a, double b) {
    return a + fraction * (b - a);
}

static double gradient_noise(const Noise *noise, int channel, const LatticePoint *x, const LatticePoint *y) {
    const uint8_t *order = noise->order;
    const double(*slopes)[2] = noise->slopes[channel];
    const double *s00 = slopes[order[(order[x->cell] + y->cell) & (LATTICE - 1)]];
    const double *s10 = slopes[order[(order[x->next] + y->cell) & (LATTICE - 1)]];
    const double *s01 = slopes[order[(order[x->cell] + y->next) & (LATTICE - 1)]];
    const double *s11 = slopes[order[(order[x->next] + y->next) & (LATTICE - 1)]];
    double above = interpolate(x->ease, x->part * s00[0] + y->part * s00[1], (x->part - 1) * s10[0] + y->part * s10[1]);
    double below = interpolate(x->ease, x->part * s01[0] + (y->part - 1) * s01[1],
                               (x->part - 1) * s11[0] + (y->part - 1) * s11[1]);
    return interpolate(y->ease, above, below);
}

// Returns the product of dx, dy and the gradient at a lattice point, for improved noise (Perlin, 2002) in the plane z.
// There are twelve gradients, which point from the centre of a cube to the middles of its edges.
static double slope_along(const Noise *noise, int x, int y, int z, double dx, double dy) {
    const uint8_t *order = noise->order;
    int edge = order[(order[(order[x] + y) & (LATTICE - 1)] + z) & (LATTICE - 1)] & 15;
    double u = edge < 8 ? dx : dy, v = edge < 4 ? dy : edge == 12 || edge == 14 ? dx : 0;
    return ((edge & 1) ? -u : u) + ((edge & 2) ? -v : v);
}

static double improved_ease(double t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

static double improved_noise(const Noise *noise, int channel, const LatticePoint *x, const LatticePoint *y) {
    double across = improved_ease(x->part);
    double above = interpolate(across, slope_along(noise, x->cell, y->cell, channel, x->part, y->part),
                               slope_along(noise, x->next, y->cell, channel, x->part - 1, y->part));
    double below = interpolate(across, slope_along(noise, x->cell, y->next, channel, x->part, y->part - 1),
                               slope_along(noise, x->next, y->next, channel, x->part - 1, y->part - 1));
    return interpolate(improved_ease(y->part), above, below);
}

// Computes the noise of the four channels at x, y. Results range from 0 to 1.
static void noise_at(const Noise *noise, double x, double y, double out[CHANNELS]) {
    int type = (int)noise->source->type;
    double sums[CHANNELS] = {0, 0, 0, 0}, ratio = 1;
    for (uint32_t octave = 0; octave < noise->source->octaves && isfinite(ratio); octave++, ratio *= 2) {
        double at_x = x * noise->frequency[0] * ratio, at_y = y * noise->frequency[1] * ratio;
        if (!(fabs(at_x) < 1e15) || !(fabs(at_y) < 1e15)) // doubles this large have hardly any fraction bits left
            break;
        LatticePoint place_x = lattice_point_of(at_x, noise->tile[0] * ratio),
                     place_y = lattice_point_of(at_y, noise->tile[1] * ratio);
        for (int channel = 0; channel < CHANNELS; channel++) {
            double wave = type == TURBULENCE_IMPROVED ? improved_noise(noise, channel, &place_x, &place_y)
                                                      : gradient_noise(noise, channel, &place_x, &place_y);
            sums[channel] += (type == TURBULENCE_FOLDED ? fabs(wave) : wave) / ratio;
        }
    }
    for (int channel = 0; channel < CHANNELS; channel++) {
        double sum = type == TURBULENCE_FOLDED ? sums[channel] : (sums[channel] + 1) / 2;
        out[channel] = fmin(fmax(sum, 0), 1);
    }
}

static uint32_t pixel_of(const double c[CHANNELS], double alpha) {
    double a = c[3] * alpha;
    uint32_t pixel = (uint32_t)lrint(255 * a) << 24;
    for (unsigned k = 0; k < 3; k++)
        pixel |= (uint32_t)lrint(255 * c[k] * a) << (16 - 8 * k);
    return pixel;
}

void noise_fill(const NOISEOperands *source, const DisplayMatrix *to_units, int left, int top, double alpha,
                uint32_t *pixels, int width, int height) {
    Noise noise = {.source = source};
    make_lattice(&noise);
    fit_tiles(&noise);
    for (int row = 0; row < height; row++)
        for (int column = 0; column < width; column++) {
            double x = left + column + 0.5, y = top + row + 0.5, c[CHANNELS];
            noise_at(&noise, to_units->xx * x + to_units->xy * y + to_units->x0,
                     to_units->yx * x + to_units->yy * y + to_units->y0, c);
            *pixels++ = pixel_of(c, alpha);
        }
}
