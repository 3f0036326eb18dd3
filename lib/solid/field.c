// field.c: see field.h. Surfaces are made by surface nets: each cube of the grid that the surface crosses has one
// point, the mean of the crossings on its edges. Each edge that crosses the surface has a square of four such points.
#include "solid/field.h"

#include <math.h>
#include <string.h>

// A row of sample points: base + i * step.
typedef struct Row {
    double base[3];
    double step[3];
    uint32_t count;
    size_t number; // number of the first point in the grid
} Row;

static double box_distance(const double p[3]) {
    double outside = 0, inside = -INFINITY;
    for (int k = 0; k < 3; k++) {
        double q = fabs(p[k]) - 0.5;
        outside += q > 0 ? q * q : 0;
        inside = fmax(inside, q);
    }
    return sqrt(outside) + fmin(inside, 0);
}

static void primitive_row(FieldKind kind, const Row *row, double *out) {
    for (uint32_t i = 0; i < row->count; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = row->base[k] + i * row->step[k];
        double across = p[0] * p[0] + p[1] * p[1];
        switch (kind) {
        case FIELD_BOX:
            out[i] = box_distance(p);
            break;
        case FIELD_SPHERE:
            out[i] = sqrt(across + p[2] * p[2]) - 1;
            break;
        case FIELD_CYLINDER:
            out[i] = fmax(sqrt(across) - 1, fabs(p[2]) - 0.5);
            break;
        default:
            out[i] = fmax(sqrt(across) + p[2], fabs(p[2])) - 0.5;
        }
    }
}

static double join_distances(const Field *field, double d, double e) {
    if (field->smooth > 0) {
        double h = fmin(fmax(0.5 + (e - d) / (2 * field->smooth), 0), 1);
        return h * d + (1 - h) * e - field->smooth * h * (1 - h);
    }
    if (field->fillet > 0) {
        double a = fmax(0, field->fillet - d), b = fmax(0, field->fillet - e);
        return fmax(field->fillet, fmin(d, e)) - sqrt(a * a + b * b);
    }
    double nearest = fmin(d, e);
    return field->chamfer > 0 ? fmin(nearest, (d + e - field->chamfer) * 0.7071067811865476) : nearest;
}

static void field_row(Arena *arena, const Field *field, const Row *outside, double *out);

// Combines the distances of all children. Intersections and differences are unions of complements.
static void operation_row(Arena *arena, const Field *field, const Row *row, double *out) {
    ArenaMark mark = arena_mark(arena);
    double *other = arena_alloc_array(arena, row->count, sizeof *other), total = 0;
    bool mix = field->kind == FIELD_MIX;
    double first_sign = field->kind == FIELD_INTERSECTION || field->kind == FIELD_DIFFERENCE ? -1 : 1;
    double other_sign = field->kind == FIELD_INTERSECTION ? -1 : 1;
    for (uint32_t i = 0; i < row->count; i++)
        out[i] = mix ? 0 : INFINITY;
    for (uint32_t c = 0; c < field->child_count; c++) {
        double weight = mix && field->weight_count > 0 ? field->weights[c % field->weight_count] : 1;
        field_row(arena, field->children[c], row, other);
        total += weight;
        for (uint32_t i = 0; i < row->count; i++)
            if (mix)
                out[i] += weight * other[i];
            else if (c == 0)
                out[i] = first_sign * other[i];
            else
                out[i] = join_distances(field, out[i], other_sign * other[i]);
    }
    for (uint32_t i = 0; i < row->count; i++)
        out[i] = mix ? out[i] / total : field->child_count > 0 ? first_sign * out[i] : INFINITY;
    if (field->kind == FIELD_TRIM)
        for (uint32_t i = 0; i < row->count; i++) {
            double above = 0;
            for (int k = 0; k < 3; k++)
                above += (row->base[k] + i * row->step[k] - field->origin[k]) * field->normal[k];
            out[i] = -join_distances(field, -out[i], -above);
        }
    arena_rewind(arena, mark);
}

// Converts a row to the coordinates inside a field.
static Row inside_row(const Field *field, const Row *outside) {
    Row row = {.count = outside->count, .number = outside->number};
    for (int k = 0; k < 3; k++) {
        const double *m = field->inverse + 4 * k;
        row.base[k] = m[0] * outside->base[0] + m[1] * outside->base[1] + m[2] * outside->base[2] + m[3];
        row.step[k] = m[0] * outside->step[0] + m[1] * outside->step[1] + m[2] * outside->step[2];
    }
    return row;
}

// Computes the distances of a row of points. The recursion is limited by the maximum depth of nodes.
static void field_row(Arena *arena, const Field *field, const Row *outside, double *out) {
    Row row = inside_row(field, outside);
    arena_charge(arena, 4 + outside->count / 2);
    if (field->kind == FIELD_FUNCTION)
        for (uint32_t i = 0; i < row.count; i++)
            out[i] = field->samples ? field->samples[row.number + i] : INFINITY;
    else if (field->kind <= FIELD_CONE)
        primitive_row(field->kind, &row, out);
    else
        operation_row(arena, field, &row, out);
    for (uint32_t i = 0; i < row.count; i++)
        out[i] *= field->scale;
}

