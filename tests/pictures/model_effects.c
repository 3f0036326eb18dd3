// model_effects.c: the effects of pictures.md 6 and 7 except noise (see model.h).
#include "model.h"

#include <math.h>
#include <string.h>

static const double TURN = 6.283185307179586;

// The inputs of a pass.
typedef struct Pass {
    const Work *work;
    const char *attrs;
    Edges edges;
    const Pic *t;    // combined inputs
    const Pic *last; // result of the previous pass
    int w;
    int h;
} Pass;

typedef Px Program(const Pass *pass, double u, double v);

static double number(const Pass *pass, const char *name, double default_value) {
    return model_number(pass->attrs, name, 0, default_value);
}

static double clamp(double x, double low, double high) {
    return fmin(fmax(x, low), high);
}

static Px scaled(Px p, double by) {
    for (int k = 0; k < 4; k++)
        p.c[k] *= by;
    return p;
}

static double alpha(const Pass *pass) {
    return number(pass, "alpha", 1);
}

static void run_pass(const Pass *usual, const Pic *last, bool reduced, Program *program, Pic *out) {
    Pass pass = *usual;
    int down = reduced ? (int)model_number(pass.attrs, "downsample", 0, 2) : 1;
    pass.last = last;
    pass.w = pass.work->w / down;
    pass.h = pass.work->h / down;
    model_target(out, pass.w, pass.h);
    for (int y = 0; y < pass.h; y++)
        for (int x = 0; x < pass.w; x++)
            out->at[y * pass.w + x] = program(&pass, (x + 0.5) / pass.w, (y + 0.5) / pass.h);
}

static Px merge_pass(const Pass *pass, double u, double v) {
    return model_merge(pass->work, &pass->edges, u, v);
}

static Px plain_pass(const Pass *pass, double u, double v) {
    return scaled(merge_pass(pass, u, v), alpha(pass));
}

// 6.1: blurs the input or the result of the previous pass.
static Px blurred(const Pass *pass, const Pic *from, int r, double sigma, int axis, double u, double v) {
    Px sum = {{0}};
    double total = 0;
    for (int i = -r; i <= r; i++) {
        double w = r > 0 ? exp(-i * i / (2 * sigma * sigma)) : 1;
        Px t = model_sample(from, &pass->edges, u + (axis == 0 ? (double)i / pass->w : 0),
                            v + (axis == 1 ? (double)i / pass->h : 0));
        for (int k = 0; k < 4; k++)
            sum.c[k] += w * t.c[k];
        total += w;
    }
    return scaled(sum, 1 / total);
}

static Px gauss(const Pass *pass, const Pic *from, int axis, double usual, double down, double u, double v) {
    int r = (int)floor(floor(model_number(pass->attrs, "radius", axis, usual)) / down);
    return blurred(pass, from, r, r * model_number(pass->attrs, "sigma", axis, 0.3), axis, u, v);
}

static double down(const Pass *pass) {
    return number(pass, "downsample", 2);
}

// Sections 6.2 to 6.4.
static void adjust(const Pass *pass, double exposure, double c[3]) {
    double k = number(pass, "contrast", 1);
    for (int i = 0; i < 3; i++)
        c[i] = c[i] * pow(2, number(pass, "exposure", exposure)) * k + number(pass, "brightness", 0) + (1 - k) / 2;
    double l = model_lum(c);
    for (int i = 0; i < 3; i++)
        c[i] *= pow(2, number(pass, "shadows", 0) * clamp(4 * (0.25 - l), 0, 1)) *
                pow(2, number(pass, "highlights", 0) * clamp(2 * (l - 0.5), 0, 1));
}

static void unpremultiply(const Px *t, double c[3]) {
    for (int k = 0; k < 3; k++)
        c[k] = t->c[3] > 0 ? t->c[k] / t->c[3] : 0;
}

