// host.h: what the engine in WebAssembly asks of JavaScript: functions that engine.mjs gives it under the name `petri`.
//
// Texts are valid during the call. Numbers that are 64 bits wide go as doubles, which JavaScript has.
#ifndef PETRI_WEB_HOST_H
#define PETRI_WEB_HOST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define HOST(name) __attribute__((import_module("petri"), import_name(#name)))
#define EXPORT(type, name, ...)                                                                                        \
    __attribute__((export_name(#name))) type name(__VA_ARGS__);                                                        \
    type name(__VA_ARGS__)

// A piece of text that was asked for.
HOST(write) void host_write(const char *text, size_t length);
// Whether what is under way is to end: asked every ten microseconds or so.
HOST(should_interrupt) bool host_should_interrupt(void);
// The bytes of a file, which stay where they are; NULL if there is none.
HOST(read) const char *host_read(const char *name, size_t *length);
HOST(diagnostic)
void host_diagnostic(int level, const char *file, const char *text, const char *code, const char *hint,
                     const char *rendered, uint32_t line, uint32_t column, uint32_t end_line, uint32_t end_column);
HOST(frame)
void host_frame(double number, double time, double beat, double fps, double tempo, double steps,
                double evaluation_seconds, double physics_seconds);
HOST(parameter)
void host_parameter(const char *name, const char *fallback, const char *value, const char *comment, double number,
                    double default_number, double least, double most, double step, bool defined, bool settable,
                    uint32_t line, uint32_t column);
// Columns: where the numbers of the first particle are, and how many doubles on those of the next.
HOST(system)
void host_system(const char *name, uint32_t dimensions, uint32_t particles, uint32_t forces, double steps);
HOST(column) void host_column(const char *name, const double *data, size_t stride);
HOST(entry) void host_entry(const char *key, const double *numbers, uint32_t length, const char *text);
// A picture, as petri_picture_display_list has it.
HOST(picture) void host_picture(const double *numbers, size_t count, const char *title, bool ready);
// A painter draws on the host's screen, of that size, from here on, and has done so.
HOST(screen) void host_screen(int width, int height);
HOST(shown) void host_shown(const char *title, bool ready);
// A canvas into cleared pixels, and an image, as PetriCanvasBackend has them.
HOST(draw) bool host_draw(const double *numbers, size_t count, int width, int height, uint32_t *pixels);
HOST(image) const uint32_t *host_image(const char *file, int *width, int *height);
HOST(token) void host_token(int kind, size_t start, size_t end);
// What there is to know for help: a row of a table.
HOST(help)
void host_help(const char *area, const char *name, const char *parameters, const char *fallback, const char *unit,
               const char *help);

#endif
