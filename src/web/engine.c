// engine.c: petri.h for JavaScript, as functions whose arguments and results are only numbers and strings (host.h).
// Functions of petri.h that already have this form are exported directly (meson.build). Functions with structs or
// callbacks are wrapped here.
#include "cli/link_work.h"
#include "cli/particles.h"
#include "petri-archive.h"
#include "petri-draw.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "web/host.h"

#include <stdio.h>
#include <string.h>

static void on_diagnostic(void *user_data, const PetriDiagnostic *diagnostic) {
    (void)user_data;
    host_diagnostic((int)diagnostic->level, diagnostic->file, diagnostic->text, diagnostic->code, diagnostic->hint,
                    diagnostic->rendered, diagnostic->line, diagnostic->column, diagnostic->end_line,
                    diagnostic->end_column);
}

static const char *read_file(void *user_data, const char *name, size_t *length) {
    (void)user_data;
    return host_read(name, length);
}

static bool write_text(void *user_data, const char *text, size_t length) {
    (void)user_data;
    host_write(text, length);
    return true;
}

static bool should_interrupt(void *user_data) {
    (void)user_data;
    return host_should_interrupt();
}

// Opens a session. `memory` and `stack` are limits in bytes, and `work` is the work limit of each call. A value of 0
// means the default.
// If `archive` is not NULL, the session reads the files of that archive.
EXPORT(PetriSession *, web_open, double fps, double memory, double work, double stack, bool keep_forces,
       PetriArchive *archive) {
    PetriOptions options = petri_default_options();
    options.fps = fps > 0 ? fps : options.fps;
    options.memory_limit = memory > 0 ? (size_t)memory : options.memory_limit;
    options.work_limit = work > 0 ? (uint64_t)work : options.work_limit;
    options.stack_limit = stack > 0 ? (size_t)stack : options.stack_limit;
    options.threads = 1;
    options.keep_forces = keep_forces;
    options.rollback_frames = true;
    options.on_diagnostic = on_diagnostic;
    options.read_file = archive ? petri_archive_read : read_file;
    options.read_user_data = archive;
    options.should_interrupt = should_interrupt;
    return petri_open(&options);
}

EXPORT(void, web_close, PetriSession *session) {
    petri_close(&session);
}

EXPORT(void, web_frame, const PetriSession *session) {
    PetriFrame frame;
    petri_frame(session, &frame, sizeof frame);
    host_frame((double)frame.number, frame.time, frame.beat, frame.fps, frame.tempo, (double)frame.physics_steps,
               frame.evaluation_seconds, frame.physics_seconds);
}

EXPORT(double, web_work, const PetriSession *session) {
    return (double)petri_work(session);
}

// Returns the maximum work to open a link, as in `petri run LINK`.
EXPORT(double, web_link_work_limit, void) {
    return (double)link_work_limit(petri_default_options().work_limit);
}

// Collects short strings and passes them to the host together, because each call of a JavaScript function is slow.
typedef struct TextBuffer {
    size_t used;
    char text[1 << 14];
} TextBuffer;

static void flush_text(TextBuffer *gathered) {
    host_write(gathered->text, gathered->used);
    gathered->used = 0;
}

static bool append_text(void *user_data, const char *text, size_t length) {
    TextBuffer *gathered = user_data;
    if (gathered->used + length > sizeof gathered->text)
        flush_text(gathered);
    if (length > sizeof gathered->text)
        return write_text(NULL, text, length);
    memcpy(gathered->text + gathered->used, text, length);
    gathered->used += length;
    return true;
}

// Writes the particles of the last frame as rows of a table whose vectors have `dimensions` components. If `dimensions`
// is 0, writes a header first and uses as many components as needed. Returns the number of components, or 0 if out of
// memory. If interrupted, clears the interrupt and returns UINT32_MAX.
EXPORT(uint32_t, web_particles, PetriSession *session, uint32_t dimensions) {
    TextBuffer gathered = {.used = 0};
    uint32_t have = dimensions ? dimensions : particles_dimensions(session);
    if (!dimensions)
        particles_header(have, false, append_text, &gathered);
    bool done = particles_rows(session, have, NULL, append_text, &gathered);
    flush_text(&gathered);
    return done ? have : petri_clear_interrupt(session) ? UINT32_MAX : 0;
}

