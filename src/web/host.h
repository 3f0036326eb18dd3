// host.h: functions that the WebAssembly engine imports from JavaScript. petri.mjs provides them as the import module
// `petri`.
//
// Strings are valid only during the call. 64-bit integers are passed as doubles.
#pragma once

#include "petri.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define HOST(name) __attribute__((import_module("petri"), import_name(#name)))
#define EXPORT(type, name, ...)                                                                                        \
    __attribute__((export_name(#name))) type name(__VA_ARGS__);                                                        \
    type name(__VA_ARGS__)

// Receives a part of the text that the current call produces.
HOST(write) void host_write(const char *text, size_t length);
// Returns true to interrupt the current call. Polled about every 10 µs.
HOST(should_interrupt) bool host_should_interrupt(void);
// Returns the bytes of a file, or NULL if there is no such file. The bytes must stay valid until the session is closed.
HOST(read) const char *host_read(const char *name, size_t *length);
HOST(diagnostic)
void host_diagnostic(int level, const char *file, const char *text, const char *code, const char *hint,
                     const char *rendered, uint32_t line, uint32_t column, uint32_t end_line, uint32_t end_column);
HOST(frame)
void host_frame(double number, double time, double beat, double fps, double tempo, double steps,
                double evaluation_seconds, double physics_seconds);
HOST(parameter)
void host_parameter(const char *name, const char *default_value, const char *value, const char *comment, double number,
                    double default_number, double min, double max, double step, bool defined, bool settable,
                    uint32_t line, uint32_t column);
// Receives a system; host_column then receives its columns. `data` points to the numbers of the first particle;
// `stride` is the number of doubles from one particle to the next.
HOST(system)
void host_system(const char *name, uint32_t dimensions, uint32_t particles, uint32_t forces, double steps);
HOST(column) void host_column(const char *name, const double *data, size_t stride);
// Receives a contribution to the force on a particle. `kind` and `file` are NULL for the particle's own force,
// `partner` is NULL if there is no other particle. Its vector has `dimensions` numbers.
HOST(contribution)
void host_contribution(const char *kind, const char *file, uint32_t line, uint32_t column, const char *partner,
                       const double *vector, uint32_t dimensions);
HOST(entry) void host_entry(const char *key, const double *numbers, uint32_t length, const char *text);
// Receives a picture in the format of petri_picture_display_list.
HOST(picture) void host_picture(const double *numbers, size_t count, const char *title, bool ready);
// Sets the size of the host's screen before a painter draws on it. host_shown is called after the drawing.
HOST(screen) void host_screen(int width, int height);
HOST(shown) void host_shown(const char *title, bool ready);
// Implement PetriCanvasBackend: host_draw draws a canvas into cleared pixels, host_image returns an image.
HOST(draw) bool host_draw(const double *numbers, size_t count, int width, int height, uint32_t *pixels);
// Returns the width of a text, in units of the font size.
HOST(measure)
double host_measure(const char *text, const char *family, double weight, int width, int slant);
HOST(image) const uint32_t *host_image(const char *file, int *width, int *height);
// Fills pixels, in the format of ImageData, with the paint of a filter (PetriPaintCallback).
HOST(paint) void host_paint(const double *commands, size_t count, uint32_t *pixels);
// Receives the contents of an archive, and a version of a file in it.
HOST(archive)
void host_archive(const char *script, const char *command, const char *version, const char *sha256, double first_frame,
                  double last_frame);
HOST(archived_file) void host_archived_file(const char *name, double frame, const char *bytes, size_t length);
// Lets the host of a prompt act: "step"; "goTo" a frame; "set" the parameter `name` to `value`; "run" the script;
// "plot" the expression `name`. Returns the PetriStatus.
HOST(prompt) int host_prompt(const char *act, double frame, const char *name, const char *value);
// Lets the host of a prompt move a particle (petri_history_move_particle). `position` and `velocity` have `dimensions`
// numbers; NULL keeps them. Returns the PetriStatus.
HOST(move)
int host_move(uint32_t system, uint32_t particle, uint32_t dimensions, const double *position, const double *velocity);
// Returns true if a regular expression matches a part of a text.
HOST(matches) bool host_matches(const char *pattern, const char *text);
HOST(token) void host_token(int kind, size_t start, size_t end);
// Receives a row of the help tables.
HOST(help)
void host_help(const char *area, const char *name, const char *parameters, const char *default_value, const char *unit,
               const char *help);

// Exported by engine.c, and called by particle.c.
PetriStatus web_explain(PetriSession *session, size_t system, uint32_t particle);
