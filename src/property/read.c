// read.c: reads NAME.properties; see property.h.
#include "base/file.h"
#include "base/source.h"
#include "property/property.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Reader {
    Properties *properties;
    uint32_t line;
} Reader;

__attribute__((format(printf, 2, 3))) static bool fail(const Reader *reader, const char *format, ...) {
    SCOPED_TEXT text = {0};
    va_list list;
    va_start(list, format);
    text_add_va(&text, format, list);
    va_end(list);
    message("%s:%" PRIu32 ": error: %s", reader->properties->file, reader->line, text.bytes);
    return false;
}

// Removes blanks at both ends.
static Str trim(Str text) {
    while (text.len > 0 && strchr(" \t\r", text.bytes[0]))
        text = (Str){text.bytes + 1, text.len - 1};
    while (text.len > 0 && strchr(" \t\r", text.bytes[text.len - 1]))
        text.len--;
    return text;
}

// Removes a word at the start. Returns false if the text begins with something else.
static bool take(Str *text, const char *word) {
    size_t length = strlen(word);
    if (text->len < length || memcmp(text->bytes, word, length) != 0 ||
        (text->len > length && !strchr(" \t", text->bytes[length])))
        return false;
    *text = trim((Str){text->bytes + length, text->len - length});
    return true;
}

static bool read_number(Str text, double *number) {
    SCOPED_STRING word = memory_strndup(text.bytes, text.len);
    char *end = NULL;
    *number = strtod(word, &end);
    return text.len > 0 && *end == '\0' && isfinite(*number);
}

// --- ranges

static Range *find_range(Properties *properties, const char *name) {
    for (size_t i = 0; i < properties->range_count; i++)
        if (strcmp(properties->ranges[i].name, name) == 0)
            return &properties->ranges[i];
    return NULL;
}

static Range *add_range(Properties *properties, const char *name) {
    size_t count = properties->range_count;
    properties->ranges = memory_realloc(properties->ranges, (count + 1) * sizeof *properties->ranges);
    properties->ranges[count] = (Range){.name = memory_strdup(name), .usual = NAN};
    return &properties->ranges[properties->range_count++];
}

static bool is_whole(double number) {
    return number == floor(number);
}

// With `let N=N or 5`, the script would use the default instead of 0.
static void avoid_zero(Range *range) {
    if (!range->zero && range->min == 0)
        range->min = range->whole ? 1 : range->max / 1000;
}

// Adds the parameters of the script whose comments have ranges.
static void add_parameters(Properties *properties, PetriSession *session) {
    PetriParameter parameter;
    for (size_t i = 0; petri_parameter(session, i, &parameter, sizeof parameter); i++) {
        if (!parameter.settable || isnan(parameter.default_number))
            continue;
        Range *range = add_range(properties, parameter.name);
        range->usual = parameter.default_number;
        range->min = isfinite(parameter.min) ? parameter.min : range->usual;
        range->max = isfinite(parameter.max) ? parameter.max : range->usual;
        range->whole =
            is_whole(range->usual) && is_whole(range->min) && is_whole(range->max) && is_whole(parameter.step);
        range->zero = parameter.accepts_false || range->usual == 0;
        avoid_zero(range);
    }
}