static void to_hsv(const double c[3], double hsv[3]) {
    double v = fmax(c[0], fmax(c[1], c[2])), x = v - fmin(c[0], fmin(c[1], c[2])), h = 0;
    if (x > 0)
        h = v == c[0] ? (c[1] - c[2]) / x : v == c[1] ? 2 + (c[2] - c[0]) / x : 4 + (c[0] - c[1]) / x;
    hsv[0] = h / 6 - floor(h / 6);
    hsv[1] = x / (v + 1e-10);
    hsv[2] = v;
}

static void to_rgb(const double hsv[3], double c[3]) {
    static const double o[3] = {1, 2.0 / 3, 1.0 / 3};
    for (int k = 0; k < 3; k++) {
        double t = hsv[0] + o[k];
        double share = clamp(fabs(6 * (t - floor(t)) - 3) - 1, 0, 1);
        c[k] = hsv[2] * (1 - hsv[1] + hsv[1] * share);
    }
}

static void product(const double m[9], bool columns, const double x[3], double out[3]) {
    for (int row = 0; row < 3; row++) {
        out[row] = 0;
        for (int k = 0; k < 3; k++)
            out[row] += m[columns ? 3 * k + row : 3 * row + k] * x[k];
    }
}

// Section 7.1.
static void agx(double c[3], bool punchy) {
    static const double inset[9] = {0.842479062253094,  0.0423282422610123, 0.0423756549057051,
                                    0.0784335999999992, 0.878468636469772,  0.0784336,
                                    0.0792237451477643, 0.0791661274605434, 0.879142973793104};
    static const double outset[9] = {1.19687900512017,    -0.0528968517574562, -0.0529716355144438,
                                     -0.0980208811401368, 1.15190312990417,    -0.0980434501171241,
                                     -0.0990297440797205, -0.0989611768448433, 1.15107367264116};
    double y[3];
    product(inset, true, c, y);
    for (int k = 0; k < 3; k++) {
        double x = (clamp(log2(y[k]), -12.47393, 4.026069) + 12.47393) / 16.499999;
        y[k] = 15.5 * pow(x, 6) - 40.14 * pow(x, 5) + 31.96 * pow(x, 4) - 6.868 * pow(x, 3) + 0.4298 * x * x +
               0.1191 * x - 0.00232;
    }
    double l = model_lum(y);
    for (int k = 0; k < 3 && punchy; k++)
        y[k] = l + 1.4 * (pow(fmax(y[k], 0), 1.35) - l);
    product(outset, true, y, c);
}

static void tonemap(const Pass *pass, double c[3]) {
    static const double a[9] = {0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840, 0.13383, 0.83777};
    static const double q[9] = {1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602};
    double white = number(pass, "whitepoint", 0), x[3];
    if (model_word(pass->attrs, "tonemap", "agx") || model_word(pass->attrs, "tonemap", "agx_punchy"))
        agx(c, model_word(pass->attrs, "tonemap", "agx_punchy"));
    for (int k = 0; k < 3 && model_word(pass->attrs, "tonemap", "reinhard"); k++)
        c[k] = c[k] / (1 + c[k]) * (white > 1 ? 1 + c[k] / (white * white) : 1);
    if (!model_word(pass->attrs, "tonemap", "aces"))
        return;
    product(a, false, c, x);
    for (int k = 0; k < 3; k++)
        x[k] = (x[k] * (x[k] + 0.0245786) - 0.000090537) / (x[k] * (0.983729 * x[k] + 0.4329510) + 0.238081);
    product(q, false, x, c);
}