EXPORT(PetriStatus, web_print, PetriSession *session, unsigned sections) {
    return petri_print(session, sections, write_text, NULL);
}

EXPORT(PetriStatus, web_log, PetriSession *session) {
    return petri_print_log(session, write_text, NULL);
}

EXPORT(void, web_parameters, PetriSession *session) {
    PetriParameter p;
    for (size_t i = 0; petri_parameter(session, i, &p, sizeof p); i++)
        host_parameter(p.name, p.default_value, p.value, p.comment, p.number, p.default_number, p.min, p.max, p.step,
                       p.defined, p.settable, p.line, p.column);
}

EXPORT(void, web_systems, PetriSession *session) {
    PetriSystem system;
    for (size_t i = 0; petri_system(session, i, &system, sizeof system); i++) {
        const PetriColumn ids = petri_particle_ids(session, i);
        host_system(system.name, system.dimensions, system.particle_count, system.force_count, (double)system.steps);
        host_column("position", system.position.data, system.position.stride);
        host_column("velocity", system.velocity.data, system.velocity.stride);
        host_column("radius", system.radius.data, system.radius.stride);
        host_column("mass", system.mass.data, system.mass.stride);
        host_column("charge", system.charge.data, system.charge.stride);
        host_column("ids", ids.data, ids.stride);
    }
}

static const char *particle_id(PetriSession *session, size_t system, uint32_t particle) {
    return particle == PETRI_NO_PARTICLE ? NULL
                                         : petri_format_value(session, petri_particle_id(session, system, particle));
}

EXPORT(bool, web_particle_id, PetriSession *session, size_t system, uint32_t particle) {
    PetriSystem info;
    bool exists = petri_system(session, system, &info, sizeof info) && particle < info.particle_count;
    const char *id = exists ? particle_id(session, system, particle) : NULL;
    if (id)
        host_write(id, strlen(id));
    return id;
}

// Explains the force on a particle in the last step of the frame: passes each contribution to host_contribution, then
// the sum to host_entry.
EXPORT(PetriStatus, web_explain, PetriSession *session, size_t system, uint32_t particle) {
    PetriSystem info;
    PetriExplanation found;
    if (!petri_system(session, system, &info, sizeof info) || info.steps == 0)
        return PETRI_INVALID;
    uint32_t dimensions = info.dimensions;
    PetriStatus status = petri_explain_force(session, system, particle, info.steps - 1, &found, sizeof found);
    for (uint32_t c = 0; status == PETRI_OK && c < found.count; c++) {
        PetriForce force = {.kind = NULL};
        if (found.force[c] != PETRI_OWN_FORCE)
            petri_system_force(session, system, found.force[c], &force, sizeof force);
        const char *partner = particle_id(session, system, found.partner[c]);
        host_contribution(force.kind, force.file, force.line, force.column, partner,
                          found.vector + (size_t)c * dimensions, dimensions);
    }
    if (status == PETRI_OK)
        host_entry("sum", found.sum, dimensions, NULL);
    return status;
}

// Passes each entry of the state to host_entry. The argument `text` is NULL if all elements of the value are numbers.
EXPORT(void, web_state, PetriSession *session) {
    PetriValue key, value;
    for (uint32_t at = 0; petri_state_next(session, &at, &key, &value);) {
        char name[256];
        const char *text = petri_format_value(session, key);
        snprintf(name, sizeof name, "%s", text ? text : "");
        host_entry(name, value.numbers, value.length, value.numbers ? NULL : petri_format_value(session, value));
    }
}

EXPORT(PetriStatus, web_set_global, PetriSession *session, const char *name, const double *numbers, uint32_t length) {
    return petri_set_global(session, name, (PetriValue){.length = length, .numbers = numbers});
}

EXPORT(bool, web_symbol_name, const PetriSession *session, double number) {
    const char *name = petri_symbol_name(session, number);
    if (name)
        host_write(name, strlen(name));
    return name;
}

EXPORT(PetriStatus, web_pointer, PetriSession *session, bool inside, double x, double y, unsigned buttons) {
    return petri_report_pointer(
        session, &(PetriPointer){.size = sizeof(PetriPointer), .inside = inside, .x = x, .y = y, .buttons = buttons});
}

