// draw_order.c: culls, sorts and batches the instances of a scene; see draw_order.h.
//
// Opaque instances with the same model and textures follow each other, so that few draws suffice. Transparent ones are
// ordered by depth. No two instances are equal in this order, so it does not depend on qsort.
#include "scene3d/draw_order.h"

#include "scene3d/sphere_impostor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Sorted {
    double depth;
    uint32_t segments;
    uint32_t instance;
    uint32_t rank; // rank of the instance's model and textures (Ranks)
    bool last; // true if the instance is transparent, in a group with depth_sort and depth_test; it is then drawn last
    bool disc; // true if the instance can be drawn as a disc
} Sorted;

// Orders opaque instances by rank, then from near to far. Transparent instances follow: from far to near and, at equal
// depth, by rank.
static int compare_sorted(const void *a, const void *b) {
    const Sorted *one = a, *two = b;
    if (one->last != two->last)
        return two->last ? -1 : 1;
    if (!one->last && one->rank != two->rank)
        return one->rank < two->rank ? -1 : 1;
    if (one->depth < two->depth || one->depth > two->depth)
        return (one->depth < two->depth) != one->last ? -1 : 1;
    if (one->rank != two->rank)
        return one->rank < two->rank ? -1 : 1;
    return one->instance < two->instance ? -1 : one->instance > two->instance;
}

// Computes the minimum and maximum of f[0]·x + f[1]·y + f[2]·z + f[3] within a box.
static void range_of(const double f[4], const SceneBox *box, double *min, double *max) {
    double middle = f[3], extent = 0;
    for (int k = 0; k < 3; k++) {
        middle += f[k] * (box->low[k] + box->high[k]) / 2;
        extent += fabs(f[k] * (box->high[k] - box->low[k]) / 2);
    }
    *min = middle - extent;
    *max = middle + extent;
}

static void row_of(const Matrix *a, int row, double out[4]) {
    for (int column = 0; column < 4; column++)
        out[column] = a->m[4 * column + row];
}

// Returns false only if no part of the box is visible. Can also return true if no part is visible.
static bool is_seen(const Matrix *clip, const SceneBox *box) {
    double w[4], row[4], plane[4], min, max;
    row_of(clip, 3, w);
    for (int side = 0; side < 6; side++) {
        row_of(clip, side / 2, row);
        for (int k = 0; k < 4; k++)
            plane[k] = side % 2 ? w[k] - row[k] : w[k] + row[k];
        range_of(plane, box, &min, &max);
        if (max < 0)
            return false;
    }
    return true;
}

// Ranks number the pairs of model and textures in a group, in the order in which the group first uses them. The lower
// half of an entry of `ranks` is the rank of a pair. It is valid only in one group; the upper half is the index of this
// group plus 1.
typedef struct Ranks {
    uint64_t *ranks; // indexed by pair: index of the model times number of textures, plus index of the textures
    uint32_t count;  // number of ranks in the current group
} Ranks;

static uint32_t rank_of(Ranks *ranks, size_t pair, uint32_t group) {
    uint64_t stamp = (uint64_t)(group + 1) << 32;
    if ((ranks->ranks[pair] & ~(uint64_t)UINT32_MAX) != stamp)
        ranks->ranks[pair] = stamp | ranks->count++;
    return (uint32_t)ranks->ranks[pair];
}

static bool is_translucent(const SceneInstance *instance) {
    return instance->material->surface.translucency > 0;
}

static bool is_transparent(const Scene *scene, const SceneInstance *instance) {
    return instance->material->surface.transparency > 0 || is_translucent(instance) ||
           scene->textures[instance->material->textures].ids[SCENE_TEXTURES - 1].len > 0;
}

static bool can_extend(const SceneDraw *draw, const SceneDraw *wanted, bool split) {
    return draw->group == wanted->group && draw->model == wanted->model && draw->textures == wanted->textures &&
           draw->transparent == wanted->transparent && draw->translucent == wanted->translucent &&
           draw->disc == wanted->disc && (draw->segments == wanted->segments || !split);
}

