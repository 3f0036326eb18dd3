// state_text.c: reads and compares states in printed form.
#include "cli/state_text.h"

#include "base/number.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static int compare_entries(const void *a, const void *b) {
    return str_compare(((const StateEntry *)a)->key, ((const StateEntry *)b)->key);
}

// Returns the length of a key, which ends before ` = `. Strings in a key can contain any characters except their own
// quote, which is then escaped.
static size_t key_length(Str line) {
    char quote = '\0';
    for (size_t i = 0; i + 3 <= line.len; i++) {
        char c = line.bytes[i];
        if (quote != '\0' && c == '\\')
            i++;
        else if (c == '\'' || c == '"')
            quote = quote == '\0' ? c : quote == c ? '\0' : quote;
        else if (quote == '\0' && memcmp(line.bytes + i, " = ", 3) == 0)
            return i;
    }
    return line.len;
}

// Reads a line `$KEY = VALUE` or `$(KEY) = VALUE`. Returns false for other lines.
static bool read_entry(Str line, StateEntry *entry) {
    size_t length = key_length(line);
    if (line.len == 0 || line.bytes[0] != '$' || length == line.len)
        return false;
    bool enclosed = length > 2 && line.bytes[1] == '(';
    entry->key = (Str){line.bytes + 1 + enclosed, length - 1 - 2 * (size_t)enclosed};
    entry->value = (Str){line.bytes + length + 3, line.len - length - 3};
    return true;
}

StateText state_text_read(Str printed) {
    StateText state = {0};
    size_t capacity = 0, at = 0, number = 0;
    const Text text = {.bytes = (char *)printed.bytes, .len = printed.len};
    for (Str line; text_next_line(&text, &at, &line); number++) {
        StateEntry entry = {.line = number};
        if (!read_entry(line, &entry))
            continue;
        if (state.count == capacity) {
            capacity = capacity == 0 ? 64 : 2 * capacity;
            state.entries = memory_realloc(state.entries, capacity * sizeof *state.entries);
        }
        state.entries[state.count++] = entry;
    }
    if (state.count > 0)
        qsort(state.entries, state.count, sizeof *state.entries, compare_entries);
    return state;
}

void state_text_free(StateText *state) {
    free(state->entries);
    *state = (StateText){0};
}

StateDifferences state_text_compare(const StateText *a, const StateText *b) {
    StateDifferences found = {.items = memory_calloc((a->count + b->count) * sizeof *found.items)};
    for (size_t i = 0, j = 0; i < a->count || j < b->count; found.total++) {
        const StateEntry *first = i < a->count ? &a->entries[i] : NULL;
        const StateEntry *second = j < b->count ? &b->entries[j] : NULL;
        int order = !first ? 1 : !second ? -1 : compare_entries(first, second);
        i += order <= 0;
        j += order >= 0;
        if (order == 0 && str_equal(first->value, second->value))
            continue;
        StateDifference *difference = &found.items[found.count++];
        *difference = (StateDifference){.key = order <= 0 ? first->key : second->key,
                                        .line = order <= 0 ? first->line : second->line};
        if (order <= 0)
            difference->values[0] = first->value;
        if (order >= 0)
            difference->values[1] = second->value;
    }
    return found;
}

void state_differences_free(StateDifferences *differences) {
    free(differences->items);
    *differences = (StateDifferences){0};
}

const StateDifference *state_first_difference(const StateDifferences *differences) {
    const StateDifference *first = NULL;
    for (size_t i = 0; i < differences->count; i++)
        if (!first || differences->items[i].line < first->line)
            first = &differences->items[i];
    return first;
}

StateDifference *state_find_difference(const StateDifferences *differences, Str key) {
    size_t low = 0, high = differences->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        int order = str_compare(differences->items[middle].key, key);
        if (order == 0)
            return &differences->items[middle];
        low = order < 0 ? middle + 1 : low;
        high = order < 0 ? high : middle;
    }
    return NULL;
}

// Reads the number at the start of `text` and removes it with the semicolon after it. Returns false if there is none.
static bool take_number(Str *text, double *number) {
    const char *end = memchr(text->bytes, ';', text->len);
    Str word = {text->bytes, end ? (size_t)(end - text->bytes) : text->len};
    bool negative = word.len > 0 && word.bytes[0] == '-';
    Str digits = {word.bytes + negative, word.len - negative};
    bool infinite = str_equal(digits, STR("inf"));
    if (!infinite && (digits.len == 0 || digits.bytes[0] < '0' || digits.bytes[0] > '9'))
        return false;
    double value = infinite ? INFINITY : number_parse(digits);
    *number = negative ? -value : value;
    size_t length = word.len + (end != NULL);
    *text = (Str){text->bytes + length, text->len - length};
    return true;
}

// Returns a number that increases by 1 from each double to the next. -0 and 0 differ by 1.
static uint64_t position_of(double x) {
    uint64_t bits = number_bits(x), sign = UINT64_C(1) << 63;
    return bits & sign ? ~bits : bits | sign;
}

void value_add_ulps(Text *text, Str a, Str b) {
    SCOPED_TEXT distances = {0};
    do {
        double first, second;
        if (!take_number(&a, &first) || !take_number(&b, &second) || (a.len == 0) != (b.len == 0))
            return;
        uint64_t one = position_of(first), other = position_of(second);
        text_add_format(&distances, "%s%" PRIu64, distances.len ? ";" : "", one > other ? one - other : other - one);
    } while (a.len > 0);
    text_add(text, text_str(&distances));
}

void state_add_values(Text *text, const Str *values, const char *const *positions) {
    static const char signs[] = "-+";
    for (int i = 0; i < 2; i++) {
        Str value = values[i].bytes ? values[i] : STR("none");
        text_add_format(text, "%c %.*s%s%s\n", signs[i], STR_ARGS(value), positions[i] ? "  " : "",
                        positions[i] ? positions[i] : "");
    }
    SCOPED_TEXT ulps = {0};
    if (values[0].bytes && values[1].bytes)
        value_add_ulps(&ulps, values[0], values[1]);
    if (ulps.len > 0)
        text_add_format(text, "  distance in ulps: %s\n", ulps.bytes);
}

void state_add_report(Text *text, const char *const *labels, int64_t frame, double time,
                      const StateDifferences *differences, const StateDifference *shown) {
    static const char *const no_positions[2];
    text_add_format(text, "--- %s\n+++ %s\nframe %" PRId64, labels[0], labels[1], frame);
    if (!isnan(time)) {
        text_add_c(text, ", time ");
        text_add_number(text, time);
    }
    text_add_format(text, ": %zu of %zu entries of the state differ\n", differences->count, differences->total);
    bool several = memchr(shown->key.bytes, ';', shown->key.len);
    text_add_format(text, several ? "first: $(%.*s)\n" : "first: $%.*s\n", STR_ARGS(shown->key));
    state_add_values(text, shown->values, no_positions);
}
