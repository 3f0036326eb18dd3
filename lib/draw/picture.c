// picture.c: what the last frame shows, chosen and copied so that it can be drawn later and elsewhere (painter.c).
#include "draw/picture.h"

#include "base/heap.h"
#include "base/number.h"
#include "draw/pictures.h"
#include "maths/maths.h"
#include "session/shown.h"
#include "value/format.h"

#include <math.h>
#include <string.h>

enum { USUAL_SIZE = 512, AUTO_SIDE = 1080, MOST_FAULTS = 100 };
enum { MOST_AUTO_SYSTEMS = 64 }; // in one automatic picture

void petri_picture_options_init(PetriPictureOptions *options, size_t size) {
    const PetriPictureOptions usual = {.size = size, .scale = 1, .window = -1};
    memcpy(options, &usual, size < sizeof usual ? size : sizeof usual);
}

// The options of a host, who may have been compiled with an earlier petri-draw.h, whose struct was shorter. False if
// they were not initialised, or are those of a later one.
static bool take_options(PetriPictureOptions *options, const PetriPictureOptions *given) {
    size_t least = offsetof(PetriPictureOptions, automatic) + sizeof options->automatic;
    if (!given || given->size < least || given->size > sizeof *options)
        return false;
    petri_picture_options_init(options, sizeof *options);
    memcpy(options, given, given->size);
    return true;
}

// What petri_picture is working on.
typedef struct Request {
    Shown shown;
    AutoFrame *frames; // what the automatic picture showed last of each system
    const PetriPictureOptions *options;
    PetriPicture *picture;
    const char *problem; // why there is no picture; may be NULL
    PetriStatus status;
} Request;

// The window of that number; of none in particular, the first with something to draw, one that is on the screen before
// one that is not, or else the first.
static const Node *find_window(const Shown *shown, int number) {
    const Node *first = NULL, *offscreen = NULL, *window;
    for (uint32_t at = 0; (window = canvas_next_window(shown->schema, shown->tree, &at)) != NULL;) {
        bool on_screen = schema_window_kind(shown->schema, window) == KIND_WINDOW;
        if (number >= 0 ? number-- == 0 : on_screen && canvas_in_window(shown->schema, window))
            return window;
        if (number < 0 && !offscreen && !on_screen && canvas_in_window(shown->schema, window))
            offscreen = window;
        first = first || number >= 0 ? first : window;
    }
    return offscreen ? offscreen : first;
}

// At most three of a vector's numbers; the missing ones are 0.
static void take_three(double out[3], const double *v, uint32_t n) {
    for (uint32_t k = 0; k < 3; k++)
        out[k] = v && k < n ? v[k] : 0;
}

// Takes the particles that are somewhere; `numbers` tells where each has gone.
static void copy_bodies(Arena *arena, const SceneView *view, AutoSystem *system, uint32_t *numbers) {
    PhysColumns columns = phys_columns(view->engine);
    double most = 0;
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
        body->shade = isfinite(charge) ? charge : 0;
        most = fmax(most, fabs(body->shade));
    }
    system->charged = most > 0;
    for (uint32_t i = 0; i < system->body_count && most > 0; i++)
        system->bodies[i].shade /= most;
}

// Without charges the shade is the speed: half way up where the frame would be crossed in two seconds.
static void shade_by_speed(const SceneView *view, AutoSystem *system, const uint32_t *numbers) {
    PhysColumns columns = phys_columns(view->engine);
    for (uint32_t i = 0; i < view->particle_count; i++) {
        double v[3];
        if (numbers[i] == UINT32_MAX)
            continue;
        take_three(v, phys_at_particle(columns.velocity, i), view->dimensions);
        double speed = maths_hypot(maths_hypot(v[0], v[1]), v[2]);
        system->bodies[numbers[i]].shade = isfinite(speed) ? speed / (speed + system->frame.half) : 1;
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
        if (force.kind == PHYS_DISTANCE && force.from < view->particle_count && force.to < view->particle_count &&
            numbers[force.from] != UINT32_MAX && numbers[force.to] != UINT32_MAX) {
            system->links[system->link_count++] = (AutoLink){numbers[force.from], numbers[force.to]};
        } else if (force.kind == PHYS_BARRIER && (!force.vector || numbers_finite(force.vector, n, 1)) &&
                   force.vector2 && numbers_finite(force.vector2, n, 1)) {
            AutoBarrier *barrier = &system->barriers[system->barrier_count++];
            take_three(barrier->position, force.vector, n);
            take_three(barrier->normal, force.vector2, n);
        }
    }
}

