// shader_errors.c: see shader_errors.h.
#include "picture/shader_errors.h"

#include <ctype.h>
#include <string.h>

// A compiler's message. `line` is the line number in the shader source, from 1; 0: unknown.
typedef struct CompilerMessage {
    uint32_t line;
    Str text;
} CompilerMessage;

static uint32_t read_number(Str *text) {
    uint32_t number = 0;
    while (text->len > 0 && isdigit((unsigned char)*text->bytes)) {
        number = number < 100000000 ? 10 * number + (uint32_t)(*text->bytes - '0') : number;
        text->bytes++, text->len--;
    }
    return number;
}

static bool skip_char(Str *text, char c) {
    if (text->len == 0 || *text->bytes != c)
        return false;
    text->bytes++, text->len--;
    return true;
}

// Parses the compiler's output. Drivers write `0:5(22): error: …`, `ERROR: 0:5: …` or `0(5) : error …`. Uses only the
// first line, because later errors usually result from the first.
static CompilerMessage read_message(Str problem) {
    const char *end = memchr(problem.bytes, '\n', problem.len);
    Str all = str_trim((Str){problem.bytes, end ? (size_t)(end - problem.bytes) : problem.len}), rest = all;
    CompilerMessage message = {.text = all};
    while (rest.len > 0 && !isdigit((unsigned char)*rest.bytes))
        rest.bytes++, rest.len--;
    read_number(&rest); // index of the source string
    bool colon = skip_char(&rest, ':');
    if (!colon && !skip_char(&rest, '('))
        return message;
    message.line = read_number(&rest);
    if (colon && skip_char(&rest, '('))
        read_number(&rest); // the column, which Mesa counts in preprocessed source
    while (rest.len > 0 && (*rest.bytes == ')' || *rest.bytes == ':' || *rest.bytes == ' '))
        rest.bytes++, rest.len--;
    if (str_starts_with(rest, STR("error: ")))
        rest = (Str){rest.bytes + 7, rest.len - 7};
    message.text = rest;
    return message;
}

static bool is_letter(char c) {
    return isalnum((unsigned char)c) || c == '_';
}

// Returns the offset of the first occurrence of `text` in `in` at or after `from`; UINT32_MAX: not found. If `text` is
// a word, only whole words match.
static uint32_t find_text(Str in, Str text, size_t from) {
    for (size_t i = from; text.len > 0 && i + text.len <= in.len; i++) {
        size_t end = i + text.len;
        if (in.bytes[i] == *text.bytes && memcmp(in.bytes + i, text.bytes, text.len) == 0 &&
            !(i > 0 && is_letter(*text.bytes) && is_letter(in.bytes[i - 1])) &&
            !(end < in.len && is_letter(text.bytes[text.len - 1]) && is_letter(in.bytes[end])))
            return (uint32_t)i;
    }
    return UINT32_MAX;
}

// Returns the first quoted part of a compiler message: `blue' or 'blue'.
static Str find_quoted(Str text) {
    for (size_t i = 0; i + 2 < text.len; i++) {
        const char *end =
            text.bytes[i] == '`' || text.bytes[i] == '\'' ? memchr(text.bytes + i + 1, '\'', text.len - i - 1) : NULL;
        if (end)
            return (Str){text.bytes + i + 1, (size_t)(end - text.bytes) - i - 1};
    }
    return (Str){0};
}

// Returns the span of the error in a shader whose text starts at `start` in the script. The span is the word that the
// message quotes. If the reported line does not contain this word, the span is the whole line.
static Span span_of(Str source, uint32_t start, const CompilerMessage *message) {
    size_t at = start;
    for (uint32_t line = 1; line < message->line && at < source.len; at++)
        line += source.bytes[at] == '\n';
    size_t end = at;
    while (end < source.len && source.bytes[end] != '\n')
        end++;
    Str quoted = find_quoted(message->text);
    uint32_t word = find_text((Str){source.bytes, end}, quoted, at);
    if (word != UINT32_MAX)
        return (Span){word, word + (uint32_t)quoted.len};
    while (at < end && (source.bytes[at] == ' ' || source.bytes[at] == '\t'))
        at++;
    return (Span){(uint32_t)at, (uint32_t)(end > at ? end : at + 1)};
}

// Returns the name in the first `read('name')` of a shader; empty: none.
static Str find_file(Str text) {
    for (size_t i = 0; i + 6 < text.len; i++) {
        char quote = text.bytes[i + 5];
        const char *name = text.bytes + i + 6, *end;
        if (memcmp(text.bytes + i, "read(", 5) == 0 && (quote == '\'' || quote == '"') &&
            (end = memchr(name, quote, text.len - i - 6)))
            return (Str){name, (size_t)(end - name)};
    }
    return (Str){0};
}

static void format_message(Text *out, const Diag *diag, const CompilerMessage *message) {
    const Source *source = diag->at.source;
    Span span = diag->at.span;
    Str file = source ? find_file((Str){source->text.bytes + span.start, span.end - span.start}) : (Str){0};
    text_add_format(out, "!%s: ", diag->shader.node);
    if (message->line > 0 && file.len > 0)
        text_add_format(out, "%.*s:%u: ", STR_ARGS(file), message->line);
    else if (message->line > 0)
        text_add_format(out, "line %u of the shader: ", message->line);
    text_add(out, message->text);
}

void picture_place_shader_error(Diag *diag, Text *out) {
    const Source *source = diag->at.source;
    Str program = diag->shader.program;
    CompilerMessage message = read_message(diag->text);
    uint32_t start = UINT32_MAX;
    if (source && message.line > 0) {
        start = find_text(source->text, program, diag->at.span.start);
        start = start == UINT32_MAX ? find_text(source->text, program, 0) : start;
    }
    if (start != UINT32_MAX) {
        diag->at.span = span_of(source->text, start, &message);
        message.line = 0;
    }
    format_message(out, diag, &message);
    diag->text = text_str(out);
    diag->shader = (DiagShader){0};
}
