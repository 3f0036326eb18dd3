// scene_field.c: reads `!sdf` nodes and creates their surfaces (spec canvas3d.md 9.4).
#include "scene3d/scene_solid.h"

#include <math.h>
#include <string.h>

// Stores the inverse of a matrix in a field, and the factor by which the matrix scales distances at least. Returns
// false if there is no inverse.
static bool set_transform(Field *field, const Matrix *matrix) {
    double cofactors[9], smallest = INFINITY;
    matrix_cofactors(matrix, cofactors);
    double determinant = vector_dot(matrix->m, cofactors);
    if (!matrix_is_finite(matrix) || !(fabs(determinant) > 0))
        return false;
    for (int row = 0; row < 3; row++) {
        double *m = field->inverse + 4 * row;
        for (int k = 0; k < 3; k++)
            m[k] = cofactors[3 * row + k] / determinant;
        m[3] = -(m[0] * matrix->m[12] + m[1] * matrix->m[13] + m[2] * matrix->m[14]);
        smallest = fmin(smallest, sqrt(vector_dot(matrix->m + 4 * row, matrix->m + 4 * row)));
    }
    field->scale = smallest;
    return true;
}

static void read_blend(Field *field, const DrawNode *node) {
    if (!schema_row((NodeKind)node->kind, ATTR_SMOOTH))
        return;
    field->smooth = draw_number(node, ATTR_SMOOTH);
    field->fillet = draw_number(node, ATTR_FILLET);
    field->chamfer = draw_number(node, ATTR_CHAMFER);
}

static void read_plane(const Scene *scene, Field *field, const DrawNode *node) {
    const AttrValue *origin = draw_attr(node, ATTR_ORIGIN), *normal = draw_attr(node, ATTR_NORMAL);
    if (origin)
        memcpy(field->origin, origin->as.numbers, sizeof field->origin);
    if (normal)
        memcpy(field->normal, normal->as.numbers, sizeof field->normal);
    if (vector_normalise(field->normal))
        return;
    scene_report(scene, "missing-attribute", node, "'normal' is missing; nothing is cut away");
    field->kind = FIELD_UNION;
}

static bool field_kind(NodeKind kind, FieldKind *out) {
    static const struct {
        NodeKind node;
        FieldKind field;
    } kinds[] = {{KIND_BOX, FIELD_BOX},
                 {KIND_SPHERE, FIELD_SPHERE},
                 {KIND_CYLINDER, FIELD_CYLINDER},
                 {KIND_CONE, FIELD_CONE},
                 {KIND_UNION, FIELD_UNION},
                 {KIND_TRANSFORM3D, FIELD_UNION},
                 {KIND_SDF, FIELD_UNION},
                 {KIND_INTERSECT, FIELD_INTERSECTION},
                 {KIND_DIFFERENCE, FIELD_DIFFERENCE},
                 {KIND_TRIM, FIELD_TRIM},
                 {KIND_SLICE, FIELD_TRIM},
                 {KIND_MIX, FIELD_MIX}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].node == kind) {
            *out = kinds[i].field;
            return true;
        }
    return false;
}

// Returns the attribute of an `!sdf` that is a function. NULL: it has none.
static const AttrValue *function_of(const DrawNode *node) {
    return node->kind == KIND_SDF ? draw_attr(node, ATTR_FUNCTION) : NULL;
}

// Reads a member of a distance field. Returns NULL if it has no distance function. The recursion is limited by the
// maximum depth of nodes.
static Field *read_field(const Scene *scene, const DrawNode *node, const Matrix *matrix, Arena *arena) {
    Field *field = arena_alloc(arena, sizeof *field);
    *field = (Field){.scale = 1};
    if (!field_kind((NodeKind)node->kind, &field->kind)) {
        scene_report(scene, "misplaced-node", node, "has no effect inside a distance field; ignored");
        return NULL;
    }
    if (!set_transform(field, matrix))
        return NULL;
    read_blend(field, node);
    if (field->kind == FIELD_TRIM)
        read_plane(scene, field, node);
    const AttrValue *weights = field->kind == FIELD_MIX ? draw_attr(node, ATTR_WEIGHTS) : NULL;
    if (weights) {
        field->weights = weights->as.list;
        field->weight_count = weights->count;
    }
    const AttrValue *function = field->kind == FIELD_UNION ? function_of(node) : NULL;
    if (function) {
        field->kind = FIELD_FUNCTION;
        field->function = function->as.function;
        field->samples = function->as.function->values;
        return field;
    }
    field->children = arena_alloc_array(arena, node->child_count, sizeof(Field *));
    for (uint32_t i = 0; i < node->child_count; i++) {
        Matrix placed = matrix_of_member(&matrix_identity, node->children[i]);
        Field *child = read_field(scene, node->children[i], &placed, arena);
        if (child)
            field->children[field->child_count++] = child;
    }
    return field;
}

