// committed.c: a side that is a script as git has it: REVISION:FILE.
//
// The script and the modules in git are those of the revision; other files are those on disk. `git cat-file` executes
// no filters, hooks or pagers of the repository; see also subprocess_git.
#include "base/file.h"
#include "base/source.h"
#include "cli/subprocess.h"
#include "diff/diff.h"

#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

enum { PATIENCE = 10 }; // seconds for one file

struct CommittedFile {
    CommittedFile *next;
    char *path;
    Text text;
    bool found;
};

static const char *script_part(const char *source) {
    const char *colon = source ? strchr(source, ':') : NULL;
    return colon ? colon + 1 : NULL;
}

bool committed_is(const char *source) {
    const char *script = script_part(source);
    return script && script > source + 1 && source[0] != '-' && str_ends_with(str_from(script), STR(".fl")) &&
           !file_exists(source);
}

static bool read_committed(const char *revision, const char *path, Text *text, Text *errors) {
    SCOPED_STRING folder = memory_folder(path);
    SCOPED_TEXT object = {0};
    text_add_format(&object, "%s:./%s", revision, path + path_directory(str_from(path)).len);
    TextList words = {0};
    texts_add(&words, "cat-file");
    texts_add(&words, "blob");
    texts_add(&words, object.bytes);
    int status = subprocess_git(folder, &words, PATIENCE, text, errors);
    texts_free(&words);
    return status >= 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

static CommittedFile *find_file(Side *side, const char *path) {
    CommittedFile *file = side->committed;
    while (file && strcmp(file->path, path) != 0)
        file = file->next;
    if (file)
        return file;
    SCOPED_TEXT errors = {0};
    file = memory_calloc(sizeof *file);
    *file = (CommittedFile){.next = side->committed, .path = memory_strdup(path)};
    file->found = read_committed(side->revision, path, &file->text, &errors);
    side->committed = file;
    return file;
}

const char *committed_read(void *context, const char *path, size_t *length) {
    const CommittedFile *file = find_file(context, path);
    *length = file->text.len;
    return file->found ? file->text.bytes : NULL;
}

bool committed_load(Side *side) {
    const char *path = script_part(side->source);
    SCOPED_TEXT text = {0}, errors = {0};
    side->revision = memory_strndup(side->source, (size_t)(path - side->source - 1));
    if (!read_committed(side->revision, path, &text, &errors)) {
        size_t length = errors.bytes ? strcspn(errors.bytes, "\n") : 0;
        message("cannot read %s from git%s%.*s", side->source, length > 0 ? ": " : "", (int)length,
                errors.bytes ? errors.bytes : "");
        return false;
    }
    return petri_load_text(side->session, path, text.bytes, text.len) == PETRI_OK;
}

void committed_free(Side *side) {
    while (side->committed) {
        CommittedFile *file = side->committed;
        side->committed = file->next;
        free(file->path);
        text_free(&file->text);
        free(file);
    }
    free(side->revision);
}
