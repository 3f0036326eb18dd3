// world.h: helpers that run a script from a string and read its printed state, with petri.h only.
#pragma once

#include "groups.h"
#include "last_frame.h"
#include "petri-inspect.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))

// First lines of a system with the prefix `:s`.
#define P1 "!physics state=:s dimensions=1\n"
#define P2 "!physics state=:s dimensions=2\n"
#define P3 "!physics state=:s dimensions=3\n"
#define P5 "!physics state=:s dimensions=5\n"

enum { WORLD_MAX_REPORTED = 32, WORLD_MAX_NUMBERS = 64 };

typedef struct Reported {
    PetriLevel level;
    char code[32];
    char text[256];
} Reported;

typedef struct World {
    PetriSession *session;
    char *text; // printed state; NULL: not printed since the last step
    size_t len;
    Reported reported[WORLD_MAX_REPORTED];
    int reported_count; // number of diagnostics; those beyond WORLD_MAX_REPORTED are counted but not stored
} World;

static inline void world_on_diagnostic(void *user_data, const PetriDiagnostic *diagnostic) {
    World *world = user_data;
    if (world->reported_count < WORLD_MAX_REPORTED) {
        Reported *reported = &world->reported[world->reported_count];
        reported->level = diagnostic->level;
        snprintf(reported->code, sizeof reported->code, "%s", diagnostic->code ? diagnostic->code : "-");
        snprintf(reported->text, sizeof reported->text, "%s", diagnostic->text);
    }
    world->reported_count++;
}

// Opens a session with `options` and loads a script. The struct must not be moved or copied afterwards.
static inline void world_open_with(World *world, PetriOptions options, const char *script) {
    *world = (World){0};
    options.on_diagnostic = world_on_diagnostic;
    options.user_data = world;
    world->session = petri_open(&options);
    assert_non_null(world->session);
    if (petri_load_text(world->session, "world.fl", script, PETRI_NUL_TERMINATED) != PETRI_OK) {
        print_error("%s\n%s\n", script, world->reported_count ? world->reported[0].text : "?");
        fail_msg("the script cannot be loaded");
    }
}

static inline void world_open(World *world, double fps, const char *script) {
    PetriOptions options = petri_default_options();
    options.fps = fps;
    world_open_with(world, options, script);
}

static inline void world_close(World *world) {
    petri_close(&world->session);
    free(world->text);
    world->text = NULL;
}

// Returns a formatted string. The caller frees it.
__attribute__((format(printf, 1, 2))) static inline char *text_of(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    int len = vsnprintf(NULL, 0, format, arguments);
    va_end(arguments);
    char *text = malloc((size_t)len + 1);
    assert_non_null(text);
    va_start(arguments, format);
    vsnprintf(text, (size_t)len + 1, format, arguments);
    va_end(arguments);
    return text;
}

// Steps until the frame number equals `frame`.
static inline void world_to(World *world, int64_t frame) {
    while (petri_frame_number(world->session) < frame)
        assert_int_equal(petri_step(world->session), PETRI_OK);
    free(world->text);
    world->text = NULL;
}

static inline bool world_append_text(void *user_data, const char *text, size_t len) {
    World *world = user_data;
    char *grown = realloc(world->text, world->len + len + 1);
    if (!grown)
        return false;
    memcpy(grown + world->len, text, len);
    world->text = grown;
    world->len += len;
    grown[world->len] = 0;
    return true;
}

// Returns the frame's header and the state. The state begins after the first newline.
static inline const char *world_text(World *world) {
    if (!world->text) {
        world->len = 0;
        assert_int_equal(petri_print(world->session, PETRI_PRINT_STATE, world_append_text, world), PETRI_OK);
    }
    return world->text;
}

static inline const char *world_state(World *world) {
    return strchr(world_text(world), '\n') + 1;
}

// Returns the printed value of a key such as ":s;:a;:velocity", or NULL if the state does not have it.
static inline const char *world_find(World *world, const char *key) {
    char line[160];
    for (int several = 0; several < 2; several++) {
        snprintf(line, sizeof line, several ? "\n$(%s) = " : "\n$%s = ", key);
        const char *found = strstr(world_text(world), line);
        if (found)
            return found + strlen(line);
    }
    return NULL;
}

