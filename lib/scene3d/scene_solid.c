// scene_solid.c: see scene_solid.h. The members of a solid are read into a tree of parts, from which the grid of all
// coordinates follows. Then the operations are executed.
#include "scene3d/scene_solid.h"

#include "solid/solid.h"

#include <math.h>
#include <string.h>

// A node in a solid: an operation on its children, or a leaf, whose triangles are in the coordinates of the solid.
typedef struct Part Part;
struct Part {
    const DrawNode *node;
    Part **children;
    uint32_t child_count;
    double (*points)[3]; // of a leaf
    uint32_t *indices;
    uint32_t point_count;
    uint32_t index_count;
    double origin[3]; // of a plane
    double normal[3]; // 0;0;0: no plane
};

typedef struct SolidBuild {
    const Scene *scene;
    Arena *arena;
    double low[3];
    double high[3];
    SolidGrid grid;
    Solid *open; // members that are not closed
    uint32_t open_count;
    uint32_t open_capacity;
} SolidBuild;

// Rounds the coordinates of primitives, so that points at the same place become equal: at seams, they differ by
// rounding errors.
static double round_point(double x) {
    const double STEPS = 1 << 24;
    return floor(x * STEPS + 0.5) / STEPS;
}

static bool is_mirrored(const Matrix *matrix) {
    double cofactors[9];
    matrix_cofactors(matrix, cofactors);
    return vector_dot(matrix->m, cofactors) < 0;
}

static void read_leaf(SolidBuild *build, Part *part, const Matrix *matrix) {
    SceneModel model = scene_model(build->scene, part->node);
    Mesh mesh;
    if (!matrix_is_finite(matrix))
        return;
    if (!(model.kind == KIND_SDF ? scene_field_mesh(build->scene, part->node, build->arena, &mesh)
                                 : scene_triangles(build->scene, &model, build->arena, &mesh)))
        return;
    part->points = arena_alloc_array(build->arena, mesh.vertex_count, sizeof *part->points);
    part->indices = mesh.indices;
    part->point_count = mesh.vertex_count;
    part->index_count = mesh.index_count;
    for (uint32_t i = 0; i < mesh.vertex_count; i++) {
        double p[3];
        for (int k = 0; k < 3; k++)
            p[k] = model.kind == KIND_MODEL ? (double)mesh.vertices[i].position[k]
                                            : round_point(mesh.vertices[i].position[k]);
        matrix_point(matrix, p, part->points[i]);
        for (int k = 0; k < 3; k++) {
            build->low[k] = fmin(build->low[k], part->points[i][k]);
            build->high[k] = fmax(build->high[k], part->points[i][k]);
        }
    }
    if (is_mirrored(matrix))
        for (uint32_t i = 0; i + 2 < mesh.index_count; i += 3) {
            uint32_t second = part->indices[i + 1];
            part->indices[i + 1] = part->indices[i + 2];
            part->indices[i + 2] = second;
        }
}

static void read_plane(Part *part, const Matrix *matrix) {
    const AttrValue *origin = draw_attr(part->node, ATTR_ORIGIN), *normal = draw_attr(part->node, ATTR_NORMAL);
    if (!normal)
        return;
    double cofactors[9], *n = part->normal;
    matrix_point(matrix, origin ? origin->as.numbers : (double[3]){0}, part->origin);
    matrix_cofactors(matrix, cofactors);
    double sign = is_mirrored(matrix) ? -1 : 1;
    for (int k = 0; k < 3; k++)
        n[k] = sign * (cofactors[k] * normal->as.numbers[0] + cofactors[3 + k] * normal->as.numbers[1] +
                       cofactors[6 + k] * normal->as.numbers[2]);
}

// Reads a node and its members. The recursion is limited by the maximum depth of nodes.
static Part *read_part(SolidBuild *build, const DrawNode *node, const Matrix *matrix) {
    Part *part = arena_alloc(build->arena, sizeof *part);
    *part = (Part){.node = node};
    if (scene_is_model((NodeKind)node->kind)) {
        read_leaf(build, part, matrix);
        return part;
    }
    part->children = arena_alloc_array(build->arena, node->child_count, sizeof(Part *));
    if (node->kind == KIND_TRIM || node->kind == KIND_SLICE)
        read_plane(part, matrix);
    for (uint32_t i = 0; i < node->child_count; i++) {
        const DrawNode *child = node->children[i];
        if (!scene_is_model((NodeKind)child->kind) && !scene_is_operation((NodeKind)child->kind)) {
            scene_report(build->scene, "misplaced-node", child, "has no effect inside a solid; ignored");
            continue;
        }
        Matrix placed = matrix_of_member(matrix, child);
        part->children[part->child_count++] = read_part(build, child, &placed);
    }
    return part;
}