static void copy_system(const Shown *shown, Arena *arena, const SceneView *view, AutoFrame *frame, AutoSystem *system) {
    uint32_t *numbers = arena_alloc_array(arena, view->particle_count, sizeof *numbers);
    *system = (AutoSystem){.name = value_text(arena, shown->schema->symbols, view->prefix),
                           .dimensions = view->dimensions > 3 ? 3 : view->dimensions};
    copy_bodies(arena, view, system, numbers);
    copy_forces(arena, view, system, numbers);
    auto_frame(arena, frame, system);
    system->frame = *frame;
    if (!system->charged)
        shade_by_speed(view, system, numbers);
}

static uint32_t count_systems(const Shown *shown) {
    SceneView view;
    uint32_t count = 0;
    while (count < MOST_AUTO_SYSTEMS && scene_view(shown->scene, shown->state, count, &view))
        count++;
    return count;
}

static void copy_systems(const Request *request, uint32_t count) {
    const Shown *shown = &request->shown;
    PetriPicture *picture = request->picture;
    AutoSystem *systems = arena_alloc_array(&picture->arena, count, sizeof *systems);
    for (uint32_t i = 0; i < count; i++) {
        SceneView view;
        if (scene_view(shown->scene, shown->state, i, &view))
            copy_system(shown, &picture->arena, &view, &request->frames[i], &systems[i]);
    }
    picture->automatic = (AutoPicture){systems, count};
    picture->picture.automatic = &picture->automatic;
}

static Value attr_value(const Schema *schema, const Node *node, AttrRow row) {
    return node_get(node, schema->slots[row].name);
}

static bool has_word(Str text, Str word) {
    for (size_t i = 0; i + word.len <= text.len; i++)
        if (str_equal((Str){text.bytes + i, word.len}, word))
            return true;
    return false;
}

// Whether a program names the frame before.
static bool names_last(const Schema *schema, const Node *node) {
    Value v = attr_value(schema, node, ROW_SHADER_FRAGMENT);
    for (uint32_t i = 0; v.kind == VALUE_MIXED && i < v.len; i++)
        if (v.as.items[i].type == ITEM_STRING && has_word(v.as.items[i].as.string->text, STR("last")))
            return true;
    return false;
}

// Whether something in a canvas shows the picture of another node.
static bool shows_others(const Schema *schema, const Node *node, int depth, uint32_t *left) {
    enum { DEEPEST = 1000 };
    if (*left == 0 || ((node->kind == schema->kinds[KIND_IMAGE] || node->kind == schema->kinds[KIND_PATTERN]) &&
                       (attr_value(schema, node, ROW_IMAGE_IMAGE_ID).len > 0 ||
                        attr_value(schema, node, ROW_IMAGE_TEXTURE_ID).len > 0)))
        return true;
    --*left;
    for (uint32_t i = 0; i < node->child_count && depth < DEEPEST; i++)
        if (shows_others(schema, node->children[i], depth + 1, left))
            return true;
    return false;
}

static bool looks_back(const Schema *schema, const Node *node, NodeKind kind, int depth, uint32_t *left) {
    enum { DEEPEST = 100 };
    if (*left == 0 || kind == KIND_FEEDBACK || kind == KIND_REFERENCE || names_last(schema, node) ||
        (kind == KIND_RECORD && attr_value(schema, node, ROW_RECORD_FILENAME).len > 0))
        return true;
    --*left;
    for (uint32_t i = 0; i < node->child_count && depth < DEEPEST; i++) {
        const Node *child = node->children[i];
        NodeKind inside = schema_kind_in(schema, child, PLACE_PICTURES);
        if (inside == KIND_CANVAS ? shows_others(schema, child, 0, left)
                                  : inside < KIND_COUNT && looks_back(schema, child, inside, depth + 1, left))
            return true;
    }
    return false;
}

static bool any_looks_back(const Shown *shown) {
    uint32_t left = CANVAS_LOOK;
    const Node *window;
    for (uint32_t at = 0; (window = canvas_next_window(shown->schema, shown->tree, &at)) != NULL;)
        if (looks_back(shown->schema, window, KIND_WINDOW, 0, &left))
            return true;
    return false;
}

