// line.c: see line.h.
#include "repl/line.h"

#include <stdlib.h>
#include <string.h>

#include "repl/edit.h"
#include "repl/plain.h"

struct LineReader {
    Repl *repl;
    PlainReader plain;
    Editor *editor; // NULL: none is wanted, or there is none
    Bytes lines;    // that were edited together, from `at` on
    size_t at;
};

LineReader *line_reader_new(Repl *repl) {
    LineReader *reader = memory_zeroed(sizeof *reader);
    reader->repl = repl;
    reader->editor = repl->terminal ? editor_new(repl) : NULL;
    return reader;
}

void line_reader_free(LineReader *reader) {
    editor_free(reader->editor);
    bytes_free(&reader->plain.text);
    bytes_free(&reader->lines);
    free(reader);
}

static void take_line(LineReader *reader, Bytes *line) {
    const char *start = reader->lines.data + reader->at;
    size_t length = strcspn(start, "\n");
    bytes_add(line, start, length);
    reader->at += length + (start[length] == '\n');
}

// An editor gives several lines at a time, which have been seen on the screen already.
static LineStatus edit(LineReader *reader, const char *prompt, Bytes *line) {
    LineStatus status = LINE_READ;
    if (reader->at >= reader->lines.length) {
        reader->lines.length = reader->at = 0;
        status = editor_read(reader->editor, prompt, &reader->lines);
    }
    bytes_add(line, "", 0);
    if (status == LINE_READ) {
        take_line(reader, line);
    }
    return status;
}

LineStatus line_read(LineReader *reader, const char *prompt, Bytes *line) {
    output_flush(&reader->repl->output);
    if (reader->editor != NULL) {
        return edit(reader, prompt, line);
    }
    return plain_read(&reader->plain, reader->repl, prompt, line);
}
