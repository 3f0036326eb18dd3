// golden_tests.c: failed tests of a script, shown as diagnostics of the script when it is saved.
//
// `petri test` runs the tests beside the script. A failure is shown in the line of its cause, if petri test finds one,
// or of its error, else in the first line.
#include "base/file.h"
#include "base/source.h"
#include "cli/subprocess.h"
#include "lsp/server.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

enum { PATIENCE = 2 }; // seconds in which the editor waits for answers

bool golden_tests_exist(const char *path) {
    static const char *const suffixes[] = {".golden", ".err"};
    if (!str_ends_with(str_from(path), STR(".fl")))
        return false;
    for (size_t i = 0; i < sizeof suffixes / sizeof suffixes[0]; i++) {
        SCOPED_TEXT file = {0};
        text_add_format(&file, "%.*s%s", (int)(strlen(path) - strlen(".fl")), path, suffixes[i]);
        if (file_exists(file.bytes))
            return true;
    }
    return false;
}

// Returns the line in `NAME:LINE` at the end of a text, or 0.
static uint32_t line_at_end(Str text, const char *name) {
    size_t length = strlen(name), digits = 0;
    while (digits < text.len && strchr("0123456789", text.bytes[text.len - 1 - digits]))
        digits++;
    size_t before = text.len - digits;
    if (digits == 0 || before < length + 2 || text.bytes[before - 1] != ':' ||
        memcmp(text.bytes + before - 1 - length, name, length) != 0 || text.bytes[before - 2 - length] != ' ')
        return 0;
    return (uint32_t)strtoul(text.bytes + before, NULL, 10);
}

// Reads `FILE:LINE: error: REASON`. Returns false if the line is something else.
static bool read_failure(Str line, const char *path, uint32_t *number, Text *reason) {
    static const char mark[] = ": error: ";
    SCOPED_STRING text = memory_strndup(line.bytes, line.len);
    char *end = strstr(text, mark), *colon;
    if (!end || text[0] == ' ')
        return false;
    *end = '\0';
    colon = strrchr(text, ':');
    if (!colon)
        return false;
    *colon = '\0';
    *number = strcmp(text, path) == 0 ? (uint32_t)strtoul(colon + 1, NULL, 10) : 0;
    reason->len = 0;
    text_add_format(reason, "%s fails: %s", text + path_directory(str_from(text)).len, end + strlen(mark));
    return true;
}

static void read_report(Document *document, const Text *output) {
    const char *name = document->path + path_directory(str_from(document->path)).len;
    SCOPED_TEXT reason = {0};
    uint32_t line_number = 0;
    size_t at = 0;
    for (Str line; text_next_line(output, &at, &line);) {
        bool cause = line.len > 6 && memcmp(line.bytes, "    + ", 6) == 0;
        uint32_t found = cause ? line_at_end(line, name) : 0;
        line_number = found > 0 ? found : line_number;
        bool ends = reason.len > 0 && line.len > 0 && line.bytes[0] != ' ';
        if (ends) {
            document_add_failure(document, line_number, reason.bytes);
            reason.len = 0;
        }
        if (reason.len == 0)
            read_failure(line, document->path, &line_number, &reason);
    }
}

void golden_tests_run(Server *server, Document *document) {
    document_clear_failures(document);
    if (server->options->no_files || !document->is_file || !golden_tests_exist(document->path))
        return;
    char *words[] = {"petri", "test", "--color=never", "--", document->path, NULL};
    SCOPED_TEXT output = {0}, errors = {0};
    int status = subprocess_run(server->host->program, ".", words, PATIENCE, &output, &errors);
    if (status >= 0 && WIFEXITED(status) && WEXITSTATUS(status) == STATUS_FAILED)
        read_report(document, &output);
}

void golden_tests_report(Server *server, Document *document) {
    for (size_t i = 0; i < document->failure_count; i++) {
        const DocumentFailure *failure = &document->failures[i];
        uint32_t line = failure->line > 0 ? failure->line : 1;
        const PetriDiagnostic diagnostic = {
            .size = sizeof diagnostic,
            .level = PETRI_ERROR,
            .file = document->path,
            .line = line,
            .column = 1,
            .text = failure->text,
            .hint = "",
            .end_line = line + 1,
            .end_column = 1,
        };
        diagnostics_collect(server, &diagnostic);
    }
}
