// golden_compare.c: comparison of two outputs, frame by frame.
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "golden/golden.h"
#include "golden/golden_line.h"

// How closely numbers must agree between `strict` and the horizon (conformance/physics/README.md).
static const double LOOSE_TOLERANCE = 1e-4;

enum { EXCERPT_LENGTH = 100, EXCERPT_BEFORE = 30 };

typedef struct Line {
    Slice slice;
    uint32_t number;
    bool taken; // already matched with a line of the other side
} Line;

typedef struct LineList {
    Line *items;
    size_t count;
    size_t capacity;
} LineList;

// One frame of an output. What stands before the first header (logs alone have none) counts as frame 0.
typedef struct Frame {
    LineList head;   // the @ line, if there is one
    LineList body;   // tree and state, in order
    LineList logs;   // in any order
    LineList errors; // in any order
    uint32_t end;    // number of the line after the last
} Frame;

typedef struct Reader {
    const char *at;
    const char *end;
    uint32_t number;
    Frame frame;
} Reader;

static void add_line(LineList *list, Slice slice, uint32_t number) {
    if (list->count == list->capacity) {
        list->capacity = list->capacity == 0 ? 64 : 2 * list->capacity;
        list->items = memory_resized(list->items, list->capacity * sizeof *list->items);
    }
    list->items[list->count++] = (Line){.slice = slice, .number = number};
}

static Slice peek_line(const Reader *reader) {
    size_t rest = (size_t)(reader->end - reader->at);
    const char *end = memchr(reader->at, '\n', rest);
    return (Slice){reader->at, end == NULL ? rest : (size_t)(end - reader->at)};
}

static Slice take_line(Reader *reader) {
    Slice line = peek_line(reader);
    reader->at += line.length + (reader->at + line.length < reader->end ? 1 : 0);
    reader->number++;
    return line;
}

// A text of several lines goes on where lines are indented.
static Slice take_text(Reader *reader) {
    Slice text = take_line(reader);
    while (reader->at < reader->end && *reader->at == ' ') {
        Slice more = take_line(reader);
        text.length = (size_t)(more.text + more.length - text.text);
    }
    return text;
}

// Reads the next frame; false at the end.
static bool read_frame(Reader *reader) {
    Frame *frame = &reader->frame;
    frame->head.count = frame->body.count = frame->logs.count = frame->errors.count = 0;
    if (reader->at == reader->end) {
        frame->end = reader->number;
        return false;
    }
    if (*reader->at == '@') {
        uint32_t number = reader->number;
        add_line(&frame->head, take_line(reader), number);
    }
    while (reader->at < reader->end && *reader->at != '@') {
        uint32_t number = reader->number;
        if (*reader->at == '>') {
            add_line(&frame->logs, take_text(reader), number);
        } else if (*reader->at == '?') {
            add_line(&frame->errors, take_text(reader), number);
        } else {
            add_line(&frame->body, take_line(reader), number);
        }
    }
    frame->end = reader->number;
    return true;
}

static void free_reader(Reader *reader) {
    free(reader->frame.head.items);
    free(reader->frame.body.items);
    free(reader->frame.logs.items);
    free(reader->frame.errors.items);
}

static int64_t frame_number(const Frame *frame) {
    return frame->head.count == 0 ? 0 : strtoll(frame->head.items[0].slice.text + 1, NULL, 10);
}

// The part of a line around the place that matters.
static void add_excerpt(Bytes *trouble, Slice line, size_t at) {
    size_t start = line.length <= EXCERPT_LENGTH || at <= EXCERPT_BEFORE ? 0 : at - EXCERPT_BEFORE;
    // Do not cut a character in two.
    while (start > 0 && ((unsigned char)line.text[start] & 0xC0U) == 0x80U) {
        start--;
    }
    size_t end = line.length - start <= EXCERPT_LENGTH ? line.length : start + EXCERPT_LENGTH;
    while (end < line.length && ((unsigned char)line.text[end] & 0xC0U) == 0x80U) {
        end++;
    }
    bytes_add_text(trouble, start > 0 ? "..." : "");
    for (size_t i = start; i < end; i++) {
        if (line.text[i] == '\n') {
            bytes_format(trouble, "\\n");
        } else {
            bytes_add(trouble, &line.text[i], 1);
        }
    }
    bytes_add_text(trouble, end < line.length ? "..." : "");
}

typedef struct Comparison {
    int64_t frame;
    double tolerance;
    Bytes *trouble;
} Comparison;

