// script.c: see script.h.
#include "cli/script.h"

#include <dirent.h>
#include <errno.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

static bool is_picture(const char *name) {
    static const char *const suffixes[] = {".png", ".svg", ".pdf", ".mp4", ".webm", ".gif"};
    const char *dot = strrchr(name, '.');
    for (size_t i = 0; dot != NULL && i < sizeof suffixes / sizeof suffixes[0]; i++) {
        if (strcmp(dot, suffixes[i]) == 0) {
            return true;
        }
    }
    return false;
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
    char block[1 << 16];
    ssize_t got = 0;
    if (isatty(STDIN_FILENO)) {
        message("reading the script from the terminal; Ctrl-D ends it");
    }
    while (text->length <= MOST_BYTES && (got = read(STDIN_FILENO, block, sizeof block)) != 0) {
        if (got < 0 && errno != EINTR) {
            message("cannot read standard input: %s", strerror(errno));
            return false;
        }
        bytes_add(text, block, got < 0 ? 0 : (size_t)got);
    }
    if (text->length > MOST_BYTES) {
        message("cannot read standard input: it is too large");
    }
    return text->length <= MOST_BYTES;
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

static bool is_script_name(const char *name) {
    size_t length = strlen(name);
    return name[0] != '.' && length > 3 && strcmp(name + length - 3, ".fl") == 0;
}

static int by_name(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

typedef struct Names {
    char **items;
    size_t count;
} Names;

// The scripts of a folder, sorted.
static Names scripts_of(const char *folder) {
    Names names = {0};
    DIR *entries = opendir(folder);
    for (struct dirent *entry = NULL; entries != NULL && (entry = readdir(entries)) != NULL;) {
        if (is_script_name(entry->d_name)) {
            names.items = memory_resized(names.items, (names.count + 1) * sizeof *names.items);
            names.items[names.count++] = memory_text(entry->d_name);
        }
    }
    if (entries != NULL) {
        closedir(entries);
    }
    if (names.count > 0) {
        qsort(names.items, names.count, sizeof *names.items, by_name);
    }
    return names;
}

static void free_names(Names *names) {
    for (size_t i = 0; i < names->count; i++) {
        free(names->items[i]);
    }
    free(names->items);
}

static void list_scripts(const char *folder) {
    enum { MOST = 4 };
    Names names = scripts_of(folder);
    size_t length = strlen(folder);
    SCOPED_BYTES list = {0};
    bytes_add(&list, "", 0);
    for (size_t i = 0; i < names.count && i < MOST; i++) {
        bytes_format(&list, "%s%s%s%s", i == 0 ? "" : ", ", folder, folder[length - 1] == '/' ? "" : "/",
                     names.items[i]);
    }
    if (names.count > 0) {
        message("name a script in it: %s%s", list.data, names.count > MOST ? " ..." : "");
    }
    free_names(&names);
}

// Whether `name` is what is left of `script` without a suffix such as `.bak`, or what it becomes with `.fl`.
static bool differs_in_suffix(const char *name, const char *script) {
    size_t length = strlen(name);
    return strncmp(name, script, strlen(script)) == 0 ||
           (strncmp(name, script, length) == 0 && strcmp(script + length, ".fl") == 0);
}

// The script in a folder whose name is nearest; NULL: none is near.
static const char *nearest_of(const Names *names, const char *name) {
    Nearest nearest = {.word = name};
    for (size_t i = 0; i < names->count; i++) {
        if (differs_in_suffix(name, names->items[i])) {
            return names->items[i];
        }
        nearest_offer(&nearest, names->items[i]);
    }
    return nearest.name;
}

// A script of just this name in a folder below this one.
static bool suggest_below(const char *name) {
    DIR *entries = opendir(".");
    bool found = false;
    for (struct dirent *entry = NULL; entries != NULL && !found && (entry = readdir(entries)) != NULL;) {
        struct stat about;
        SCOPED_BYTES path = {0};
        bytes_format(&path, "%s/%s", entry->d_name, name);
        found = entry->d_name[0] != '.' && stat(path.data, &about) == 0 && S_ISREG(about.st_mode);
        if (found) {
            message("did you mean '%s'?", path.data);
        }
    }
    if (entries != NULL) {
        closedir(entries);
    }
    return found;
}

void script_suggest(const char *name) {
    struct stat about;
    const char *slash = strrchr(name, '/'), *last = slash == NULL ? name : slash + 1;
    if (stat(name, &about) == 0 || last[0] == '\0') {
        list_scripts(name);
        return;
    }
    char *folder = slash == NULL ? memory_copied("./", 2) : memory_copied(name, (size_t)(last - name));
    Names names = scripts_of(folder);
    const char *nearest = nearest_of(&names, last);
    if (nearest != NULL) {
        message("did you mean '%s%s'?", slash == NULL ? "" : folder, nearest);
    } else if (slash == NULL) {
        suggest_below(name);
    }
    free_names(&names);
    free(folder);
}
