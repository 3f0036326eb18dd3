// line.c: reading lines at the prompt, and grouping them into statements; see line.h.
//
// Input is read in blocks and returned line by line, so that pasted lines are not lost. While it waits for input, the
// reader also watches the files of the script.
#include "repl/line.h"

#include "base/file.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const size_t MAX_HISTORY_BYTES = (size_t)16 << 20;

enum { BLOCK = 1 << 16, MAX_ECHOED = 4000 };

struct LineReader {
    Repl *repl;
    Editor *editor; // NULL: lines are not edited
    Text text;      // input; the bytes from offset `at` on have not been returned yet
    size_t at;
    size_t searched; // number of bytes from `at` that are known to contain no line feed
    bool ended;      // true if the input has ended
};

LineReader *line_reader_new(Repl *repl) {
    LineReader *reader = memory_calloc(sizeof *reader);
    reader->repl = repl;
    text_add_c(&reader->text, ""); // makes `bytes` non-NULL
    reader->editor = repl->terminal ? editor_new(repl) : NULL;
    return reader;
}

void line_reader_free(LineReader *reader) {
    editor_free(reader->editor);
    text_free(&reader->text);
    free(reader);
}

LineWait line_wait(Repl *repl) {
    for (;;) {
        if (repl_interrupted())
            return WAIT_INTERRUPTED; // checked first, because a signal before the call does not interrupt poll
        struct pollfd files[2] = {{STDIN_FILENO, POLLIN, 0}, {file_watch_descriptor(repl->files), POLLIN, 0}};
        int ready = poll(files, 2, files[1].fd < 0 ? 200 : -1);
        if ((ready < 0 && errno == EINTR) || repl_interrupted())
            continue;
        if (files[0].revents != 0 || ready < 0)
            return WAIT_INPUT;
        if (repl_report_changes(repl, true))
            return WAIT_NOTICED;
    }
}

// Moves the first line of the buffered input to `line`. Returns false if the line is incomplete.
static bool read_buffered_line(LineReader *reader, Text *line) {
    const char *start = reader->text.bytes + reader->at;
    size_t length = reader->text.len - reader->at;
    const char *end = length == 0 ? NULL : memchr(start + reader->searched, '\n', length - reader->searched);
    reader->searched = length;
    if (!end && !(reader->ended && length > 0))
        return false;
    size_t consumed = !end ? length : (size_t)(end - start);
    text_add(line, (Str){start, consumed});
    reader->at += consumed + (end != NULL);
    reader->searched = 0;
    if (line->len > 0 && line->bytes[line->len - 1] == '\r')
        line->bytes[--line->len] = '\0';
    return true;
}

static void echo_line(Repl *repl, const Text *line) {
    if (line->len <= MAX_ECHOED) {
        output_write(&repl->output, line->bytes, line->len);
        output_write(&repl->output, "\n", 1);
    } else {
        output_write(&repl->output, line->bytes, 60);
        output_format(&repl->output, "... (%zu bytes)\n", line->len);
    }
}

// Waits for input and appends a block of it to reader->text. If the script's files change before input arrives, reports
// the change and writes the prompt again instead.
static LineStatus read_block(LineReader *reader, const char *prompt) {
    Output *output = &reader->repl->output;
    if (reader->ended) {
        output_write(output, "\n", 1);
        return LINE_END;
    }
    output_flush(output);
    LineWait wait = line_wait(reader->repl);
    if (wait == WAIT_INTERRUPTED) {
        output_write(output, "\n", 1);
        return LINE_INTERRUPTED;
    }
    if (wait == WAIT_NOTICED) {
        output_format(output, "%s", prompt);
        return LINE_READ;
    }
    char block[BLOCK];
    ssize_t got = read(STDIN_FILENO, block, sizeof block);
    reader->ended = got == 0 || (got < 0 && errno != EINTR);
    text_add(&reader->text, (Str){block, got > 0 ? (size_t)got : 0});
    return LINE_READ;
}

