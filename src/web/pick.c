// pick.c: finds the particle at a point of a picture, for the page: circles of the display list that are drawn at the
// positions of particles.
#include "petri-draw.h"
#include "petri-inspect.h"
#include "web/host.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MIN_RADIUS = 6; // in the picture's units: how close to the centre of a small circle a click must be
// Bounds of the search for the coordinate system of the particles.
enum { MAX_FRAMES = 32, MAX_CIRCLES = 4, MAX_SAMPLES = 20, MAX_SYSTEMS = 64 };

typedef struct Matrix {
    double xx, yx, xy, yy, x0, y0;
} Matrix;

static const Matrix IDENTITY = {1, 0, 0, 1, 0, 0};

typedef struct Circle {
    size_t panel; // number of clips before the circle: in an automatic picture, each system has a panel
    Matrix matrix;
    double x, y, radius; // in the picture's units
} Circle;

// The part of a display list that determines where circles are, and the systems of the frame.
typedef struct Picked {
    const double *numbers;
    size_t count;
    size_t at; // index of the next number
    Matrix matrix;
    size_t panel;
    Circle *circles;
    size_t circle_count;
    size_t circle_room;
    Matrix frames[MAX_FRAMES + 2 * MAX_CIRCLES * MAX_SYSTEMS]; // possible coordinate systems of the particles
    size_t frame_count;
    PetriSystem systems[MAX_SYSTEMS];
    size_t system_count;
} Picked;

static double scale_of(const Matrix *m) {
    return sqrt(fabs(m->xx * m->yy - m->xy * m->yx));
}

static double next(Picked *list) {
    return list->at < list->count ? list->numbers[list->at++] : 0;
}

static void skip_list(Picked *list) {
    list->at += (size_t)next(list);
}

static void add_circle(Picked *list, double x, double y, double radius) {
    const Matrix *m = &list->matrix;
    if (list->circle_count == list->circle_room) {
        size_t room = list->circle_room * 2 + 64;
        Circle *grown = realloc(list->circles, room * sizeof *grown);
        if (!grown)
            return;
        list->circles = grown;
        list->circle_room = room;
    }
    list->circles[list->circle_count++] =
        (Circle){list->panel, *m, m->xx * x + m->xy * y + m->x0, m->yx * x + m->yy * y + m->y0, radius * scale_of(m)};
}

static void read_path(Picked *list) {
    static const unsigned char sizes[] = {
#define PETRI_PATH_ELEMENT(name, operands, text) operands 0,
#define NUMBER(name) 1 +
#define FLAG(name) 1 +
#define PAIR(name) 2 +
#include "petri-display-list.inc"
#undef NUMBER
#undef FLAG
#undef PAIR
    };
    size_t end = (size_t)next(list);
    for (end += list->at; list->at < end && list->at < list->count;) {
        size_t kind = (size_t)next(list);
        const double *n = list->numbers + list->at;
        if (kind == PETRI_PATH_ARC)
            add_circle(list, n[0], n[1], fmax(fabs(n[2]), fabs(n[3])));
        list->at += kind < sizeof sizes ? sizes[kind] : 0;
    }
}

static void read_matrix(Picked *list) {
    Matrix *m = &list->matrix;
    memcpy(m, list->numbers + list->at, sizeof *m);
    list->at += 6;
    size_t known = 0;
    while (known < list->frame_count && memcmp(&list->frames[known], m, sizeof *m) != 0)
        known++;
    if (known == list->frame_count && known < MAX_FRAMES)
        list->frames[list->frame_count++] = *m;
}

static void skip_operands(Picked *list, int kind);

static void skip_paint(Picked *list) {
    do
        skip_operands(list, (int)next(list));
    while (list->at < list->count && list->numbers[list->at] == PETRI_DRAW_UNSUPPORTED);
}

static void skip_pixels(Picked *list) {
    double width = next(list);
    list->at += (size_t)(width * next(list));
}

static void skip_stops(Picked *list) {
    list->at += 5 * (size_t)next(list);
}