static Px adjust_pass(const Pass *pass, double u, double v) {
    Px m = merge_pass(pass, u, v);
    double c[3], hsv[3], matrix[9], moved[3];
    for (int i = 0; i < 9; i++)
        matrix[i] = model_number(pass->attrs, "color_matrix", i, i % 4 == 0);
    unpremultiply(&m, c);
    product(matrix, true, c, moved);
    to_hsv(moved, hsv);
    hsv[0] += number(pass, "hue", 0);
    hsv[1] *= number(pass, "saturation", 1);
    to_rgb(hsv, c);
    adjust(pass, 0, c);
    for (int k = 0; k < 3; k++)
        c[k] = pow(fmax(c[k], 0), number(pass, "gamma", 1));
    tonemap(pass, c);
    return scaled((Px){{c[0] * m.c[3], c[1] * m.c[3], c[2] * m.c[3], m.c[3]}}, alpha(pass));
}

// Section 7.2.
static Px blur_along(const Pass *pass, double u, double v) {
    return gauss(pass, pass->t, 0, 0, 1, u, v);
}
static Px blur_across(const Pass *pass, double u, double v) {
    return scaled(gauss(pass, pass->last, 1, 0, 1, u, v), alpha(pass));
}

// Passes of 7.3 to 7.5 at reduced resolution.
static Px reduced_along(const Pass *pass, double u, double v) {
    return gauss(pass, pass->last, 0, strcmp(pass->work->kind, "chromakey") == 0 ? 10 : 0, down(pass), u, v);
}
static Px reduced_across(const Pass *pass, double u, double v) {
    return gauss(pass, pass->last, 1, strcmp(pass->work->kind, "chromakey") == 0 ? 10 : 0, down(pass), u, v);
}

static Px bloom_bright(const Pass *pass, double u, double v) {
    Px t = model_sample(pass->t, &pass->edges, u, v);
    double c[3];
    unpremultiply(&t, c);
    adjust(pass, -1, c);
    return (Px){{c[0] * t.c[3], c[1] * t.c[3], c[2] * t.c[3], t.c[3]}};
}
static Px bloom_end(const Pass *pass, double u, double v) {
    Px t = model_sample(pass->t, &pass->edges, u, v), b = model_sample(pass->last, &pass->edges, u, v);
    for (int k = 0; k < 4; k++)
        t.c[k] = fmax(t.c[k], b.c[k]);
    return scaled(t, alpha(pass));
}

// Section 7.4.
static Px edges_along(const Pass *pass, double u, double v) {
    return gauss(pass, pass->t, 0, 0, down(pass), u, v);
}
static Px edges_end(const Pass *pass, double u, double v) {
    Px t = model_sample(pass->t, &pass->edges, u, v), b = model_sample(pass->last, &pass->edges, u, v), out;
    double mixer = number(pass, "mixer", 0);
    for (int k = 0; k < 4; k++) {
        double e = k < 3 ? fabs(b.c[k] - t.c[k]) : fmax(t.c[k], b.c[k]);
        out.c[k] = t.c[k] * mixer + e * (1 - t.c[3] * mixer);
    }
    return scaled(out, alpha(pass));
}

// Section 7.5.
static Px key_mask(const Pass *pass, double u, double v) {
    Px t = model_sample(pass->t, &pass->edges, u, v);
    double hsv[3], hue = number(pass, "hue", 1.0 / 3), half = number(pass, "range", 0.1) / 2;
    to_hsv(t.c, hsv);
    bool key = hue - half < hsv[0] && hsv[0] < hue + half && hsv[1] > number(pass, "saturation", 0.75) &&
               hsv[2] > number(pass, "brightness", 0.1);
    return key ? (Px){{0}} : (Px){{1, 1, 1, 1}};
}
static Px key_end(const Pass *pass, double u, double v) {
    Px t = model_sample(pass->t, &pass->edges, u, v), mask = model_sample(pass->last, &pass->edges, u, v);
    for (int k = 0; k < 4; k++)
        t.c[k] *= pow(mask.c[k], number(pass, "hard", 4));
    return scaled(t, alpha(pass));
}