EXPORT(PetriStatus, web_prompt, PetriSession *session, const char *text, size_t length) {
    PetriPromptResult done;
    return petri_prompt(session, text, length, write_text, NULL, &done, sizeof done);
}

// Evaluates an expression and writes its value as text. Also passes the value to host_entry as one number, which is NaN
// if the value is not a number.
EXPORT(PetriStatus, web_evaluate, PetriSession *session, const char *text, size_t length) {
    PetriEvaluation result = {.number = __builtin_nan("")};
    PetriStatus status = petri_evaluate(session, text, length, &result, sizeof result, write_text, NULL);
    host_entry("", &result.number, 1, NULL);
    return status;
}

static bool draw_canvas(void *user_data, const double *numbers, size_t count, int width, int height, uint32_t *pixels) {
    (void)user_data;
    return host_draw(numbers, count, width, height, pixels);
}

static const uint32_t *find_image(void *user_data, const char *file, int *width, int *height) {
    (void)user_data;
    return host_image(file, width, height);
}

static double measure_text(void *user_data, const char *text, const char *family, double weight, int width, int slant) {
    (void)user_data;
    return host_measure(text, family, weight, width, slant);
}

// Returns a painter, which also serves the scripts of the session, or NULL if out of memory.
EXPORT(PetriPainter *, web_painter, PetriSession *session) {
    const PetriCanvasBackend host = {
        .size = sizeof host, .draw = draw_canvas, .image = find_image, .measure = measure_text};
    PetriPainter *painter = petri_painter_open();
    if (painter &&
        (petri_painter_use_backend(painter, &host) != PETRI_OK || petri_painter_serve(painter, session) != PETRI_OK))
        petri_painter_close(&painter);
    return painter;
}

// Lets the painter render effects. Returns false if WebGL 2 is not available.
EXPORT(bool, web_painter_use_gl, PetriPainter *painter) {
    return petri_painter_use_gl(painter) == PETRI_OK;
}

EXPORT(void, web_painter_close, PetriPainter *painter, PetriSession *session) {
    petri_painter_serve(NULL, session);
    petri_painter_close(&painter);
}

static PetriStatus send_display_list(PetriPicture *picture, bool ready) {
    const double *numbers;
    size_t count;
    PetriStatus status = petri_picture_display_list(picture, &numbers, &count);
    if (status == PETRI_OK)
        host_picture(numbers, count, petri_picture_title(picture), ready);
    return status;
}

// Renders the picture of the last frame, on which pictures of later frames depend. Returns the picture, so that it can
// be passed to web_picture, or NULL if there is none.
EXPORT(PetriPicture *, web_render_if_needed, PetriSession *session, PetriPainter *painter) {
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture;
    if (petri_picture(session, &options, &picture) == PETRI_OK) {
        petri_picture_render(picture, painter);
        petri_picture_report(session, picture);
    }
    return picture;
}

// Updates the visible region of the automatic picture, which depends on previous frames.
EXPORT(void, web_follow_frame, PetriSession *session) {
    PetriPictureOptions options = petri_default_picture_options();
    petri_picture_follow(session, &options);
}

EXPORT(void, web_picture_free, PetriPicture *picture) {
    petri_picture_free(&picture);
}

static PetriStatus render_picture(PetriSession *session, PetriPainter *painter, PetriPicture *picture, bool ready) {
    int width, height;
    petri_picture_size(picture, &width, &height);
    host_screen(width, height);
    PetriStatus status = petri_painter_present(painter, picture, NULL, 0, 0, 1, width, height);
    petri_picture_report(session, picture);
    if (status == PETRI_OK)
        host_shown(petri_picture_title(picture), ready);
    return status;
}