// Reads `NAME in MIN..MAX`. As in the language, a range of integers does not contain MAX.
static bool read_range(const Reader *reader, Str text) {
    const char *blank = memchr(text.bytes, ' ', text.len);
    Str rest = blank ? trim((Str){blank, (size_t)(text.bytes + text.len - blank)}) : (Str){0};
    SCOPED_STRING name = memory_strndup(text.bytes, blank ? (size_t)(blank - text.bytes) : text.len);
    if (!take(&rest, "in"))
        return fail(reader, "expected 'over NAME in MIN..MAX'");
    SCOPED_STRING whole = memory_strndup(rest.bytes, rest.len);
    char *dots = strstr(whole, "..");
    double min = 0, max = 0;
    bool good = dots && (dots == whole || read_number((Str){whole, (size_t)(dots - whole)}, &min)) &&
                read_number(str_from(dots + 2), &max);
    bool integers =
        good && is_whole(min) && is_whole(max) && !memchr(whole, '.', (size_t)(dots - whole)) && !strchr(dots + 2, '.');
    max -= integers ? 1 : 0;
    if (!good || max < min)
        return fail(reader, "expected a range such as ..100, 2..50 or 0.5..2.0, not '%s'", whole);
    Range *range = find_range(reader->properties, name);
    if (!range)
        return fail(reader, "the script has no parameter '%s' with a number as its default", name);
    *range = (Range){
        .name = range->name, .min = min, .max = max, .usual = range->usual, .whole = integers, .zero = range->zero};
    avoid_zero(range);
    return true;
}

// --- lines

static bool add_property(const Reader *reader, PropertyKind kind, Str line, Str expression, double amount) {
    Properties *properties = reader->properties;
    properties->items = memory_realloc(properties->items, (properties->count + 1) * sizeof *properties->items);
    properties->items[properties->count++] = (Property){
        .kind = kind,
        .text = memory_strndup(line.bytes, line.len),
        .expression = expression.len > 0 ? memory_strndup(expression.bytes, expression.len) : NULL,
        .line = reader->line,
        .amount = amount,
    };
    return true;
}

// Reads `within X%` or `within X`. Leaves the amount as it is if there is nothing.
static bool read_amount(const Reader *reader, Str rest, double *amount) {
    if (rest.len == 0)
        return true;
    bool within = take(&rest, "within"), percent = rest.len > 0 && rest.bytes[rest.len - 1] == '%';
    rest.len -= percent ? 1 : 0;
    if (!within || !read_number(trim(rest), amount) || *amount < 0)
        return fail(reader, "expected 'within NUMBER%%'");
    *amount = percent ? *amount / 100 : *amount;
    return true;
}

static bool read_expression(const Reader *reader, PropertyKind kind, Str line, Str expression) {
    return expression.len > 0 ? add_property(reader, kind, line, expression, 0)
                              : fail(reader, "expected an expression");
}

// Properties that are words.
static const struct {
    const char *words;
    PropertyKind kind;
    bool has_amount;
    double amount;
} NAMED[] = {
    {"finite", PROPERTY_FINITE, false, 0},
    {"inside BARRIERS", PROPERTY_INSIDE, true, 1e-3},
    {"inside barriers", PROPERTY_INSIDE, true, 1e-3},
    {"conserves momentum", PROPERTY_MOMENTUM, true, 1e-9},
    {"conserves energy", PROPERTY_ENERGY, true, 0.01},
    {"settles", PROPERTY_SETTLES, true, 0.001},
    {"independent of order", PROPERTY_ORDER, true, 1e-6},
    {"stable under half steps", PROPERTY_HALF_STEPS, true, 0.01},
};

static bool read_setting(const Reader *reader, Str rest, double min, double *value) {
    return (read_number(rest, value) && *value >= min) || fail(reader, "expected a number from %g", min);
}

