// model.c: reading of attributes, sampling, compositing and noise (see model.h).
#include "model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double TURN = 6.283185307179586;

// Returns the text after ` name=`.
static const char *find_attr(const char *attrs, const char *name) {
    size_t length = strlen(name);
    for (const char *at = attrs; (at = strstr(at, name)) != NULL; at++)
        if (at[length] == '=' && (at == attrs || at[-1] == ' '))
            return at + length + 1;
    return NULL;
}

bool model_has(const char *attrs, const char *name) {
    return find_attr(attrs, name) != NULL;
}

static double read_number_at(const char *at) {
    return strncmp(at, "true", 4) == 0 ? 1 : strtod(at, NULL);
}

double model_number(const char *attrs, const char *name, int k, double default_value) {
    const char *at = find_attr(attrs, name);
    if (!at)
        return default_value;
    double first = read_number_at(at);
    for (const char *next = at; k > 0; k--) {
        next += strcspn(next, "; ");
        if (*next != ';')
            return first;
        first = read_number_at(++next);
    }
    return first;
}

bool model_word(const char *attrs, const char *name, const char *word) {
    const char *at = find_attr(attrs, name);
    return at && *at == ':' && strncmp(at + 1, word, strlen(word)) == 0 && strchr(" ", at[1 + strlen(word)]);
}

double model_lin(double e) {
    return e <= 0.04045 ? e / 12.92 : pow((e + 0.055) / 1.055, 2.4);
}

double model_enc(double c) {
    c = c > 0 ? fmin(c, 1) : 0;
    return c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
}

double model_lum(const double c[3]) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

static Px texel(const Pic *pic, const Edges *edges, int x, int y) {
    int at[2] = {x, y}, size[2] = {pic->w, pic->h};
    for (int k = 0; k < 2; k++) {
        if (edges->repeat[k])
            at[k] = (at[k] % size[k] + size[k]) % size[k];
        else if (edges->clamped || edges->repeat[1 - k])
            at[k] = at[k] < 0 ? 0 : at[k] < size[k] ? at[k] : size[k] - 1;
        if (at[k] < 0 || at[k] >= size[k])
            return (Px){{edges->border[0], edges->border[1], edges->border[2], edges->border[3]}};
    }
    return pic->at[at[1] * pic->w + at[0]];
}

Px model_sample(const Pic *pic, const Edges *edges, double u, double v) {
    double x = u * pic->w - 0.5, y = v * pic->h - 0.5;
    if (edges->nearest)
        return texel(pic, edges, (int)floor(x + 0.5), (int)floor(y + 0.5));
    Px sum = {{0}};
    for (int i = 0; i < 4; i++) {
        int left = (int)floor(x), low = (int)floor(y);
        double share = (i & 1 ? x - left : 1 - (x - left)) * (i & 2 ? y - low : 1 - (y - low));
        Px part = texel(pic, edges, left + (i & 1), low + (i >> 1));
        for (int k = 0; k < 4; k++)
            sum.c[k] += share * part.c[k];
    }
    return sum;
}

Edges model_edges(const char *attrs, bool clamped) {
    Edges edges = {.nearest = model_number(attrs, "nearest", 0, 0) != 0};
    if (model_has(attrs, "border"))
        for (int k = 0; k < 4; k++)
            edges.border[k] = model_number(attrs, "border", k, 0);
    else if (model_has(attrs, "repeat"))
        for (int k = 0; k < 2; k++)
            edges.repeat[k] = model_number(attrs, "repeat", k, 0) != 0;
    else
        edges.clamped = clamped;
    return edges;
}

static Px combine_pixels(const char *attrs, Px s, Px d) {
    Px m;
    for (int k = 0; k < 4; k++)
        if (model_word(attrs, "composite", "dest_over"))
            m.c[k] = s.c[k] * (1 - d.c[3]) + d.c[k];
        else if (model_word(attrs, "composite", "lighten"))
            m.c[k] = fmax(s.c[k], d.c[k]);
        else if (model_word(attrs, "composite", "darken"))
            m.c[k] = fmin(s.c[k], d.c[k]);
        else if (model_word(attrs, "composite", "add"))
            m.c[k] = k < 3 ? s.c[k] + d.c[k] : fmin(s.c[k] + d.c[k], 1);
        else if (model_word(attrs, "composite", "difference"))
            m.c[k] = k < 3 ? fabs(d.c[k] - s.c[k]) : fmax(s.c[k], d.c[k]);
        else if (model_word(attrs, "composite", "multiply"))
            m.c[k] = s.c[k] * d.c[k];
        else
            m.c[k] = s.c[k] + d.c[k] * (1 - s.c[3]);
    return m;
}

Px model_merge(const Work *work, const Edges *edges, double u, double v) {
    Px m = {{0}};
    for (int i = 0; i < work->n; i++) {
        Px t = model_sample(&work->in[i], edges, u, v);
        m = i == 0 ? t : combine_pixels(work->attrs, t, m);
    }
    return m;
}

void model_target(Pic *pic, int w, int h) {
    pic->w = w;
    pic->h = h;
    memset(pic->at, 0, sizeof pic->at);
}

// Noise (7.9). The hash is computed with floats, so their rounding matters.
static float perm(float t) {
    t -= 289 * floorf(t / 289);
    return t * (34 * t + 133);
}

