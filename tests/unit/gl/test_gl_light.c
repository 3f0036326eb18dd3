// test_gl_light.c: compares pixels of scenes with an independent model of spec canvas3d.md 5.
//
// The surface is a wall at z = 0, or the nearest point of a sphere. The script and the model are created from the same
// record.
#include "check.h"
#include "petri-draw.h"
#include "petri.h"

#include <stdlib.h>

enum { SIZE = 32, TOLERANCE = 2, LIGHTS_MAX = 3 };

typedef struct Light {
    enum { NONE, AMBIENT, DIRECTIONAL, SPOT, POINT, LINE } kind;
    double color[3];
    double position[3];  // for a line light: its start
    double direction[3]; // for a line light: its end; for a spot light: its focus
    double radius;
    double outer;
    double inner;
    double falloff[4];
} Light;

typedef struct Case {
    const char *name;
    double color[3];
    double emissive[3];
    double roughness;
    double metal;
    double ior;
    double ao;
    double transparency;
    double translucency; // the wall has thickness 1
    bool orthographic;
    bool monochrome;
    double tint[3];
    double fog_min;
    double fog_max;
    double fog_curve;
    Light lights[LIGHTS_MAX];
} Case;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double size_of(const double a[3]) {
    return sqrt(dot(a, a));
}

static double norm(double a[3]) {
    double length = size_of(a);
    for (int k = 0; k < 3; k++)
        a[k] /= length;
    return length;
}

static void add_scaled(double out[3], const double a[3], double x, const double b[3]) {
    for (int k = 0; k < 3; k++)
        out[k] = a[k] + x * b[k];
}

static double clamp(double x, double low, double high) {
    return fmin(fmax(x, low), high);
}

static double lum(const double c[3]) {
    return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
}

typedef struct Point {
    const Case *c;
    double p[3], N[3], V[3], F0[3], NV, GV, alpha2, k, D;
    double diffuse[3], specular[3];
} Point;

static void step(Point *at, const Light *light, const double L[3], double d, double b, bool first, bool last) {
    const double *f = light->falloff;
    double NL = clamp(dot(at->N, L), 0, 1), I[3], max = 0;
    if (NL == 0)
        return;
    for (int k = 0; k < 3; k++) {
        I[k] = light->color[k] * b * NL / (f[0] + f[1] * d + f[2] * d * d + f[3] * d * d * d);
        max = fmax(max, fabs(I[k]));
    }
    if (max < 1e-3 * (last ? at->alpha2 : 1))
        return;
    double H[3];
    add_scaled(H, at->V, 1, L);
    norm(H);
    double HV = clamp(dot(H, at->V), 0, 1), NH = clamp(dot(at->N, H), 0, 1);
    double Dn = at->alpha2 / pow(NH * NH * (at->alpha2 - 1) + 1, 2), G = at->GV * NL / (NL * (1 - at->k) + at->k);
    for (int k = 0; k < 3; k++) {
        double F = at->F0[k] + (1 - at->F0[k]) * pow(1 - HV, 5);
        at->diffuse[k] += first ? I[k] * (1 - at->F0[k]) * (1 - at->c->metal) * at->c->color[k] : 0;
        at->specular[k] += last ? I[k] * Dn * G * F / (4 * at->NV * NL + 1e-6) : 0;
    }
}

static void point_light(Point *at, const Light *light, double Q[3]) {
    double r = light->radius, L[3], R[3], l[3], zero[3] = {0};
    add_scaled(L, Q, 0, zero);
    double d = norm(L);
    if (r == 0) {
        step(at, light, L, d, 1, true, true);
        return;
    }
    double b = clamp(1 - r / d, 0.005, 1);
    step(at, light, L, d - fmin(r, 0.99 * d), b, true, false);
    add_scaled(R, at->V, -2 * dot(at->V, at->N), at->N);
    add_scaled(l, zero, dot(Q, R), R);
    add_scaled(l, l, -1, Q);
    add_scaled(L, Q, fmin(0.99, r / size_of(l)), l);
    d = norm(L);
    step(at, light, L, d, b, false, true);
}

