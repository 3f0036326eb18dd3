// report.c: see report.h.
//
// Diagnostics are added to one text as they arrive. SARIF has its list of rules before the results, so report_end adds
// it when all codes are known.
#include "check/report.h"

#include "cli/json.h"
#include "cli/output.h"

#include <string.h>

static const struct {
    const char *code;
    const char *text;
} rules[] = {
#define RULE(code, text) {code, text},
#include "check/rule_list.h"
};

// Adds a rule of SARIF: a code, its meaning, and the page that lists all codes.
static void put_rule(JsonWriter *json, const char *code) {
    const char *text = NULL;
    for (size_t i = 0; !text && i < sizeof rules / sizeof rules[0]; i++)
        if (strcmp(rules[i].code, code) == 0)
            text = rules[i].text;
    json_open(json, NULL, "{");
    json_put_text(json, "id", code);
    if (text) {
        JSON_PUT_OBJECT(json, "shortDescription", "text", text);
        json_put_text(json, "helpUri", PETRI_HOMEPAGE "/manual/diagnostics.html");
    }
    json_close(json, "}");
}

// Adds text and hint as one message.
static void add_message_text(const PetriDiagnostic *diagnostic, Text *out) {
    text_add_format(out, "%s%s%s", diagnostic->text, diagnostic->hint[0] != '\0' ? "; " : "", diagnostic->hint);
}

// Adds a line `FILE:LINE:COLUMN: level: text [code]`.
static void add_gcc(Report *report, const PetriDiagnostic *diagnostic, const char *message_text) {
    Text *out = &report->text;
    if (diagnostic->file)
        text_add_format(out, "%s:%u:%u: ", diagnostic->file, diagnostic->line, diagnostic->column);
    text_add_format(out, "%s: %s", level_word(diagnostic->level), message_text);
    if (diagnostic->code)
        text_add_format(out, " [%s]", diagnostic->code);
    text_add_c(out, "\n");
}

static void add_json(Report *report, const PetriDiagnostic *diagnostic) {
    JsonWriter json = {.out = &report->text, .spaced = true};
    if (report->count == 0)
        json_open(&json, NULL, "[");
    json_break(&json, "\n  ");
    json_put_diagnostic(&json, diagnostic);
}

static uint32_t at_least_1(uint32_t number) {
    return number > 0 ? number : 1;
}

static void put_location(JsonWriter *json, const char *file, const PetriDiagnostic *diagnostic) {
    SCOPED_TEXT uri = {0};
    text_add_uri(&uri, file);
    json_open(json, "locations", "[{");
    json_open(json, "physicalLocation", "{");
    JSON_PUT_OBJECT(json, "artifactLocation", "uri", uri.bytes);
    json_open(json, "region", "{");
    json_put_integer(json, "startLine", at_least_1(diagnostic->line));
    json_put_integer(json, "startColumn", at_least_1(diagnostic->column));
    json_put_integer(json, "endLine", at_least_1(diagnostic->end_line));
    json_put_integer(json, "endColumn", at_least_1(diagnostic->end_column));
    json_close(json, "}}}]");
}

static void add_sarif(Report *report, const PetriDiagnostic *diagnostic, const char *message_text) {
    JsonWriter json = {.out = &report->text, .spaced = true};
    json_break(&json, "\n      ");
    json_open(&json, NULL, "{");
    json_put_text(&json, "level", level_word(diagnostic->level));
    if (diagnostic->code) {
        json_put_text(&json, "ruleId", diagnostic->code);
        if (!texts_contain(&report->codes, diagnostic->code))
            texts_add(&report->codes, diagnostic->code);
    }
    JSON_PUT_OBJECT(&json, "message", "text", message_text);
    const char *file = diagnostic->file ? diagnostic->file : report->script;
    if (file) // sites that show findings require a location
        put_location(&json, file, diagnostic);
    json_close(&json, "}");
}

void report_add(Report *report, const PetriDiagnostic *diagnostic) {
    SCOPED_TEXT message_text = {0};
    add_message_text(diagnostic, &message_text);
    if (report->form == REPORT_GCC)
        add_gcc(report, diagnostic, message_text.bytes);
    else if (report->form == REPORT_JSON)
        add_json(report, diagnostic);
    else
        add_sarif(report, diagnostic, message_text.bytes);
    report->count++;
}

static void frame_sarif(const Report *report, Text *out) {
    JsonWriter json = {.out = out, .spaced = true};
    json_open(&json, NULL, "{\n  ");
    json_put_text(&json, "$schema", "https://json.schemastore.org/sarif-2.1.0.json");
    json_break(&json, "\n  ");
    json_put_text(&json, "version", "2.1.0");
    json_break(&json, "\n  ");
    json_open(&json, "runs", "[{\n    ");
    json_open(&json, "tool", "{");
    json_open(&json, "driver", "{");
    JSON_PUT_TEXTS(&json, "name", "petri", "version", petri_version());
    json_open(&json, "rules", "[");
    for (size_t i = 0; i < report->codes.count; i++)
        put_rule(&json, report->codes.items[i]);
    json_close(&json, "]}}");
    json_break(&json, "\n    ");
    json_open(&json, "invocations", "[{");
    json_put_bool(&json, "executionSuccessful", !report->incomplete);
    json_close(&json, "}]");
    json_break(&json, "\n    ");
    json_put_text(&json, "columnKind", "unicodeCodePoints");
    json_break(&json, "\n    ");
    json_open(&json, "results", "[");
    text_add(out, text_str(&report->text));
    json_close(&json, "\n    ]\n  }]\n}\n");
}

int report_end(Report *report, int status) {
    SCOPED_TEXT all = {0};
    text_add_c(&report->text, "");
    if (report->form == REPORT_SARIF)
        frame_sarif(report, &all);
    else
        text_add(&all, text_str(&report->text));
    if (report->form == REPORT_JSON)
        text_add_c(&all, report->count == 0 ? "[]\n" : "\n]\n");
    status = output_text(all.bytes, all.len, status);
    text_free(&report->text);
    texts_free(&report->codes);
    return status;
}
