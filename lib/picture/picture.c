// picture.c: chooses and copies the visible part of the last frame. The copy can be drawn later, also in another thread
// (painter.c).
#include "picture/picture.h"

#include "base/heap.h"
#include "base/host_struct.h"
#include "base/number.h"
#include "maths/maths.h"
#include "picture/automatic_systems.h"
#include "picture/history.h"
#include "picture/render_graph.h"
#include "picture/shader_errors.h"
#include "scene3d/scene_solid.h"
#include "session/draw_access.h"
#include "value/format.h"

#include <math.h>
#include <string.h>

enum { MAX_DIAGNOSTICS = 100 };

void petri_picture_options_init(PetriPictureOptions *options, size_t size) {
    const PetriPictureOptions defaults = {.size = size, .scale = 1, .window = PETRI_FIRST_WINDOW, .detail = 1};
    host_struct_write(options, size, &defaults, sizeof defaults);
}

// Copies the options of a host. Returns false if they are not valid.
static bool copy_options(PetriPictureOptions *options, const PetriPictureOptions *given) {
    petri_picture_options_init(options, sizeof *options);
    return host_struct_read(options, sizeof *options, given) && options->detail > 0 && options->detail <= 1;
}

// The state of a call of petri_picture.
typedef struct Request {
    DrawAccess shown;
    AutoFrame *frames; // views of the systems, kept by the session from picture to picture
    const PetriPictureOptions *options;
    PetriPicture *picture;
    PetriSession *session;
    const char *problem; // why there is no picture; NULL: the reason was already reported
} Request;

static Value attr_value(const Schema *schema, const Node *node, AttrRow row) {
    return node_get(node, schema->slots[row].name);
}

static bool sample_function(void *user_data, void *function, const double (*points)[3], uint32_t count,
                            double *distances) {
    const Request *request = user_data;
    return session_sample_function(request->session, &request->picture->arena, function, points, count, distances);
}

// Copies all windows, because each can show pictures of the others.
static void copy_windows(Request *request, const Node *shown) {
    static _Atomic uint64_t serial;
    PetriPicture *picture = request->picture;
    CanvasPicture *canvases = &picture->picture;
    bool scalable = true;
    Schema *schema = request->shown.schema;
    const Node *window;
    const DrawNode **tops = NULL;
    for (uint32_t at = 0; (window = canvas_next_window(schema, request->shown.tree, &at));) {
        uint32_t count = canvases->top_count++;
        tops = arena_grow(&picture->arena, tops, count * sizeof *tops, (count + 1) * sizeof *tops);
        picture->windows = arena_grow(&picture->arena, picture->windows, count * sizeof *picture->windows,
                                      (count + 1) * sizeof *picture->windows);
        tops[count] = canvas_read(schema, &picture->arena, window);
        scene_sample_functions(&picture->arena, tops[count], sample_function, request);
        scalable = scalable && render_graph_scalable(tops[count]);
        picture->windows[count] = (PictureWindow){.has_picture = canvas_window_has_picture(schema, window),
                                                  .has_size = attr_value(schema, window, ROW_WINDOW_SIZE).len > 0};
        if (window == shown)
            picture->shown = (int)count;
    }
    canvases->tops = tops;
    canvases->needs_history = picture_needs_history(&request->shown);
    canvases->frame = request->shown.number;
    canvases->detail = scalable && !canvases->needs_history ? request->options->detail : 1;
    canvases->serial = ++serial;
}

// Maximum number of frames for which petri_picture_ready waits until each system has been simulated. The wait is
// limited because a system whose clock stands still is never simulated.
enum { MAX_START_FRAMES = 2 };

bool petri_picture_ready(PetriSession *session, const PetriPictureOptions *options) {
    PetriPictureOptions wanted;
    if (!session || !copy_options(&wanted, options))
        return false;
    DrawAccess access = session_draw_access(session);
    const Node *window = picture_find_window(&access, options->window);
    bool own = window && canvas_window_has_picture(access.schema, window) && options->automatic != PETRI_AUTO_ALWAYS;
    SceneView view;
    for (uint32_t i = 0; own && access.number < MAX_START_FRAMES; i++) {
        if (!scene_view(access.scene, access.state, i, &view))
            break;
        if (!view.had_simulated)
            return false;
    }
    return true;
}

static PetriStatus follow_protected(PetriSession *session, void *arena) {
    DrawAccess access = session_draw_access(session);
    auto_follow(&access, arena, session_draw_memory(session, SYSTEMS_MAX * sizeof(AutoFrame)));
    return PETRI_OK;
}

void petri_picture_follow(PetriSession *session, const PetriPictureOptions *options) {
    PetriPictureOptions wanted;
    if (!session || !copy_options(&wanted, options) || wanted.automatic == PETRI_AUTO_NEVER)
        return;
    DrawAccess access = session_draw_access(session);
    const Node *window = picture_find_window(&access, wanted.window);
    if (access.number < 0 ||
        (wanted.automatic != PETRI_AUTO_ALWAYS && window && canvas_window_has_picture(access.schema, window)))
        return;
    Arena arena;
    arena_init(&arena, "picture", access.memory_limit);
    arena.budget = access.budget;
    session_protect(session, &arena, follow_protected, &arena); // if out of memory, the view does not change
    arena_free(&arena);
}

bool petri_needs_history(PetriSession *session) {
    if (!session)
        return false;
    DrawAccess access = session_draw_access(session);
    return picture_needs_history(&access);
}