static void line_light(Point *at, const Light *light, const double Q[3]) {
    double a[3], near[3], R[3], l[3], zero[3] = {0}, r = light->radius;
    add_scaled(a, light->direction, -1, light->position);
    double len = norm(a), cp = clamp(-dot(Q, a), 0, len), ip = clamp(-dot(Q, at->N) / dot(a, at->N), 0, len);
    double mu = len / 2;
    if (dot(Q, at->N) < 0) {
        mu = (ip + len) / 2;
        cp = fmax(cp, ip);
    } else if (dot(Q, at->N) + len * dot(a, at->N) < 0) {
        mu = ip / 2;
        cp = fmin(cp, ip);
    }
    add_scaled(near, Q, (3 * cp + mu) / 4, a);
    double d = norm(near);
    step(at, light, near, d - fmin(r, 0.99 * d), clamp(1 - r / d, 0, 1), true, false);
    add_scaled(R, at->V, -2 * dot(at->V, at->N), at->N);
    double s = dot(R, a), beta = (dot(Q, a) - s * dot(Q, R)) / (1 - s * s);
    add_scaled(near, Q, clamp(-beta, 0, len), a);
    add_scaled(l, zero, dot(near, R), R);
    add_scaled(l, l, -1, near);
    double D0 = size_of(near), b = clamp(1 - r / D0, 0, 1);
    add_scaled(near, near, fmin(0.99, r / D0), l);
    d = norm(near);
    step(at, light, near, d, b, false, true);
}

static void add_light(Point *at, const Light *light) {
    double Q[3], L[3], zero[3] = {0}, towards[3];
    add_scaled(Q, light->position, -1, at->p);
    if (light->kind == AMBIENT) {
        for (int k = 0; k < 3; k++)
            at->diffuse[k] += (1 - at->F0[k]) * (1 - at->c->metal) * at->c->color[k] * light->color[k] * at->c->ao;
    } else if (light->kind == DIRECTIONAL) {
        add_scaled(L, zero, -1, light->direction);
        norm(L);
        step(at, light, L, 1, 1, true, true);
    } else if (light->kind == SPOT) {
        const double pi = 3.141592653589793;
        add_scaled(towards, light->direction, -1, light->position);
        norm(towards);
        double d = norm(Q), x = -dot(Q, towards), i = cos(pi * light->inner), o = cos(pi * light->outer);
        step(at, light, Q, d, 1 - clamp((i - x) / (i - o), 0, 1), true, true);
    } else if (light->kind == POINT) {
        point_light(at, light, Q);
    } else if (light->kind == LINE) {
        line_light(at, light, Q);
    }
}

// Adds to `at` the light that enters through the back of the wall (canvas3d.md 5.6). All points of the back receive the
// same light. Also reduces *opacity.
static void come_through(Point *at, const Case *c, double *opacity) {
    const Light *light = &c->lights[0];
    double T = pow(0.5, 1 / c->translucency), towards[3], zero[3] = {0};
    add_scaled(towards, zero, 1, light->direction);
    norm(towards);
    for (int k = 0; k < 3; k++) {
        double in =
            light->color[k] * clamp(towards[2], 0, 1) * (1 - at->F0[k]) * (1 - c->metal) * (1 + c->color[k]) / 2;
        at->specular[k] += in * c->color[k] * T * (1 - T);
    }
    *opacity *= 1 - pow(T, 5);
}

