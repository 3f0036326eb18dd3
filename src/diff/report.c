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

static void add_string(Text *out, const char *name, Str value) {
    SCOPED_STRING copy = value.bytes ? memory_strndup(value.bytes, value.len) : NULL;
    text_add_format(out, ",\"%s\":", name);
    json_add_text(out, copy);
}

static void add_ulps(Text *out, const Str *values) {
    SCOPED_TEXT ulps = {0};
    if (values[0].bytes && values[1].bytes)
        value_add_ulps(&ulps, values[0], values[1]);
    add_string(out, "ulps", ulps.len > 0 ? text_str(&ulps) : (Str){NULL, 0});
}

static void add_row(Text *out, const char *name, const ForceRow *row) {
    text_add_format(out, ",\"%s\":", name);
    if (!row->name) {
        text_add_c(out, "null");
        return;
    }
    text_add_c(out, "{\"kind\":");
    json_add_text(out, row->name);
    add_string(out, "from", strcmp(row->partner, "-") == 0 ? (Str){NULL, 0} : str_from(row->partner));
    add_string(out, "contribution", str_from(row->vector));
    add_string(out, "position", strcmp(row->position, "-") == 0 ? (Str){NULL, 0} : str_from(row->position));
    text_add_c(out, "}");
}

void report_json(const DiffReport *report, Text *out) {
    const Side *sides = report->sides;
    const ForceDifference *force = report->force;
    const StateDifference *first = first_entry(report);
    double time = isnan(sides[0].time) ? sides[1].time : sides[0].time;
    text_add_c(out, "{\"same\":false,\"a\":");
    json_add_text(out, sides[0].label.bytes);
    add_string(out, "b", text_str(&sides[1].label));
    text_add_format(out, ",\"frame\":%" PRId64, sides[0].frame);
    text_add_c(out, ",\"time\":");
    if (isnan(time))
        text_add_c(out, "null");
    else
        text_add_number(out, time);
    text_add_format(out, ",\"entries\":%zu,\"differing\":%zu", report->differences->total, report->differences->count);
    text_add_c(out, ",\"first\":{\"key\":");
    SCOPED_STRING key = memory_strndup(first->key.bytes, first->key.len);
    json_add_text(out, key);
    add_string(out, "a", first->values[0]);
    add_string(out, "b", first->values[1]);
    add_ulps(out, first->values);
    text_add_c(out, "},\"force\":");
    if (force->particle.len == 0 || !(force->rows[0].name || force->rows[1].name)) {
        text_add_c(out, "null}\n");
        return;
    }
    text_add_c(out, "{\"particle\":");
    json_add_text(out, force->particle.bytes);
    text_add_format(out, ",\"step\":%" PRIu64 ",\"steps\":%" PRIu64, force->step, force->steps);
    add_row(out, "a", &force->rows[0]);
    add_row(out, "b", &force->rows[1]);
    const Str values[] = {text_or_none(force->rows[0].vector), text_or_none(force->rows[1].vector)};
    add_ulps(out, values);
    text_add_c(out, "}}\n");
}
