// load.c: files to programs: the script, its modules and includes (spec language.md L13, L14).
#include "session/session.h"

#include "syntax/parse.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define MAX_SOURCE_BYTES ((size_t)1 << 30)
#define UNIT_BUDGET ((size_t)4 << 30)
enum { MOST_ERRORS = 50 };

static Unit *unit_new(PetriSession *session) {
    Unit *unit = calloc(1, sizeof *unit);
    if (!unit)
        return NULL;
    arena_init(&unit->arena, "program", UNIT_BUDGET);
    unit->arena.escape = session->frame_arena.escape;
    return unit;
}

void unit_free(Unit *unit) {
    if (unit)
        arena_free(&unit->arena);
    free(unit);
}

// Reads everything; false with a reason.
static bool read_descriptor(Arena *arena, int descriptor, const struct stat *info, Str *text, Str *why) {
    size_t capacity = info->st_size > 0 ? (size_t)info->st_size + 1 : 4096, len = 0;
    char *bytes = arena_alloc(arena, capacity);
    for (;;) {
        if (len == capacity) {
            bytes = arena_grow(arena, bytes, capacity, capacity * 2);
            capacity *= 2;
        }
        ssize_t got = read(descriptor, bytes + len, capacity - len);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0) {
            *why = str_from(strerror(errno));
            return false;
        }
        if (got == 0)
            break;
        len += (size_t)got;
        if (len > MAX_SOURCE_BYTES) {
            *why = STR("larger than 1 GiB");
            return false;
        }
    }
    *text = (Str){bytes, len};
    return true;
}

static Str file_version(Arena *arena, const struct stat *info) {
    return str_format(arena, "%lld.%ld %lld %llu", (long long)info->st_mtim.tv_sec, (long)info->st_mtim.tv_nsec,
                      (long long)info->st_size, (unsigned long long)info->st_ino);
}

// Reads a file of the unit's; fills *version if it is not NULL.
static bool read_file(Arena *arena, const char *file, Str *text, Str *version, Str *why) {
    int descriptor = open(file, O_RDONLY | O_CLOEXEC);
    struct stat info;
    if (descriptor < 0 || fstat(descriptor, &info) != 0) {
        *why = str_from(strerror(errno));
        if (descriptor >= 0)
            close(descriptor);
        return false;
    }
    bool done = false;
    if (S_ISDIR(info.st_mode)) {
        *why = STR("it is a directory");
    } else {
        if (version)
            *version = file_version(arena, &info);
        done = read_descriptor(arena, descriptor, &info, text, why);
    }
    close(descriptor);
    return done;
}

static Str canonical_path(Arena *arena, const char *file) {
    char *resolved = realpath(file, NULL);
    Str path = str_copy(arena, str_from(resolved ? resolved : file));
    free(resolved);
    return path;
}

// True if this is the first %include of the path in the unit.
static bool take_include(Unit *unit, Str path) {
    for (uint32_t i = 0; i < unit->included_count; i++)
        if (str_equal(unit->included[i], path))
            return false;
    size_t size = unit->included_count * sizeof(Str);
    unit->included = arena_grow(&unit->arena, unit->included, size, size + sizeof(Str));
    unit->included[unit->included_count++] = path;
    return true;
}

static const Ast *parse(PetriSession *session, Unit *unit, const Source *source) {
    DiagSink sink = diag_sink_new(&unit->arena, MOST_ERRORS);
    const Ast *ast = parse_program(&unit->arena, &session->symbols, source, &sink);
    session_tell_all(session, &sink);
    diag_sink_free(&sink);
    return ast;
}

static const Ast *host_include(void *host, Str path, const Source **source, Str *why) {
    PetriSession *session = host;
    Unit *unit = session->loading;
    const char *file = str_to_c(&unit->arena, path);
    Str canonical = canonical_path(&unit->arena, file), text;
    if (str_equal(canonical, unit->path) || !take_include(unit, canonical)) {
        *why = STR("this file is included already");
        return NULL;
    }
    if (!read_file(&unit->arena, file, &text, NULL, why))
        return NULL;
    *source = source_new(&unit->arena, path, canonical, text);
    const Ast *ast = parse(session, unit, *source);
    if (!ast) {
        *why = STR("it does not parse");
        return NULL;
    }
    // Pragmas of an included file count for nothing (L12).
    uint32_t skip = 0;
    while (skip < ast->count && ast->children[skip]->kind == AST_PRAGMA)
        skip++;
    return ast_new(&unit->arena, AST_SUITE, ast->span, NULL, ast->children + skip, ast->count - skip);
}

static Value host_evaluate(void *host, const Expr *expr, uint32_t frame_size) {
    PetriSession *session = host;
    return vm_run_static(&session->vm, &session->loading->arena, expr, frame_size);
}

static void compile(PetriSession *session, Unit *unit, bool module) {
    DiagSink sink = diag_sink_new(&unit->arena, MOST_ERRORS);
    CompileOptions options = {.module = module,
                              .defines = session->defines,
                              .define_count = session->define_count,
                              .host = {session, host_include, host_evaluate}};
    Unit *outer = session->loading;
    session->loading = unit;
    unit->program = program_compile(&unit->arena, &session->symbols, unit->source, unit->ast, &options, &sink);
    session->loading = outer;
    session_tell_all(session, &sink);
    diag_sink_free(&sink);
}

static void load_text(PetriSession *session, Unit *unit, Str name, Str text, bool module) {
    unit->source = source_new(&unit->arena, name, unit->path, text);
    unit->ast = parse(session, unit, unit->source);
    if (unit->ast)
        compile(session, unit, module);
    else
        unit->why = STR("it does not parse");
}

Unit *unit_load_text(PetriSession *session, Str name, Str text) {
    Unit *unit = unit_new(session);
    if (unit) {
        unit->path = name;
        load_text(session, unit, name, text, false);
    }
    return unit;
}

Unit *unit_load_file(PetriSession *session, const char *file, bool module) {
    Unit *unit = unit_new(session);
    if (!unit)
        return NULL;
    if (module) { // on the list at once: an escape while loading must not lose it
        unit->next = session->modules;
        session->modules = unit;
    }
    Str text;
    unit->path = canonical_path(&unit->arena, file);
    if (read_file(&unit->arena, file, &text, &unit->version, &unit->why))
        load_text(session, unit, str_from(file), text, module);
    return unit;
}

// The cached module at a canonical path, if its file has not changed since.
static Unit *cached_module(PetriSession *session, Str path, const struct stat *info) {
    for (Unit *unit = session->modules; unit; unit = unit->next) {
        if (unit->retired || !str_equal(unit->path, path))
            continue;
        if (str_equal(unit->version, file_version(&session->frame_arena, info)))
            return unit;
        unit->retired = true;
    }
    return NULL;
}

const Program *session_module(void *host, Str path, Str *why) {
    PetriSession *session = host;
    const char *file = str_to_c(&session->frame_arena, path);
    struct stat info;
    if (stat(file, &info) != 0) {
        *why = str_from(strerror(errno));
        return NULL;
    }
    Unit *unit = cached_module(session, canonical_path(&session->frame_arena, file), &info);
    if (!unit)
        unit = unit_load_file(session, file, true);
    if (!unit) {
        *why = STR("out of memory");
        return NULL;
    }
    *why = unit->why;
    return unit->program;
}

void session_free_retired(PetriSession *session) {
    for (Unit **link = &session->modules; *link;) {
        Unit *unit = *link;
        unit->arena.escape = NULL;
        if (!unit->retired) {
            link = &unit->next;
            continue;
        }
        *link = unit->next;
        unit_free(unit);
    }
}
