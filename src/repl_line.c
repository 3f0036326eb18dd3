// repl_line.c: see repl_line.h.
#include "repl_line.h"

#include <stdlib.h>
#include <string.h>

#include "repl_edit.h"
#include "repl_plain.h"

struct LineReader {
    Repl *repl;
    PlainReader plain;
    Editor *editor; // NULL: none is wanted, or there is none
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
    free(reader);
}

LineStatus line_read(LineReader *reader, const char *prompt, Bytes *line) {
    output_flush(&reader->repl->output);
    if (reader->editor != NULL) {
        return editor_read(reader->editor, prompt, line);
    }
    return plain_read(&reader->plain, reader->repl, prompt, line);
}