// The grid. Samples 0 and count - 1 of each axis are outside the box. Of samples and cells, the two latest layers along
// z are stored.
typedef struct Net {
    Arena *arena;
    const Field *field;
    double low[3];
    double high[3];
    double cell;
    uint32_t counts[3]; // samples along each axis
    double *samples[2];
    uint32_t *cells[2]; // points of cells; UINT32_MAX: none
    FieldSurface *surface;
} Net;

static Row grid_row(const Net *net, uint32_t y, uint32_t z) {
    return (Row){.count = net->counts[0],
                 .step = {net->cell, 0, 0},
                 .base = {net->low[0] - net->cell, net->low[1] + net->cell * ((double)y - 1),
                          net->low[2] + net->cell * ((double)z - 1)},
                 .number = ((size_t)z * net->counts[1] + y) * net->counts[0]};
}

static void sample_layer(const Net *net, uint32_t z) {
    double *layer = net->samples[z & 1];
    for (uint32_t y = 0; y < net->counts[1]; y++) {
        double *out = layer + (size_t)y * net->counts[0];
        Row row = grid_row(net, y, z);
        field_row(net->arena, net->field, &row, out);
        for (uint32_t x = 0; x < row.count; x++) { // cuts the body off at the box
            double p[3] = {row.base[0] + x * net->cell, row.base[1], row.base[2]};
            if (!(fabs(out[x]) < 1e300)) // also for NaN
                out[x] = net->cell;
            for (int k = 0; k < 3; k++)
                out[x] = fmax(out[x], fmax(net->low[k] - p[k], p[k] - net->high[k]));
            if (x == 0 || y == 0 || z == 0 || x == row.count - 1 || y == net->counts[1] - 1 || z == net->counts[2] - 1)
                out[x] = fmax(out[x], 1e-6 * net->cell);
        }
    }
}

static double sample_at(const Net *net, uint32_t x, uint32_t y, uint32_t z) {
    return net->samples[z & 1][(size_t)y * net->counts[0] + x];
}

static bool add_cell_point(const Net *net, uint32_t x, uint32_t y, uint32_t z) {
    double corners[8], sum[3] = {0};
    int count = 0;
    for (uint32_t i = 0; i < 8; i++)
        corners[i] = sample_at(net, x + (i & 1), y + (i >> 1 & 1), z + (i >> 2));
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++) {
            int j = i | 1 << k;
            if (j == i || (corners[i] < 0) == (corners[j] < 0))
                continue;
            double along = corners[i] / (corners[i] - corners[j]);
            for (int axis = 0; axis < 3; axis++)
                sum[axis] += axis == k ? along : i >> axis & 1;
            count++;
        }
    uint32_t *point = &net->cells[z & 1][(size_t)y * net->counts[0] + x];
    *point = UINT32_MAX;
    if (count == 0)
        return true;
    FieldSurface *surface = net->surface;
    if (surface->point_count >= FIELD_MAX_POINTS)
        return false;
    surface->points = arena_grow_array(net->arena, surface->points, surface->point_count, &surface->point_capacity,
                                       sizeof *surface->points);
    uint32_t place[3] = {x, y, z};
    for (int k = 0; k < 3; k++)
        surface->points[surface->point_count][k] = net->low[k] + net->cell * (place[k] - 1.0 + sum[k] / count);
    *point = surface->point_count++;
    return true;
}

static void add_triangle(const Net *net, uint32_t a, uint32_t b, uint32_t c) {
    FieldSurface *surface = net->surface;
    uint32_t corners[3] = {a, b, c};
    for (int k = 0; k < 3; k++) {
        surface->indices = arena_grow_array(net->arena, surface->indices, surface->index_count,
                                            &surface->index_capacity, sizeof *surface->indices);
        surface->indices[surface->index_count++] = corners[k];
    }
}

static uint32_t cell_point(const Net *net, const uint32_t cell[3]) {
    return net->cells[cell[2] & 1][(size_t)cell[1] * net->counts[0] + cell[0]];
}

// Adds the square around the edge from a sample along an axis, if the edge crosses the surface.
static void add_square(const Net *net, const uint32_t sample[3], int axis) {
    int second = (axis + 1) % 3, third = (axis + 2) % 3;
    uint32_t end[3] = {sample[0], sample[1], sample[2]}, corners[4];
    end[axis]++;
    bool one = sample_at(net, sample[0], sample[1], sample[2]) < 0, two = sample_at(net, end[0], end[1], end[2]) < 0;
    if (one == two)
        return;
    for (uint32_t i = 0; i < 4; i++) { // counter-clockwise seen from the end of the edge
        uint32_t cell[3] = {sample[0], sample[1], sample[2]};
        cell[second] -= i == 0 || i == 3;
        cell[third] -= i == 0 || i == 1;
        corners[one ? i : 3 - i] = cell_point(net, cell);
    }
    add_triangle(net, corners[0], corners[1], corners[2]);
    add_triangle(net, corners[0], corners[2], corners[3]);
}