// Computes the colour of point p of a surface with normal N, seen by a camera at 0;0;4 that looks along -z.
static void model(const Case *c, const double p[3], const double N[3], double out[3]) {
    double eye[3] = {0, 0, 4};
    Point at = {.c = c, .p = {p[0], p[1], p[2]}, .N = {N[0], N[1], N[2]}, .V = {0, 0, 1}, .D = 4 - p[2]};
    if (!c->orthographic) {
        add_scaled(at.V, eye, -1, p);
        at.D = norm(at.V);
    }
    double R = c->roughness, l = lum(c->emissive), f0 = pow((c->ior - 1) / (c->ior + 1), 2);
    at.alpha2 = R * R * R * R;
    at.k = (R + 1) * (R + 1) / 8;
    at.NV = clamp(dot(at.N, at.V), 0, 1);
    at.GV = at.NV / (at.NV * (1 - at.k) + at.k);
    for (int k = 0; k < 3; k++) {
        double e = c->emissive[k];
        at.F0[k] = f0 * (1 - c->metal) + c->color[k] * c->metal;
        at.specular[k] = l <= 1 ? e : e / l + (e - e / l) * dot(at.N, at.V);
    }
    for (int i = 0; i < LIGHTS_MAX; i++)
        add_light(&at, &c->lights[i]);
    double opacity = 1 - c->transparency;
    if (c->translucency > 0)
        come_through(&at, c, &opacity);
    double fog = 0, sky[3] = {0.1, 0.2, 0.3};
    if (c->fog_max > c->fog_min && c->fog_curve > 0)
        fog = pow(clamp((at.D - c->fog_min) / (c->fog_max - c->fog_min), 0, 1), 1 / c->fog_curve);
    for (int k = 0; k < 3; k++)
        out[k] = (at.diffuse[k] * (1 - fog) + sky[k] * fog) * opacity + at.specular[k] * (1 - fog);
    double grey = lum(out);
    for (int k = 0; k < 3; k++)
        out[k] = (c->monochrome ? grey : out[k]) * c->tint[k];
    if (!isfinite(out[0] + out[1] + out[2]))
        out[0] = out[1] = out[2] = 0;
}

static int byte_of(double c) {
    c = clamp(c, 0, 1);
    return (int)lrint(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055));
}

static int add_three(char *out, const char *name, const double x[3]) {
    return sprintf(out, " %s=%g;%g;%g", name, x[0], x[1], x[2]);
}

static void write_light(char *out, const Light *light) {
    out += sprintf(out, "        !light");
    out += add_three(out, "color", light->color);
    if (light->kind == DIRECTIONAL)
        out += add_three(out, "direction", light->direction);
    if (light->kind == SPOT || light->kind == POINT)
        out += add_three(out, "position", light->position);
    if (light->kind == SPOT) {
        out += add_three(out, "focus", light->direction);
        out += sprintf(out, " outer=%g inner=%g", light->outer, light->inner);
    }
    if (light->kind == LINE) {
        out += add_three(out, "start", light->position);
        out += add_three(out, "end", light->direction);
    }
    if (light->radius > 0)
        out += sprintf(out, " radius=%g", light->radius);
    const double *f = light->falloff;
    sprintf(out, " falloff=%g;%g;%g;%g\n", f[0], f[1], f[2], f[3]);
}

static void write_script(char *out, const Case *c, const char *surface) {
    out += sprintf(out, "!window size=%d;%d\n    !canvas3d viewpoint=0;0;4 near=0.5 far=20 width=4", SIZE, SIZE);
    out +=
        sprintf(out, " fog_min=%g fog_max=%g fog_curve=%g fog_color=0.1;0.2;0.3", c->fog_min, c->fog_max, c->fog_curve);
    out += sprintf(out, " orthographic=%s monochrome=%s", c->orthographic ? "true" : "false",
                   c->monochrome ? "true" : "false");
    out += add_three(out, "tint", c->tint);
    out += sprintf(out, "\n");
    for (int i = 0; i < LIGHTS_MAX && c->lights[i].kind; i++) {
        write_light(out, &c->lights[i]);
        out += strlen(out);
    }
    out += sprintf(out, "        %s", surface);
    out += add_three(out, "color", c->color);
    out += add_three(out, "emissive", c->emissive);
    sprintf(out, " roughness=%g metal=%g ior=%g ao=%g transparency=%g translucency=%g\n", c->roughness, c->metal,
            c->ior, c->ao, c->transparency, c->translucency);
}

