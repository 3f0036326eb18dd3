// diag.c: see diag.h.
//
// Text that can come from a script is printed by text_add_printable, so that it cannot control the terminal, and its
// length is limited.
#include "base/diag.h"

DiagSink diag_sink_new(Arena *arena, uint32_t limit) {
    return (DiagSink){.arena = arena, .limit = limit};
}

void diag_sink_free(DiagSink *sink) {
    hash_index_free(&sink->index);
    *sink = (DiagSink){.arena = sink->arena, .limit = sink->limit};
}

static bool is_same_diag(const void *owner, uint32_t entry, const void *key) {
    const Diag *a = &((const DiagSink *)owner)->items[entry], *b = key;
    return a->at.source == b->at.source && a->at.span.start == b->at.span.start && str_equal(a->text, b->text);
}

bool diag_report(DiagSink *sink, const Diag *diag) {
    uint64_t hash = hash_bytes(diag->at.span.start, diag->text.bytes, diag->text.len);
    if (hash_index_find(&sink->index, hash, is_same_diag, sink, diag) != HASH_INDEX_NONE)
        return false;
    if (sink->count >= sink->limit) {
        sink->dropped++;
        return false;
    }
    sink->items = arena_grow_array(sink->arena, sink->items, sink->count, &sink->capacity, sizeof *sink->items);
    Diag *stored = &sink->items[sink->count];
    *stored = *diag;
    stored->text = str_copy(sink->arena, diag->text);
    stored->hint = str_copy(sink->arena, diag->hint);
    if (!hash_index_add(&sink->index, hash, sink->count))
        arena_exhausted(sink->arena);
    sink->count++;
    sink->error_count += diag->level == DIAG_ERROR;
    return true;
}

static const char *const level_names[] = {"error", "warning", "note"};
static const char *const level_colours[] = {"\033[1;31m", "\033[1;35m", "\033[1;36m"};

// Returns the part of a line around *column, at most MAX_WIDTH characters, and makes *column relative to its start.
static Str excerpt(Str line, uint32_t *column) {
    enum { MAX_WIDTH = 160, CONTEXT_WIDTH = 60 };
    if (utf8_length(line) <= MAX_WIDTH)
        return line;
    uint32_t skip = *column > CONTEXT_WIDTH ? *column - CONTEXT_WIDTH : 0;
    size_t start = 0, end;
    for (uint32_t i = 0; i < skip && start < line.len; i++)
        utf8_next(line, &start);
    end = start;
    for (int i = 0; i < MAX_WIDTH && end < line.len; i++)
        utf8_next(line, &end);
    *column -= skip;
    return (Str){line.bytes + start, end - start};
}

static void format_caret_line(Text *out, Str line, uint32_t column, size_t width, const char *plain) {
    size_t at = 0;
    // Tabs are copied, so that the caret is below its column for any tab width.
    for (uint32_t i = 1; i < column; i++)
        text_add_char(out, at < line.len && utf8_next(line, &at) == '\t' ? '\t' : ' ');
    text_add_char(out, '^');
    size_t max_width = at < line.len ? utf8_length((Str){line.bytes + at, line.len - at}) : 0;
    for (size_t i = 1; i < width && i < max_width; i++)
        text_add_char(out, '~');
    text_add_c(out, plain);
    text_add_char(out, '\n');
}

Str diag_text(const Diag *diag) {
    return str_truncate(diag->text, 400); // names in a script may be megabytes long
}

static void add_text(Text *out, const Diag *diag) {
    Str text = diag_text(diag);
    text_add_printable(out, text, "\t\n");
    if (text.len < diag->text.len)
        text_add_c(out, "…");
}

void diag_format(Text *out, const Diag *diag, bool colour) {
    const char *bold = colour ? "\033[1m" : "", *plain = colour ? "\033[0m" : "";
    const char *tint = colour ? level_colours[diag->level] : "";
    SourcePosition position = {0};
    if (diag->at.source) {
        position = source_locate(diag->at.source, diag->at.span.start);
        text_add_c(out, bold);
        text_add_printable(out, diag->at.source->name, "\t\n");
        text_add_format(out, ":%u:%u:%s ", position.line, position.column, plain);
    }
    text_add_format(out, "%s%s:%s ", tint, level_names[diag->level], plain);
    add_text(out, diag);
    if (diag->code)
        text_add_format(out, " [%s]", diag->code);
    text_add_char(out, '\n');
    if (diag->at.source) {
        uint32_t column = position.column;
        Str line = excerpt(position.text, &column);
        size_t len = diag->at.span.end > diag->at.span.start ? diag->at.span.end - diag->at.span.start : 1;
        size_t left = diag->at.source->text.len - diag->at.span.start;
        size_t width = utf8_length((Str){diag->at.source->text.bytes + diag->at.span.start, len < left ? len : left});
        text_add_c(out, "    ");
        text_add_printable(out, line, "\t\n");
        text_add_format(out, "\n    %s", tint);
        format_caret_line(out, line, column, width, plain);
    }
    if (diag->hint.len) {
        text_add_c(out, "    ");
        text_add_printable(out, diag->hint, "\t\n");
        text_add_char(out, '\n');
    }
}

Str diag_one_line(Arena *arena, const Diag *diag) {
    Text out = text_new(arena);
    add_text(&out, diag);
    if (diag->at.source) {
        SourcePosition position = source_locate(diag->at.source, diag->at.span.start);
        text_add_format(&out, " (%.*s:%u)", STR_ARGS(diag->at.source->name), position.line);
    }
    return text_str(&out);
}
