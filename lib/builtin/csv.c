// csv.c: rows of comma-separated files (spec builtins.md B13.5).
//
// The cache holds the file and the offsets of its rows. The fields of a row are parsed on demand, so a frame pays only
// for the rows of a large table that it uses.
#include "base/number.h"
#include "builtin/family.h"
#include "builtin/files.h"

#include <math.h>
#include <string.h>
#include <strings.h>

typedef struct CsvFile {
    Str contents;
    const uint32_t *row_starts;
    uint32_t row_count;
} CsvFile;

// --- fields

// Scans the field at *at and moves *at past the separator that ends the field. Copies the field's text, without its
// quotes, to `out` unless `out` is NULL. Sets *last if the separator was a line end or the end of the file. Returns the
// length of the text, which is at most the length of the field.
static size_t scan_field(Str in, size_t *at, char *out, bool *last) {
    size_t i = *at, len = 0;
    if (i < in.len && in.bytes[i] == '"') {
        i++;
        while (i < in.len) {
            char c = in.bytes[i++];
            if (c == '"' && (i == in.len || in.bytes[i] != '"'))
                break;
            i += c == '"'; // skips the second of two quotes, which represent one quote
            if (out)
                out[len] = c;
            len++;
        }
    }
    for (; i < in.len && in.bytes[i] != ',' && in.bytes[i] != '\n' && in.bytes[i] != '\r'; i++) {
        if (out)
            out[len] = in.bytes[i];
        len++;
    }
    *last = i == in.len || in.bytes[i] != ',';
    if (i + 1 < in.len && in.bytes[i] == '\r' && in.bytes[i + 1] == '\n')
        i++;
    *at = i < in.len ? i + 1 : i;
    return len;
}

// Returns the number of fields of the row at `at`, not counting empty fields at its end. Sets *end to the start of the
// next row.
static size_t scan_row(Str in, size_t at, size_t *end) {
    size_t fields = 0, kept = 0;
    for (bool last = false; !last;) {
        size_t len = scan_field(in, &at, NULL, &last);
        fields++;
        kept = len ? fields : kept;
    }
    *end = at;
    return kept;
}

// --- numbers

// Returns the length of an unsigned decimal number at the start of the text, or 0 if there is none. A number has
// digits, single underscores between digits, at most one point next to a digit, and an optional exponent.
static size_t scan_decimal(Str text) {
    size_t whole = builtin_scan_digits(text), at = whole, part = 0;
    if (at < text.len && text.bytes[at] == '.') {
        at++;
        part = builtin_scan_digits((Str){text.bytes + at, text.len - at});
        at += part;
    }
    if (whole + part == 0)
        return 0;
    if (at < text.len && (text.bytes[at] == 'e' || text.bytes[at] == 'E')) {
        size_t exponent = at + 1;
        exponent += exponent < text.len && (text.bytes[exponent] == '+' || text.bytes[exponent] == '-');
        size_t digits = builtin_scan_digits((Str){text.bytes + exponent, text.len - exponent});
        at = digits ? exponent + digits : at;
    }
    return at;
}

static bool is_word(Str text, const char *word) {
    return text.len == strlen(word) && strncasecmp(text.bytes, word, text.len) == 0;
}

// Returns true and sets *x if the field is a number, ignoring white space around it.
static bool read_number(Str field, double *x) {
    Str text = str_trim(field);
    bool negative = text.len && text.bytes[0] == '-';
    if (text.len && (text.bytes[0] == '-' || text.bytes[0] == '+')) {
        text.bytes++;
        text.len--;
    }
    if (text.len == 0)
        return false;
    if (is_word(text, "inf") || is_word(text, "infinity"))
        *x = INFINITY;
    else if (is_word(text, "nan"))
        *x = NAN;
    else if (scan_decimal(text) == text.len)
        *x = number_parse(text);
    else
        return false;
    *x = negative ? -*x : *x;
    return true;
}

// --- files and rows

static const void *parse_csv(Arena *arena, char *bytes, size_t len, const char **problem) {
    if (!file_is_text(bytes, len, problem))
        return NULL;
    if (str_starts_with((Str){bytes, len}, STR("\xef\xbb\xbf"))) { // byte order mark, as written by spreadsheets
        bytes += 3;
        len -= 3;
    }
    CsvFile *file = arena_alloc(arena, sizeof *file);
    *file = (CsvFile){.contents = {bytes, len}};
    for (size_t at = 0; at < len; file->row_count++)
        scan_row(file->contents, at, &at);
    uint32_t *starts = arena_alloc_array(arena, file->row_count, sizeof *starts);
    uint32_t row = 0;
    for (size_t at = 0; at < len; row++) {
        starts[row] = (uint32_t)at; // fits in 32 bits, because a file has at most 2^30 bytes
        scan_row(file->contents, at, &at);
    }
    file->row_starts = starts;
    return file;
}

static Value row_value(BuiltinContext *context, const CsvFile *file, uint32_t row) {
    Arena *arena = context->arena;
    size_t at = file->row_starts[row], end;
    size_t fields = scan_row(file->contents, at, &end);
    if (fields > VALUE_MAX_LEN)
        return builtin_too_long(context, "csv");
    if (fields == 0)
        return VALUE_NULL;
    char *text = arena_alloc(arena, end - at); // room for the text of all fields of the row
    String *strings = arena_alloc_array(arena, fields, sizeof *strings);
    Item *items = arena_alloc_array(arena, fields, sizeof *items);
    bool mixed = false, last = false;
    for (size_t i = 0; i < fields; i++) {
        Str field = {text, scan_field(file->contents, &at, text, &last)};
        text += field.len;
        items[i].type = ITEM_NUMBER;
        if (read_number(field, &items[i].as.number))
            continue;
        strings[i].text = field;
        items[i] = (Item){ITEM_STRING, .as.string = &strings[i]};
        mixed = true;
    }
    if (mixed)
        return (Value){.len = (uint32_t)fields, .kind = VALUE_MIXED, .as.items = items};
    double *numbers = arena_alloc_array(arena, fields, sizeof *numbers);
    for (size_t i = 0; i < fields; i++)
        numbers[i] = items[i].as.number;
    return value_numbers_view(numbers, (uint32_t)fields);
}

// Reads a row number. It is either a number, which is rounded down, or a string that contains an integer. Returns false
// if it is invalid or negative. Symbols are negative numbers, so they match no row.
static bool read_row_number(Value v, double *row) {
    if (value_is_number(v))
        *row = floor(v.as.number);
    else if (v.len != 1 || v.as.items[0].type != ITEM_STRING || !builtin_is_integer(v.as.items[0].as.string->text) ||
             !read_number(v.as.items[0].as.string->text, row))
        return false;
    return *row >= 0;
}

Value builtin_csv(BuiltinContext *context, const Value *args, uint32_t count) {
    double row;
    if (!read_row_number(args[1], &row))
        return VALUE_NULL;
    const CsvFile *file = file_cache_get(context, "csv", parse_csv, args[0]);
    if (!file || row >= file->row_count)
        return VALUE_NULL;
    return row_value(context, file, (uint32_t)row);
}