static bool missing; // true if OpenGL is not available

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    (void)host;
    missing |= diagnostic->code && strcmp(diagnostic->code, "needs-gpu") == 0;
    if (!missing)
        printf("%s", diagnostic->rendered);
}

// Returns false if OpenGL is not available.
static bool draw_script(const char *script, uint32_t pixels[SIZE * SIZE]) {
    PetriOptions options = petri_default_options();
    options.on_diagnostic = on_diagnostic;
    PetriSession *session = petri_open(&options);
    PetriPainter *painter = petri_painter_open();
    PetriPictureOptions picture_options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    assert_int_equal(petri_load_text(session, "light.fl", script, strlen(script)), PETRI_OK);
    assert_int_equal(petri_step(session), PETRI_OK);
    assert_int_equal(petri_picture(session, &picture_options, &picture), PETRI_OK);
    assert_int_equal(petri_picture_draw(picture, painter, pixels, SIZE, SIZE, SIZE * 4), PETRI_OK);
    petri_picture_report(session, picture);
    petri_picture_free(&picture);
    petri_painter_close(&painter);
    petri_close(&session);
    return !missing;
}

#define WHITE                                                                                                          \
    { 1, 1, 1 }
#define SQUARE                                                                                                         \
    { 0, 0, 1, 0 }
#define USUAL .roughness = 1, .ior = 1.5, .ao = 1, .tint = WHITE, .fog_curve = 1
static const Case cases[] = {
    {.name = "example of the spec",
     .color = WHITE,
     USUAL,
     .orthographic = true,
     .lights = {{DIRECTIONAL, WHITE, .direction = {0, 0, -1}, .falloff = SQUARE}}},
    {.name = "ambient", .color = {1, 0.5, 0.1}, USUAL, .lights = {{AMBIENT, {0.5, 0.6, 0.7}, .falloff = SQUARE}}},
    {.name = "directional, also negative",
     .color = {0.9, 0.5, 0.3},
     .roughness = 0.4,
     .ior = 1.8,
     .ao = 0.5,
     .tint = WHITE,
     .lights = {{AMBIENT, {0.3, 0.3, 0.3}, .falloff = SQUARE},
                {DIRECTIONAL, {1, 0.9, 2}, .direction = {1, -1, -2}, .falloff = SQUARE},
                {DIRECTIONAL, {-0.1, 0, -0.1}, .direction = {-1, 0, -1}, .falloff = SQUARE}}},
    {.name = "metal",
     .color = {0.9, 0.6, 0.2},
     .roughness = 0.3,
     .metal = 0.8,
     .ior = 1.5,
     .ao = 1,
     .tint = WHITE,
     .lights = {{POINT, {3, 3, 3}, .position = {0.5, 0.5, 2}, .falloff = SQUARE}}},
    {.name = "point",
     .color = {0.2, 0.6, 0.9},
     .roughness = 0.6,
     .ior = 1.5,
     .ao = 1,
     .tint = {1, 0.5, 0.8},
     .lights = {{POINT, {4, 2, 1}, .position = {-1, 0.2, 1}, .falloff = {0.1, 0.2, 0.5, 0.1}}}},
    {.name = "ball",
     .color = {0.7, 0.6, 0.5},
     .roughness = 0.2,
     .ior = 1.5,
     .ao = 1,
     .tint = WHITE,
     .lights = {{POINT, {2, 2, 1}, .position = {0.3, 0.2, 1.5}, .radius = 0.4, .falloff = SQUARE}}},
    {.name = "spot",
     .color = {0.7, 0.6, 0.5},
     .roughness = 0.5,
     .ior = 1.5,
     .ao = 1,
     .tint = WHITE,
     .lights = {{SPOT,
                 {5, 5, 8},
                 .position = {1, 1, 2},
                 .direction = {0.2, 0, 0},
                 .outer = 0.3,
                 .inner = 0.1,
                 .falloff = SQUARE}}},
    {.name = "line",
     .color = {0.7, 0.6, 0.5},
     .roughness = 0.3,
     .ior = 1.5,
     .ao = 1,
     .tint = WHITE,
     .lights =
         {{LINE, {2, 1, 2}, .position = {-1, -0.5, 0.6}, .direction = {1, 0.7, 1}, .radius = 0.1, .falloff = SQUARE}}},
    {.name = "fog",
     .color = {0.7, 0.6, 0.5},
     .roughness = 0.3,
     .ior = 1.5,
     .ao = 1,
     .tint = WHITE,
     .fog_min = 2,
     .fog_max = 6,
     .fog_curve = 2,
     .lights = {{POINT, {3, 3, 3}, .position = {0.5, 0.5, 2}, .falloff = SQUARE}}},
    {.name = "emission, monochrome", .color = {0.7, 0.6, 0.5}, .emissive = {3, 2, 1}, USUAL, .monochrome = true},
    {.name = "emission beyond 1", .emissive = {0.9, 3, 0.1}, USUAL},
    {.name = "transparency",
     .color = {0.7, 0.6, 0.5},
     .roughness = 0.3,
     .ior = 1.5,
     .ao = 1,
     .tint = WHITE,
     .transparency = 0.6,
     .lights = {{POINT, {3, 3, 3}, .position = {0.5, 0.5, 2}, .falloff = SQUARE}}},
};

