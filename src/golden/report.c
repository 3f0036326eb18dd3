// report.c: reports of test results; see report.h.
#include "golden/report.h"

#include <inttypes.h>

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

static void report_text(Output *output, const Result *result, bool colour) {
    if (result->passed) {
        output_format(output, "ok %s%s\n", result->name, result->updated ? " (updated)" : "");
        return;
    }
    const char *reason = result->error_text.bytes ? result->error_text.bytes : "";
    output_format(output, "%sFAIL%s %s\n", colour ? RED : "", colour ? PLAIN : "", result->name);
    output_format(output, "%s:%" PRIu32 ": error: %s\n", result->file, result->line > 0 ? result->line : 1, reason);
    report_details(output, &result->details, colour);
}

void report_begin(Output *output, ReportFormat format, size_t count) {
    if (format == REPORT_TAP)
        output_format(output, "TAP version 14\n1..%zu\n", count);
}

void report_result(Output *output, ReportFormat format, size_t number, const Result *result, bool colour) {
    if (format == REPORT_TEXT || format == REPORT_GITHUB)
        report_text(output, result, colour);
    if (format == REPORT_GITHUB && !result->passed)
        report_github(output, result);
    if (format == REPORT_TAP)
        report_tap(output, number, result);
}
