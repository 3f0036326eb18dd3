// report.c: reports of test results (golden.h).
#include "base/file.h"
#include "base/source.h"
#include "cli/cli.h"
#include "golden/golden.h"

#include <inttypes.h>
#include <string.h>

#define RED "\033[31m"
#define GREEN "\033[32m"
#define CYAN "\033[36m"
#define PLAIN "\033[0m"

static const char *colour_of(Str line) {
    return line.len == 0          ? NULL
           : line.bytes[0] == '-' ? RED
           : line.bytes[0] == '+' ? GREEN
           : line.bytes[0] == '@' ? CYAN
                                  : NULL;
}

static void report_details(Output *output, const Text *details, bool colour) {
    size_t at = 0;
    for (Str line; text_next_line(details, &at, &line);) {
        const char *start = colour ? colour_of(line) : NULL;
        output_format(output, "    %s%.*s%s\n", start ? start : "", STR_ARGS(line), start ? PLAIN : "");
    }
}

void report_result(Output *output, const Result *result, bool colour) {
    if (result->passed) {
        output_format(output, "ok %s%s\n", result->name, result->updated ? " (updated)" : "");
        return;
    }
    const char *reason = result->error_text.bytes ? result->error_text.bytes : "";
    output_format(output, "%sFAIL%s %s\n", colour ? RED : "", colour ? PLAIN : "", result->name);
    output_format(output, "%s:%" PRIu32 ": error: %s\n", result->file, result->line > 0 ? result->line : 1, reason);
    report_details(output, &result->details, colour);
}

// Adds text escaped for XML. Control characters become `?`, because XML does not allow them even escaped.
static void add_escaped(Text *out, const char *text) {
    static const char *const escapes[128] = {
        ['\n'] = "&#10;", ['<'] = "&lt;", ['>'] = "&gt;", ['&'] = "&amp;", ['"'] = "&quot;"};
    for (const char *c = text; *c != '\0'; c++) {
        const char *escape = (unsigned char)*c < 128 ? escapes[(unsigned char)*c] : NULL;
        if (!escape && (unsigned char)*c < ' ')
            escape = "?";
        text_add(out, (Str){escape ? escape : c, escape ? strlen(escape) : 1});
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
    add_escaped(out, folder.bytes);
}

static void add_result(Text *out, const Result *result) {
    text_add_format(out, "  <testcase classname=\"");
    add_class(out, result->name);
    text_add_format(out, "\" name=\"");
    add_escaped(out, result->name + path_directory(str_from(result->name)).len);
    text_add_format(out, "\" time=\"%.3f\"", result->seconds);
    if (result->passed) {
        text_add_format(out, "/>\n");
        return;
    }
    const char *error_text = !result->error_text.bytes ? "" : result->error_text.bytes;
    text_add_format(out, ">\n    <failure type=\"failure\" message=\"");
    add_escaped(out, error_text);
    text_add_format(out, "\">");
    add_escaped(out, error_text);
    text_add_format(out, "</failure>\n  </testcase>\n");
}

bool report_junit(const char *path, const Result *const *results, size_t count) {
    size_t failed = 0;
    double seconds = 0;
    for (size_t i = 0; i < count; i++) {
        failed += results[i]->passed ? 0 : 1;
        seconds += results[i]->seconds;
    }
    SCOPED_TEXT out = {0};
    text_add_format(&out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    text_add_format(&out, "<testsuite name=\"petri\" tests=\"%zu\" failures=\"%zu\" errors=\"0\" time=\"%.3f\">\n",
                    count, failed, seconds);
    for (size_t i = 0; i < count; i++)
        add_result(&out, results[i]);
    text_add_format(&out, "</testsuite>\n");
    return output_file(path, text_str(&out));
}
