// script.c: see script.h.
#include "cli/script.h"

#include <errno.h>
#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/source.h"
#include "base/str.h"
#include "cli/bytes.h"
#include "cli/cli.h"

// As much as the library takes of a file.
static const size_t MOST_BYTES = (size_t)256 << 20;

bool script_is_stdin(const char *name) {
    return strcmp(name, "-") == 0;
}

const char *script_shown(const char *name) {
    return script_is_stdin(name) ? SCRIPT_STDIN : name;
}

int script_suffix(const char *name, const char *words) {
    const char *dot = strrchr(name, '.');
    return dot == NULL || dot == name ? -1 : str_word_number(str_from(dot), words);
}

static bool is_picture(const char *name) {
    return script_suffix(name, ".png .svg .pdf .mp4 .webm .gif") >= 0;
}

void script_second(const char *first, const char *second) {
    bool swapped = is_picture(first) || strchr(first, '=') != NULL;
    const char *other = swapped ? first : second;
    if (is_picture(other)) {
        message("'%s' is no script; to write it: petri render %s -o %s", other, swapped ? second : first, other);
    } else if (strchr(other, '=') != NULL) {
        message("'%s' is no script, did you mean '-D %s'?", other, other);
    } else {
        message("one script at a time: '%s' and '%s' were given", first, second);
    }
}

static bool read_stdin(Bytes *text) {
    if (isatty(STDIN_FILENO)) {
        message("reading the script from the terminal; Ctrl-D ends it");
    }
    bool read = bytes_read(text, STDIN_FILENO, MOST_BYTES);
    if (!read || text->length > MOST_BYTES) {
        message("cannot read standard input: %s", read ? "it is too large" : strerror(errno));
    }
    return read && text->length <= MOST_BYTES;
}

typedef PetriStatus TakeFile(PetriSession *session, const char *file);
typedef PetriStatus TakeText(PetriSession *session, const char *name, const char *text, size_t length);

static PetriStatus take(PetriSession *session, const char *name, TakeFile *take_file, TakeText *take_text) {
    struct stat about;
    if (!script_is_stdin(name)) {
        PetriStatus status = take_file(session, name);
        if (status == PETRI_INVALID && (stat(name, &about) != 0 || S_ISDIR(about.st_mode))) {
            script_suggest(name);
        }
        return status;
    }
    SCOPED_BYTES text = {0};
    bytes_add(&text, "", 0);
    PetriStatus status = read_stdin(&text) ? take_text(session, SCRIPT_STDIN, text.data, text.length) : PETRI_INVALID;
    return status;
}

PetriStatus script_load(PetriSession *session, const char *name) {
    return take(session, name, petri_load, petri_load_text);
}

PetriStatus script_check(PetriSession *session, const char *name) {
    return take(session, name, petri_check, petri_check_text);
}

// What a pattern of the shell stands for, sorted; to be freed by globfree.
__attribute__((format(printf, 1, 2))) static glob_t find_files(const char *format, ...) {
    SCOPED_BYTES pattern = {0};
    glob_t found = {0};
    va_list list;
    va_start(list, format);
    bytes_format_list(&pattern, format, list);
    va_end(list);
    glob(pattern.data, 0, NULL, &found);
    return found;
}

static void list_scripts(const char *folder) {
    enum { MOST = 4 };
    glob_t scripts = find_files("%s%s*.fl", folder, folder[strlen(folder) - 1] == '/' ? "" : "/");
    SCOPED_BYTES list = {0};
    for (size_t i = 0; i < scripts.gl_pathc && i < MOST; i++) {
        bytes_format(&list, "%s%s", i == 0 ? "" : ", ", scripts.gl_pathv[i]);
    }
    if (scripts.gl_pathc > 0) {
        message("name a script in it: %s%s", list.data, scripts.gl_pathc > MOST ? " ..." : "");
    }
    globfree(&scripts);
}

// Whether `name` is what is left of `script` without a suffix such as `.bak`, or what it becomes with `.fl`.
static bool differs_in_suffix(const char *name, const char *script) {
    size_t length = strlen(name);
    return strncmp(name, script, strlen(script)) == 0 ||
           (strncmp(name, script, length) == 0 && strcmp(script + length, ".fl") == 0);
}

// The script whose name in its folder is nearest; NULL: none is near.
static const char *nearest_of(const glob_t *scripts, size_t folder, const char *name) {
    StrNearest nearest = nearest_start(name);
    const char *found = NULL;
    for (size_t i = 0; i < scripts->gl_pathc; i++) {
        const char *path = scripts->gl_pathv[i];
        if (differs_in_suffix(name, path + folder)) {
            return path;
        }
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
    const char *nearest = nearest_of(&beside, folder, name + folder);
    for (size_t i = 0; nearest == NULL && folder == 0 && i < below.gl_pathc; i++) {
        nearest = is_file(below.gl_pathv[i]) ? below.gl_pathv[i] : NULL;
    }
    if (nearest != NULL) {
        message("did you mean '%s'?", nearest);
    }
    globfree(&beside);
    globfree(&below);
}

char *script_folder(const char *name) {
    size_t length = path_directory(str_from(name)).len;
    return length == 0 ? memory_text(".") : memory_copied(name, length);
}

void shell_add_word(Bytes *text, const char *path) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+,:@%=-";
    if (path[0] != '\0' && path[strspn(path, plain)] == '\0') {
        bytes_add_text(text, path);
        return;
    }
    bytes_format(text, "'");
    for (const char *c = path; *c != '\0'; c++) {
        bytes_format(text, *c == '\'' ? "'\\''" : "%c", *c);
    }
    bytes_format(text, "'");
}

void shell_add_program(Bytes *text, const char *called) {
    char *folder = getcwd(NULL, 0);
    size_t length = folder == NULL ? 0 : strlen(folder);
    if (length > 1 && strncmp(called, folder, length) == 0 && called[length] == '/') {
        const char *below = called + length + 1;
        bytes_add_text(text, strchr(below, '/') == NULL ? "./" : "");
        called = below;
    }
    shell_add_word(text, called);
    free(folder);
}

void hint_pictures(const Host *host, const char *script) {
    SCOPED_BYTES program = {0};
    SCOPED_BYTES operand = {0};
    shell_add_program(&program, host->called);
    shell_add_word(&operand, script);
    message("to see it: %s view %s", program.data, operand.data);
    message("to keep a picture of it: %s render %s -o OUT.png (or OUT.mp4)", program.data, operand.data);
}
