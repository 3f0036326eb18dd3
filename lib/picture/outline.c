// outline.c: path effects; see outline.h. Each effect creates a new outline from the previous one.
#include "picture/outline.h"

#include "maths/maths.h"
#include "maths/random.h"

#include <math.h>
#include <string.h>

enum { MAX_ELEMENTS = 100000 };

static const double TURN = 6.283185307179586;

int arcs_of_ellipse(const double n[6], double scale, double start[2], double curves[ARCS_MAX][6]) {
    double x = n[0], y = n[1], rx = n[2], ry = n[3], turns = fmin(fmax(n[5], -1), 1);
    double max_radius = fmax(rx, ry) * scale;
    int count = (int)ceil(fabs(turns) * (max_radius < 64 ? 4 : 8));
    double from = (n[4] - floor(n[4])) * TURN, step = turns * TURN / (count ? count : 1);
    double handle = 4.0 / 3 * maths_tan(step / 4);
    double c = maths_cos(from), s = maths_sin(from);
    start[0] = x + rx * c;
    start[1] = y + ry * s;
    for (int i = 1; i <= count; i++) {
        double c2 = maths_cos(from + i * step), s2 = maths_sin(from + i * step), *curve = curves[i - 1];
        curve[0] = x + rx * (c - handle * s);
        curve[1] = y + ry * (s + handle * c);
        curve[2] = x + rx * (c2 + handle * s2);
        curve[3] = y + ry * (s2 - handle * c2);
        curve[4] = x + rx * c2;
        curve[5] = y + ry * s2;
        c = c2;
        s = s2;
    }
    return count;
}

// Follows the implementation notes on elliptical arcs in the SVG specification. Dividing coordinates by the radii maps
// the arc to a circle. Its centre is computed from the chord. If the radii are too short for the chord, the circle
// grows.
int arcs_to_point(const double start[2], const double n[7], double curves[ARCS_MAX][6]) {
    double x = n[5], y = n[6], c = maths_cos(n[2] * TURN), s = maths_sin(n[2] * TURN);
    double rx = n[0], ry = n[1], dx = (x - start[0]) / 2, dy = (y - start[1]) / 2;
    double a = (c * dx + s * dy) / rx, b = (c * dy - s * dx) / ry; // half the chord, scaled to the unit circle
    double half = maths_hypot(a, b);
    if (!(half > 0) || !isfinite(half)) // the arc has no length or no radius: draw a line
        return 0;
    double grow = fmax(half, 1), height = sqrt(fmax(grow * grow / (half * half) - 1, 0));
    double side = (n[3] != 0) == (n[4] != 0) ? -1 : 1;
    double mx = -b * height * side,
           my = a * height * side; // vector from the middle of the chord to the centre of the circle
    double from = maths_atan2(-b - my, -a - mx), to = maths_atan2(b - my, a - mx);
    double sweep = to - from + (n[4] != 0 && to < from ? TURN : n[4] == 0 && to > from ? -TURN : 0);
    int count = (int)ceil(fabs(sweep) / (TURN / 8));
    double step = sweep / (count ? count : 1), handle = 4.0 / 3 * maths_tan(step / 4);
    for (int i = 1; i <= count; i++) {
        double at = from + (i - 1) * step, next = from + i * step;
        double c1 = maths_cos(at), s1 = maths_sin(at), c2 = maths_cos(next), s2 = maths_sin(next);
        const double circle[3][2] = {
            {c1 - handle * s1, s1 + handle * c1}, {c2 + handle * s2, s2 - handle * c2}, {c2, s2}};
        for (int k = 0; k < 3; k++) {
            double u = (circle[k][0] * grow + mx) * rx, v = (circle[k][1] * grow + my) * ry;
            curves[i - 1][2 * k] = (start[0] + x) / 2 + c * u - s * v;
            curves[i - 1][2 * k + 1] = (start[1] + y) / 2 + s * u + c * v;
        }
    }
    return count;
}

// A subpath flattened to straight lines.
typedef struct Flat {
    DISPLAY_ARRAY(OutlinePoint) points;
    bool closed; // true if the last point equals the first
    double length;
} Flat;

static OutlinePoint end_of(const OutlineElement *element) {
    return element->points[element->kind == PATH_CUBIC ? 2 : 0];
}