static void read_corner(const DrawNode *node, AttrName name, AttrName alias, double default_value, double out[3]) {
    const AttrValue *attr = draw_attr(node, name) ? draw_attr(node, name) : draw_attr(node, alias);
    for (int k = 0; k < 3; k++)
        out[k] = attr ? attr->as.numbers[k] : default_value;
}

// Reads the box of an `!sdf`. Returns the distance between samples.
static double read_box(const DrawNode *node, double low[3], double high[3]) {
    double size = 0, cell = draw_number(node, ATTR_RESOLUTION);
    read_corner(node, ATTR_MINIMUM, ATTR_MIN, -1, low);
    read_corner(node, ATTR_MAXIMUM, ATTR_MAX, 1, high);
    for (int k = 0; k < 3; k++)
        size = fmax(size, high[k] - low[k]);
    return cell > 0 ? cell : size / 64;
}

static bool has_function(const DrawNode *node) {
    if (function_of(node))
        return true;
    for (uint32_t i = 0; i < node->child_count; i++)
        if (has_function(node->children[i]))
            return true;
    return false;
}

// Stores the results of the functions where they are read from when the scene is drawn.
static void store_samples(const Field *field) {
    FunctionSamples *function = field->function;
    if (function && field->samples) {
        function->values = field->samples;
        function->hash = hash_bytes(1, field->samples, field->sample_count * sizeof *field->samples);
    }
    for (uint32_t i = 0; i < field->child_count; i++)
        store_samples(field->children[i]);
}

void scene_sample_functions(Arena *arena, const DrawNode *node, FieldFunction *call, void *user_data) {
    double low[3], high[3];
    if (node->kind == KIND_SDF && has_function(node)) {
        double cell = read_box(node, low, high);
        const Scene scene = {.arena = arena}; // problems are reported when the scene is drawn
        Field *field = read_field(&scene, node, &matrix_identity, arena);
        if (!field)
            return;
        field_sample_functions(arena, field, low, high, cell, call, user_data);
        store_samples(field);
    } else if (node->kind != KIND_CANVAS) {
        for (uint32_t i = 0; i < node->child_count; i++)
            scene_sample_functions(arena, node->children[i], call, user_data);
    }
}

bool scene_field_mesh(const Scene *scene, const DrawNode *node, Arena *arena, Mesh *mesh) {
    double low[3], high[3], cell = read_box(node, low, high);
    FieldSurface surface;
    const Field *field = read_field(scene, node, &matrix_identity, arena);
    if (!field_surface(arena, field, low, high, cell, &surface)) {
        scene_report(scene, "bad-resolution", node,
                     "'resolution' is too small: at most 1024 samples along an axis and 4 million points are possible");
        return false;
    }
    if (surface.index_count == 0) {
        scene_report(scene, "empty-solid", node, "the distance field has no surface in its box");
        return false;
    }
    *mesh = (Mesh){.vertices = arena_alloc_array(arena, surface.point_count, sizeof *mesh->vertices),
                   .indices = surface.indices,
                   .vertex_count = surface.point_count,
                   .index_count = surface.index_count};
    for (uint32_t i = 0; i < surface.point_count; i++) {
        mesh->vertices[i] = (MeshVertex){.uv = {0}};
        for (int k = 0; k < 3; k++)
            mesh->vertices[i].position[k] = (float)surface.points[i][k];
    }
    return true;
}