bool petri_must_render(PetriSession *session) {
    if (!session)
        return false;
    DrawAccess access = session_draw_access(session);
    return picture_shows_history(&access);
}

// Fills request->picture. If there is nothing to draw, stores the reason in request->problem and returns false.
static bool make_picture(Request *request) {
    const DrawAccess *access = &request->shown;
    PetriPicture *picture = request->picture;
    const PetriPictureOptions *options = request->options;
    const Node *window = picture_find_window(access, options->window);
    uint32_t systems = options->automatic == PETRI_AUTO_NEVER ? 0 : auto_count(access);
    bool drawable = window && canvas_window_has_picture(access->schema, window);
    bool automatic = options->automatic == PETRI_AUTO_ALWAYS || (!drawable && systems > 0);
    picture->frame = access->number;
    picture->title = "";
    picture->picture.detail = 1;
    picture->picture.reach = file_access_copy(&picture->arena, access->reach);
    if (options->automatic == PETRI_AUTO_ALWAYS && systems == 0) {
        request->problem = "cannot draw an automatic picture: the frame has no !physics";
        return false;
    }
    if (!window && (!automatic || options->window >= 0)) {
        request->problem = options->window > 0 ? "nothing to draw: the frame has no window with this number or id"
                                               : "nothing to draw: the frame has neither a !window with a "
                                                 "!canvas nor !physics";
        return false;
    }
    picture->shown = -1;
    if (window)
        copy_windows(request, window);
    if (automatic) {
        picture->automatic = auto_copy(access, &picture->arena, request->frames, systems);
        picture->picture.automatic = &picture->automatic;
    }
    request->problem = picture_show_window(picture, picture->shown);
    return !request->problem;
}

static PetriStatus make_protected(PetriSession *session, void *context) {
    Request *request = context;
    request->session = session;
    request->frames = session_draw_memory(session, SYSTEMS_MAX * sizeof *request->frames);
    CanvasPicture *picture = &request->picture->picture;
    picture->name_count =
        session_frame_numbers(session, &request->picture->arena, picture->names, picture->numbers, PICTURE_NAMES);
    if (!make_picture(request))
        return PETRI_INVALID;
    if (request->options->window == PETRI_FIRST_WINDOW && picture->window)
        picture_report_other_windows(request->picture, &request->shown);
    return PETRI_OK;
}

PetriStatus petri_picture(PetriSession *session, const PetriPictureOptions *options, PetriPicture **out) {
    PetriPictureOptions wanted;
    if (!session || !out)
        return PETRI_INVALID;
    *out = NULL;
    if (!copy_options(&wanted, options))
        return PETRI_INVALID;
    DrawAccess access = session_draw_access(session);
    PetriPicture *picture = heap_calloc(1, sizeof *picture);
    if (!picture)
        return session_report_abort(session, PETRI_OUT_OF_MEMORY, "the picture");
    arena_init(&picture->arena, "picture", access.memory_limit);
    picture->arena.budget = access.budget;
    Request request = {.shown = access, .options = &wanted, .picture = picture};
    PetriStatus status = PETRI_INVALID;
    picture->picture.beat = access.beat;
    picture->options = wanted;
    if (access.number >= 0)
        status = session_report_abort(session, session_protect(session, &picture->arena, make_protected, &request),
                                      "the picture");
    else
        request.problem = "nothing to draw: no frame has been computed";
    size_t left = access.budget->memory_limit - access.budget->memory;
    picture->picture.work = access.budget->work_limit;
    picture->picture.session_memory = access.memory_limit;
    picture->picture.memory = left < access.memory_limit ? left : access.memory_limit;
    arena_detach_budget(&picture->arena); // detached because another thread can free the picture
    if (status == PETRI_OK) {
        picture->diags = diag_sink_new(&picture->arena, MAX_DIAGNOSTICS);
        *out = picture;
        return PETRI_OK;
    }
    if (request.problem)
        session_report_text(session, DIAG_ERROR, "cannot-draw", str_from(request.problem));
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
    diag_sink_free(&picture->diags);
    arena_free(&picture->arena);
    heap_free(picture);
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

bool petri_picture_needs_history(const PetriPicture *picture) {
    return picture && picture->picture.needs_history && picture->picture.window;
}

bool petri_picture_lacks_shader(const PetriPicture *picture) {
    for (uint32_t i = 0; picture && i < picture->diags.count; i++) {
        const Diag *diag = &picture->diags.items[i];
        if (diag->level == DIAG_ERROR && diag->code &&
            (strcmp(diag->code, "bad-shader") == 0 || strcmp(diag->code, "drawing-limit") == 0))
            return true;
    }
    return false;
}

// Reports a problem that was found while the picture was drawn. The script may have been unloaded since then.
static void report_diag(PetriSession *session, Diag *diag) {
    if (!session_has_source(session, diag))
        diag->at.source = NULL;
    Diag placed = *diag; // the original recognises the same problem when the picture is drawn again
    Text text = {0};
    if (placed.shader.node)
        picture_place_shader_error(&placed, &text);
    session_report(session, &placed);
    text_free(&text);
}

void petri_picture_report(PetriSession *session, PetriPicture *picture) {
    if (!session || !picture)
        return;
    for (uint32_t i = 0; i < picture->diags.count; i++)
        report_diag(session, &picture->diags.items[i]);
    session_report_dropped(session, &picture->diags);
    session_add_work(session, picture->work);
    picture->work = 0;
}