static void add_element(Outline *out, PathElement kind, OutlinePoint point) {
    *DISPLAY_ADD(out->arena, out->elements, 1) = (OutlineElement){kind, {point}};
}

static double distance(OutlinePoint a, OutlinePoint b) {
    return maths_hypot(b.x - a.x, b.y - a.y);
}

static OutlinePoint between(OutlinePoint a, OutlinePoint b, double fraction) {
    return (OutlinePoint){a.x + fraction * (b.x - a.x), a.y + fraction * (b.y - a.y)};
}

static void add_point(Outline *out, Flat *flat, OutlinePoint point) {
    if (flat->points.count > 0)
        flat->length += distance(flat->points.at[flat->points.count - 1], point);
    *DISPLAY_ADD(out->arena, flat->points, 1) = point;
}

static void add_curve(Outline *out, Flat *flat, OutlinePoint from, const OutlinePoint *points) {
    double rough = distance(from, points[0]) + distance(points[0], points[1]) + distance(points[1], points[2]);
    int count = (int)fmin(fmax(ceil(sqrt(rough / out->fine)), 1), 200);
    for (int i = 1; i <= count; i++) {
        double t = (double)i / count;
        OutlinePoint a = between(from, points[0], t), b = between(points[0], points[1], t),
                     c = between(points[1], points[2], t);
        add_point(out, flat, between(between(a, b, t), between(b, c, t), t));
    }
}

// Flattens the subpath that starts at *at, and moves *at to the element after it.
static Flat flatten_subpath(Outline *from, uint32_t *at) {
    Flat flat = {.closed = false};
    uint32_t i = *at;
    for (bool begun = false; i < from->elements.count && !flat.closed; i++, begun = true) {
        const OutlineElement *element = &from->elements.at[i];
        if (element->kind == PATH_MOVE && begun)
            break;
        if (element->kind == PATH_CUBIC && flat.points.count > 0) {
            add_curve(from, &flat, flat.points.at[flat.points.count - 1], element->points);
        } else if (element->kind != PATH_CLOSE) {
            add_point(from, &flat, end_of(element));
        } else if (flat.points.count > 0) {
            add_point(from, &flat, flat.points.at[0]);
            flat.closed = true;
        }
    }
    *at = i;
    return flat;
}

// A position on a flattened subpath.
typedef struct Walk {
    const Flat *flat;
    uint32_t piece; // the current line, which leads from the point with this index to the next point
    double before;  // total length of the lines before `piece`
} Walk;

// Returns the point at the distance `along` from the start of the subpath. If `direction` is not NULL, it receives the
// direction there. `along` must not decrease from call to call.
static OutlinePoint point_along(Walk *walk, double along, OutlinePoint *direction) {
    const OutlinePoint *points = walk->flat->points.at;
    uint32_t last = walk->flat->points.count - 2;
    double length = distance(points[walk->piece], points[walk->piece + 1]);
    while (walk->piece < last && walk->before + length < along) {
        walk->before += length;
        walk->piece++;
        length = distance(points[walk->piece], points[walk->piece + 1]);
    }
    OutlinePoint a = points[walk->piece], b = points[walk->piece + 1];
    if (direction)
        *direction = length > 0 ? (OutlinePoint){(b.x - a.x) / length, (b.y - a.y) / length} : (OutlinePoint){0, 0};
    return between(a, b, length > 0 ? fmin((along - walk->before) / length, 1) : 0);
}

static void copy_flat(Outline *out, const Flat *flat) {
    uint32_t count = flat->points.count - (flat->closed ? 1 : 0);
    for (uint32_t i = 0; i < count; i++)
        add_element(out, i ? PATH_LINE : PATH_MOVE, flat->points.at[i]);
    if (flat->closed)
        add_element(out, PATH_CLOSE, flat->points.at[0]);
}

// An effect to apply.
typedef struct EffectTask {
    const DisplayRow *effect;
    DisplayReader *inside; // the effects inside it
    bool lines;
} EffectTask;

