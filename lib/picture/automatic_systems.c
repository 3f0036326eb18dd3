// automatic_systems.c: see automatic_systems.h.
#include "picture/automatic_systems.h"

#include "base/number.h"
#include "maths/maths.h"
#include "physics/forces.h"
#include "value/format.h"

#include <math.h>

// Copies the first three components of a vector; missing components become 0.
static void take_three(double out[3], const double *v, uint32_t n) {
    for (uint32_t k = 0; k < 3; k++)
        out[k] = v && k < n ? v[k] : 0;
}

// Copies the particles that have finite positions to system->bodies. numbers[i] receives the index of the body for
// particle i, or UINT32_MAX if the particle is not copied.
static void copy_bodies(Arena *arena, const SceneView *view, AutoSystem *system, uint32_t *numbers) {
    PhysColumns columns = phys_columns(view->engine);
    double max = 0;
    system->bodies = arena_alloc_array(arena, view->particle_count, sizeof *system->bodies);
    for (uint32_t i = 0; i < view->particle_count; i++) {
        const double *position = phys_at_particle(columns.position, i);
        double radius = *phys_at_particle(columns.radius, i), charge = *phys_at_particle(columns.charge, i);
        numbers[i] = UINT32_MAX;
        if (!numbers_finite(position, view->dimensions, 1))
            continue;
        AutoBody *body = &system->bodies[system->body_count];
        numbers[i] = system->body_count++;
        *body =
            (AutoBody){.radius = isfinite(radius) ? radius : 0, .anchor = columns.anchor[i * columns.anchor_stride]};
        take_three(body->position, position, view->dimensions);
        take_three(body->velocity, phys_at_particle(columns.velocity, i), view->dimensions);
        body->shade = isfinite(charge) ? charge : 0;
        max = fmax(max, fabs(body->shade));
    }
    system->charged = max > 0;
    for (uint32_t i = 0; i < system->body_count && max > 0; i++)
        system->bodies[i].shade /= max;
}

// Shades bodies by speed, which is done if no body is charged. The middle colour means the speed at which a body
// crosses the view in two seconds.
static void shade_by_speed(AutoSystem *system) {
    for (uint32_t i = 0; i < system->body_count; i++) {
        const double *v = system->bodies[i].velocity;
        double speed = maths_hypot(maths_hypot(v[0], v[1]), v[2]);
        system->bodies[i].shade = isfinite(speed) ? speed / (speed + system->frame.half) : 1;
    }
}

static void copy_forces(Arena *arena, const SceneView *view, AutoSystem *system, const uint32_t *numbers) {
    uint32_t count = phys_force_count(view->engine), n = view->dimensions;
    system->links = arena_alloc_array(arena, count, sizeof *system->links);
    system->barriers = arena_alloc_array(arena, count, sizeof *system->barriers);
    for (uint32_t i = 0; i < count; i++) {
        PhysForce force;
        if (!phys_get_force(view->engine, i, &force))
            continue;
        Stage stage = phys_force_row(force.kind).stage;
        if (stage == STAGE_LINK && force.from < view->particle_count && force.to < view->particle_count &&
            numbers[force.from] != UINT32_MAX && numbers[force.to] != UINT32_MAX) {
            system->links[system->link_count++] = (AutoLink){numbers[force.from], numbers[force.to]};
        } else if (stage == STAGE_BARRIER && (!force.vector || numbers_finite(force.vector, n, 1)) && force.vector2 &&
                   numbers_finite(force.vector2, n, 1)) {
            AutoBarrier *barrier = &system->barriers[system->barrier_count++];
            take_three(barrier->position, force.vector, n);
            take_three(barrier->normal, force.vector2, n);
        }
    }
}

static void copy_system(const DrawAccess *shown, Arena *arena, const SceneView *view, AutoFrame *frame,
                        AutoSystem *system) {
    uint32_t *numbers = arena_alloc_array(arena, view->particle_count, sizeof *numbers);
    *system = (AutoSystem){.name = value_text(arena, shown->schema->symbols, view->prefix),
                           .dimensions = view->dimensions > 3 ? 3 : view->dimensions};
    copy_bodies(arena, view, system, numbers);
    copy_forces(arena, view, system, numbers);
    auto_frame(arena, frame, system);
    system->frame = *frame;
    if (frame->half == 0)
        system->frame.half = 1;
    auto_scale(arena, system);
    if (!system->charged)
        shade_by_speed(system);
}

uint32_t auto_count(const DrawAccess *shown) {
    SceneView view;
    uint32_t count = 0;
    while (count < SYSTEMS_MAX && scene_view(shown->scene, shown->state, count, &view))
        count++;
    return count;
}

AutoPicture auto_copy(const DrawAccess *shown, Arena *arena, AutoFrame *frames, uint32_t count) {
    AutoSystem *systems = arena_alloc_array(arena, count, sizeof *systems);
    for (uint32_t i = 0; i < count; i++) {
        SceneView view;
        if (scene_view(shown->scene, shown->state, i, &view))
            copy_system(shown, arena, &view, &frames[i], &systems[i]);
    }
    return (AutoPicture){systems, count};
}

void auto_follow(const DrawAccess *shown, Arena *arena, AutoFrame *frames) {
    SceneView view;
    for (uint32_t i = 0; i < SYSTEMS_MAX && scene_view(shown->scene, shown->state, i, &view); i++) {
        ArenaMark mark = arena_mark(arena);
        AutoSystem system = {.dimensions = view.dimensions > 3 ? 3 : view.dimensions};
        uint32_t *numbers = arena_alloc_array(arena, view.particle_count, sizeof *numbers);
        copy_bodies(arena, &view, &system, numbers);
        if (frames[i].half == 0)
            copy_forces(arena, &view, &system, numbers);
        auto_frame(arena, &frames[i], &system);
        arena_rewind(arena, mark);
    }
}