// Section 7.6.
static Px feedback_pass(const Pass *pass, double u, double v) {
    const Work *work = pass->work;
    double tau = work->past ? work->beats / number(pass, "timebase", 1) : 0, mixer = number(pass, "mixer", 0);
    double x = (u - 0.5) * pass->w / pow(model_number(pass->attrs, "scale", 0, 1), tau);
    double y = (v - 0.5) * pass->h / pow(model_number(pass->attrs, "scale", 1, 1), tau);
    double angle = TURN * number(pass, "rotate", 0) * tau, qx = x * cos(angle) - y * sin(angle);
    double qy = x * sin(angle) + y * cos(angle), k = mixer > 0 ? pow(mixer, tau) : 0;
    qx -= model_number(pass->attrs, "translate", 0, 0) * tau;
    qy += model_number(pass->attrs, "translate", 1, 0) * tau;
    Px m = merge_pass(pass, u, v), before = {{0}};
    if (work->past)
        before = model_sample(&work->last, &pass->edges, qx / pass->w + 0.5, qy / pass->h + 0.5);
    for (int i = 0; i < 4; i++)
        m.c[i] = (1 - k) * m.c[i] * (1 + number(pass, "glow", 0)) + k * before.c[i];
    return scaled(m, alpha(pass));
}

// 7.7: M = A1 A2 … The inverse of M is applied to coordinates, so the first attribute is undone first.
static Px transform_pass(const Pass *pass, double u, double v) {
    double p[3] = {(u - 0.5) * pass->w, (v - 0.5) * pass->h, 1};
    for (const char *at = pass->attrs; *at; at += strcspn(at, " "), at += strspn(at, " ")) {
        double x = p[0], y = p[1];
        if (strncmp(at, "scale=", 6) == 0) {
            p[0] /= model_number(at, "scale", 0, 1), p[1] /= model_number(at, "scale", 1, 1);
        } else if (strncmp(at, "rotate=", 7) == 0) {
            double angle = TURN * model_number(at, "rotate", 0, 0);
            p[0] = x * cos(angle) + y * sin(angle), p[1] = -x * sin(angle) + y * cos(angle);
        } else if (strncmp(at, "translate=", 10) == 0) {
            p[0] -= model_number(at, "translate", 0, 0) * p[2], p[1] -= model_number(at, "translate", 1, 0) * p[2];
        } else if (strncmp(at, "keystone=", 9) == 0) {
            p[2] -= model_number(at, "keystone", 0, 0) / pass->w * x + model_number(at, "keystone", 1, 0) / pass->h * y;
        }
    }
    return scaled(merge_pass(pass, p[0] / p[2] / pass->w + 0.5, p[1] / p[2] / pass->h + 0.5), alpha(pass));
}

// Sections 7.8 and 6.5.
static double fade(const Pass *pass, double x) {
    double inset = number(pass, "inset", 0.25);
    x = clamp(x < inset ? x / inset : x > 1 - inset ? (1 - x) / inset : 1, 0, 1);
    if (model_word(pass->attrs, "fade", "quad"))
        return x < 0.5 ? 2 * x * x : 1 - 2 * (1 - x) * (1 - x);
    if (model_word(pass->attrs, "fade", "cubic"))
        return x < 0.5 ? 4 * x * x * x : 1 - 4 * (1 - x) * (1 - x) * (1 - x);
    return x;
}
static Px vignette_pass(const Pass *pass, double u, double v) {
    double share = number(pass, "inset", 0.25) <= 0 ? 1 : fade(pass, u) * fade(pass, v);
    return scaled(merge_pass(pass, u, v), share * alpha(pass));
}