static void apply_jitter(const EffectTask *task, Outline *from, Outline *out) {
    const EFFECT_JITTEROperands *effect = &task->effect->EFFECT_JITTER;
    uint64_t key = random_hash_step(RANDOM_HASH_START, random_hash_number(effect->seed)), item = 0;
    for (uint32_t at = 0; at < from->elements.count;) {
        Flat flat = flatten_subpath(from, &at);
        double count = fmin(rint(flat.length / effect->length), MAX_ELEMENTS);
        if (flat.points.count < 2 || count < 2 || out->elements.count > MAX_ELEMENTS) {
            copy_flat(out, &flat);
            continue;
        }
        Walk walk = {.flat = &flat};
        // A closed subpath has no ends, so the first point of the result is half a segment after the start of the
        // subpath.
        uint32_t points = (uint32_t)count + (flat.closed ? 0 : 1);
        for (uint32_t i = 0; i < points; i++) {
            OutlinePoint direction,
                point = point_along(&walk, (i + (flat.closed ? 0.5 : 0)) * flat.length / count, &direction);
            double side = effect->deviation * (2 * random_uniform(key, item++) - 1);
            add_element(out, i ? PATH_LINE : PATH_MOVE,
                        (OutlinePoint){point.x - side * direction.y, point.y + side * direction.x});
        }
        if (flat.closed)
            add_element(out, PATH_CLOSE, flat.points.at[0]);
    }
}

// Returns the index of the interval that contains the dash offset. *left receives the remaining length of this
// interval.
static uint32_t find_interval(const EFFECT_DASHOperands *dash, double *left) {
    const double *intervals = dash->dashes.at;
    double sum = 0;
    for (uint32_t i = 0; i < dash->dashes.count; i++)
        sum += intervals[i];
    double offset = dash->offset - sum * floor(dash->offset / sum);
    uint32_t at = 0;
    for (; at + 1 < dash->dashes.count && offset >= intervals[at]; at++)
        offset -= intervals[at];
    *left = fmax(intervals[at] - offset, 0);
    return at;
}

static void dash_subpath(const EFFECT_DASHOperands *dash, const Flat *flat, Outline *out) {
    double left, along = 0;
    uint32_t interval = find_interval(dash, &left);
    Walk walk = {.flat = flat};
    while (along < flat->length && out->elements.count < MAX_ELEMENTS) {
        double end = fmin(along + left, flat->length);
        if (interval % 2 == 0) {
            add_element(out, PATH_MOVE, point_along(&walk, along, NULL));
            for (uint32_t first = walk.piece; point_along(&walk, end, NULL), first < walk.piece; first++)
                add_element(out, PATH_LINE, flat->points.at[first + 1]);
            add_element(out, PATH_LINE, point_along(&walk, end, NULL));
        }
        along = end;
        interval = (interval + 1) % dash->dashes.count;
        left = dash->dashes.at[interval];
    }
}

static void apply_dash(const EffectTask *task, Outline *from, Outline *out) {
    const EFFECT_DASHOperands *dash = &task->effect->EFFECT_DASH;
    double sum = 0;
    if (!task->lines) {
        *out = *from;
        return;
    }
    for (uint32_t i = 0; i < dash->dashes.count; i++)
        sum += dash->dashes.at[i];
    for (uint32_t at = 0; at < from->elements.count;) {
        Flat flat = flatten_subpath(from, &at);
        bool countless = flat.length * dash->dashes.count / sum > MAX_ELEMENTS;
        if (flat.points.count < 2 || countless)
            copy_flat(out, &flat);
        else
            dash_subpath(dash, &flat, out);
    }
}

// Rounds the corner at p between two straight lines: adds a line that ends before p, and a curve around the corner.
static void round_corner(Outline *out, OutlinePoint before, OutlinePoint p, OutlinePoint after, double radius) {
    double in = distance(before, p), away = distance(p, after);
    OutlinePoint a = between(p, before, in > 0 ? fmin(radius / in, 0.5) : 0);
    OutlinePoint b = between(p, after, away > 0 ? fmin(radius / away, 0.5) : 0);
    add_element(out, PATH_LINE, a);
    *DISPLAY_ADD(out->arena, out->elements, 1) =
        (OutlineElement){PATH_CUBIC, {between(a, p, 2.0 / 3), between(b, p, 2.0 / 3), b}};
}

