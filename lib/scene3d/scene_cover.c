// scene_cover.c: see scene_cover.h.
#include "scene3d/scene_cover.h"

#include <math.h>

// Projects a point of the model to the picture. Returns false if it is behind the camera.
static bool project(const Matrix *clip, const double point[3], double place[2], double *depth) {
    double x[4];
    for (int row = 0; row < 4; row++)
        x[row] =
            clip->m[12 + row] + clip->m[row] * point[0] + clip->m[4 + row] * point[1] + clip->m[8 + row] * point[2];
    place[0] = x[0] / x[3];
    place[1] = x[1] / x[3];
    *depth = x[2];
    return x[3] > 1e-9;
}

Footprint footprint_of(const Matrix *clip, const SceneBox *box) {
    Footprint print = {.low = {1, 1}, .high = {-1, -1}, .near = INFINITY};
    for (int corner = 0; corner < 8; corner++) {
        double point[3], *place = print.corners[corner];
        for (int k = 0; k < 3; k++)
            point[k] = (double)(corner >> k & 1 ? box->high[k] : box->low[k]);
        if (!project(clip, point, place, &print.depths[corner]))
            return (Footprint){.low = {-1, -1}, .high = {1, 1}, .near = -INFINITY, .is_around = true};
        for (int k = 0; k < 2; k++) {
            print.low[k] = fmin(print.low[k], fmax(place[k], -1));
            print.high[k] = fmax(print.high[k], fmin(place[k], 1));
        }
        print.near = fmin(print.near, print.depths[corner]);
    }
    return print;
}

// Returns the area of the parallelogram that two axes of a box span at a corner, in pictures. It can reach beyond the
// picture.
static double spanned_part(const Footprint *print, int corner, int one, int other) {
    const double *a = print->corners[corner], *b = print->corners[corner ^ 1 << one],
                 *c = print->corners[corner ^ 1 << other];
    return fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 4;
}

double footprint_pictures(const Footprint *print, const SceneBox *box, double room, bool is_convex) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double face = 0, layers = (double)box->layers[k];
        for (int corner = 0; corner < 8 && !print->is_around; corner++)
            face = fmax(face, spanned_part(print, corner, (k + 1) % 3, (k + 2) % 3));
        sum = print->is_around ? fmax(sum, layers * room) : sum + layers * fmin(face, room);
    }
    return is_convex ? fmin(sum, room) : sum;
}

double footprint_lengths(const Footprint *print, const SceneBox *box) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double longest = print->is_around ? INFINITY : 0;
        for (int corner = 0; corner < 8 && !print->is_around; corner++) {
            const double *a = print->corners[corner], *b = print->corners[corner ^ 1 << k];
            longest = fmax(longest, fmax(fabs(b[0] - a[0]), fabs(b[1] - a[1])) / 2);
        }
        sum += (double)box->lengths[k] > 0 ? (double)box->lengths[k] * longest : 0;
    }
    return sum;
}

bool hiding_face_of_box(const Footprint *print, HidingFace *face) {
    face->depth = INFINITY;
    for (int side = 0; side < 6 && !print->is_around; side++) {
        HidingFace now = {.depth = -INFINITY};
        int axis = side / 2;
        for (int corner = 0; corner < 8; corner++)
            if ((corner >> axis & 1) == side % 2) {
                now.corners[now.count][0] = print->corners[corner][0];
                now.corners[now.count++][1] = print->corners[corner][1];
                now.depth = fmax(now.depth, print->depths[corner]);
            }
        if (now.depth < face->depth)
            *face = now;
    }
    return !print->is_around;
}

