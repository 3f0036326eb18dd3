// report_ci.c: test results in formats that CI systems read; see report.h.
#include "base/source.h"
#include "golden/report.h"

#include <inttypes.h>
#include <string.h>

static const char *reason(const Result *result) {
    return result->error_text.bytes ? result->error_text.bytes : "";
}

static uint32_t line_of(const Result *result) {
    return result->line > 0 ? result->line : 1;
}

// --- TAP 14

// Adds text as a YAML string in single quotes.
static void add_quoted(Text *out, const char *text) {
    text_add_c(out, "'");
    for (const char *c = text; *c != '\0'; c++)
        text_add_format(out, *c == '\'' ? "''" : "%c", *c == '\n' ? ' ' : *c);
    text_add_c(out, "'\n");
}

// Adds a description. `#` would begin a directive such as SKIP.
static void add_description(Text *out, const char *name) {
    for (const char *c = name; *c != '\0'; c++)
        text_add_format(out, *c == '#' || *c == '\\' ? "\\%c" : "%c", *c);
    text_add_c(out, "\n");
}

void report_tap(Output *output, size_t number, const Result *result) {
    SCOPED_TEXT out = {0}, place = {0};
    text_add_format(&out, "%sok %zu - ", result->passed ? "" : "not ", number);
    add_description(&out, result->name);
    if (!result->passed) {
        text_add_c(&out, "  ---\n  message: ");
        add_quoted(&out, reason(result));
        text_add_format(&place, "%s:%" PRIu32, result->file, line_of(result));
        text_add_c(&out, "  at: ");
        add_quoted(&out, place.bytes);
        text_add_c(&out, result->details.len > 0 ? "  output: |2\n" : "");
        size_t at = 0;
        for (Str line; text_next_line(&result->details, &at, &line);)
            text_add_format(&out, "    %.*s\n", STR_ARGS(line));
        text_add_c(&out, "  ...\n");
    }
    output_write(output, out.bytes, out.len);
}

// --- GitHub

// Adds text with the escapes of workflow commands. Values of properties also escape separators.
static void add_command_text(Text *out, const char *text, bool property) {
    for (const char *c = text; *c != '\0'; c++) {
        bool special = strchr(property ? "%\r\n:," : "%\r\n", *c);
        text_add_format(out, special ? "%%%02X" : "%c", (unsigned char)*c);
    }
}

void report_github(Output *output, const Result *result) {
    SCOPED_TEXT out = {0};
    const char *file = result->file;
    while (strncmp(file, "./", 2) == 0)
        file += 2;
    text_add_c(&out, "::error file=");
    add_command_text(&out, file, true);
    text_add_format(&out, ",line=%" PRIu32 ",title=", line_of(result));
    add_command_text(&out, result->name, true);
    text_add_c(&out, "::");
    add_command_text(&out, reason(result), false);
    if (result->details.len > 0) {
        text_add_c(&out, "%0A");
        add_command_text(&out, result->details.bytes, false);
    }
    text_add_c(&out, "\n");
    output_write(output, out.bytes, out.len);
}

// --- JUnit

// Adds text escaped for XML. Characters that XML does not allow even escaped, and ill-formed bytes, become `?`.
static void add_escaped(Text *out, const char *text, bool attribute) {
    static const char *const escapes[128] = {['<'] = "&lt;", ['>'] = "&gt;", ['&'] = "&amp;", ['"'] = "&quot;"};
    const Str whole = str_from(text);
    for (size_t at = 0, start = 0; at < whole.len; start = at) {
        int32_t code = utf8_next(whole, &at);
        const char *escape = code >= 0 && code < 128 ? escapes[code] : NULL;
        bool breaks = code == '\n' || code == '\t';
        if (escape)
            text_add_c(out, escape);
        else if (breaks && attribute)
            text_add_format(out, "&#%d;", (int)code);
        else if (code < 0 || (code < ' ' && !breaks) || code == 0xFFFE || code == 0xFFFF)
            text_add_c(out, "?");
        else
            text_add(out, (Str){text + start, at - start});
    }
}

// Adds the folder of a script as the name of a class, with points between its parts. Readers identify a test by class
// and name.
static void add_class(Text *out, const char *name) {
    SCOPED_TEXT folder = {0};
    while (strncmp(name, "./", 2) == 0)
        name += 2;
    size_t len = path_directory(str_from(name)).len;
    text_add(&folder, len > 1 ? (Str){name, len - 1} : STR("petri"));
    text_add_c(&folder, "");
    for (size_t i = 0; i < folder.len; i++)
        folder.bytes[i] = folder.bytes[i] == '/' ? '.' : folder.bytes[i];
    add_escaped(out, folder.bytes, true);
}

static void add_case(Text *out, const Result *result) {
    text_add_format(out, "  <testcase classname=\"");
    add_class(out, result->name);
    text_add_format(out, "\" name=\"");
    add_escaped(out, result->name + path_directory(str_from(result->name)).len, true);
    text_add_format(out, "\" time=\"%.3f\"", result->seconds);
    if (result->passed) {
        text_add_format(out, "/>\n");
        return;
    }
    text_add_format(out, ">\n    <failure type=\"failure\" message=\"");
    add_escaped(out, reason(result), true);
    text_add_format(out, "\">");
    add_escaped(out, result->file, false);
    text_add_format(out, ":%" PRIu32 ": ", line_of(result));
    add_escaped(out, reason(result), false);
    text_add_format(out, "</failure>\n");
    if (result->details.len > 0) {
        text_add_format(out, "    <system-out>");
        add_escaped(out, result->details.bytes, false);
        text_add_format(out, "</system-out>\n");
    }
    text_add_format(out, "  </testcase>\n");
}

void report_junit(Text *out, const Result *const *results, size_t count) {
    size_t failed = 0;
    double seconds = 0;
    for (size_t i = 0; i < count; i++) {
        failed += results[i]->passed ? 0 : 1;
        seconds += results[i]->seconds;
    }
    text_add_format(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    text_add_format(out, "<testsuite name=\"petri\" tests=\"%zu\" failures=\"%zu\" errors=\"0\" time=\"%.3f\">\n",
                    count, failed, seconds);
    for (size_t i = 0; i < count; i++)
        add_case(out, results[i]);
    text_add_format(out, "</testsuite>\n");
}