// Section 7.11.
static Px kaleid_pass(const Pass *pass, double u, double v) {
    double px = (u - 0.5) * pass->w, py = (v - 0.5) * pass->h, rotation = number(pass, "rotation", 0);
    double segments = number(pass, "segments", 6), t = (atan2(py, px) / TURN + 0.5 - rotation) * segments;
    double i = floor(t), s = number(pass, "radius", 1) * fmin(pass->w, pass->h) / 2, r = hypot(px, py) / s;
    double j = floor(r);
    t = fmod(fabs(i), 2) == 0 ? t - i : i + 1 - t;
    r = (fmod(j, 2) == 0 ? r - j : j + 1 - r) * s;
    double angle = TURN * (t / segments + rotation - 0.5);
    return scaled(merge_pass(pass, r * cos(angle) / pass->w + 0.5, r * sin(angle) / pass->h + 0.5), alpha(pass));
}

// Section 7.10.
static void add_bright(const Pass *pass, Px t, const double by[3], double sum[3]) {
    double x = clamp(model_lum(t.c) - number(pass, "threshold", 1), 0, 1), w = x * x * (3 - 2 * x);
    for (int k = 0; k < 3; k++)
        sum[k] += t.c[k] * w * by[k];
}

static void add_ghost(const Pass *pass, const double row[4], double u, double v, double out[3]) {
    static const double S[6][3] = {{.1, 0, .3}, {0, 0, .5}, {0, .25, .2}, {0, .5, 0}, {.4, .25, 0}, {.5, 0, 0}};
    double p[2] = {(u - 0.5) * pass->w, (v - 0.5) * pass->h}, r = hypot(p[0], p[1]);
    double R = hypot(pass->w, pass->h) / 2, moved = (1 - pow(1 - r / R, row[0])) * R / row[1];
    double w = 1 - pow(clamp(moved / R, 0, 1), 2), sum[3] = {0}, ab = number(pass, "aberration", 1) * row[3];
    for (int j = 0; j < (ab > 0 ? 6 : 1); j++) {
        static const double one[3] = {1, 1, 1};
        double by = r > 0 ? moved / r * (ab > 0 ? 1 + (j / 5.0 - 0.5) * ab / 4 : 1) : 0;
        Px t = model_sample(pass->t, &pass->edges, 0.5 + p[0] * by / pass->w, 0.5 + p[1] * by / pass->h);
        add_bright(pass, t, ab > 0 ? S[j] : one, sum);
    }
    for (int k = 0; k < 3; k++)
        out[k] += sum[k] * pow(2, -(number(pass, "attenuation", 2) + row[2])) * w;
}

static Px flare_ghosts(const Pass *pass, double u, double v) {
    static const double rows[6][4] = {{1, -1.25, 0, 1}, {1.5, -.25, 0, 1}, {.5, .25, 1, 1},
                                      {.75, -3, 2, .5}, {.25, 2, 3, .5},   {1, -.75, 1, 1}};
    double sum[3] = {0}, halo[3] = {0}, rho = number(pass, "halo_radius", 0.0625) * fmin(pass->w, pass->h) / 2;
    double n = TURN * rho;
    for (int i = 0; i < (int)number(pass, "ghosts", 6); i++)
        add_ghost(pass, rows[i], u, v, sum);
    for (int i = 0; i < n; i++) {
        const double share[3] = {1 / n, 1 / n, 1 / n};
        double angle = TURN * i / n;
        Px t = model_sample(pass->t, &pass->edges, u + rho * cos(angle) / pass->w, v + rho * sin(angle) / pass->h);
        add_bright(pass, t, share, halo);
    }
    double by = pow(2, -(number(pass, "attenuation", 2) - 0.5 + number(pass, "halo_attenuation", 0)));
    return (Px){{sum[0] + halo[0] * by, sum[1] + halo[1] * by, sum[2] + halo[2] * by, 1}};
}

