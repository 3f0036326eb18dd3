// inlay_hints.c: inlay hints with values of constants, document colours and quick fixes.
#include "lsp/server.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_HINT = 40 };

// --- values of constants

void answer_hints(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    Document *document = request->document;
    size_t from = request_offset(request, "range.start"), to = request_offset(request, "range.end");
    json_open(result, NULL, "[");
    for (size_t i = 0; i < document->name_count; i++) {
        const PetriBinding *name = &document->names[i];
        if (name->kind != PETRI_NAME_LET || name->value_end < from || name->value_start > to)
            continue;
        const char *value = hover_value(request->server, document, name);
        Str text = document_slice(document, name->value_start, name->value_end);
        size_t first = document_token_at(document, name->value_start);
        bool literal = first < document->token_count && document->tokens[first].end >= name->value_end;
        if (!value || literal || strlen(value) > MAX_HINT || str_equal(text, str_from(value)))
            continue;
        SCOPED_TEXT label = {0};
        text_add_format(&label, "= %s", value);
        json_open(result, NULL, "{");
        document_put_position(result, "position", document, name->value_end, request->server->utf8);
        json_put_text(result, "label", label.bytes);
        json_put_bool(result, "paddingLeft", true);
        json_close(result, "}");
    }
    json_close(result, "]");
}

// --- colours

// Parses a list of numbers separated by semicolons, which starts at `token`. Sets *end to the token of the last number
// and returns the length of the list. Returns 0 if there are more than `max` elements or an element is not a number.
static size_t read_numbers(const Document *document, size_t token, double *numbers, size_t max, size_t *end) {
    size_t count = 0;
    for (size_t i = token; i < document->token_count && count < max; i += 2) {
        Str text = document_token(document, i);
        SCOPED_STRING copy = memory_strndup(text.bytes, text.len);
        if (document->tokens[i].kind != PETRI_TOKEN_NUMBER || !petri_parse_number(copy, &numbers[count]))
            return 0;
        count++;
        *end = i;
        if (!document_is(document, i + 1, ";"))
            break;
    }
    return document_is(document, *end + 1, ";") ? 0 : count;
}

static double clamp_unit(double x) {
    return x > 0 ? (x < 1 ? x : 1) : 0;
}

static void from_hsv(const double *hsv, double *rgb) {
    for (int i = 0; i < 3; i++) {
        double k = fmod(5 - 2 * i + (hsv[0] - floor(hsv[0])) * 6, 6), min = k < 4 - k ? k : 4 - k;
        rgb[i] = clamp_unit(hsv[2]) * (1 - clamp_unit(hsv[1]) * clamp_unit(min));
    }
}

static void to_hsv(const double *rgb, double *hsv) {
    double max = fmax(rgb[0], fmax(rgb[1], rgb[2])), spread = max - fmin(rgb[0], fmin(rgb[1], rgb[2]));
    double hue = spread <= 0     ? 0
                 : max == rgb[0] ? (rgb[1] - rgb[2]) / spread + 6
                 : max == rgb[1] ? (rgb[2] - rgb[0]) / spread + 2
                                 : (rgb[0] - rgb[1]) / spread + 4;
    hsv[0] = fmod(hue, 6) / 6;
    hsv[1] = max > 0 ? spread / max : 0;
    hsv[2] = max;
}

static void add_colour(const RequestContext *request, JsonWriter *list, size_t first, size_t last, const double *rgb,
                       double alpha) {
    static const char *const names[] = {"red", "green", "blue"};
    const Document *document = request->document;
    json_open(list, NULL, "{");
    document_put_range(list, "range", document, document->tokens[first].start, document->tokens[last].end,
                       request->server->utf8);
    json_open(list, "color", "{");
    json_put_number(list, "alpha", clamp_unit(alpha));
    for (int i = 0; i < 3; i++)
        json_put_number(list, names[i], clamp_unit(rgb[i]));
    json_close(list, "}}");
}

void answer_colours(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    const Document *document = request->document;
    json_open(result, NULL, "[");
    for (size_t i = 0; i + 2 < document->token_count; i++) {
        double numbers[4] = {0, 0, 0, 1}, rgb[3];
        size_t end = 0, count;
        bool hsv = document_is(document, i, "hsv"), call = hsv || document_is(document, i, "rgb");
        if (call && document_is(document, i + 1, "(")) {
            count = read_numbers(document, i + 2, numbers, 3, &end);
            if (count == 3 && document_is(document, end + 1, ")")) {
                from_hsv(numbers, rgb);
                add_colour(request, result, i, end + 1, hsv ? rgb : numbers, 1);
            }
        } else if (document_is(document, i, "color") && document_is(document, i + 1, "=")) {
            count = read_numbers(document, i + 2, numbers, 4, &end);
            if (count >= 3)
                add_colour(request, result, i + 2, end, numbers, numbers[3]);
        }
    }
    json_close(result, "]");
}