static void add_draws(const Scene *scene, DrawOrder *order, uint32_t number, const Sorted *sorted, uint32_t count,
                      bool deep) {
    // If there are this many draws or more, one draw combines instances with different `segments`.
    enum { MAX_SPLIT = 2000 };
    const SceneGroup *group = scene->groups[number];
    for (uint32_t i = 0; i < count; i++) {
        const SceneInstance *instance = &group->instances[sorted[i].instance];
        SceneDraw *draw = order->draw_count ? &order->draws[order->draw_count - 1] : NULL;
        const SceneDraw wanted = {.group = number,
                                  .model = instance->model,
                                  .textures = instance->material->textures,
                                  .transparent = sorted[i].last,
                                  .translucent = sorted[i].last && is_translucent(instance),
                                  .disc = sorted[i].disc,
                                  .deep = deep,
                                  .first = order->count,
                                  .segments = sorted[i].segments};
        if (!draw || !can_extend(draw, &wanted, order->draw_count < MAX_SPLIT)) {
            order->draws =
                arena_grow_array(scene->arena, order->draws, order->draw_count, &order->draw_capacity, sizeof *draw);
            draw = &order->draws[order->draw_count++];
            *draw = wanted;
        }
        draw->count++;
        draw->segments = draw->segments > sorted[i].segments ? draw->segments : sorted[i].segments;
        order->instances[order->count++] = instance;
    }
}

// Returns the length in pixels that an edge of length 1 in model coordinates has at the nearest point of the model.
// `scale` is Sight.scale.
static double pixels_of(const Matrix *placed, double depth, bool perspective, double scale) {
    double max = 0;
    for (int column = 0; column < 3; column++)
        max = fmax(max, vector_dot(placed->m + 4 * column, placed->m + 4 * column));
    return perspective ? scale * sqrt(max) / fmax(depth, 1e-9) : scale * sqrt(max);
}

static const double CHORD = 4.93; // maximum distance between an arc and its chord, in units of radius / segments²

static bool is_ball(const Scene *scene, const SceneInstance *instance) {
    const SceneModel *model = &scene->models[instance->model];
    return model->kind == KIND_SPHERE && !model->flat && model->snap == 0.5 && instance->material->textures == 0;
}

// Returns the number of segments to draw. For a sphere, halves the number of the model as long as no point moves by
// more than a twentieth of a pixel. For shiny surfaces, points may move even less.
static uint32_t segments_of(const Scene *scene, const SceneInstance *instance, double pixels) {
    double roughness = instance->material->surface.roughness, max = 0.05 * roughness * roughness;
    bool ball = is_ball(scene, instance);
    uint32_t segments = scene->models[instance->model].segments;
    while (ball && segments >= 32 && segments % 8 == 0 && pixels * CHORD < max * (segments / 2.0) * (segments / 2.0))
        segments /= 2;
    return segments;
}

// Returns true if a disc looks like the sphere: no point differs by more than a tenth of a pixel.
static bool can_be_disc(const Scene *scene, const SceneGroup *group, const SceneInstance *instance, double pixels) {
    const SceneModel *model = &scene->models[instance->model];
    return is_ball(scene, instance) && !model->invert && group->state.face_cull &&
           group->state.cull_face == FACE_BACK && pixels * CHORD < 0.1 * model->segments * model->segments;
}

// The projection of a camera.
typedef struct Sight {
    const Eye *eye;
    const Matrix *view;
    const Matrix *projection;
    Matrix both;
    double scale; // length in pixels that an edge of length 1 in the scene has at a distance of 1
} Sight;

