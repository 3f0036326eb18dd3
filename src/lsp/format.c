// format.c: formatting of scripts and of selected lines.
#include "fmt/layout.h"
#include "lsp/server.h"

#include <string.h>

void request_put_edit(JsonWriter *json, const char *name, const RequestContext *request, size_t start, size_t end,
                      Str text) {
    json_open(json, name, "{");
    document_put_range(json, "range", request->document, start, end, request->server->utf8);
    json_put_str(json, "newText", text);
    json_close(json, "}");
}

size_t request_offset(const RequestContext *request, const char *position) {
    return document_offset(request->document, json_path(request->params, position), request->server->utf8);
}

// Appends the formatted script to `out`. Returns false if the script has an invalid token.
static bool format(const RequestContext *request, Text *out) {
    PetriSession *session = request->server->session;
    return session && layout_text(session, text_str(&request->document->text), out);
}

static bool keeps_meaning(const RequestContext *request, Str text) {
    const Document *document = request->document;
    return layout_same(request->server->session, document->path, text_str(&document->text), text);
}

// Answers with a single edit that replaces the changed lines. Does not format a script with errors.
void answer_format(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    Str text = text_str(&request->document->text);
    SCOPED_TEXT out = {0};
    if (!format(request, &out) || !keeps_meaning(request, text_str(&out)))
        return;
    size_t start = 0, end = 0, max = text.len < out.len ? text.len : out.len;
    while (start < max && text.bytes[start] == out.bytes[start])
        start++;
    while (start > 0 && text.bytes[start - 1] != '\n')
        start--;
    while (end < max - start && text.bytes[text.len - 1 - end] == out.bytes[out.len - 1 - end])
        end++;
    while (end > 0 && text.bytes[text.len - end] != '\n')
        end--;
    Str changed = {out.bytes + start, out.len - end - start};
    json_open(result, NULL, "[");
    if (text.len != out.len || start + end < text.len)
        request_put_edit(result, NULL, request, start, text.len - end, changed);
    json_close(result, "]");
}

// Returns the next line with characters other than blanks, and moves *rest after it. Returns an empty string at the
// end.
static Str next_line(Str *rest) {
    Str line = {0};
    while (rest->len > 0 && str_trim(line).len == 0) {
        const char *stop = memchr(rest->bytes, '\n', rest->len);
        line = (Str){rest->bytes, !stop ? rest->len : (size_t)(stop - rest->bytes)};
        size_t used = line.len + (stop ? 1 : 0);
        *rest = (Str){rest->bytes + used, rest->len - used};
    }
    return str_trim(line).len == 0 ? (Str){0} : line;
}

// The formatter neither joins nor breaks lines, and keeps all lines that are not empty.
void answer_range_format(const RequestContext *request, JsonWriter *result, const char **problem) {
    const Document *document = request->document;
    size_t start = request_offset(request, "range.start"), end = request_offset(request, "range.end");
    Str text = text_str(&document->text);
    SCOPED_TEXT out = {0};
    SCOPED_TEXT changed = {0};
    if (!format(request, &out))
        return;
    json_open(result, NULL, "[");
    size_t done = 0;
    for (Str before = text, after = text_str(&out);;) {
        Str line = next_line(&before), wanted = next_line(&after);
        size_t at = !line.bytes ? text.len : (size_t)(line.bytes - text.bytes);
        if (line.len == 0 || at >= end)
            break;
        if (at + line.len >= start && !str_equal(line, wanted)) {
            request_put_edit(result, NULL, request, at, at + line.len, wanted);
            text_add(&changed, (Str){text.bytes + done, at - done});
            text_add(&changed, wanted);
            done = at + line.len;
        }
    }
    text_add(&changed, (Str){text.bytes + done, text.len - done});
    json_close(result, "]");
    if (!keeps_meaning(request, text_str(&changed)))
        *problem = "cannot format these lines alone, because others are indented differently: format the whole script";
}
