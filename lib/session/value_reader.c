// value_reader.c: see value_reader.h.
#include "session/value_reader.h"

#include "ast/literal.h"
#include "session/session.h"

#include <string.h>

bool value_reader_skip(ValueReader *reader, Str prefix) {
    if (!str_starts_with(reader->rest, prefix))
        return false;
    reader->rest = (Str){reader->rest.bytes + prefix.len, reader->rest.len - prefix.len};
    return true;
}

// Returns the length of the element at the start of `rest`: a quoted string, or everything up to ";", ")", a space or
// the end of the line. Returns 0 if a string is not terminated.
static size_t element_length(Str rest) {
    size_t at = 0;
    char quote = rest.len && (rest.bytes[0] == '\'' || rest.bytes[0] == '"') ? rest.bytes[0] : 0;
    if (!quote) {
        while (at < rest.len && !strchr(";) \n", rest.bytes[at]))
            at++;
        return at;
    }
    for (at = 1; at < rest.len && rest.bytes[at] != quote; at++)
        at += rest.bytes[at] == '\\';
    return at < rest.len ? at + 1 : 0;
}

static bool read_element(ValueReader *reader, Vector *vector) {
    size_t len = element_length(reader->rest);
    Str text = {reader->rest.bytes, len};
    double x;
    if (len == 0)
        return false;
    reader->rest = (Str){reader->rest.bytes + len, reader->rest.len - len};
    if (text.bytes[0] == ':') {
        const Symbol *symbol = symbol_register(&reader->session->symbols, (Str){text.bytes + 1, len - 1});
        if (symbol)
            vector_add_number(vector, symbol->number);
        return symbol;
    }
    if (text.bytes[0] == '\'' || text.bytes[0] == '"') {
        Str string;
        if (literal_string(reader->arena, text, &string))
            return false;
        vector_add(vector, value_string(reader->arena, string));
        return true;
    }
    if (!literal_parse_number(text, &x))
        return false;
    vector_add_number(vector, x);
    return true;
}

bool value_reader_read(ValueReader *reader, Value *value) {
    Vector vector = vector_new(reader->arena);
    if (!value_reader_skip(reader, STR("null"))) {
        do
            if (!read_element(reader, &vector))
                return false;
        while (value_reader_skip(reader, STR(";")));
    }
    *value = vector_finish(&vector);
    return true;
}
