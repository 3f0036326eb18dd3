// golden_compare.c: comparison of two outputs, frame by frame (golden.h).
#include "cli/state_text.h"
#include "golden/golden.h"
#include "golden/line_diff.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Tolerance for frames between `strict` and the horizon (conformance/physics/README.md).
static const double LOOSE_TOLERANCE = 1e-4;

enum { EXCERPT_LENGTH = 100, EXCERPT_BEFORE = 30 };

typedef struct Line {
    Str text;
    uint32_t number;
    bool matched; // true if the line agrees with a line of the other output
} Line;

typedef struct LineList {
    Line *items;
    size_t count;
    size_t capacity;
} LineList;

// The sections of a frame. HEAD contains the `@` line, if there is one. BODY contains the tree and the state. The
// lines of LOGS and of ERRORS can be in any order.
typedef enum Section { HEAD, BODY, LOGS, ERRORS, SECTION_COUNT } Section;

// Reads an output frame by frame. Lines before the first `@` line belong to frame 0. Output with only logs has no `@`
// lines.
typedef struct Reader {
    const char *at;
    const char *end;
    const char *start;                // of the last frame that was read
    bool more;                        // false: there was no other frame
    uint32_t number;                  // line number of the next line
    LineList sections[SECTION_COUNT]; // lines of the last frame that was read
} Reader;

static void add_line(LineList *list, Str text, uint32_t number) {
    if (list->count == list->capacity) {
        list->capacity = list->capacity == 0 ? 64 : 2 * list->capacity;
        list->items = memory_realloc(list->items, list->capacity * sizeof *list->items);
    }
    list->items[list->count++] = (Line){.text = text, .number = number};
}

static Str read_line(Reader *reader) {
    size_t rest = (size_t)(reader->end - reader->at);
    const char *start = reader->at, *end = memchr(start, '\n', rest);
    reader->at = !end ? reader->end : end + 1;
    reader->number++;
    return (Str){start, !end ? rest : (size_t)(end - start)};
}

// Reads the next frame. At the end of the output, sets `more` to false.
static void read_frame(Reader *reader) {
    const char *start = reader->start = reader->at;
    for (int i = 0; i < SECTION_COUNT; i++)
        reader->sections[i].count = 0;
    while (reader->at < reader->end && (reader->at == start || *reader->at != '@')) {
        char first = *reader->at;
        Section section = first == '@' ? HEAD : first == '>' ? LOGS : first == '?' ? ERRORS : BODY;
        uint32_t number = reader->number;
        Str text = read_line(reader);
        // Indented lines continue a log or error text.
        while (section >= LOGS && reader->at < reader->end && *reader->at == ' ') {
            Str more = read_line(reader);
            text.len = (size_t)(more.bytes + more.len - text.bytes);
        }
        add_line(&reader->sections[section], text, number);
    }
    reader->more = reader->at > start;
}

static void free_reader(Reader *reader) {
    for (int i = 0; i < SECTION_COUNT; i++)
        free(reader->sections[i].items);
}

static int64_t frame_number(const Reader *reader) {
    return reader->sections[HEAD].count == 0 ? 0 : strtoll(reader->sections[HEAD].items[0].text.bytes + 1, NULL, 10);
}

// Adds an excerpt of a line around the offset `at`.
static void add_excerpt(Text *error_text, Str line, size_t at) {
    size_t start = line.len <= EXCERPT_LENGTH || at <= EXCERPT_BEFORE ? 0 : at - EXCERPT_BEFORE;
    // Do not split a UTF-8 character.
    while (start > 0 && ((unsigned char)line.bytes[start] & 0xC0U) == 0x80U)
        start--;
    size_t end = line.len - start <= EXCERPT_LENGTH ? line.len : start + EXCERPT_LENGTH;
    while (end < line.len && ((unsigned char)line.bytes[end] & 0xC0U) == 0x80U)
        end++;
    text_add_c(error_text, start > 0 ? "..." : "");
    for (size_t i = start; i < end; i++)
        if (line.bytes[i] == '\n')
            text_add_format(error_text, "\\n");
        else
            text_add_char(error_text, line.bytes[i]);
    text_add_c(error_text, end < line.len ? "..." : "");
}

typedef struct Comparison {
    int64_t frame;
    double tolerance;
    Result *result; // NULL: only the answer is wanted
} Comparison;

// Describes a difference in the result. `expected` is a line of the golden; if it is NULL, the golden
// has no such line and the difference is reported at line number `line`. `got` is the line of the current output, or
// NULL if there is none. Always returns false.
static bool report_difference(const Comparison *comparison, const Line *expected, const Line *got, uint32_t line,
                              LineDifference where) {
    if (!comparison->result)
        return false;
    Text *error_text = &comparison->result->error_text;
    comparison->result->line = !expected ? line : expected->number;
    text_add_format(error_text, "frame %" PRId64 ": expected ", comparison->frame);
    if (!expected)
        text_add_format(error_text, "nothing more");
    else
        add_excerpt(error_text, expected->text, where.expected_at);
    text_add_format(error_text, ", got ");
    if (!got)
        text_add_format(error_text, "nothing");
    else
        add_excerpt(error_text, got->text, where.got_at);
    return false;
}

static bool compare_in_order(const Comparison *comparison, const LineList *expected, const LineList *got,
                             uint32_t end) {
    for (size_t i = 0; i < expected->count || i < got->count; i++) {
        const Line *first = i < expected->count ? &expected->items[i] : NULL;
        const Line *second = i < got->count ? &got->items[i] : NULL;
        LineDifference where = {0};
        if (!first || !second || !line_same(first->text, second->text, comparison->tolerance, &where))
            return report_difference(comparison, first, second, end, where);
    }
    return true;
}