static double corner(float h, const double q[3], const double v[3]) {
    double d[3], near = 0.75, cube[3], o[3], r[3], kappa = 1, sum = 0;
    float g = perm(perm(perm(h + (float)v[0]) + (float)v[1]) + (float)v[2]);
    int hash = (int)(g - 48 * floorf(g / 48));
    for (int k = 0; k < 3; k++) {
        d[k] = q[k] - v[k];
        near -= d[k] * d[k];
        cube[k] = 2 * (hash >> k & 1) - 1;
        o[k] = hash / 16 == k ? 0 : cube[k];
        r[k] = cube[k];
    }
    if (hash / 8 % 2 == 1) {
        kappa = 1 - 0.042942436724648037;
        for (int k = 0; k < 3; k++)
            r[k] = o[k] + cube[(k + 1) % 3] * o[(k + 2) % 3] - cube[(k + 2) % 3] * o[(k + 1) % 3];
    }
    for (int k = 0; k < 3; k++)
        sum += d[k] * (1.22474487139 * o[k] + r[k]) * kappa * 3.5946317686139184;
    return near > 0 ? near * near * near * near * sum : 0;
}

static double lattice(float h, const double q[3]) {
    double b[3], f[3], v[3], sum, all = 0;
    for (int k = 0; k < 3; k++) {
        b[k] = floor(q[k]);
        f[k] = q[k] - b[k];
        all += f[k];
    }
    for (int k = 0; k < 3; k++)
        v[k] = b[k] + floor(all / 4 + 0.625);
    sum = corner(h, q, v);
    for (int i = 0; i < 3; i++) {
        double step = floor((all - 2 * f[i]) / 4 + 0.875);
        for (int k = 0; k < 3; k++)
            v[k] = b[k] + (k == i) + (k == i ? -step : step);
        sum += corner(h, q, v);
    }
    return sum;
}

static double noise(float h, const double p[3], bool plane) {
    static const double a = 0.788675134594813, b = -0.211324865405187, c = 0.577350269189626;
    double q[3], third = 2 * (p[0] + p[1] + p[2]) / 3;
    for (int k = 0; k < 3; k++)
        q[k] = third - p[k];
    if (plane) {
        q[0] = a * p[0] + b * p[1] + c * p[2];
        q[1] = b * p[0] + a * p[1] + c * p[2];
        q[2] = -c * p[0] - c * p[1] + c * p[2];
    }
    double moved[3] = {q[0] + 144.5, q[1] + 144.5, q[2] + 144.5};
    return lattice(h, q) + lattice(h, moved);
}

// Returns the seed hash (builtins.md B9.2) of an empty vector or of one number.
static float seed_of(const char *attrs) {
    uint64_t h = UINT64_C(0xe220a8397b1dcdaf), bits;
    if (model_has(attrs, "seed")) {
        double x = model_number(attrs, "seed", 0, 0);
        memcpy(&bits, &x, sizeof bits);
        h = (h ^ bits) + UINT64_C(0x9e3779b97f4a7c15);
        h = (h ^ (h >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
        h = (h ^ (h >> 27)) * UINT64_C(0x94d049bb133111eb);
        h ^= h >> 31;
    }
    return (float)((double)(int64_t)h / 281474976710656.0);
}

static void find_point(const Work *work, double u, double v, double p[3]) {
    double around = work->w / TURN, phi = TURN / 2 * (v - 0.5);
    p[0] = u * work->w, p[1] = v * work->h, p[2] = 0;
    if (model_word(work->attrs, "shape", "cylinder"))
        p[0] = around * cos(TURN * u), p[1] = around * sin(TURN * u), p[2] = v * work->h;
    if (model_word(work->attrs, "shape", "sphere"))
        p[0] = around * cos(phi) * cos(TURN * u), p[1] = around * cos(phi) * sin(TURN * u), p[2] = around * sin(phi);
}

static Px noise_at(const Work *work, const Edges *edges, double u, double v) {
    const char *attrs = work->attrs;
    double p[3], rough = model_number(attrs, "roughness", 0, 0.5);
    bool round = model_word(attrs, "shape", "cylinder") || model_word(attrs, "shape", "sphere");
    find_point(work, u, v, p);
    p[0] += model_number(attrs, "origin", 0, 0);
    p[1] += model_number(attrs, "origin", 1, 0);
    p[2] += model_number(attrs, "z", 0, 0);
    Px m = model_merge(work, edges, u, v), out;
    for (int k = 0; k < 3; k++)
        p[k] = (p[k] + m.c[k] * model_number(attrs, "tscale", k, 1)) * model_number(attrs, "scale", k, 1);
    float h = seed_of(attrs);
    for (int j = 0; j < 4; j++) {
        double sum = 0, total = 0;
        for (int i = 0; i < (int)model_number(attrs, "octaves", 0, 1); i++) {
            double share = pow(rough, i), at[3] = {p[0] / share, p[1] / share, p[2] / share};
            sum += share * noise(h, at, !round);
            total += share;
        }
        out.c[j] = j < (int)model_number(attrs, "components", 0, 1)
                       ? sum / total * model_number(attrs, "multiplier", 0, 0.5) + model_number(attrs, "offset", 0, 0.5)
                       : model_number(attrs, "default", j, 1);
        out.c[j] *= model_number(attrs, "alpha", 0, 1);
        h = perm(h + 1);
    }
    return out;
}

void model_noise(const Work *work, Pic *out) {
    Edges edges = model_edges(work->attrs, false);
    model_target(out, work->w, work->h);
    for (int y = 0; y < out->h; y++)
        for (int x = 0; x < out->w; x++)
            out->at[y * out->w + x] = noise_at(work, &edges, (x + 0.5) / out->w, (y + 0.5) / out->h);
}