bool hiding_face_of_ball(const Matrix *clip, const SceneBox *box, HidingFace *face) {
    // An octagon across the direction to the camera. It lies within a ball with 16 segments, in front of its centre.
    static const double AHEAD = 0.15;
    static const double places[8][2] = {{0.87, 0.36},   {0.36, 0.87},   {-0.36, 0.87}, {-0.87, 0.36},
                                        {-0.87, -0.36}, {-0.36, -0.87}, {0.36, -0.87}, {0.87, -0.36}};
    double away[3], length = 0;
    for (int k = 0; k < 3; k++) {
        away[k] = clip->m[4 * k + 2];
        length += away[k] * away[k];
    }
    int smallest = fabs(away[0]) <= fabs(away[1]) ? 0 : 1;
    smallest = fabs(away[2]) < fabs(away[smallest]) ? 2 : smallest;
    double axis[3] = {smallest == 0, smallest == 1, smallest == 2}, across[3], upwards[3];
    length = sqrt(length);
    for (int k = 0; k < 3; k++)
        away[k] /= length;
    vector_cross(away, axis, across);
    double width = sqrt(vector_dot(across, across));
    for (int k = 0; k < 3; k++)
        across[k] /= width;
    vector_cross(away, across, upwards);
    bool is_seen = length > 0;
    face->count = 8;
    for (int corner = 0; corner < 8; corner++) {
        double point[3], x = places[corner][0], y = places[corner][1];
        for (int k = 0; k < 3; k++) {
            double half = ((double)box->high[k] - (double)box->low[k]) / 2;
            point[k] = (double)box->low[k] + half + half * (x * across[k] + y * upwards[k] - AHEAD * away[k]);
        }
        is_seen &= project(clip, point, face->corners[corner], &face->depth);
    }
    return is_seen;
}

void hidden_clear(HiddenCells *hidden) {
    for (int row = 0; row < HIDDEN_CELLS; row++)
        for (int column = 0; column < HIDDEN_CELLS; column++)
            hidden->depths[row][column] = INFINITY;
}

// Computes the interval that the hull of a face covers on the line at height y. It is empty if *low > *high.
static void interval_at(const HidingFace *face, double y, double *low, double *high) {
    *low = INFINITY;
    *high = -INFINITY;
    for (int i = 0; i < face->count; i++)
        for (int j = 0; j < i; j++) {
            const double *a = face->corners[i], *b = face->corners[j];
            if (!(a[1] <= y && y <= b[1]) && !(b[1] <= y && y <= a[1]))
                continue;
            double x = a[1] < b[1] || a[1] > b[1] ? a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1])) : a[0];
            *low = fmin(*low, x);
            *high = fmax(*high, x);
        }
}

static double cell_of(double place) {
    return fmin(fmax((place + 1) / 2, 0), 1) * HIDDEN_CELLS;
}

void hidden_add(HiddenCells *hidden, const HidingFace *face) {
    double bottom = INFINITY, top = -INFINITY, lows[2], highs[2];
    for (int corner = 0; corner < face->count; corner++) {
        bottom = fmin(bottom, face->corners[corner][1]);
        top = fmax(top, face->corners[corner][1]);
    }
    int first = (int)ceil(cell_of(bottom)), end = (int)cell_of(top);
    if (first < end)
        interval_at(face, 2.0 * first / HIDDEN_CELLS - 1, &lows[0], &highs[0]);
    for (int row = first; row < end; row++) {
        // The hull is convex: what is within it on the lines below and above a row is within it on all lines between.
        interval_at(face, 2.0 * (row + 1) / HIDDEN_CELLS - 1, &lows[1], &highs[1]);
        double low = fmax(lows[0], lows[1]), high = fmin(highs[0], highs[1]);
        int last = low < high ? (int)cell_of(high) : 0;
        for (int column = low < high ? (int)ceil(cell_of(low)) : 0; column < last; column++)
            hidden->depths[row][column] = fmin(hidden->depths[row][column], face->depth);
        lows[0] = lows[1];
        highs[0] = highs[1];
    }
}

double hidden_room(const HiddenCells *hidden, const Footprint *print, double depth) {
    double area = fmax(print->high[0] - print->low[0], 0) * fmax(print->high[1] - print->low[1], 0) / 4;
    if (!hidden)
        return area;
    int left = (int)cell_of(print->low[0]), right = (int)ceil(cell_of(print->high[0]));
    int top = (int)ceil(cell_of(print->high[1])), open = 0;
    for (int row = (int)cell_of(print->low[1]); row < top; row++)
        for (int column = left; column < right; column++)
            open += hidden->depths[row][column] > depth;
    return fmin(area, open / (double)(HIDDEN_CELLS * HIDDEN_CELLS));
}