// Finds a line in `set` that agrees with `wanted`, and marks it as matched. The search starts at *next, the line after
// the previous match, because both outputs usually have their lines in the same order.
static bool claim_match(const Comparison *comparison, const Line *wanted, LineList *set, size_t *next) {
    for (size_t i = 0; i < set->count; i++) {
        Line *line = &set->items[(*next + i) % set->count];
        LineDifference where;
        if (!line->matched && line_same(wanted->text, line->text, comparison->tolerance, &where)) {
            line->matched = true;
            *next = *next + i + 1;
            return true;
        }
    }
    return false;
}

static const Line *first_unmatched(const LineList *set) {
    for (size_t i = 0; i < set->count; i++)
        if (!set->items[i].matched)
            return &set->items[i];
    return NULL;
}

static bool compare_as_sets(const Comparison *comparison, const LineList *expected, LineList *got, uint32_t end) {
    const LineDifference nowhere = {0};
    const Line *missing = NULL;
    size_t next = 0;
    for (size_t i = 0; i < expected->count; i++)
        if (!claim_match(comparison, &expected->items[i], got, &next) && !missing)
            missing = &expected->items[i];
    const Line *extra = first_unmatched(got);
    return (!missing && !extra) || report_difference(comparison, missing, extra, end, nowhere);
}

static bool compare_frames(const Golden *golden, Comparison *comparison, const Reader *expected, Reader *got) {
    const LineList *first = expected->sections;
    LineList *second = got->sections;
    bool is_near = golden->tolerance > 0;
    if (!compare_in_order(comparison, &first[HEAD], &second[HEAD], expected->number))
        return false;
    if (is_near && comparison->frame > golden->horizon)
        return true;
    if (is_near && comparison->frame > golden->strict && comparison->tolerance < LOOSE_TOLERANCE)
        comparison->tolerance = LOOSE_TOLERANCE;
    return compare_in_order(comparison, &first[BODY], &second[BODY], expected->number) &&
           compare_as_sets(comparison, &first[LOGS], &second[LOGS], expected->number) &&
           (first[ERRORS].count == 0 || compare_as_sets(comparison, &first[ERRORS], &second[ERRORS], expected->number));
}

// Returns the text of the last frame that was read.
static Str frame_text(const Reader *reader) {
    return (Str){reader->start, (size_t)(reader->at - reader->start)};
}

// Adds the number of entries of the state that differ in a frame, and the distance of the first one.
static void report_state(const Reader *expected, const Reader *got, Text *text) {
    StateText a = state_text_read(frame_text(expected)), b = state_text_read(frame_text(got));
    StateDifferences differences = state_text_compare(&a, &b);
    const StateDifference *first = state_first_difference(&differences);
    SCOPED_TEXT ulps = {0};
    if (first && first->values[0].bytes && first->values[1].bytes)
        value_add_ulps(&ulps, first->values[0], first->values[1]);
    if (first)
        text_add_format(text, "frame %" PRId64 ": %zu of %zu entries of the state differ\n", frame_number(expected),
                        differences.count, differences.total);
    if (ulps.len > 0)
        text_add_format(text, "distance of the first one in ulps: %s\n", ulps.bytes);
    state_differences_free(&differences);
    state_text_free(&a);
    state_text_free(&b);
}

// Adds the frames that both readers have read to the diff, and reads the next ones. If only one has such a frame, the
// other one waits. The first difference is put into the result, and the entries of the state that differ there into
// `state`.
static void compare_pair(const Golden *golden, Reader *expected, Reader *got, LineDiff *diff, Result *result,
                         Text *state) {
    Reader none = {.number = expected->number};
    bool only_expected = !got->more || (expected->more && frame_number(expected) < frame_number(got));
    bool only_got = !expected->more || (got->more && frame_number(got) < frame_number(expected));
    Reader *first = only_got ? &none : expected, *second = only_expected ? &none : got;
    Comparison comparison = {
        .frame = frame_number(only_got ? got : expected),
        .tolerance = golden->tolerance,
        .result = result->line == 0 ? result : NULL,
    };
    bool reported = result->line > 0;
    if (compare_frames(golden, &comparison, first, second)) {
        line_diff_skip(diff, frame_text(first), comparison.frame);
    } else {
        line_diff_add(diff, frame_text(first), frame_text(second), comparison.tolerance, comparison.frame);
        // With a tolerance, numbers may differ.
        if (!reported && first == expected && second == got && golden->tolerance == 0)
            report_state(expected, got, state);
    }
    if (!only_got)
        read_frame(expected);
    if (!only_expected)
        read_frame(got);
}

bool golden_compare(const Golden *golden, const Text *output, Result *result) {
    const char *recorded = golden->text.bytes + golden->body;
    size_t length = golden->text.len - golden->body;
    if (length == output->len && memcmp(recorded, output->bytes, length) == 0)
        return true;
    Reader expected = {.at = recorded, .end = recorded + length, .number = golden->body_line};
    Reader got = {.at = output->bytes, .end = output->bytes + output->len, .number = 1};
    LineDiff diff = {0};
    SCOPED_TEXT state = {0};
    result->line = 0;
    for (read_frame(&expected), read_frame(&got); expected.more || got.more;)
        compare_pair(golden, &expected, &got, &diff, result, &state);
    if (result->line > 0) {
        line_diff_print(&diff, golden->body_line, "frame", &result->details);
        text_add(&result->details, text_str(&state));
    }
    free(diff.edits);
    free_reader(&expected);
    free_reader(&got);
    return result->line == 0;
}