// Copies all windows: each may show pictures of the others.
static void take_windows(Request *request, const Node *shown) {
    static _Atomic uint64_t serial;
    PetriPicture *picture = request->picture;
    CanvasPicture *canvases = &picture->picture;
    const Node *window;
    const DrawNode **tops = NULL;
    for (uint32_t at = 0; (window = canvas_next_window(request->shown.schema, request->shown.tree, &at)) != NULL;) {
        uint32_t count = canvases->top_count++;
        tops = arena_grow(&picture->arena, tops, count * sizeof *tops, (count + 1) * sizeof *tops);
        tops[count] = canvas_read(request->shown.schema, &picture->arena, window);
        if (window == shown)
            canvases->window = tops[count];
    }
    const AttrValue *title = canvases->window->kind == KIND_WINDOW ? draw_attr(canvases->window, ATTR_TITLE) : NULL;
    picture->title = title ? title->as.text.bytes : "";
    canvases->tops = tops;
    canvases->opaque = canvases->window->kind == KIND_WINDOW;
    canvases->looks_back = any_looks_back(&request->shown);
    canvases->serial = ++serial;
}

// The size in the script's units: what the window says, else the usual one. False if that makes no sense.
static bool choose_size(CanvasPicture *picture, const Node *node, const Symbol *name) {
    const DrawNode *window = picture->window;
    picture->width = picture->height = window ? USUAL_SIZE : AUTO_SIDE;
    double size[2];
    if (!window)
        return true;
    if (!draw_pair(window, ATTR_SIZE, size))
        return node_get(node, name).len == 0;
    picture->width = floor(size[0]);
    picture->height = floor(size[1]);
    return true;
}

static void report_size(Request *request, double width, double height) {
    Arena *arena = &request->picture->arena;
    request->problem =
        str_to_c(arena, str_format(arena, "a picture can have 1 to %d pixels in width and height, not %.10g x %.10g",
                                   PETRI_MOST_PIXELS, width, height));
}

static bool choose_pixels(Request *request) {
    PetriPicture *picture = request->picture;
    const PetriPictureOptions *options = request->options;
    double width = options->width, height = options->height;
    if (!picture_is_good_size(picture->picture.width, picture->picture.height)) {
        report_size(request, picture->picture.width, picture->picture.height);
        return false;
    }
    if (width == 0 && height == 0) {
        width = floor(picture->picture.width * options->scale + 0.5);
        height = floor(picture->picture.height * options->scale + 0.5);
    }
    if (!picture_is_good_size(width, height)) {
        report_size(request, width, height);
        return false;
    }
    picture->width = (int)width;
    picture->height = (int)height;
    return true;
}

// A system whose time stands still never stores anything: it is not waited for.
enum { LONGEST_START = 2 };

bool petri_picture_ready(PetriSession *session, const PetriPictureOptions *options) {
    PetriPictureOptions wanted;
    if (!session || !take_options(&wanted, options))
        return false;
    Shown shown = session_shown(session);
    const Node *window = find_window(&shown, options->window);
    bool own = window && canvas_in_window(shown.schema, window) && options->automatic != PETRI_AUTO_ALWAYS;
    SceneView view;
    for (uint32_t i = 0; own && shown.number < LONGEST_START; i++) {
        if (!scene_view(shown.scene, shown.state, i, &view))
            break;
        if (!view.began)
            return false;
    }
    return true;
}

bool petri_looks_back(PetriSession *session) {
    if (!session)
        return false;
    Shown shown = session_shown(session);
    return any_looks_back(&shown);
}