// The editor may return several lines at once. They are not echoed, because they are already on the screen.
LineStatus line_read(LineReader *reader, const char *prompt, Text *line) {
    Output *output = &reader->repl->output;
    output_flush(output);
    text_add_c(line, "");
    output_format(output, "%s", reader->editor ? "" : prompt);
    bool echoed = !reader->editor && !isatty(STDIN_FILENO);
    while (!read_buffered_line(reader, line)) {
        if (reader->at > 0) {
            memmove(reader->text.bytes, reader->text.bytes + reader->at, reader->text.len - reader->at);
            reader->text.len -= reader->at;
            reader->at = 0;
        }
        LineStatus status =
            reader->editor ? editor_read(reader->editor, prompt, &reader->text) : read_block(reader, prompt);
        if (status != LINE_READ)
            return status;
    }
    if (echoed)
        echo_line(reader->repl, line);
    return LINE_READ;
}

bool line_is_blank(const char *line) {
    return line[strspn(line, " \t\n")] == '\0';
}

// Returns true if a line continues the lines above it.
static bool continues_block(const char *line) {
    return line[0] == ' ' || line[0] == '\t' || strncmp(line, "else", 4) == 0 || strncmp(line, "elif", 4) == 0;
}

// Returns the offset at which the last line begins.
static size_t last_line(const char *text, size_t length) {
    size_t at = length > 0 ? length - 1 : 0;
    while (at > 0 && text[at - 1] != '\n')
        at--;
    return at;
}

bool line_needs_more(Repl *repl, const char *text, size_t length, size_t *consumed) {
    size_t last = last_line(text, length);
    *consumed = length;
    if (text[strspn(text, " \t")] == '.')
        return false;
    PetriCompleteness above = last == 0 ? PETRI_INCOMPLETE : petri_prompt_check(repl->prompt.session, text, last);
    if (above != PETRI_INCOMPLETE && (line_is_blank(text + last) || !continues_block(text + last))) {
        *consumed = last;
        return false;
    }
    return petri_prompt_check(repl->prompt.session, text, length) != PETRI_COMPLETE;
}

size_t line_indentation(Repl *repl, const char *text, size_t length) {
    enum { INDENTATION = 4 };
    size_t last = last_line(text, length), own = strspn(text + last, " ");
    PetriCompleteness all = petri_prompt_check(repl->prompt.session, text, length);
    // Nodes may have children. Those of the first line often have, others rarely.
    bool opens =
        petri_prompt_check(repl->prompt.session, text + last + own, length - last - own) == PETRI_NEEDS_BLOCK ||
        (last == 0 && all == PETRI_EXTENDABLE);
    return own + (opens && all != PETRI_INCOMPLETE ? INDENTATION : 0);
}

// Appends the path of the history file. Returns false if the environment names no folder for it.
static bool file_path(Text *path) {
    const char *folder = getenv("XDG_STATE_HOME"), *home = getenv("HOME");
    if (folder && folder[0] == '/') // the XDG specification requires that relative paths are ignored
        text_add_c(path, folder);
    else if (home && home[0] != '\0')
        text_add_format(path, "%s/.local/state", home);
    else
        return false;
    text_add_format(path, "/petri/history");
    return true;
}

void saved_read(Text *lines) {
    SCOPED_TEXT path = {0};
    if (file_path(&path))
        text_read_file(lines, path.bytes, MAX_HISTORY_BYTES);
    if (lines->len > 0 && lines->bytes[lines->len - 1] != '\n')
        text_add_c(lines, "\n");
}

// Creates the parent folders of a file, accessible only to the owner.
static void make_folders(char *path) {
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        mkdir(path, 0700);
        *slash = '/';
    }
}

// Returns the offset at which the last `max` lines begin.
static size_t start_of_last(const Text *lines, size_t max) {
    size_t at = lines->len;
    while (at > 0 && max > 0) {
        at--;
        while (at > 0 && lines->bytes[at - 1] != '\n')
            at--;
        max--;
    }
    return at;
}

void saved_add(const Text *lines) {
    SCOPED_TEXT path = {0}, all = {0};
    if (lines->len > 0 && file_path(&path)) {
        saved_read(&all); // read the file again, because another session may have added lines
        text_add(&all, text_str(lines));
        size_t start = start_of_last(&all, SAVED_MAX);
        Text kept = {.bytes = all.bytes + start, .len = all.len - start};
        make_folders(path.bytes);
        file_replace(path.bytes, text_str(&kept), 0);
    }
}
