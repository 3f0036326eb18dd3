// fault.c: see fault.h.
#include "gl/fault.h"

#include <ctype.h>
#include <string.h>

// What a compiler says: a line of the text, from 1, 0 if unknown; and what is wrong there.
typedef struct Words {
    uint32_t line;
    Str text;
} Words;

static uint32_t take_number(Str *text) {
    uint32_t number = 0;
    while (text->len > 0 && isdigit((unsigned char)*text->bytes)) {
        number = number < 100000000 ? 10 * number + (uint32_t)(*text->bytes - '0') : number;
        text->bytes++, text->len--;
    }
    return number;
}

static bool take(Str *text, char c) {
    if (text->len == 0 || *text->bytes != c)
        return false;
    text->bytes++, text->len--;
    return true;
}

// Drivers say `0:5(22): error: …` or `ERROR: 0:5: …` or `0(5) : error …`. The first line is enough: what follows often
// comes of it.
static Words read_words(Str problem) {
    const char *end = memchr(problem.bytes, '\n', problem.len);
    Str all = str_trim((Str){problem.bytes, end ? (size_t)(end - problem.bytes) : problem.len}), rest = all;
    Words words = {.text = all};
    while (rest.len > 0 && !isdigit((unsigned char)*rest.bytes))
        rest.bytes++, rest.len--;
    take_number(&rest); // of the text
    bool colon = take(&rest, ':');
    if (!colon && !take(&rest, '('))
        return words;
    words.line = take_number(&rest);
    if (colon && take(&rest, '('))
        take_number(&rest); // columns of what Mesa's preprocessor has left of the line
    while (rest.len > 0 && (*rest.bytes == ')' || *rest.bytes == ':' || *rest.bytes == ' '))
        rest.bytes++, rest.len--;
    if (str_starts_with(rest, STR("error: ")))
        rest = (Str){rest.bytes + 7, rest.len - 7};
    words.text = rest;
    return words;
}

static bool is_letter(char c) {
    return isalnum((unsigned char)c) || c == '_';
}

// Where a text stands in another, from an offset on, as a word if it is one; UINT32_MAX: nowhere.
static uint32_t find(Str in, Str text, size_t from) {
    for (size_t i = from; text.len > 0 && i + text.len <= in.len; i++) {
        size_t end = i + text.len;
        if (in.bytes[i] == *text.bytes && memcmp(in.bytes + i, text.bytes, text.len) == 0 &&
            !(i > 0 && is_letter(*text.bytes) && is_letter(in.bytes[i - 1])) &&
            !(end < in.len && is_letter(text.bytes[text.len - 1]) && is_letter(in.bytes[end])))
            return (uint32_t)i;
    }
    return UINT32_MAX;
}

// What a compiler has put in quotes: `blue' or 'blue'.
static Str find_quoted(Str text) {
    for (size_t i = 0; i + 2 < text.len; i++) {
        const char *end =
            text.bytes[i] == '`' || text.bytes[i] == '\'' ? memchr(text.bytes + i + 1, '\'', text.len - i - 1) : NULL;
        if (end)
            return (Str){text.bytes + i + 1, (size_t)(end - text.bytes) - i - 1};
    }
    return (Str){0};
}

// What is wrong in a line of a text that stands at `start`: the word in quotes, or all of the line.
static Span span_of(Str source, uint32_t start, const Words *words) {
    size_t at = start;
    for (uint32_t line = 1; line < words->line && at < source.len; at++)
        line += source.bytes[at] == '\n';
    size_t end = at;
    while (end < source.len && source.bytes[end] != '\n')
        end++;
    Str quoted = find_quoted(words->text);
    uint32_t word = find((Str){source.bytes, end}, quoted, at);
    if (word != UINT32_MAX)
        return (Span){word, word + (uint32_t)quoted.len};
    while (at < end && (source.bytes[at] == ' ' || source.bytes[at] == '\t'))
        at++;
    return (Span){(uint32_t)at, (uint32_t)(end > at ? end : at + 1)};
}

// The name in the first `read('name')` of a text; empty: there is none.
static Str find_file(Str text) {
    for (size_t i = 0; i + 6 < text.len; i++) {
        char quote = text.bytes[i + 5];
        const char *name = text.bytes + i + 6, *end;
        if (memcmp(text.bytes + i, "read(", 5) == 0 && (quote == '\'' || quote == '"') &&
            (end = memchr(name, quote, text.len - i - 6)) != NULL)
            return (Str){name, (size_t)(end - name)};
    }
    return (Str){0};
}

static Str tell(Arena *arena, const DrawNode *node, const Words *words) {
    const char *kind = schema_kinds[node->kind].name;
    const Source *source = node->place.source;
    Span span = node->place.span;
    Str file = source ? find_file((Str){source->text.bytes + span.start, span.end - span.start}) : (Str){0};
    if (words->line == 0)
        return str_format(arena, "!%s: %.*s", kind, STR_ARGS(words->text));
    if (file.len == 0)
        return str_format(arena, "!%s: line %u of its program: %.*s", kind, words->line, STR_ARGS(words->text));
    return str_format(arena, "!%s: %.*s:%u: %.*s", kind, STR_ARGS(file), words->line, STR_ARGS(words->text));
}

void gl_report_shader(DiagSink *faults, const DrawNode *node, const GlFault *fault) {
    const AttrValue *own = draw_attr(node, fault->in_vertex ? ATTR_VERTEX : ATTR_FRAGMENT);
    const Source *source = node->place.source;
    Words words = read_words(fault->text);
    uint32_t start = UINT32_MAX;
    Diag diag = {.level = DIAG_WARNING, .source = source, .span = node->place.span, .code = "bad-shader"};
    if (source && own && words.line > 0) {
        start = find(source->text, own->as.text, node->place.span.start);
        start = start == UINT32_MAX ? find(source->text, own->as.text, 0) : start;
    }
    if (start != UINT32_MAX) {
        diag.span = span_of(source->text, start, &words);
        words.line = 0;
    }
    diag.text = tell(faults->arena, node, &words);
    diag_report(faults, &diag);
}
