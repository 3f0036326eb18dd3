// scene_cost.c: see scene_cost.h. The costs were measured with llvmpipe, in processor time of all its threads. A GPU is
// faster, but the work limit must not depend on the machine.
#include "scene3d/scene_cost.h"

#include "scene3d/scene_cover.h"

#include <math.h>

static const double PIXEL = 60;      // shading a pixel of an instance
static const double HIDDEN = 2;      // finding that a pixel is hidden
static const double BACKS = 2;       // translucent instances are drawn twice
static const double THROUGH = 900;   // adding the light that a translucent body transmits to a pixel
static const double SENT_LIGHT = 10; // sending a light to the GPU, for each group
static const double TRIANGLE = 80;
static const double SAMPLE = 80;     // each sample of a triangle, with multisampling
static const double MAX_SAMPLES = 4; // limit of llvmpipe
static const double QUAD = 4;        // pixels that are shaded together
static const double ROUND = 0.21;    // the part of a square that a circle leaves free
static const double FRAGMENT = 6;    // pixels that are shaded for each pixel, if all triangles are tiny
static const double EDGE = 0.4;      // pixels that are shaded at the edges of a triangle, for each pixel of its length

// Costs of adding a light to a pixel.
static const double light_costs[LIGHT_KINDS] = {
    [LIGHT_DIRECTIONAL] = 6, [LIGHT_SPOT] = 8, [LIGHT_POINT] = 6, [LIGHT_BALL] = 11, [LIGHT_LINE] = 14};

// A picture whose cost is summed.
typedef struct CostSum {
    const SceneView *view;
    double pixels;  // of the picture
    double samples; // of a pixel, at least 1
    double shading; // cost of shading a pixel in the current group
    HiddenCells hidden;
    double sum;
} CostSum;

// Starts a group: computes its cost of shading a pixel, and adds the cost of sending its lights.
static void begin_group(CostSum *cost, const SceneGroup *group) {
    double left = fmin(fmax(group->state.max_lights, 1), SCENE_MAX_LIGHTS);
    cost->shading = PIXEL;
    for (; group; group = group->parent)
        for (uint32_t i = 0; i < group->light_count && left > 0; i++, left--) {
            cost->shading += light_costs[(int)group->lights[i].kind];
            cost->sum += SENT_LIGHT;
        }
}

static bool is_ball(const SceneModel *model) {
    return model->kind == KIND_SPHERE && model->segments >= 16;
}

static bool is_convex(const SceneModel *model) {
    return is_ball(model) || model->kind == KIND_BOX;
}

// Adds the cost of shading an instance. `lengths` is the sum of the lengths of its triangles in pixels.
static void add_pixels(CostSum *cost, const SceneDraw *draw, double pixels, double lengths) {
    const SceneModel *model = &cost->view->scene->models[draw->model];
    double detail = model->segments > 0 ? (double)draw->segments / model->segments : 1;
    // A pixel at the edge of a triangle is shaded for each triangle that it shows, together with its neighbours. Half
    // of the triangles face away.
    double triangles = detail * detail * cost->view->boxes[draw->model].triangles / 2;
    double edges = QUAD * triangles + EDGE * cost->samples * detail * lengths;
    double shaded = fmin(pixels + edges, FRAGMENT * cost->samples * pixels);
    cost->sum += shaded * (draw->translucent ? BACKS * cost->shading + THROUGH : cost->shading);
}

// Returns true if the instances of a draw hide all that is behind them and drawn later.
static bool is_hiding(const SceneView *view, const SceneDraw *draw) {
    const SceneGroup *group = view->scene->groups[draw->group];
    return is_convex(&view->scene->models[draw->model]) && draw->textures == 0 && !draw->transparent &&
           !group->program && group->state.depth_test && group->state.depth_sort;
}

static void add_draw(CostSum *cost, const SceneDraw *draw) {
    const SceneView *view = cost->view;
    const SceneBox *box = &view->boxes[draw->model];
    const SceneModel *model = &view->scene->models[draw->model];
    bool convex = is_convex(model), hides = is_hiding(view, draw);
    double sides = view->scene->groups[draw->group]->state.face_cull ? 1 : 2;
    for (uint32_t i = draw->first; i < draw->first + draw->count; i++) {
        Matrix clip = matrix_product(&view->clip, &view->order->instances[i]->matrix);
        Footprint print = footprint_of(&clip, box);
        double room = hidden_room(NULL, &print, 0), seen = room;
        HidingFace face;
        if (hides && (is_ball(model) ? hiding_face_of_ball(&clip, box, &face) : hiding_face_of_box(&print, &face))) {
            // Most of the surface of a ball that can be seen is not far in front of its face.
            seen = hidden_room(&cost->hidden, &print, is_ball(model) ? face.depth : print.near);
            hidden_add(&cost->hidden, &face);
        }
        double corners = is_ball(model) ? ROUND * room : 0; // the corners of its bounds, where there is no ball
        double all = sides * cost->pixels * footprint_pictures(&print, box, room - corners, convex);
        double shown = sides * cost->pixels * footprint_pictures(&print, box, fmax(seen - corners, 0), convex);
        add_pixels(cost, draw, shown, seen / fmax(room, 1e-9) * view->width * footprint_lengths(&print, box));
        cost->sum += HIDDEN * (all - shown);
    }
}

// Adds an upper bound of the cost of a draw: each instance covers the picture.
static void bound_draw(CostSum *cost, const SceneDraw *draw) {
    const float *layers = cost->view->boxes[draw->model].layers;
    double each = 2 * fmax(1, (double)layers[0] + (double)layers[1] + (double)layers[2]);
    for (uint32_t i = 0; i < draw->count; i++)
        add_pixels(cost, draw, each * cost->pixels, INFINITY);
}

static double sum_costs(const SceneView *view, bool exact) {
    double samples = fmin(view->samples, MAX_SAMPLES);
    CostSum cost = {.view = view,
                    .pixels = (double)view->width * view->height,
                    .samples = fmax(samples, 1),
                    .sum = (double)view->order->triangles * (TRIANGLE + SAMPLE * samples)};
    hidden_clear(&cost.hidden);
    for (uint32_t i = 0; i < view->order->draw_count; i++) {
        const SceneDraw *draw = &view->order->draws[i];
        if (i == 0 || draw->group != view->order->draws[i - 1].group) {
            begin_group(&cost, view->scene->groups[draw->group]);
            cost.sum += draw->translucent ? cost.pixels : 0;
        }
        if (exact)
            add_draw(&cost, draw);
        else
            bound_draw(&cost, draw);
    }
    return cost.sum;
}

double scene_cost(const SceneView *view, double enough) {
    double bound = sum_costs(view, false);
    return bound <= enough ? bound : sum_costs(view, true);
}