// Adds the points of a layer of cells, and the squares around all edges whose four cells are known from then on.
static bool add_layer(const Net *net, uint32_t z) {
    for (uint32_t y = 0; y + 1 < net->counts[1]; y++) {
        arena_charge(net->arena, net->counts[0]);
        for (uint32_t x = 0; x + 1 < net->counts[0]; x++)
            if (!add_cell_point(net, x, y, z))
                return false;
    }
    for (uint32_t y = 0; y + 1 < net->counts[1]; y++) {
        arena_charge(net->arena, net->counts[0]);
        for (uint32_t x = 0; x + 1 < net->counts[0]; x++) {
            uint32_t sample[3] = {x, y, z};
            if (y > 0 && z > 0)
                add_square(net, sample, 0);
            if (x > 0 && z > 0)
                add_square(net, sample, 1);
            if (x > 0 && y > 0)
                add_square(net, sample, 2);
        }
    }
    return true;
}

// Sets the size of the grid. Sets *too_large if there would be too many cells. Returns false if there are too many or
// none.
static bool set_size(Net *net, const double low[3], const double high[3], bool *too_large) {
    for (int k = 0; k < 3; k++) {
        net->low[k] = low[k];
        net->high[k] = high[k];
        double count = ceil((high[k] - low[k]) / net->cell - 1e-9);
        *too_large = !(count <= FIELD_MAX_CELLS);
        if (*too_large || !(count >= 1))
            return false;
        net->counts[k] = (uint32_t)count + 3;
    }
    return true;
}

// Calls the functions of a field.
typedef struct Sampler {
    const Net *net;
    FieldFunction *call;
    void *user_data;
} Sampler;

// Returns the distances of a function at all points of the grid. `inverse` converts to its coordinates.
static const double *sample_function(const Sampler *sampler, const Field *field, const double inverse[12]) {
    const Net *net = sampler->net;
    const uint32_t width = net->counts[0];
    Field place = {0};
    memcpy(place.inverse, inverse, sizeof place.inverse);
    double *samples = arena_alloc_array(net->arena, (size_t)net->counts[1] * net->counts[2], width * sizeof *samples);
    const uint32_t layer = width * net->counts[1];
    double(*points)[3] = arena_alloc_array(net->arena, layer, sizeof *points);
    for (uint32_t z = 0; z < net->counts[2]; z++) {
        arena_charge(net->arena, layer / 4);
        for (uint32_t y = 0; y < net->counts[1]; y++) {
            Row outside = grid_row(net, y, z), row = inside_row(&place, &outside);
            for (uint32_t x = 0; x < width; x++)
                for (int k = 0; k < 3; k++)
                    points[y * width + x][k] = row.base[k] + x * row.step[k];
        }
        if (!sampler->call(sampler->user_data, field->function, (const double(*)[3])points, layer,
                           samples + (size_t)z * layer))
            return NULL;
    }
    return samples;
}

// The recursion is limited by the maximum depth of nodes.
static void sample_functions(const Sampler *sampler, Field *field, const double outside[12]) {
    double inverse[12]; // field->inverse times outside
    for (int i = 0; i < 12; i++) {
        const double *m = field->inverse + i / 4 * 4, *n = outside + i % 4;
        inverse[i] = m[0] * n[0] + m[1] * n[4] + m[2] * n[8] + (i % 4 == 3 ? m[3] : 0);
    }
    if (field->kind == FIELD_FUNCTION) {
        field->samples = sample_function(sampler, field, inverse);
        field->sample_count = (size_t)sampler->net->counts[0] * sampler->net->counts[1] * sampler->net->counts[2];
    }
    for (uint32_t i = 0; i < field->child_count; i++)
        sample_functions(sampler, field->children[i], inverse);
}

void field_sample_functions(Arena *arena, Field *field, const double low[3], const double high[3], double cell,
                            FieldFunction *call, void *user_data) {
    Net net = {.arena = arena, .cell = cell};
    Sampler sampler = {.net = &net, .call = call, .user_data = user_data};
    bool too_large;
    if (set_size(&net, low, high, &too_large))
        sample_functions(&sampler, field, (const double[12]){1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
}

bool field_surface(Arena *arena, const Field *field, const double low[3], const double high[3], double cell,
                   FieldSurface *surface) {
    Net net = {.arena = arena, .field = field, .cell = cell, .surface = surface};
    bool too_large;
    *surface = (FieldSurface){0};
    if (!set_size(&net, low, high, &too_large))
        return !too_large;
    size_t layer = (size_t)net.counts[0] * net.counts[1];
    for (int i = 0; i < 2; i++) {
        net.samples[i] = arena_alloc_array(arena, layer, sizeof *net.samples[i]);
        net.cells[i] = arena_alloc_array(arena, layer, sizeof *net.cells[i]);
        memset(net.cells[i], 0xff, layer * sizeof *net.cells[i]);
    }
    sample_layer(&net, 0);
    for (uint32_t z = 0; z + 1 < net.counts[2]; z++) {
        sample_layer(&net, z + 1);
        if (!add_layer(&net, z))
            return false;
    }
    return true;
}