// Reads the numbers at the start of a string such as "1;-2.5". Returns their count. Sets *end to the text after them,
// unless `end` is NULL.
static inline int read_numbers(const char *text, double *numbers, const char **end) {
    int count = 0;
    char *next = (char *)text;
    do {
        const char *start = next + (count > 0);
        assert_true(count < WORLD_MAX_NUMBERS);
        numbers[count] = strtod(start, &next);
        assert_true(next > start);
        count++;
    } while (*next == ';');
    if (end)
        *end = next;
    return count;
}

// Reads the numbers of a key. Returns their count, or -1 if the key does not exist.
static inline int world_numbers(World *world, const char *key, double *numbers) {
    const char *value = world_find(world, key);
    return value ? read_numbers(value, numbers, NULL) : -1;
}

static inline double world_number(World *world, const char *key) {
    double numbers[WORLD_MAX_NUMBERS];
    int count = world_numbers(world, key, numbers);
    if (count != 1)
        fail_msg("%s: %d numbers, wanted one\n%s", key, count, world_state(world));
    return numbers[0];
}

// Returns the number of diagnostics with this code.
static inline int world_count_reported(const World *world, const char *code) {
    int count = 0;
    for (int i = 0; i < world->reported_count && i < WORLD_MAX_REPORTED; i++)
        count += strcmp(world->reported[i].code, code) == 0;
    return count;
}

static inline void world_print_reported(const World *world) {
    for (int i = 0; i < world->reported_count && i < WORLD_MAX_REPORTED; i++)
        print_error("  reported: [%s] %s\n", world->reported[i].code, world->reported[i].text);
}

// Checks that the numbers of a key are equal to the wanted ones, or within a tolerance. NaN never matches.
static inline void check_numbers(World *world, const char *key, double tolerance, int count, const double *wanted,
                                 const char *file, int line) {
    double found[WORLD_MAX_NUMBERS];
    int n = world_numbers(world, key, found);
    bool same = n == count;
    for (int i = 0; same && i < count; i++)
        same = found[i] == wanted[i] || fabs(found[i] - wanted[i]) <= tolerance;
    if (same)
        return;
    print_error("%s:%d: %s\n found: ", file, line, key);
    for (int i = 0; i < n; i++)
        print_error(" %.17g", found[i]);
    print_error("%s\n wanted:", n < 0 ? " nothing" : "");
    for (int i = 0; i < count; i++)
        print_error(" %.17g", wanted[i]);
    print_error("\n");
    world_print_reported(world);
    _fail(file, line);
}

#define NUMBERS(...)                                                                                                   \
    (int)(sizeof((double[]){__VA_ARGS__}) / sizeof(double)), (double[]) {                                              \
        __VA_ARGS__                                                                                                    \
    }
// Checks that `key` has these numbers, either exactly (zeros of either sign are equal) or within a tolerance.
#define EXPECT(world, key, ...) check_numbers(world, key, 0, NUMBERS(__VA_ARGS__), __FILE__, __LINE__)
#define EXPECT_NEAR(world, key, tolerance, ...)                                                                        \
    check_numbers(world, key, tolerance, NUMBERS(__VA_ARGS__), __FILE__, __LINE__)
#define EXPECT_ABSENT(world, key) assert_null(world_find(world, key))

static inline void check_near(double found, double wanted, double tolerance, const char *file, int line) {
    if (found == wanted || fabs(found - wanted) <= tolerance)
        return;
    print_error("found %.17g, wanted %.17g within %g\n", found, wanted, tolerance);
    _fail(file, line);
}

#define NEAR(found, wanted, tolerance) check_near(found, wanted, tolerance, __FILE__, __LINE__)

// Checks that exactly these diagnostics were reported, in any order: "bad-attribute bad-attribute", or "" for none.
static inline void check_reported(const World *world, const char *codes, const char *title, const char *file,
                                  int line) {
    int wanted = 0;
    bool all = true;
    for (const char *at = codes; *at; at += strspn(at, " ")) {
        size_t len = strcspn(at, " ");
        char code[32];
        int same = 0;
        snprintf(code, sizeof code, "%.*s", (int)len, at);
        for (const char *other = codes; *other; other += strcspn(other, " "), other += strspn(other, " "))
            same += strcspn(other, " ") == len && strncmp(other, code, len) == 0;
        all = all && world_count_reported(world, code) == same;
        wanted++;
        at += len;
    }
    if (all && world->reported_count == wanted)
        return;
    print_error("%s: wanted the diagnostics \"%s\"\n", title, codes);
    world_print_reported(world);
    _fail(file, line);
}

#define EXPECT_REPORTED(world, codes) check_reported(world, codes, "", __FILE__, __LINE__)