// Rounds the corners of the subpath in elements `first` to `end` - 1: a PATH_MOVE, lines and curves, and optionally a
// PATH_CLOSE.
static void round_subpath(const OutlineElement *elements, uint32_t first, uint32_t end, double radius, Outline *out) {
    bool closed = end - first > 2 && elements[end - 1].kind == PATH_CLOSE;
    uint32_t last = closed ? end - 1 : end; // index after the last line or curve
    OutlinePoint start = elements[first].points[0], back = end_of(&elements[last - 1]);
    bool gap = closed && distance(start, back) > 0; // true if PATH_CLOSE draws a line
    bool corner = closed && (gap || elements[last - 1].kind == PATH_LINE) && elements[first + 1].kind == PATH_LINE;
    OutlinePoint before_start =
        gap ? back : end_of(&elements[last - 2]); // the point before the start, going backwards around the subpath
    double length = distance(start, elements[first + 1].points[0]);
    add_element(out, PATH_MOVE,
                corner ? between(start, elements[first + 1].points[0], length > 0 ? fmin(radius / length, 0.5) : 0)
                       : start);
    for (uint32_t i = first + 1; i < last; i++) {
        OutlinePoint p = end_of(&elements[i]);
        bool ends = i + 1 == last;
        if (elements[i].kind == PATH_CUBIC)
            *DISPLAY_ADD(out->arena, out->elements, 1) = elements[i];
        else if (ends && !gap)
            if (corner)
                round_corner(out, end_of(&elements[i - 1]), start, elements[first + 1].points[0], radius);
            else
                add_element(out, PATH_LINE, p);
        else if (ends || elements[i + 1].kind == PATH_LINE)
            round_corner(out, end_of(&elements[i - 1]), p, ends ? start : elements[i + 1].points[0], radius);
        else
            add_element(out, PATH_LINE, p);
    }
    if (corner && gap)
        round_corner(out, before_start, start, elements[first + 1].points[0], radius);
    if (closed)
        add_element(out, PATH_CLOSE, start);
}

static void apply_round_corners(const EffectTask *task, Outline *from, Outline *out) {
    const OutlineElement *elements = from->elements.at;
    for (uint32_t first = 0, end; first < from->elements.count; first = end) {
        for (end = first + 1; end < from->elements.count && elements[end].kind != PATH_MOVE; end++)
            ;
        if (end - first > 1 && elements[first].kind == PATH_MOVE && elements[first + 1].kind != PATH_CLOSE)
            round_subpath(elements, first, end, task->effect->EFFECT_ROUND_CORNERS.radius, out);
        else
            for (uint32_t i = first; i < end; i++)
                *DISPLAY_ADD(out->arena, out->elements, 1) = elements[i];
    }
}

static void apply_path_matrix(const EffectTask *task, Outline *from, Outline *out) {
    const double *m = task->effect->EFFECT_PATH_MATRIX.matrix;
    for (uint32_t i = 0; i < from->elements.count; i++) {
        OutlineElement *element = DISPLAY_ADD(out->arena, out->elements, 1);
        *element = from->elements.at[i];
        for (int k = 0; k < 3; k++) {
            OutlinePoint *p = &element->points[k], old = *p;
            double w = m[6] * old.x + m[7] * old.y + m[8];
            p->x = (m[0] * old.x + m[1] * old.y + m[2]) / w;
            p->y = (m[3] * old.x + m[4] * old.y + m[5]) / w;
        }
    }
}

static Outline apply_next(DisplayReader *reader, Outline from, bool lines);

static void apply_sum(const EffectTask *task, Outline *from, Outline *out) {
    for (uint32_t i = 0; i < task->effect->EFFECT_SUM.inputs; i++) {
        Outline part = apply_next(task->inside, *from, task->lines);
        if (part.elements.count > 0)
            memcpy(DISPLAY_ADD(out->arena, out->elements, part.elements.count), part.elements.at,
                   part.elements.count * sizeof *part.elements.at);
    }
}

static void (*const effects[])(const EffectTask *task, Outline *from, Outline *out) = {
#define EFFECT(id, name, help) [PETRI_EFFECT_##id] = apply_##name,
#include "schema/schema_list.h"
};