// Fills the picture; false if there is none, with the problem if it is not told already.
static bool make_picture(Request *request) {
    const Shown *shown = &request->shown;
    PetriPicture *picture = request->picture;
    const PetriPictureOptions *options = request->options;
    const Node *window = find_window(shown, options->window);
    uint32_t systems = options->automatic == PETRI_AUTO_NEVER ? 0 : count_systems(shown);
    bool drawable = window && canvas_in_window(shown->schema, window);
    bool automatic = options->automatic == PETRI_AUTO_ALWAYS || (!drawable && systems > 0);
    picture->frame = shown->number;
    picture->title = "";
    picture->picture.reach = reach_copy(&picture->arena, shown->reach);
    if (options->automatic == PETRI_AUTO_ALWAYS && systems == 0) {
        request->problem = "there is nothing to draw by itself: the frame has no !physics";
        return false;
    }
    if (!window && (!automatic || options->window >= 0)) {
        request->problem = options->window > 0 ? "there is nothing to draw: the frame has no window of this number"
                                               : "there is nothing to draw: the frame has neither a !window with a "
                                                 "!canvas nor !physics";
        return false;
    }
    if (window)
        take_windows(request, window);
    if (!choose_size(&picture->picture, window, shown->schema->slots[ROW_WINDOW_SIZE].name)) {
        request->problem = "the size of the window makes no sense";
        return false;
    }
    if (automatic) {
        copy_systems(request, systems);
        picture->picture.window = NULL;
        picture->picture.opaque = true;
    }
    if (!choose_pixels(request))
        return false;
    if (picture->picture.window)
        picture->picture.direct =
            pictures_direct(picture->picture.window, (int)picture->picture.width, (int)picture->picture.height);
    return true;
}

static void make_protected(PetriSession *session, void *context) {
    Request *request = context;
    request->frames = session_drawing(session, MOST_AUTO_SYSTEMS * sizeof *request->frames);
    CanvasPicture *picture = &request->picture->picture;
    picture->name_count =
        session_numbers(session, &request->picture->arena, picture->names, picture->numbers, PICTURE_NAMES);
    request->status = make_picture(request) ? PETRI_OK : PETRI_INVALID;
}

PetriStatus petri_picture(PetriSession *session, const PetriPictureOptions *options, PetriPicture **out) {
    PetriPictureOptions wanted;
    if (!session || !out)
        return PETRI_INVALID;
    *out = NULL;
    if (!take_options(&wanted, options))
        return PETRI_INVALID;
    Shown shown = session_shown(session);
    PetriPicture *picture = heap_zeroed(1, sizeof *picture);
    if (!picture)
        return session_tell_end(session, PETRI_MEMORY, "the picture");
    arena_init(&picture->arena, "picture", shown.memory_bytes);
    picture->arena.meter = shown.meter;
    Request request = {.shown = shown, .options = &wanted, .picture = picture, .status = PETRI_INVALID};
    PetriStatus status = PETRI_OK;
    picture->picture.beat = petri_frame(session).beat;
    if (shown.number >= 0)
        status = session_tell_end(session, session_protect(session, &picture->arena, make_protected, &request),
                                  "the picture");
    else
        request.problem = "there is nothing to draw: no frame has been made yet";
    size_t left = shown.meter->memory_limit - shown.meter->memory;
    picture->picture.work = shown.meter->work_limit;
    picture->picture.memory = left < shown.memory_bytes ? left : shown.memory_bytes;
    arena_release(&picture->arena); // the picture may be freed in another thread
    if (status == PETRI_OK)
        status = request.status;
    if (status == PETRI_OK) {
        picture->faults = diag_sink_new(&picture->arena, MOST_FAULTS);
        *out = picture;
        return PETRI_OK;
    }
    if (request.problem)
        session_tell_text(session, DIAG_ERROR, "cannot-draw", str_from(request.problem));
    petri_picture_free(&picture);
    return status;
}

void petri_picture_free(PetriPicture **handle) {
    if (!handle)
        return;
    PetriPicture *picture = *handle;
    *handle = NULL;
    if (!picture)
        return;
    diag_sink_free(&picture->faults);
    arena_free(&picture->arena);
    heap_give(picture);
}

void petri_picture_size(const PetriPicture *picture, int *width, int *height) {
    if (!picture || !width || !height)
        return;
    *width = picture->width;
    *height = picture->height;
}

const char *petri_picture_title(const PetriPicture *picture) {
    return picture ? picture->title : "";
}

int64_t petri_picture_frame(const PetriPicture *picture) {
    return picture ? picture->frame : -1;
}

bool petri_picture_looks_back(const PetriPicture *picture) {
    return picture && picture->picture.looks_back && picture->picture.window != NULL;
}

void petri_picture_tell(PetriSession *session, PetriPicture *picture) {
    if (!session || !picture)
        return;
    for (uint32_t i = 0; i < picture->faults.count; i++)
        if (!session_has(session, &picture->faults.items[i]))
            picture->faults.items[i].source = NULL;
    session_tell_all(session, &picture->faults);
}