static void skip_operands(Picked *list, int kind) {
    switch (kind) {
#define PETRI_COMMAND(name, operands, text)                                                                            \
    case PETRI_DRAW_##name:                                                                                            \
        operands break;
#define NUMBER(name) list->at++;
#define FLAG(name) list->at++;
#define ALPHA(name) list->at++;
#define WORD(name, words) list->at++;
#define PAIR(name) list->at += 2;
#define NUMBERS(name, count) list->at += count;
#define MATRIX(name) list->at += 6;
#define COLOUR(name) list->at += 4;
#define PATH(name) skip_list(list);
#define STRING(name) skip_list(list);
#define LIST(name) skip_list(list);
#define FILTER(name) skip_list(list);
#define EFFECT(name) skip_list(list);
#define STOPS(name) skip_stops(list);
#define PIXELS(name) skip_pixels(list);
#define PAINT(name) skip_paint(list);
#include "petri-display-list.inc"
    default:
        list->at = list->count;
    }
}

static void read_commands(Picked *list) {
    list->matrix = list->frames[list->frame_count++] = IDENTITY;
    list->panel = SIZE_MAX;
    for (list->at = 3; list->at < list->count;) {
        int kind = (int)next(list);
        if (kind == PETRI_DRAW_PATH) {
            list->at += 3;
            read_path(list);
        } else if (kind == PETRI_DRAW_MATRIX) {
            read_matrix(list);
        } else {
            list->panel += kind == PETRI_DRAW_CLIP;
            skip_operands(list, kind);
        }
    }
}

// A particle, by number; particle PETRI_NO_PARTICLE: none.
typedef struct Found {
    size_t system;
    uint32_t particle;
} Found;

static const Found NOTHING = {0, PETRI_NO_PARTICLE};

static double coordinate(const PetriSystem *system, uint32_t particle, uint32_t axis) {
    return axis < system->dimensions ? system->position.data[particle * system->position.stride + axis] : 0;
}

// In the automatic picture of a system with up to two dimensions, circle k belongs to the k-th particle that has a
// finite position.
static Found particle_of_panel(const Picked *list, const Circle *hit) {
    if (hit->panel >= list->system_count || list->systems[hit->panel].dimensions > 2)
        return NOTHING;
    const PetriSystem *system = &list->systems[hit->panel];
    size_t before = 0;
    for (const Circle *circle = list->circles; circle < hit; circle++)
        before += circle->panel == hit->panel;
    for (uint32_t i = 0; i < system->particle_count; i++)
        if (isfinite(coordinate(system, i, 0)) && isfinite(coordinate(system, i, 1)) && before-- == 0)
            return (Found){hit->panel, i};
    return NOTHING;
}

// Returns the particle whose position, in the coordinates of a frame, is closest to the centre of a circle, if it is
// inside the circle.
static Found particle_at(const Picked *list, const Matrix *m, const Circle *circle) {
    double determinant = m->xx * m->yy - m->xy * m->yx, left = circle->x - m->x0, top = circle->y - m->y0;
    double x = (m->yy * left - m->xy * top) / determinant, y = (m->xx * top - m->yx * left) / determinant;
    double min = circle->radius / scale_of(m);
    Found best = NOTHING;
    for (size_t s = 0; s < list->system_count; s++)
        for (uint32_t i = 0; i < list->systems[s].particle_count; i++) {
            const PetriSystem *system = &list->systems[s];
            double distance = hypot(coordinate(system, i, 0) - x, coordinate(system, i, 1) - y);
            if (distance < min) {
                best = (Found){s, i};
                min = distance;
            }
        }
    return best;
}

// Adds the frames of scripts that draw 1 to MAX_CIRCLES circles per particle, in the order of the particles, as the
// first or the last circles, and move them with nested transforms. The outer transform is then not in the display list.
static void add_nested_frames(Picked *list) {
    for (size_t s = 0; s < list->system_count; s++) {
        const PetriSystem *system = &list->systems[s];
        for (size_t each = 1; each <= MAX_CIRCLES && each * system->particle_count <= list->circle_count; each++)
            for (int last = 0; last < 2 && system->particle_count > 0; last++) {
                const Circle *circle =
                    &list->circles[last ? list->circle_count - each * system->particle_count : (size_t)0];
                Matrix frame = circle->matrix;
                double x = coordinate(system, 0, 0), y = coordinate(system, 0, 1);
                frame.x0 = circle->x - frame.xx * x - frame.xy * y;
                frame.y0 = circle->y - frame.yx * x - frame.yy * y;
                list->frames[list->frame_count++] = frame;
            }
    }
}