// Reads and applies an effect. The recursion is bounded, because display_list_build_effect limits the depth.
static Outline apply_next(DisplayReader *reader, Outline from, bool lines) {
    DisplayRow effect;
    display_list_read_effect(reader, &effect);
    if (effect.kind == PETRI_EFFECT_SOURCE)
        return from;
    if (effect.kind != PETRI_EFFECT_SUM)
        from = apply_next(reader, from, lines);
    Outline out = {.arena = from.arena, .fine = from.fine};
    effects[effect.kind](&(EffectTask){&effect, reader, lines}, &from, &out);
    return out;
}

Outline outline_apply(const double *effect, Outline from, bool lines) {
    return apply_next(&(DisplayReader){.at = effect, .left = SIZE_MAX}, from, lines);
}

static bool has_dashes(DisplayReader *reader) {
    DisplayRow effect;
    display_list_read_effect(reader, &effect);
    bool any = effect.kind == PETRI_EFFECT_DASH;
    double inputs = effect.kind == PETRI_EFFECT_SOURCE ? 0
                    : effect.kind == PETRI_EFFECT_SUM  ? effect.EFFECT_SUM.inputs
                                                       : 1;
    for (; inputs > 0; inputs--)
        any = has_dashes(reader) || any;
    return any;
}

bool outline_has_dashes(const double *effect) {
    return has_dashes(&(DisplayReader){.at = effect, .left = SIZE_MAX});
}

static void add_curves(Outline *out, double curves[][6], int count) {
    for (int i = 0; i < count; i++)
        *DISPLAY_ADD(out->arena, out->elements, 1) = (OutlineElement){
            PATH_CUBIC, {{curves[i][0], curves[i][1]}, {curves[i][2], curves[i][3]}, {curves[i][4], curves[i][5]}}};
}

// Adds an element of a display list. *here is the current point and *first the start of the current subpath; both are
// updated.
static void add_path_element(Outline *out, PathElement kind, const double *n, OutlinePoint *here, OutlinePoint *first) {
    double start[2], curves[ARCS_MAX][6];
    OutlinePoint point = {n[0], n[1]};
    bool begins = out->elements.count == 0;
    int count;
    switch (kind) {
    case PATH_MOVE:
    case PATH_LINE:
        add_element(out, begins ? PATH_MOVE : kind, point);
        break;
    case PATH_QUADRATIC:
        if (begins)
            add_element(out, PATH_MOVE, *here = *first = point);
        point = (OutlinePoint){n[2], n[3]};
        *DISPLAY_ADD(out->arena, out->elements, 1) =
            (OutlineElement){PATH_CUBIC,
                             {between(*here, (OutlinePoint){n[0], n[1]}, 2.0 / 3),
                              between(point, (OutlinePoint){n[0], n[1]}, 2.0 / 3), point}};
        break;
    case PATH_CUBIC:
        if (begins)
            add_element(out, PATH_MOVE, *here = *first = point);
        add_curves(out, (double[1][6]){{n[0], n[1], n[2], n[3], n[4], n[5]}}, 1);
        break;
    case PATH_ARC:
    case PATH_ARC_ON:
        count = arcs_of_ellipse(n, 2 / out->fine, start, curves);
        add_element(out, kind == PATH_ARC || begins ? PATH_MOVE : PATH_LINE,
                    *here = (OutlinePoint){start[0], start[1]});
        if (kind == PATH_ARC || begins)
            *first = *here;
        add_curves(out, curves, count);
        break;
    case PATH_ARC_TO:
        count = arcs_to_point((const double[]){here->x, here->y}, n, curves);
        if (count == 0)
            add_element(out, PATH_LINE, (OutlinePoint){n[5], n[6]});
        add_curves(out, curves, count);
        break;
    case PATH_CLOSE:
        add_element(out, PATH_CLOSE, *here = *first);
        add_element(out, PATH_MOVE, *first);
        return;
    }
    *here = end_of(&out->elements.at[out->elements.count - 1]);
    if (kind == PATH_MOVE || begins)
        *first = kind == PATH_MOVE || kind == PATH_LINE ? *here : *first;
}

void outline_add_path(Outline *out, DisplayNumbers path) {
    OutlinePoint here = {0, 0}, first = {0, 0};
    for (uint32_t i = 0; i < path.count;) {
        PathElement kind = (PathElement)path.at[i];
        add_path_element(out, kind, path.at + i + 1, &here, &first);
        i += 1u + display_path_sizes[kind];
    }
}