// Reads a line without the ranges at its end.
static bool read_statement(const Reader *reader, Str line) {
    Properties *properties = reader->properties;
    Str rest = line;
    double number = 0;
    if (take(&rest, "always"))
        return read_expression(reader, PROPERTY_ALWAYS, line, rest);
    if (take(&rest, "never"))
        return read_expression(reader, PROPERTY_NEVER, line, rest);
    if (take(&rest, "finally"))
        return read_expression(reader, PROPERTY_FINALLY, line, rest);
    if (take(&rest, "frames") && read_setting(reader, rest, 1, &number)) {
        properties->frames = (int64_t)number;
        return true;
    }
    if (take(&rest, "cases") && read_setting(reader, rest, 1, &number)) {
        properties->cases = (int64_t)number;
        return true;
    }
    if (take(&rest, "seconds"))
        return read_setting(reader, rest, 0.1, &properties->seconds);
    for (size_t i = 0; i < sizeof NAMED / sizeof NAMED[0]; i++) {
        double amount = NAMED[i].amount;
        if (!take(&rest, NAMED[i].words))
            continue;
        if (rest.len > 0 && !NAMED[i].has_amount)
            return fail(reader, "unexpected '%.*s'", STR_ARGS(rest));
        return read_amount(reader, rest, &amount) && add_property(reader, NAMED[i].kind, line, (Str){0}, amount);
    }
    if (rest.len != line.len)
        return false; // after a message
    return fail(reader,
                "expected always, never or finally and an expression, or a property such as finite; see the manual");
}

// Finds ` over NAME in ` outside strings. Returns NULL if there is none.
static const char *find_over(Str line) {
    char quote = '\0';
    for (size_t i = 0; i + 6 < line.len; i++) {
        char c = line.bytes[i];
        quote = quote ? (c == quote ? '\0' : quote) : c == '"' || c == '\'' ? c : '\0';
        if (!quote && memcmp(line.bytes + i, " over ", 6) == 0)
            return line.bytes + i;
    }
    return NULL;
}

static bool read_line(const Reader *reader, Str line) {
    line = trim(line);
    if (line.len == 0 || line.bytes[0] == '#' || (line.len > 1 && memcmp(line.bytes, "--", 2) == 0))
        return true;
    if (take(&line, "over"))
        return read_range(reader, line);
    const char *over = find_over(line);
    Str statement = over ? trim((Str){line.bytes, (size_t)(over - line.bytes)}) : line;
    if (over) {
        Str range = trim((Str){over + 5, (size_t)(line.bytes + line.len - over - 5)});
        if (!read_range(reader, range))
            return false;
    }
    return read_statement(reader, statement);
}

static bool read_script(Properties *properties) {
    double *none = NULL;
    Attempt attempt = {.properties = properties, .values = none, .deadline = INFINITY};
    PetriSession *session = attempt_open(&attempt, NULL);
    if (session)
        add_parameters(properties, session);
    else
        message("%s: the script cannot be loaded: %s", properties->script, attempt.first_problem.bytes);
    bool good = session;
    petri_close(&session);
    text_free(&attempt.first_problem);
    return good;
}

bool properties_read(Properties *properties, const CommandContext *host, const char *file) {
    SCOPED_TEXT text = {0};
    *properties = (Properties){.host = host, .file = memory_strdup(file), .frames = 120, .cases = 100, .seconds = 5};
    size_t length = strlen(file) - (str_ends_with(str_from(file), STR(".properties")) ? strlen(".properties") : 0);
    Text script = {0};
    text_add_format(&script, "%.*s.fl", (int)length, file);
    properties->script = script.bytes;
    const char *problem = text_read_file(&text, file, SIZE_MAX);
    if (problem) {
        message("cannot read %s: %s", file, problem);
        return false;
    }
    if (!read_script(properties))
        return false;
    Reader reader = {.properties = properties};
    text.len = text.len > 0 ? source_unify_lines(text.bytes, text.len) : 0;
    size_t at = 0;
    for (Str line; text_next_line(&text, &at, &line);) {
        reader.line++;
        if (!read_line(&reader, line))
            return false;
    }
    reader.line = 1;
    kept_read(properties);
    return properties->count > 0 || fail(&reader, "the file has no property");
}

void properties_free(Properties *properties) {
    for (size_t i = 0; i < properties->count; i++) {
        free(properties->items[i].text);
        free(properties->items[i].expression);
    }
    for (size_t i = 0; i < properties->range_count; i++)
        free(properties->ranges[i].name);
    free(properties->items);
    free(properties->ranges);
    free(properties->file);
    free(properties->script);
    texts_free(&properties->kept);
}