// Walls that are lit from behind. The view is orthographic, so that the wall has the same thickness along each line of
// sight.
static const Case through[] = {
    {.name = "translucency",
     .color = {0.9, 0.6, 0.3},
     USUAL,
     .translucency = 1.5,
     .orthographic = true,
     .lights = {{DIRECTIONAL, {1, 1, 0.8}, .direction = {0.5, 0, 1}, .falloff = SQUARE},
                {AMBIENT, {0.1, 0.2, 0.3}, .falloff = SQUARE}}},
    {.name = "translucency of a thick wall",
     .color = {0.9, 0.6, 0.3},
     USUAL,
     .translucency = 0.4,
     .orthographic = true,
     .lights = {{DIRECTIONAL, {3, 3, 3}, .direction = {0, 0, 1}, .falloff = SQUARE},
                {DIRECTIONAL, {1, 1, 1}, .direction = {0, 0, -1}, .falloff = SQUARE}}},
    {.name = "translucency and transparency",
     .color = {0.9, 0.6, 0.3},
     .roughness = 0.5,
     .metal = 0.3,
     .ior = 1.4,
     .ao = 1,
     .tint = WHITE,
     .translucency = 3,
     .transparency = 0.4,
     .orthographic = true,
     .lights = {{DIRECTIONAL, {2, 1, 3}, .direction = {0, 0.2, 1}, .falloff = SQUARE},
                {DIRECTIONAL, {1, 1, 1}, .direction = {0, 1, -1}, .falloff = SQUARE}}},
};

static int worst_of(const double wanted[3], uint32_t pixel, int worst) {
    for (int k = 0; k < 3; k++) {
        int off = abs(byte_of(wanted[k]) - (int)(pixel >> (16 - 8 * k) & 255));
        worst = off > worst ? off : worst;
    }
    return worst;
}