void answer_presentations(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    static const char *const names[] = {"red", "green", "blue"};
    const Document *document = request->document;
    size_t start = request_offset(request, "range.start"), end = request_offset(request, "range.end");
    const Json *colour = json_get(request->params, "color");
    double rgb[3], hsv[3], alpha = json_number(json_get(colour, "alpha"));
    for (int i = 0; i < 3; i++)
        rgb[i] = json_number(json_get(colour, names[i]));
    to_hsv(rgb, hsv);
    Str text = document_slice(document, start, end);
    bool is_hsv = str_starts_with(text, STR("hsv")), call = is_hsv || str_starts_with(text, STR("rgb"));
    SCOPED_TEXT label = {0};
    const double *numbers = is_hsv ? hsv : rgb;
    text_add_format(&label, "%.*s%s", call ? 3 : 0, text.bytes, call ? "(" : "");
    for (int i = 0; i < 3; i++)
        text_add_format(&label, "%s%g", i == 0 ? "" : ";", round(numbers[i] * 1000) / 1000);
    if (call)
        text_add_c(&label, ")");
    else if (alpha < 1)
        text_add_format(&label, ";%g", round(alpha * 1000) / 1000);
    json_open(result, NULL, "[{");
    json_put_text(result, "label", label.bytes);
    request_put_edit(result, "textEdit", request, start, end, text_str(&label));
    json_close(result, "}]");
}

// --- quick fixes

// Returns X if the text contains "did you mean 'X'?" or "did you mean X?", else an empty string.
static Str suggested_word(const char *text) {
    static const char question[] = "did you mean ";
    const char *at = strstr(text, question);
    if (!at)
        return (Str){0};
    at += strlen(question);
    at += *at == '\'';
    return (Str){at, strcspn(at, "'?")};
}

// Returns the first word in quotes, or an empty string if there is none.
static Str quoted_word(const char *text) {
    const char *open = strchr(text, '\''), *close = !open ? NULL : strchr(open + 1, '\'');
    return !close ? (Str){0} : (Str){open + 1, (size_t)(close - open - 1)};
}

// Finds the incorrect word in the range of a diagnostic: the word that the quick fix replaces by `meant`. Sets *start
// and *end to the offsets of the word. Returns false if the word is not found.
static bool find_invalid_word(const Document *document, const DocumentDiagnostic *diagnostic, Str meant, size_t *start,
                              size_t *end) {
    Str part = document_slice(document, diagnostic->start, diagnostic->end), wrong = quoted_word(diagnostic->text);
    for (size_t i = 0; wrong.len > 0 && i + wrong.len <= part.len; i++) {
        if (memcmp(part.bytes + i, wrong.bytes, wrong.len) == 0) {
            *start = diagnostic->start + i;
            *end = *start + wrong.len;
            return true;
        }
    }
    size_t token = document_token_at(document, diagnostic->start);
    bool node = token < document->token_count && document->tokens[token].kind == PETRI_TOKEN_NODE;
    if (node && meant.bytes[0] == '!') {
        *start = document->tokens[token].start;
        *end = document->tokens[token].end;
    }
    return node && meant.bytes[0] == '!';
}

// Returns the replacement for the whole range of the diagnostic if its hint contains one, else an empty string.
static Str replacement_of(const char *hint) {
    static const char node[] = "a node is written ", comparison[] = "write '==' to compare";
    if (strncmp(hint, comparison, strlen(comparison)) == 0)
        return STR("==");
    if (strncmp(hint, node, strlen(node)) != 0)
        return (Str){0};
    const char *word = hint + strlen(node);
    return (Str){word, strcspn(word, " ,;")};
}

static void add_action(const RequestContext *request, JsonWriter *list, const DocumentDiagnostic *diagnostic) {
    size_t start = diagnostic->start, end = diagnostic->end;
    Str meant = suggested_word(diagnostic->hint);
    meant = meant.len > 0 ? meant : suggested_word(diagnostic->text);
    if (meant.len > 0) {
        if (!find_invalid_word(request->document, diagnostic, meant, &start, &end))
            return;
    } else if ((meant = replacement_of(diagnostic->hint)).len == 0) {
        return;
    }
    SCOPED_TEXT title = {0};
    text_add_format(&title, "write %.*s", STR_ARGS(meant));
    json_open(list, NULL, "{");
    JSON_PUT_TEXTS(list, "title", title.bytes, "kind", "quickfix");
    json_put_bool(list, "isPreferred", true);
    json_open(list, "edit", "{");
    json_open(list, "changes", "{");
    json_open(list, request->document->uri, "[");
    request_put_edit(list, NULL, request, start, end, meant);
    json_close(list, "]}}}");
}

void answer_actions(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    Document *document = request->document;
    size_t from = request_offset(request, "range.start"), to = request_offset(request, "range.end");
    json_open(result, NULL, "[");
    if (document->unchecked && !document->exceeded)
        diagnostics_publish(request->server, document);
    // While a full check is pending, the positions of the last diagnostics may be wrong.
    for (size_t i = 0; !document->unchecked && i < document->diagnostics.count; i++)
        if (document->diagnostics.items[i].start <= to && document->diagnostics.items[i].end >= from)
            add_action(request, result, &document->diagnostics.items[i]);
    json_close(result, "]");
}