// Passes the picture of the last frame to the host as a display list, valid during the call. If the picture is not a
// pure display list and there is a painter, draws it on the host's screen instead. `followed` is the result of
// web_render_if_needed, or NULL to create the picture.
EXPORT(PetriStatus, web_picture, PetriSession *session, PetriPainter *painter, PetriPicture *followed, bool automatic) {
    PetriPictureOptions options = petri_default_picture_options();
    options.automatic = automatic ? PETRI_AUTO_ALWAYS : PETRI_AUTO_IF_NEEDED;
    PetriPicture *picture = followed;
    PetriStatus status = picture ? PETRI_OK : petri_picture(session, &options, &picture);
    bool ready = petri_picture_ready(session, &options);
    bool shown = status == PETRI_OK && painter && !petri_picture_is_display_list(picture) &&
                 render_picture(session, painter, picture, ready) == PETRI_OK;
    if (status == PETRI_OK && !shown) // sends the part of the picture that needs no screen
        status = send_display_list(picture, ready);
    if (!followed)
        petri_picture_free(&picture);
    return status;
}

static void add_token(void *user_data, const PetriToken *token) {
    (void)user_data;
    host_token((int)token->kind, token->start, token->end);
}

EXPORT(PetriStatus, web_tokens, PetriSession *session, const char *text, size_t length) {
    return petri_tokenise(session, text, length, add_token, NULL);
}

EXPORT(void, web_help, const PetriSession *session) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++)
        host_help("function", builtin.name, builtin.parameters, "", "", builtin.help);
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        host_help("node", kind.name, kind.area, "", "", kind.help);
        PetriNodeAttribute attribute;
        for (size_t k = 0; petri_node_attribute(i, k, &attribute, sizeof attribute); k++)
            host_help("attribute", attribute.name, attribute.type, attribute.default_value, attribute.unit,
                      attribute.help);
    }
    const char *name;
    for (size_t i = 0; session && (name = petri_visible_name(session, i)); i++)
        host_help("name", name, "", "", "", "");
}

// Converts pixels from the format of ImageData, which is not premultiplied and has red in the lowest byte, to that of
// petri_picture_draw.
EXPORT(void, web_pixels_from_image_data, uint32_t *pixels, size_t count) {
    for (size_t i = 0; i < count; i++) {
        uint32_t p = pixels[i], alpha = p >> 24, out = alpha << 24;
        for (unsigned k = 0; k < 24; k += 8)
            out |= ((p >> k & 255) * alpha + 127) / 255 << (16 - k);
        pixels[i] = out;
    }
}

EXPORT(void, web_pixels_to_image_data, uint32_t *pixels, size_t count) {
    for (size_t i = 0; i < count; i++) {
        uint32_t p = pixels[i], alpha = p >> 24, out = alpha << 24;
        for (unsigned k = 0; k < 24 && alpha; k += 8) {
            uint32_t channel = ((p >> k & 255) * 255 + alpha / 2) / alpha;
            out |= (channel < 255 ? channel : 255) << (16 - k);
        }
        pixels[i] = out;
    }
}

// Fills pixels, in the format of ImageData, with the noise of PETRI_DRAW_NOISE.
EXPORT(PetriStatus, web_noise, const double *operands, const double *matrix, uint32_t *pixels, int width, int height) {
    PetriStatus status = petri_noise_draw(operands, matrix, pixels, width, height);
    web_pixels_to_image_data(pixels, (size_t)width * (size_t)height);
    return status;
}

// Stores the members of PetriFilterNeeds in `out`.
EXPORT(PetriStatus, web_filter_measure, const double *filter, size_t count, const double *matrix, double *out) {
    PetriFilterNeeds needs = {0};
    PetriStatus status = petri_filter_measure(filter, count, matrix, &needs, sizeof needs);
    out[0] = needs.margin;
    out[1] = needs.everywhere;
    return status;
}

static bool fill_paint(void *user_data, const double *commands, size_t count, uint32_t *pixels) {
    size_t *pixel_count = user_data;
    host_paint(commands, count, pixels);
    web_pixels_from_image_data(pixels, *pixel_count);
    return true;
}

// Applies a filter to pixels in the format of ImageData.
EXPORT(PetriStatus, web_filter, const double *filter, size_t count, const double *matrix, uint32_t *pixels, int width,
       int height) {
    size_t pixel_count = (size_t)width * (size_t)height;
    web_pixels_from_image_data(pixels, pixel_count);
    PetriStatus status = petri_filter_draw(filter, count, matrix, pixels, width, height, fill_paint, &pixel_count);
    web_pixels_to_image_data(pixels, pixel_count);
    return status;
}
