// framing.c: the view and the scale bar of the automatic picture; see automatic.h.
//
// The first view is chosen from the bodies around the median position, so that a few bodies that fly away do not affect
// it.
#include "maths/maths.h"
#include "picture/automatic.h"

#include <math.h>

static const double AHEAD = 2;    // seconds of motion for which the first view leaves space
static const double GROWTH = 1.6; // factor by which a view grows in one step

// Returns the number that would be at index `place` if the numbers were sorted. Reorders the numbers.
static double select_number(double *numbers, uint32_t count, uint32_t place) {
    uint32_t low = 0, high = count - 1;
    while (low < high) {
        double pivot = numbers[low + (high - low) / 2];
        uint32_t i = low, j = high;
        for (;;) {
            while (numbers[i] < pivot)
                i++;
            while (numbers[j] > pivot)
                j--;
            if (i >= j)
                break;
            double swapped = numbers[i];
            numbers[i++] = numbers[j];
            numbers[j--] = swapped;
        }
        if (place <= j)
            high = j;
        else
            low = j + 1;
    }
    return numbers[place];
}

static double distance(const double a[3], const double b[3]) {
    return maths_hypot(maths_hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

// Returns the distance from the centre beyond which bodies are ignored. Without this limit, a few bodies that fly away
// would make the remaining bodies too small to see. The limit is eight times the distance within which nine tenths of
// the bodies are. `numbers` is scratch space for one number per body.
static double outlier_distance(const AutoSystem *system, const double middle[3], double *numbers) {
    for (uint32_t i = 0; i < system->body_count; i++)
        numbers[i] = distance(system->bodies[i].position, middle);
    double max = select_number(numbers, system->body_count, (system->body_count * 9 + 9) / 10 - 1);
    return max > 0 ? 8 * max : INFINITY;
}

static void find_median(const AutoSystem *system, double middle[3], double *numbers) {
    for (int k = 0; k < 3; k++) {
        for (uint32_t i = 0; i < system->body_count; i++)
            numbers[i] = system->bodies[i].position[k];
        middle[k] = select_number(numbers, system->body_count, system->body_count / 2);
    }
}

typedef struct Bounds {
    double low[3];
    double high[3];
} Bounds;

static const Bounds NOTHING = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void include(Bounds *bounds, const double position[3], double radius) {
    for (int k = 0; k < 3; k++) {
        bounds->low[k] = fmin(bounds->low[k], position[k] - radius);
        bounds->high[k] = fmax(bounds->high[k], position[k] + radius);
    }
}

static double half_size(const Bounds *bounds, int axes) {
    double half = 0;
    for (int k = 0; k < axes; k++)
        half = fmax(half, (bounds->high[k] - bounds->low[k]) / 2);
    return half;
}

// Returns the largest distance along any axis from a point to the bounds.
static double extent(const Bounds *bounds, const double middle[3], int axes) {
    double extent = 0;
    for (int k = 0; k < axes; k++)
        extent = fmax(extent, fmax(middle[k] - bounds->low[k], bounds->high[k] - middle[k]));
    return extent;
}

// Bounds of the bodies that are not ignored: of the discs, the positions, and the ways of the bodies. The way of a body
// is the line along which it moves in the next AHEAD seconds.
typedef struct Extents {
    Bounds discs;
    Bounds positions;
    Bounds ways;
    double largest; // largest radius of a body
} Extents;

static Extents find_extents(const AutoSystem *system, const double middle[3], double reach) {
    Extents extents = {NOTHING, NOTHING, NOTHING, 0};
    for (uint32_t i = 0; i < system->body_count; i++) {
        const AutoBody *body = &system->bodies[i];
        if (distance(body->position, middle) > reach)
            continue;
        double ahead[3];
        for (int k = 0; k < 3; k++) {
            ahead[k] = body->position[k] + AHEAD * body->velocity[k];
            ahead[k] = isfinite(ahead[k]) ? ahead[k] : body->position[k];
        }
        include(&extents.discs, body->position, body->radius);
        include(&extents.positions, body->position, 0);
        include(&extents.ways, body->position, 0);
        include(&extents.ways, ahead, 0);
        extents.largest = fmax(extents.largest, body->radius);
    }
    return extents;
}

// Rounds up to one of ten numbers per decade: 1, 1.25, 1.6, 2, 2.5 and so on.
static double round_up(double x) {
    double step = ceil(maths_log10(x) * 10 - 1e-9);
    return maths_pow(10, step / 10);
}

// Extends the bounds to nearby walls, because bodies can soon reach them. A wall is nearby if its distance from the
// centre of the bounds is at most twice the half size of the bounds.
static void include_walls(Bounds *shown, const AutoSystem *system, int axes) {
    const double near = 2 * half_size(shown, axes);
    double middle[3], foot[3];
    for (int k = 0; k < 3; k++)
        middle[k] = shown->low[k] + (shown->high[k] - shown->low[k]) / 2;
    for (uint32_t i = 0; i < system->barrier_count; i++) {
        const double *n = system->barriers[i].normal, *p = system->barriers[i].position;
        double length = maths_hypot(maths_hypot(n[0], n[1]), n[2]), away = 0;
        for (int k = 0; k < 3; k++)
            away += (middle[k] - p[k]) * (n[k] / length);
        for (int k = 0; k < 3; k++)
            foot[k] = middle[k] - away * (n[k] / length);
        if (fabs(away) <= near)
            include(shown, foot, 0);
    }
}

// Chooses the first view. Bodies that start close together get space to move apart. A centre close to the origin is
// moved to the origin.
static void choose(AutoFrame *frame, const AutoSystem *system, const Extents *extents, int axes) {
    enum { RADII = 8, SLOW = 50 };
    Bounds shown = extents->discs;
    double half = half_size(&extents->positions, axes), way = half_size(&extents->ways, axes), min = 0;
    if (half < way / SLOW) {
        include(&shown, extents->ways.low, 0);
        include(&shown, extents->ways.high, 0);
    }
    if (half < extents->largest / 2)
        min = RADII * extents->largest;
    include_walls(&shown, system, axes);
    half = half_size(&shown, axes);
    for (int k = 0; k < 3; k++) {
        double middle = shown.low[k] + (shown.high[k] - shown.low[k]) / 2;
        frame->middle[k] = fabs(middle) < half / 10 ? 0 : middle;
    }
    // In perspective, corners of the box that point towards the camera need more space, so the view is larger.
    double wanted = fmax((axes == 3 ? 1.25 : 1.1) * extent(&shown, frame->middle, axes), min);
    frame->half = round_up(wanted > 1e-9 ? wanted : 1);
}

static bool shows_all(const AutoFrame *frame, const AutoSystem *system, int axes) {
    bool shows = frame->half > 0;
    for (uint32_t i = 0; i < system->body_count && shows; i++)
        for (int k = 0; k < axes; k++) {
            const AutoBody *body = &system->bodies[i];
            shows = shows && fabs(body->position[k] - frame->middle[k]) + body->radius <= frame->half;
        }
    return shows;
}

void auto_frame(Arena *arena, AutoFrame *frame, const AutoSystem *system) {
    double median[3];
    int axes = system->dimensions == 3 ? 3 : 2;
    if (system->body_count == 0 || shows_all(frame, system, axes))
        return;
    ArenaMark mark = arena_mark(arena);
    double *numbers = arena_alloc_array(arena, system->body_count, sizeof *numbers);
    find_median(system, median, numbers);
    Extents extents = find_extents(system, median, outlier_distance(system, median, numbers));
    arena_rewind(arena, mark);
    if (frame->half == 0)
        choose(frame, system, &extents, axes);
    double needed = extent(&extents.discs, frame->middle, axes);
    while (frame->half < needed && isfinite(GROWTH * frame->half))
        frame->half *= GROWTH;
}

// Returns the strokes that draw a character on a grid 2 wide and 8 high. Each pair of digits is a point, x and y, of a
// stroke; | starts another stroke.
static const char *strokes_of(char c) {
    static const char *const digits[] = {"0020280800",      "061810",       "082824040020", "08282000|0424",
                                         "080424|2820",     "280804242000", "280800202404", "082820",
                                         "0020280800|0424", "240408282000"};
    switch (c) {
    case '.':
        return "1011";
    case '-':
        return "0424";
    case '+':
        return "0424|1216";
    case 'e':
        return "200005252303";
    default:
        return c >= '0' && c <= '9' ? digits[c - '0'] : "";
    }
}

enum { LEFT = 16, BOTTOM = 16, TICK = 5, MAX_LENGTH = 120, SCALE_ROOM = 100 };
static const double GLYPH_WIDTH = 4, GLYPH_HEIGHT = 1.75, ADVANCE = 13;

static void add_line(AutoSystem *system, double x1, double y1, double x2, double y2) {
    if (system->scale_count < SCALE_ROOM)
        system->scale[system->scale_count++] = (AutoLine){x1, y1, x2, y2};
}

static void add_character(AutoSystem *system, char c, double x, double y) {
    const char *at = strokes_of(c);
    while (at[0] && at[1] && at[2]) {
        if (at[2] == '|') {
            at += 3;
            continue;
        }
        add_line(system, x + (at[0] - '0') * GLYPH_WIDTH, y + (at[1] - '0') * GLYPH_HEIGHT,
                 x + (at[2] - '0') * GLYPH_WIDTH, y + (at[3] - '0') * GLYPH_HEIGHT);
        at += 2;
    }
}

// Creates a bar whose length is 1, 2 or 5 times a power of ten, with the number above it.
void auto_scale(Arena *arena, AutoSystem *system) {
    const double unit = AUTO_PANEL / 2 * (1 - 2 * AUTO_MARGIN) / system->frame.half; // panel pixels per unit
    double power = maths_pow(10, floor(maths_log10(MAX_LENGTH / unit))), length = power;
    if (!isfinite(length) || !(length > 0))
        return;
    if (5 * power * unit <= MAX_LENGTH)
        length = 5 * power;
    else if (2 * power * unit <= MAX_LENGTH)
        length = 2 * power;
    system->scale = arena_alloc_array(arena, SCALE_ROOM, sizeof *system->scale);
    double right = LEFT + length * unit;
    add_line(system, LEFT, BOTTOM, right, BOTTOM);
    add_line(system, LEFT, BOTTOM, LEFT, BOTTOM + TICK);
    add_line(system, right, BOTTOM, right, BOTTOM + TICK);
    Str text = str_format(arena, "%.3g", length);
    double x = (LEFT + right) / 2 - (ADVANCE * (double)text.len - (ADVANCE - 2 * GLYPH_WIDTH)) / 2;
    for (size_t i = 0; i < text.len; i++)
        add_character(system, text.bytes[i], fmax(x, LEFT) + (double)i * ADVANCE, BOTTOM + 2 * TICK);
}
