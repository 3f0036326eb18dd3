// report.c: the report of the first frame that differs, as text or JSON.
#include "base/number.h"
#include "cli/json.h"
#include "diff/diff.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Returns the entry to show: the first printed one that is not of a particle, else that of the first particle in
// document order.
static const StateDifference *first_entry(const DiffReport *report) {
    const StateDifferences *differences = report->differences;
    const StateDifference *first = NULL;
    SCOPED_TEXT velocity = {0};
    for (size_t i = 0; i < differences->count; i++) {
        const StateDifference *item = &differences->items[i];
        if (!item->of_particle && (!first || item->line < first->line))
            first = item;
    }
    if (first || report->force->first.len == 0)
        return first ? first : state_first_difference(differences);
    text_add_format(&velocity, "%s;:velocity", report->force->first.bytes);
    first = state_find_difference(differences, text_str(&report->force->first));
    return first ? first : state_find_difference(differences, text_str(&velocity));
}

static Str text_or_none(const char *text) {
    return text ? str_from(text) : (Str){NULL, 0};
}

static void add_force(const ForceDifference *force, Text *text) {
    const ForceRow *rows = force->rows, *named = rows[0].name ? &rows[0] : &rows[1];
    if (!named->name) {
        if (force->cause.len > 0)
            text_add_format(text, "the forces on %s are the same; %s\n", force->particle.bytes, force->cause.bytes);
        return;
    }
    text_add_format(text, "force on %s, step %" PRIu64 " of %" PRIu64 ": %s", force->particle.bytes, force->step + 1,
                    force->steps, named->name);
    text_add_format(text, strcmp(named->partner, "-") == 0 ? "\n" : " from %s\n", named->partner);
    const Str values[] = {text_or_none(rows[0].vector), text_or_none(rows[1].vector)};
    const char *const positions[] = {rows[0].position, rows[1].position};
    if (rows[0].name && rows[1].name && strcmp(rows[0].name, rows[1].name) != 0)
        text_add_format(text, "  (the second run has %s here)\n", rows[1].name);
    state_add_values(text, values, positions);
}

void report_text(const DiffReport *report, Text *text) {
    const Side *sides = report->sides;
    const char *const labels[] = {sides[0].label.bytes, sides[1].label.bytes};
    double time = isnan(sides[0].time) ? sides[1].time : sides[0].time;
    state_add_report(text, labels, sides[0].frame, time, report->differences, first_entry(report));
    if (report->force->particle.len > 0)
        add_force(report->force, text);
    const Text *attributes = &report->force->attributes;
    size_t at = 0;
    for (Str line; text_next_line(attributes, &at, &line);)
        text_add_format(text, "its attributes differ: %.*s\n", STR_ARGS(line));
}

// --- JSON

static void put_ulps(JsonWriter *json, const Str *values) {
    SCOPED_TEXT ulps = {0};
    if (values[0].bytes && values[1].bytes)
        value_add_ulps(&ulps, values[0], values[1]);
    json_put_str(json, "ulps", ulps.len > 0 ? text_str(&ulps) : (Str){NULL, 0});
}

static const char *word_or_null(const char *word) {
    return strcmp(word, "-") == 0 ? NULL : word;
}

static void put_row(JsonWriter *json, const char *name, const ForceRow *row) {
    if (!row->name) {
        json_put_text(json, name, NULL);
        return;
    }
    JSON_PUT_OBJECT(json, name, "kind", row->name, "from", word_or_null(row->partner), "contribution", row->vector,
                    "position", word_or_null(row->position));
}

static void put_force(JsonWriter *json, const ForceDifference *force) {
    const Str values[] = {text_or_none(force->rows[0].vector), text_or_none(force->rows[1].vector)};
    json_open(json, "force", "{");
    json_put_text(json, "particle", force->particle.bytes);
    json_put_integer(json, "step", (int64_t)force->step);
    json_put_integer(json, "steps", (int64_t)force->steps);
    put_row(json, "a", &force->rows[0]);
    put_row(json, "b", &force->rows[1]);
    put_ulps(json, values);
    json_close(json, "}");
}

void report_json(const DiffReport *report, Text *out) {
    const Side *sides = report->sides;
    const ForceDifference *force = report->force;
    const StateDifference *first = first_entry(report);
    JsonWriter json = {.out = out};
    json_open(&json, NULL, "{");
    json_put_bool(&json, "same", false);
    JSON_PUT_TEXTS(&json, "a", sides[0].label.bytes, "b", sides[1].label.bytes);
    json_put_integer(&json, "frame", sides[0].frame);
    json_put_number(&json, "time", isnan(sides[0].time) ? sides[1].time : sides[0].time);
    json_put_integer(&json, "entries", (int64_t)report->differences->total);
    json_put_integer(&json, "differing", (int64_t)report->differences->count);
    json_open(&json, "first", "{");
    json_put_str(&json, "key", first->key);
    json_put_str(&json, "a", first->values[0]);
    json_put_str(&json, "b", first->values[1]);
    put_ulps(&json, first->values);
    json_close(&json, "}");
    if (force->particle.len > 0 && (force->rows[0].name || force->rows[1].name))
        put_force(&json, force);
    else
        json_put_text(&json, "force", NULL);
    json_close(&json, "}\n");
}
