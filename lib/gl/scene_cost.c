// scene_cost.c: see scene_cost.h. The costs were measured with llvmpipe, in processor time of all its threads. A GPU is
// faster, but the work limit must not depend on the machine.
#include "gl/scene_cost.h"

#include <math.h>

static const double PIXEL = 60;      // shading a pixel of an instance
static const double LIGHT = 13;      // adding a line light, the most expensive kind, to a pixel
static const double SENT_LIGHT = 10; // sending a light to the GPU, for each group
static const double BACKS = 2;       // translucent instances are drawn twice
static const double TRIANGLE = 80;
static const double SAMPLE = 100;    // each sample of a triangle, with multisampling
static const double MAX_SAMPLES = 4; // limit of llvmpipe

static double lights_of(const SceneGroup *group) {
    double count = 0;
    for (; group; group = group->parent)
        count += group->light_count;
    return fmin(count, SCENE_MAX_LIGHTS);
}

// Returns which part of the picture the box of an instance covers, from 0 to 1.
static double covered_part(const Matrix *clip, const SceneBox *box) {
    double low[2] = {1, 1}, high[2] = {-1, -1};
    for (int corner = 0; corner < 8; corner++) {
        double x[4];
        for (int row = 0; row < 4; row++) {
            x[row] = clip->m[12 + row];
            for (int k = 0; k < 3; k++)
                x[row] += clip->m[4 * k + row] * (double)(corner >> k & 1 ? box->high[k] : box->low[k]);
        }
        if (!(x[3] > 1e-9))
            return 1; // the box is partly behind the camera
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], x[k] / x[3]);
            high[k] = fmax(high[k], x[k] / x[3]);
        }
    }
    double part = 1;
    for (int k = 0; k < 2; k++)
        part *= fmax(fmin(high[k], 1) - fmax(low[k], -1), 0) / 2;
    return part;
}

// Returns how many times the instances of a draw cover the picture.
static double covered_pictures(const SceneView *view, const SceneDraw *draw) {
    double sum = 0;
    for (uint32_t i = draw->first; i < draw->first + draw->count; i++) {
        Matrix clip = matrix_product(&view->clip, &view->order->instances[i]->matrix);
        sum += covered_part(&clip, &view->boxes[draw->model]);
    }
    return sum;
}

static double sum_costs(const SceneView *view, bool exact) {
    double samples = fmin(view->samples, MAX_SAMPLES);
    double pixels = (double)view->width * view->height,
           sum = (double)view->order->triangles * (TRIANGLE + SAMPLE * samples);
    for (uint32_t i = 0; i < view->order->draw_count; i++) {
        const SceneDraw *draw = &view->order->draws[i];
        double lights = lights_of(view->scene->groups[draw->group]), times = draw->translucent ? BACKS : 1;
        double pictures = exact ? covered_pictures(view, draw) : draw->count;
        if (i == 0 || draw->group != view->order->draws[i - 1].group)
            sum += lights * SENT_LIGHT + (draw->translucent ? pixels : 0);
        sum += pictures * pixels * times * (PIXEL + LIGHT * lights);
    }
    return sum;
}

double scene_cost(const SceneView *view, double enough) {
    double bound = sum_costs(view, false);
    return bound <= enough ? bound : sum_costs(view, true);
}