static bool make_leaf(SolidBuild *build, const Part *part, Solid *solid) {
    bool closed = solid_from_mesh(build->arena, &build->grid, (const double(*)[3])part->points, part->point_count,
                                  part->indices, part->index_count, solid);
    if (!closed && part->node->kind == KIND_MODEL && draw_flag(part->node, ATTR_REPAIR))
        closed = solid_repair(build->arena, solid);
    if (closed) {
        solid_turn_outwards(solid);
        return true;
    }
    scene_report(build->scene, "open-model", part->node,
                 "the model has holes, so it is drawn unchanged; 'repair=true' fills the holes");
    build->open =
        arena_grow_array(build->arena, build->open, build->open_count, &build->open_capacity, sizeof *build->open);
    build->open[build->open_count++] = *solid;
    return false;
}

// Executes the operation of a part. Returns false if the part is not closed; it is then left out of other operations.
static bool make_solid(SolidBuild *build, const Part *part, Solid *solid) {
    NodeKind kind = (NodeKind)part->node->kind;
    if (scene_is_model(kind))
        return make_leaf(build, part, solid);
    uint32_t count = 0;
    Solid *members = arena_alloc_array(build->arena, part->child_count, sizeof *members);
    for (uint32_t i = 0; i < part->child_count; i++) {
        bool closed = make_solid(build, part->children[i], &members[count]);
        if (!closed && i == 0 && kind == KIND_DIFFERENCE)
            members[count++] = (Solid){0}; // what is not there cannot become smaller
        count += closed;
    }
    SolidOperation operation = kind == KIND_INTERSECT    ? SOLID_INTERSECTION
                               : kind == KIND_DIFFERENCE ? SOLID_DIFFERENCE
                                                         : SOLID_UNION;
    *solid = solid_combine_all(build->arena, operation, members, count);
    if (kind != KIND_TRIM && kind != KIND_SLICE)
        return true;
    if (vector_dot(part->normal, part->normal) > 0)
        *solid = solid_trim(build->arena, &build->grid, solid, part->origin, part->normal);
    else
        scene_report(build->scene, "missing-attribute", part->node, "'normal' is missing; nothing is cut away");
    return true;
}

static void add_solid(const SolidGrid *grid, const Solid *solid, Mesh *mesh) {
    for (uint32_t i = 0; i < 3 * solid->face_count; i++)
        mesh->indices[mesh->index_count++] = mesh->vertex_count + solid->faces[i / 3][i % 3];
    for (uint32_t i = 0; i < solid->point_count; i++) {
        MeshVertex *vertex = &mesh->vertices[mesh->vertex_count++];
        double place[3];
        solid_coordinates(grid, solid->points[i], place);
        *vertex = (MeshVertex){.uv = {0}};
        for (int k = 0; k < 3; k++)
            vertex->position[k] = (float)place[k];
    }
}

// Creates a mesh from a solid and open meshes.
static Mesh join_meshes(Arena *arena, const SolidGrid *grid, const Solid *solid, const Solid *open,
                        uint32_t open_count) {
    size_t points = solid->point_count, faces = solid->face_count;
    for (uint32_t i = 0; i < open_count; i++)
        points += open[i].point_count, faces += open[i].face_count;
    Mesh mesh = {.vertices = arena_alloc_array(arena, points, sizeof *mesh.vertices),
                 .indices = arena_alloc_array(arena, 3 * faces, sizeof *mesh.indices)};
    add_solid(grid, solid, &mesh);
    for (uint32_t i = 0; i < open_count; i++)
        add_solid(grid, &open[i], &mesh);
    return mesh;
}

bool scene_solid_mesh(const Scene *scene, const DrawNode *node, Arena *arena, Mesh *mesh) {
    SolidBuild build = {.scene = scene,
                        .arena = arena,
                        .low = {INFINITY, INFINITY, INFINITY},
                        .high = {-INFINITY, -INFINITY, -INFINITY}};
    Solid solid = {0};
    const Part *part = read_part(&build, node, &matrix_identity);
    if (build.low[0] <= build.high[0]) {
        build.grid = solid_grid(build.low, build.high);
        make_solid(&build, part, &solid);
    }
    *mesh = join_meshes(arena, &build.grid, &solid, build.open, build.open_count);
    if (mesh->index_count == 0)
        scene_report(scene, "empty-solid", node, "nothing is left of the models inside");
    return mesh->index_count > 0;
}

void scene_repair_mesh(Arena *arena, Mesh *mesh) {
    float low[3], high[3];
    double corners[2][3], (*points)[3] = arena_alloc_array(arena, mesh->vertex_count, sizeof *points);
    Solid solid;
    mesh_bounds(mesh, low, high);
    for (int k = 0; k < 3; k++)
        corners[0][k] = low[k], corners[1][k] = high[k];
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        for (int k = 0; k < 3; k++)
            points[i][k] = mesh->vertices[i].position[k];
    SolidGrid grid = solid_grid(corners[0], corners[1]);
    solid_from_mesh(arena, &grid, (const double(*)[3])points, mesh->vertex_count, mesh->indices, mesh->index_count,
                    &solid);
    solid_repair(arena, &solid);
    *mesh = join_meshes(arena, &grid, &solid, NULL, 0);
}
