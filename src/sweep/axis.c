// axis.c: parser for the values of a name: `1;5;20`, `1..10|0.5`, both mixed, or vectors in parentheses: `(1;2);(3;4)`.
#include "petri-edit.h"
#include "sweep/sweep.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VALUES = 1000000 };

// Returns the length of the first item of a list. A semicolon outside parentheses ends it.
static size_t item_length(const char *text) {
    int depth = 0;
    size_t length = 0;
    for (; text[length] != '\0' && (depth > 0 || text[length] != ';'); length++)
        depth += text[length] == '(' ? 1 : text[length] == ')' ? -1 : 0;
    return length;
}

static bool read_number(const char *text, size_t length, double *x) {
    SCOPED_STRING number = memory_strndup(text, length);
    return petri_parse_number(number, x) && isfinite(*x);
}

typedef struct Range {
    double min;
    double max;
    double step; // 0: not given
} Range;

// Parses `MIN..MAX` or `MIN..MAX|STEP`. Returns false if the item is something else.
static bool read_range(const char *item, Range *range) {
    const char *dots = strstr(item, "..");
    const char *bar = !dots ? NULL : strchr(dots, '|');
    if (!dots || !read_number(item, (size_t)(dots - item), &range->min))
        return false;
    const char *max = dots + 2;
    range->step = 0;
    return read_number(max, !bar ? strlen(max) : (size_t)(bar - max), &range->max) &&
           (!bar || (read_number(bar + 1, strlen(bar + 1), &range->step) && range->step > 0));
}

// Returns the value as a cell of the lowest kind that it has, but at least `min`. Numbers are what the language reads
// as numbers. Integers have only digits and a sign and fit int64_t; -0 is not an integer.
static Cell read_value(const char *value, CellKind min) {
    Cell cell = {CELL_INTEGER, {.integer = 0}};
    char *end = NULL;
    errno = 0;
    cell.as.integer = strtoll(value, &end, 10);
    bool negative_zero = cell.as.integer == 0 && value[0] == '-';
    if (min <= CELL_INTEGER && end != value && *end == '\0' && errno == 0 && !negative_zero)
        return cell;
    cell.kind = CELL_NUMBER;
    if (min <= CELL_NUMBER && petri_parse_number(value, &cell.as.number))
        return cell;
    return (Cell){CELL_TEXT, {.text = value}};
}

static void add_value(Axis *axis, const char *value) {
    axis->kind = read_value(value, axis->kind).kind;
    texts_add(&axis->values, value);
}

// Adds the values of a range, rounded to twelve digits, so that 0..1|0.1 contains 0.3, not 0.30000000000000004. Whole
// numbers with more digits are not rounded.
static bool add_range(Axis *axis, const Range *range) {
    double step = range->step > 0 ? range->step : 1;
    double count = floor((range->max - range->min) / step + 1e-9) + 1;
    if (!(count >= 1 && count <= MAX_VALUES)) {
        message(count < 1
                    ? "-D %s: empty range %.12g..%.12g"
                    : "-D %s: the range %.12g..%.12g has more than a million values; use a larger step with '|STEP'",
                axis->name, range->min, range->max);
        return false;
    }
    for (int i = 0; i < (int)count; i++) {
        char value[32];
        double x = range->min + i * step;
        snprintf(value, sizeof value, "%.12g", x);
        if (x == floor(x) && fabs(x) < 1e18 && strtod(value, NULL) != x)
            snprintf(value, sizeof value, "%.0f", x);
        add_value(axis, value);
    }
    return true;
}

static bool add_item(Axis *axis, const char *item, bool alone) {
    size_t length = strlen(item);
    Range range;
    if (length == 0 && !alone) {
        message("-D %s: empty value; write a list as 1;5;20", axis->name);
        return false;
    }
    if (item[0] == '(' && item[length - 1] == ')') {
        SCOPED_STRING inner = memory_strndup(item + 1, length - 2);
        add_value(axis, inner);
        return true;
    }
    const char *dots = strstr(item, "..");
    double min = 0;
    if (!read_range(item, &range)) {
        if (dots && read_number(item, (size_t)(dots - item), &min)) {
            message("-D %s: not a range: '%s'; write 1..10, or 1..10|0.5 with a positive step", axis->name, item);
            return false;
        }
        const char *minus = length > 0 ? strchr(item + 1, '-') : NULL;
        if (minus && read_number(item, (size_t)(minus - item), &min) &&
            read_number(minus + 1, strlen(minus + 1), &min)) {
            message("-D %s: not a number: '%s'; write a range as %.*s..%s", axis->name, item, (int)(minus - item), item,
                    minus + 1);
            return false;
        }
        add_value(axis, item);
        return true;
    }
    axis->continuous = alone && range.step == 0 && range.max > range.min;
    axis->min = range.min;
    axis->max = range.max;
    return add_range(axis, &range);
}

bool axis_read(Axis *axis, const char *text) {
    size_t name = strcspn(text, "=");
    *axis = (Axis){.name = memory_strndup(text, name)};
    const char *list = text + name + 1;
    bool alone = item_length(list) == strlen(list);
    for (;;) {
        size_t length = item_length(list);
        SCOPED_STRING item = memory_strndup(list, length);
        if (!add_item(axis, item, alone))
            return false;
        if (list[length] == '\0')
            return true;
        list += length + 1;
    }
}

Cell axis_cell(const Axis *axis, const char *value) {
    return read_value(value, axis->kind);
}

static void add_element(Text *out, const char *element) {
    double x = 0;
    if (petri_parse_number(element, &x)) {
        text_add_format(out, "(%.17g)", x);
    } else if (element[0] == ':' && element[1] != '\0') {
        text_add_c(out, element);
    } else {
        text_add_format(out, "'");
        for (const char *c = element; *c != '\0'; c++)
            text_add_format(out, *c == '\'' || *c == '\\' ? "\\%c" : "%c", *c);
        text_add_format(out, "'");
    }
}

void axis_add_literal(Text *out, const char *value) {
    SCOPED_STRING copy = memory_strdup(value);
    char *rest = copy;
    text_add_format(out, "(");
    for (const char *element = str_split(&rest, ';'); element; element = str_split(&rest, ';')) {
        add_element(out, element);
        text_add_format(out, !rest ? "" : ";");
    }
    text_add_format(out, ")");
}