// Returns the transform with which the script draws particles: the one for which most circles have a particle inside.
// Circles can have other transforms, because scripts also move a circle to a particle with a transform.
static Matrix frame_of(Picked *list) {
    size_t every = list->circle_count / MAX_SAMPLES > 1 ? list->circle_count / MAX_SAMPLES : 1, max_count = 0;
    Matrix best = IDENTITY;
    add_nested_frames(list);
    for (size_t f = 0; f < list->frame_count; f++) {
        const Matrix *frame = &list->frames[f];
        size_t count = 0;
        for (size_t i = 0; i < list->circle_count && scale_of(frame) > 0; i += every)
            count += particle_at(list, frame, &list->circles[i]).particle != PETRI_NO_PARTICLE;
        if (count > max_count) {
            best = *frame;
            max_count = count;
        }
    }
    return best;
}

// Returns the particle at a point; the circle that is drawn last is in front. `automatic` is true if petri made the
// picture.
static Found find_particle(Picked *list, bool automatic, double x, double y) {
    read_commands(list);
    Matrix frame = automatic ? IDENTITY : frame_of(list);
    Found found = NOTHING;
    for (size_t i = list->circle_count; i-- > 0 && found.particle == PETRI_NO_PARTICLE;) {
        const Circle *circle = &list->circles[i];
        if (hypot(circle->x - x, circle->y - y) <= fmax(circle->radius, MIN_RADIUS))
            found = automatic ? particle_of_panel(list, circle) : particle_at(list, &frame, circle);
    }
    return found;
}

static bool show(PetriSession *session, PetriAutomatic automatic, PetriPicture **picture, const double **numbers,
                 size_t *count) {
    PetriPictureOptions options = petri_default_picture_options();
    options.automatic = automatic;
    return petri_picture(session, &options, picture) == PETRI_OK &&
           petri_picture_display_list(*picture, numbers, count) == PETRI_OK;
}

// Passes the name of the system and the id of the particle at a point of the last frame's picture to host_entry; x and
// y are 0 at the top left and 1 at the bottom right. Returns false if there is none. `automatic` is true if the picture
// is the automatic one although the script draws. If the script draws nothing, its picture is the automatic one, too.
EXPORT(bool, web_pick, PetriSession *session, bool automatic, double x, double y) {
    Picked *list = calloc(1, sizeof *list);
    PetriPicture *shown = NULL, *plain = NULL;
    const double *plain_numbers = NULL;
    size_t plain_count = 0;
    Found found = NOTHING;
    if (list &&
        show(session, automatic ? PETRI_AUTO_ALWAYS : PETRI_AUTO_IF_NEEDED, &shown, &list->numbers, &list->count) &&
        show(session, PETRI_AUTO_ALWAYS, &plain, &plain_numbers, &plain_count)) {
        bool same =
            list->count == plain_count && memcmp(list->numbers, plain_numbers, plain_count * sizeof(double)) == 0;
        PetriSystem *system = list->systems;
        for (; list->system_count < MAX_SYSTEMS && petri_system(session, list->system_count, system, sizeof *system);
             system++, list->system_count++)
            system->particle_count = system->position.data ? system->particle_count : 0;
        found = find_particle(list, same, x * list->numbers[0], y * list->numbers[1]);
    }
    bool is_found = found.particle != PETRI_NO_PARTICLE;
    if (is_found)
        host_entry(list->systems[found.system].name, NULL, 0,
                   petri_format_value(session, petri_particle_id(session, found.system, found.particle)));
    petri_picture_free(&shown);
    petri_picture_free(&plain);
    if (list)
        free(list->circles);
    free(list);
    return is_found;
}