// Describes a difference; either line may be missing. Always false.
static bool differ(const Comparison *comparison, const Line *expected, const Line *got, uint32_t line,
                   LineDifference where) {
    Bytes *trouble = comparison->trouble;
    bytes_format(trouble, "frame %" PRId64 " line %" PRIu32 ": expected ", comparison->frame,
                 expected == NULL ? line : expected->number);
    if (expected == NULL) {
        bytes_format(trouble, "nothing more");
    } else {
        add_excerpt(trouble, expected->slice, where.expected_at);
    }
    bytes_format(trouble, " got ");
    if (got == NULL) {
        bytes_format(trouble, "nothing");
    } else {
        add_excerpt(trouble, got->slice, where.got_at);
    }
    return false;
}

static bool compare_in_order(const Comparison *comparison, const LineList *expected, const LineList *got,
                             uint32_t end) {
    for (size_t i = 0; i < expected->count || i < got->count; i++) {
        const Line *first = i < expected->count ? &expected->items[i] : NULL;
        const Line *second = i < got->count ? &got->items[i] : NULL;
        LineDifference where = {0};
        if (first == NULL || second == NULL || !line_same(first->slice, second->slice, comparison->tolerance, &where)) {
            return differ(comparison, first, second, end, where);
        }
    }
    return true;
}

// Finds a line that agrees and takes it out of the set. The search starts where the last one ended, since sets are
// mostly in the same order.
static bool take_match(const Comparison *comparison, const Line *wanted, LineList *set, size_t *next) {
    for (size_t i = 0; i < set->count; i++) {
        Line *line = &set->items[(*next + i) % set->count];
        LineDifference where;
        if (!line->taken && line_same(wanted->slice, line->slice, comparison->tolerance, &where)) {
            line->taken = true;
            *next = *next + i + 1;
            return true;
        }
    }
    return false;
}

static const Line *first_untaken(const LineList *set) {
    for (size_t i = 0; i < set->count; i++) {
        if (!set->items[i].taken) {
            return &set->items[i];
        }
    }
    return NULL;
}

static bool compare_as_sets(const Comparison *comparison, const LineList *expected, LineList *got, uint32_t end) {
    const LineDifference nowhere = {0};
    const Line *missing = NULL;
    size_t next = 0;
    for (size_t i = 0; i < expected->count; i++) {
        if (!take_match(comparison, &expected->items[i], got, &next) && missing == NULL) {
            missing = &expected->items[i];
        }
    }
    const Line *extra = first_untaken(got);
    return (missing == NULL && extra == NULL) || differ(comparison, missing, extra, end, nowhere);
}

static bool compare_frames(const Golden *golden, Comparison *comparison, const Frame *expected, Frame *got) {
    bool is_near = golden->tolerance > 0;
    if (!compare_in_order(comparison, &expected->head, &got->head, expected->end)) {
        return false;
    }
    if (is_near && comparison->frame > golden->horizon) {
        return true;
    }
    if (is_near && comparison->frame > golden->strict && comparison->tolerance < LOOSE_TOLERANCE) {
        comparison->tolerance = LOOSE_TOLERANCE;
    }
    return compare_in_order(comparison, &expected->body, &got->body, expected->end) &&
           compare_as_sets(comparison, &expected->logs, &got->logs, expected->end) &&
           (expected->errors.count == 0 || compare_as_sets(comparison, &expected->errors, &got->errors, expected->end));
}

static bool compare_readers(const Golden *golden, Reader *expected, Reader *got, Bytes *trouble) {
    for (;;) {
        bool more_expected = read_frame(expected);
        bool more_got = read_frame(got);
        if (!more_expected && !more_got) {
            return true;
        }
        Comparison comparison = {
            .frame = frame_number(more_expected ? &expected->frame : &got->frame),
            .tolerance = golden->tolerance,
            .trouble = trouble,
        };
        if (!compare_frames(golden, &comparison, &expected->frame, &got->frame)) {
            return false;
        }
    }
}

bool golden_compare(const Golden *golden, const Bytes *output, Bytes *trouble) {
    const char *recorded = golden->text.data + golden->body;
    size_t length = golden->text.length - golden->body;
    if (length == output->length && memcmp(recorded, output->data, length) == 0) {
        return true;
    }
    Reader expected = {.at = recorded, .end = recorded + length, .number = golden->body_line};
    Reader got = {.at = output->data, .end = output->data + output->length, .number = 1};
    bool same = compare_readers(golden, &expected, &got, trouble);
    free_reader(&expected);
    free_reader(&got);
    return same;
}
