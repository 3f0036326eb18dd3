// script.c: see script.h.
#include "cli/script.h"

#include "base/file.h"
#include "base/source.h"
#include "base/str.h"
#include "cli/cli.h"
#include "cli/memory.h"
#include "petri-edit.h"

#include <errno.h>
#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool script_is_stdin(const char *name) {
    return strcmp(name, "-") == 0;
}

const char *script_display_name(const char *name) {
    return script_is_stdin(name) ? SCRIPT_STDIN : name;
}

int script_suffix(const char *name, const char *words) {
    const char *dot = strrchr(name, '.');
    return !dot || dot == name ? -1 : str_word_number(str_from(dot), words);
}

static bool is_picture(const char *name) {
    return script_suffix(name, ".png .svg .pdf .mp4 .m4v .mov .mkv .webm .ogg .gif") >= 0;
}

void script_report_second(const char *first, const char *second) {
    bool swapped = is_picture(first) || strchr(first, '=');
    const char *other = swapped ? first : second;
    if (is_picture(other))
        message("'%s' is not a script; to write it, run: petri render %s -o %s", other, swapped ? second : first,
                other);
    else if (strchr(other, '='))
        message("'%s' is not a script; did you mean '-D %s'?", other, other);
    else
        message("too many scripts: '%s' and '%s'; give only one", first, second);
}

static const char *read_stdin(Text *text, size_t max_bytes) {
    if (isatty(STDIN_FILENO))
        message("reading the script from the terminal; press Ctrl-D to end it");
    if (!text_read(text, STDIN_FILENO, max_bytes))
        return strerror(errno);
    return text->len > max_bytes ? "it is too large" : NULL;
}

bool script_read(Text *text, const char *name, size_t max_bytes) {
    bool is_stdin = script_is_stdin(name);
    const char *problem = is_stdin ? read_stdin(text, max_bytes) : text_read_file(text, name, max_bytes);
    if (problem)
        message("cannot read %s: %s", is_stdin ? "standard input" : name, problem);
    return !problem;
}

typedef PetriStatus LoadFile(PetriSession *session, const char *file);
typedef PetriStatus LoadText(PetriSession *session, const char *name, const char *text, size_t length);

static PetriStatus load_from(PetriSession *session, const char *name, LoadFile *load_file, LoadText *load_text) {
    struct stat about;
    if (!script_is_stdin(name)) {
        PetriStatus status = load_file(session, name);
        if (status == PETRI_INVALID && (stat(name, &about) != 0 || S_ISDIR(about.st_mode)))
            script_suggest(name);
        return status;
    }
    SCOPED_TEXT text = {0};
    return script_read(&text, name, SCRIPT_MAX_BYTES) ? load_text(session, SCRIPT_STDIN, text.bytes, text.len)
                                                      : PETRI_INVALID;
}

PetriStatus script_load(PetriSession *session, const char *name) {
    return load_from(session, name, petri_load, petri_load_text);
}

PetriStatus script_check(PetriSession *session, const char *name) {
    return load_from(session, name, petri_check, petri_check_text);
}

// Returns the files that match a shell pattern, sorted. The caller frees them with globfree.
__attribute__((format(printf, 1, 2))) static glob_t find_files(const char *format, ...) {
    SCOPED_TEXT pattern = {0};
    glob_t found = {0};
    va_list list;
    va_start(list, format);
    text_add_va(&pattern, format, list);
    va_end(list);
    glob(pattern.bytes, 0, NULL, &found);
    return found;
}

static void list_scripts(const char *folder) {
    enum { MAX_SUGGESTIONS = 4 };
    glob_t scripts = find_files("%s%s*.fl", folder, folder[strlen(folder) - 1] == '/' ? "" : "/");
    SCOPED_TEXT list = {0};
    for (size_t i = 0; i < scripts.gl_pathc && i < MAX_SUGGESTIONS; i++)
        text_add_format(&list, "%s%s", i == 0 ? "" : ", ", scripts.gl_pathv[i]);
    if (scripts.gl_pathc > 0)
        message("choose a script in the folder: %s%s", list.bytes, scripts.gl_pathc > MAX_SUGGESTIONS ? " ..." : "");
    globfree(&scripts);
}

// Returns true if `name` is `script` plus a suffix such as `.bak`, or `script` without `.fl`.
static bool differs_in_suffix(const char *name, const char *script) {
    size_t length = strlen(name);
    return strncmp(name, script, strlen(script)) == 0 ||
           (strncmp(name, script, length) == 0 && strcmp(script + length, ".fl") == 0);
}

// Returns the path of the script whose file name is most similar to `name`, or NULL if no name is similar. All paths
// start with the same folder, `folder` bytes long.
static const char *find_nearest(const glob_t *scripts, size_t folder, const char *name) {
    StrNearest nearest = str_nearest(str_from(name));
    const char *found = NULL;
    for (size_t i = 0; i < scripts->gl_pathc; i++) {
        const char *path = scripts->gl_pathv[i];
        if (differs_in_suffix(name, path + folder))
            return path;
        found = nearest_offer(&nearest, path + folder) ? path : found;
    }
    return found;
}

static bool is_file(const char *path) {
    struct stat about;
    return stat(path, &about) == 0 && S_ISREG(about.st_mode);
}

void script_suggest(const char *name) {
    struct stat about;
    size_t folder = path_directory(str_from(name)).len;
    if (stat(name, &about) == 0 || name[folder] == '\0') {
        list_scripts(name);
        return;
    }
    glob_t beside = find_files("%.*s*.fl", (int)folder, name), below = find_files("*/%s", name);
    const char *nearest = find_nearest(&beside, folder, name + folder);
    for (size_t i = 0; !nearest && folder == 0 && i < below.gl_pathc; i++)
        nearest = is_file(below.gl_pathv[i]) ? below.gl_pathv[i] : NULL;
    if (nearest)
        message("did you mean '%s'?", nearest);
    globfree(&beside);
    globfree(&below);
}

void shell_add_word(Text *text, const char *path) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,:@%=-";
    if (path[0] != '\0' && path[strspn(path, plain)] == '\0') {
        text_add_c(text, path);
        return;
    }
    text_add_format(text, "'");
    for (const char *c = path; *c != '\0'; c++)
        text_add_format(text, *c == '\'' ? "'\\''" : "%c", *c);
    text_add_format(text, "'");
}

void shell_add_program(Text *text, const char *called) {
    char *folder = getcwd(NULL, 0);
    size_t length = !folder ? 0 : strlen(folder);
    if (length > 1 && strncmp(called, folder, length) == 0 && called[length] == '/') {
        const char *below = called + length + 1;
        text_add_c(text, !strchr(below, '/') ? "./" : "");
        called = below;
    }
    shell_add_word(text, called);
    free(folder);
}

void hint_pictures(const CommandContext *context, const char *script) {
    SCOPED_TEXT program = {0};
    SCOPED_TEXT operand = {0};
    shell_add_program(&program, context->invoked_as);
    shell_add_word(&operand, script);
    message("to watch the script: %s view %s", program.bytes, operand.bytes);
    message("to save a picture: %s render %s -o OUT.png (or OUT.mp4)", program.bytes, operand.bytes);
}
