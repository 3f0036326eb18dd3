// passes.c: runs the passes of effects and custom shaders; see shader.h.
#include "gl/context.h"
#include "gl/shader.h"
#include "gl/uniforms.h"

#include <math.h>

static int downsample_of(const DrawNode *node) {
    double x = draw_number(node, ATTR_DOWNSAMPLE);
    return x >= 2 ? x < 64 ? (int)x : 64 : 1;
}

double gl_seconds_left(const Gl *gl) {
    const Budget *budget = gl->budget;
    return budget ? 1e-9 * BUDGET_UNIT_TIME * (double)(budget->work_limit - budget->work) - gl->shader_seconds
                  : INFINITY;
}

void gl_refuse_passes(Gl *gl, double seconds, uint32_t passes) {
    static const double UNEVEN = 1.5;
    gl->budget->refused_time +=
        1e9 * ((isinf(gl->shader_seconds) ? 0 : gl->shader_seconds) + UNEVEN * seconds * passes);
}

bool gl_run_passes(Gl *gl, Arena *arena, const GlEffect *effect, const GlPass *passes, uint32_t count, GlImage *out) {
    GlImage first = {0}, last = effect->last;
    int reduction = downsample_of(effect->node);
    // A script's own program may leave out pixels. The target is then cleared first, because it can contain an earlier
    // picture.
    bool good = true, own = gl_has_shader(effect->node);
    for (uint32_t i = 0; i < count && good; i++) {
        int down = passes[i].reduced ? reduction : 1;
        int width = effect->width / down > 0 ? effect->width / down : 1;
        int height = effect->height / down > 0 ? effect->height / down : 1;
        GlImage target = gl_image_new(gl, width, height, effect->format);
        good = target.texture != 0;
        if (good) {
            GlState state = {effect, first, last, target, (int)i, (int)count, down};
            gl_target(gl, target);
            if (own) {
                glClearColor(0, 0, 0, 0);
                glClear(GL_COLOR_BUFFER_BIT);
            }
            gl_set_uniforms(gl, arena, passes[i].program, &state);
            if (own) {
                double seconds, needed, left = gl_seconds_left(gl);
                seconds = gl_draw_quad_within(gl, passes[i].program, width, height, left, &needed);
                good = seconds < INFINITY;
                if (!good && gl->budget)
                    gl_refuse_passes(gl, needed, count - i);
                gl->shader_seconds += seconds;
            } else {
                gl_draw_quad(gl, passes[i].program);
            }
        }
        if (i > 0 && last.texture != first.texture)
            gl_image_free(gl, last);
        last = target;
        first = i == 0 ? target : first;
    }
    if (first.texture != last.texture)
        gl_image_free(gl, first);
    *out = last;
    return good;
}