static void add_streak(const Pass *pass, double n, double slant, double u, double v, double sum[3]) {
    for (int i = 0; i < n; i++) {
        Px brightest = {{0}};
        for (int s = 0; s < 4; s++) {
            double x = slant != 0 ? (s & 1 ? -i : i) : s < 2 ? (s & 1 ? -i : i) : 0;
            double y = slant != 0 ? (s & 2 ? -i : i) : s < 2 ? 0 : s & 1 ? -i : i;
            Px t = model_sample(pass->t, &pass->edges, u + x / pass->w, v + y / pass->h);
            for (int k = 0; k < 3; k++)
                brightest.c[k] = s == 0 ? t.c[k] : fmax(brightest.c[k], t.c[k]);
        }
        double share = (1 - i / n) * (1 - i / n) / n;
        add_bright(pass, brightest, (const double[3]){share, share, share}, sum);
    }
}

static Px flare_along(const Pass *pass, double u, double v) {
    int r = (int)floor(0.05 * fmin(pass->w, pass->h));
    return blurred(pass, pass->last, r, 0.3 * r, 0, u, v);
}
static Px flare_across(const Pass *pass, double u, double v) {
    int r = (int)floor(0.05 * fmin(pass->w, pass->h));
    double side = fmin(pass->w, pass->h) / 2, upright[3] = {0}, diagonal[3] = {0};
    Px b = blurred(pass, pass->last, r, 0.3 * r, 1, u, v);
    add_streak(pass, number(pass, "upright_length", 0.25) * side, 0, u, v, upright);
    add_streak(pass, number(pass, "diagonal_length", 0.125) * side * sqrt(0.5), 1, u, v, diagonal);
    for (int k = 0; k < 3; k++)
        b.c[k] += fmax(upright[k], diagonal[k]) * pow(2, -number(pass, "attenuation", 2));
    return b;
}
static Px flare_end(const Pass *pass, double u, double v) {
    Px t = model_sample(pass->t, &pass->edges, u, v), f = model_sample(pass->last, &pass->edges, u, v);
    for (int k = 0; k < 4; k++)
        t.c[k] = k < 3 ? t.c[k] + f.c[k] : fmin(t.c[k] + f.c[k], 1);
    return scaled(t, alpha(pass));
}

static const struct {
    const char *kind;
    bool clamped;
    bool merges;
    bool reduced; // true if all passes except the last use a reduced size
    Program *passes[4];
} effects[] = {
    {"window", false, false, false, {plain_pass}},
    {"adjust", false, false, false, {adjust_pass}},
    {"blur", true, true, false, {blur_along, blur_across}},
    {"bloom", true, true, true, {bloom_bright, reduced_along, reduced_across, bloom_end}},
    {"edges", true, true, true, {edges_along, reduced_across, edges_end}},
    {"chromakey", true, true, true, {key_mask, reduced_along, reduced_across, key_end}},
    {"feedback", true, false, false, {feedback_pass}},
    {"transform", false, false, false, {transform_pass}},
    {"vignette", false, false, false, {vignette_pass}},
    {"flare", false, true, true, {flare_ghosts, flare_along, flare_across, flare_end}},
    {"kaleid", false, false, false, {kaleid_pass}},
};

void model_effect(const Work *work, Pic *out) {
    static Pic merged, results[4];
    size_t e = 0;
    if (strcmp(work->kind, "noise") == 0) {
        model_noise(work, out);
        return;
    }
    while (e + 1 < sizeof effects / sizeof *effects && strcmp(effects[e].kind, work->kind) != 0)
        e++;
    Pass pass = {.work = work, .attrs = work->attrs, .edges = model_edges(work->attrs, effects[e].clamped)};
    pass.t = &work->in[0];
    if (effects[e].merges && work->n > 1) {
        run_pass(&pass, NULL, false, merge_pass, &merged);
        pass.t = &merged;
    }
    const Pic *last = NULL;
    for (int i = 0; i < 4 && effects[e].passes[i]; i++) {
        bool end = i == 3 || !effects[e].passes[i + 1];
        run_pass(&pass, last, effects[e].reduced && !end, effects[e].passes[i], &results[i]);
        last = &results[i];
    }
    *out = *last;
}