static void check_wall(const Case *c) {
    static uint32_t pixels[SIZE * SIZE];
    char script[4000];
    int worst = 0;
    write_script(script, c, "!box size=40;40;1 position=0;0;-0.5");
    if (!draw_script(script, pixels))
        return;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            double reach = c->orthographic ? 2 : 4, wanted[3], N[3] = {0, 0, 1};
            double p[3] = {((x + 0.5) / SIZE * 2 - 1) * reach, (1 - (y + 0.5) / SIZE * 2) * reach, 0};
            model(c, p, N, wanted);
            worst = worst_of(wanted, pixels[y * SIZE + x], worst);
        }
    if (worst > TOLERANCE)
        fail_msg("%s: a pixel of the wall is off by %d", c->name, worst);
}

// Finds the point where the ray through a pixel meets the sphere of radius 2 around the origin. Returns false outside
// the sphere and near its silhouette.
static bool hit_sphere(bool orthographic, int x, int y, double p[3]) {
    double reach = orthographic ? 2 : 1, X = ((x + 0.5) / SIZE * 2 - 1) * reach, Y = (1 - (y + 0.5) / SIZE * 2) * reach;
    double ray[3] = {orthographic ? 0 : X, orthographic ? 0 : Y, -1},
           from[3] = {orthographic ? X : 0, orthographic ? Y : 0, 4};
    double a = dot(ray, ray), b = dot(ray, from), c = dot(from, from) - 4, root = b * b - a * c;
    if (root < a)
        return false;
    add_scaled(p, from, (-b - sqrt(root)) / a, ray);
    return true;
}

// Draws a sphere with many segments. With 516 segments, all are used; with 512, only as many as are needed for the same
// appearance. Transparent spheres are drawn as discs.
static void check_sphere(const Case *c, bool orthographic, int segments, int tolerance) {
    static uint32_t pixels[SIZE * SIZE];
    char script[4000];
    Case seen = *c;
    seen.orthographic = orthographic;
    int worst = 0, count = 0;
    char sphere[100];
    snprintf(sphere, sizeof sphere, "!sphere segments=%d size=2", segments);
    write_script(script, &seen, sphere);
    if (!draw_script(script, pixels))
        return;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            double p[3], N[3], wanted[3], zero[3] = {0};
            if (!hit_sphere(orthographic, x, y, p))
                continue;
            add_scaled(N, zero, 0.5, p);
            model(&seen, p, N, wanted);
            worst = worst_of(wanted, pixels[y * SIZE + x], worst);
            count++;
        }
    assert_true(count > SIZE * SIZE / 10);
    if (worst > tolerance)
        fail_msg("%s: a pixel of the %s sphere is off by %d", c->name, orthographic ? "orthographic" : "perspective",
                 worst);
}

static void test_walls_match_model(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases && !missing; i++)
        check_wall(&cases[i]);
    for (size_t i = 0; i < sizeof through / sizeof *through && !missing; i++)
        check_wall(&through[i]);
    if (missing)
        skip();
}

static void test_spheres_match_model(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases && !missing; i++)
        for (int orthographic = 0; orthographic < 2; orthographic++)
            check_sphere(&cases[i], orthographic, i % 2 ? 512 : 516, i % 2 ? TOLERANCE + 1 : TOLERANCE);
    if (missing)
        skip();
}

// Canvas3d.md 10.5: a linear value of 0.97 is encoded as byte 252.
static void test_example_of_spec(void **state) {
    (void)state;
    double N[3] = {0, 0, 1}, p[3] = {0}, wanted[3];
    model(&cases[0], p, N, wanted);
    assert_int_equal(byte_of(wanted[0]), 252);
    uint32_t pixels[SIZE * SIZE];
    char script[4000];
    write_script(script, &cases[0], "!box size=40;40;1 position=0;0;-0.5");
    if (!draw_script(script, pixels))
        skip();
    assert_int_equal(pixels[SIZE * SIZE / 2 + SIZE / 2] & 0xffffff, 0xfcfcfc);
}

TEST_GROUP(gl_light) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_walls_match_model),
                                       cmocka_unit_test(test_spheres_match_model),
                                       cmocka_unit_test(test_example_of_spec)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