// Fills `depth`, `segments` and `disc` of *sorted. Returns false if the instance is not visible.
static bool measure_instance(const Scene *scene, const SceneGroup *group, const Sight *sight, const SceneBox *box,
                             Sorted *sorted) {
    const SceneInstance *instance = &group->instances[sorted->instance];
    Matrix clip = matrix_product(&sight->both, &instance->matrix);
    Matrix placed = matrix_product(sight->view, &instance->matrix);
    double z[4], min, max = 0;
    row_of(&placed, 2, z);
    range_of(z, box, &min, &max);
    if (box->triangles == 0 || (!group->program && !is_seen(&clip, box)))
        return false; // a program can move vertices
    double pixels = pixels_of(&placed, -max, sight->projection->m[11] != 0, sight->scale);
    SphereImpostor disc;
    sorted->depth = -max;
    sorted->segments = group->program ? scene->models[instance->model].segments : segments_of(scene, instance, pixels);
    sorted->disc = !group->program && is_transparent(scene, instance) && can_be_disc(scene, group, instance, pixels) &&
                   sphere_impostor(sight->eye, sight->view, &instance->matrix, &disc);
    return true;
}

// Decides which spheres of a group are drawn as discs. If this or an earlier group writes depth, spheres become discs
// only if there are MANY or more of them. A smaller number remain triangles, which, unlike discs, are depth-tested for
// each sample of a pixel. `deep` is true if an earlier group writes depth. Returns true if this or an earlier group
// does.
static bool choose_discs(const Scene *scene, const SceneGroup *group, Sorted *sorted, uint32_t count, bool deep) {
    enum { MANY = 50 };
    uint32_t discs = 0;
    for (uint32_t i = 0; i < count; i++) {
        bool translucent = is_translucent(&group->instances[sorted[i].instance]);
        deep |= group->state.depth_test && (!sorted[i].last || translucent);
        sorted[i].disc &= sorted[i].last && !translucent;
        discs += sorted[i].disc;
    }
    for (uint32_t i = 0; i < count; i++) {
        sorted[i].disc &= !deep || discs >= MANY;
        if (sorted[i].disc)
            sorted[i].segments = scene->models[group->instances[sorted[i].instance].model].segments;
    }
    return deep;
}

DrawOrder draw_order(const Scene *scene, const Eye *eye, const Matrix *view, const Matrix *projection, int width,
                     const SceneBox *boxes) {
    DrawOrder order = {.instances = arena_alloc_array(scene->arena, scene->instance_count, sizeof *order.instances)};
    Sorted *sorted = arena_alloc_array(scene->arena, scene->instance_count, sizeof *sorted);
    size_t pairs = (size_t)scene->model_count * scene->texture_count;
    Ranks ranks = {arena_alloc_array(scene->arena, pairs, sizeof *ranks.ranks), 0};
    memset(ranks.ranks, 0, pairs * sizeof *ranks.ranks);
    Sight sight = {eye, view, projection, matrix_product(projection, view), fabs(projection->m[0]) * width / 2};
    bool deep = false; // true if a draw has written depth
    for (uint32_t number = 0; number < scene->group_count; number++) {
        const SceneGroup *group = scene->groups[number];
        bool sorts = group->state.depth_sort && group->state.depth_test;
        uint32_t count = 0;
        ranks.count = 0;
        for (uint32_t i = 0; i < group->instance_count; i++) {
            const SceneInstance *instance = &group->instances[i];
            const SceneBox *box = &boxes[instance->model];
            size_t pair = (size_t)instance->model * scene->texture_count + instance->material->textures;
            uint32_t rank = rank_of(&ranks, pair, number);
            Sorted *next = &sorted[count];
            *next = (Sorted){.instance = i, .rank = rank, .last = sorts && is_transparent(scene, instance)};
            if (!measure_instance(scene, group, &sight, box, next))
                continue;
            double part = next->segments ? (double)next->segments / scene->models[instance->model].segments : 1;
            uint64_t triangles = (uint64_t)(part * part * box->triangles);
            if (order.triangles + triangles > SCENE_MAX_TRIANGLES) {
                order.cut = true;
                continue;
            }
            order.triangles += triangles;
            next->depth = sorts ? next->depth : 0;
            count++;
        }
        deep = choose_discs(scene, group, sorted, count, deep);
        qsort(sorted, count, sizeof *sorted, compare_sorted);
        add_draws(scene, &order, number, sorted, count, deep);
    }
    return order;
}
