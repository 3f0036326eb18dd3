// report.c: see report.h.
#include "check/report.h"

#include "cli/json.h"
#include "cli/output.h"

// Text and hint as one: they are two sentences of one remark.
static void remark(const PetriDiagnostic *diagnostic, Bytes *out) {
    bytes_format(out, "%s%s%s", diagnostic->text, diagnostic->hint[0] != '\0' ? "; " : "", diagnostic->hint);
}

// `FILE:LINE:COLUMN: level: text [code]`.
static void add_gcc(Report *report, const PetriDiagnostic *diagnostic, const char *said) {
    Bytes *out = &report->text;
    if (diagnostic->file != NULL) {
        bytes_format(out, "%s:%u:%u: ", diagnostic->file, diagnostic->line, diagnostic->column);
    }
    bytes_format(out, "%s: %s", level_word(diagnostic->level), said);
    if (diagnostic->code != NULL) {
        bytes_format(out, " [%s]", diagnostic->code);
    }
    bytes_add_text(out, "\n");
}

static void add_json(Report *report, const PetriDiagnostic *diagnostic) {
    bytes_add_text(&report->text, report->count == 0 ? "[\n  " : ",\n  ");
    json_add_diagnostic(&report->text, diagnostic);
}

static void add_sarif(Report *report, const PetriDiagnostic *diagnostic, const char *said) {
    Bytes *out = &report->text;
    bytes_format(out, "%s\n      {\"level\": \"%s\"", report->count == 0 ? "" : ",", level_word(diagnostic->level));
    if (diagnostic->code != NULL) {
        bytes_format(out, ", \"ruleId\": \"%s\"", diagnostic->code);
        if (!texts_hold(&report->codes, diagnostic->code)) {
            texts_add(&report->codes, diagnostic->code);
        }
    }
    bytes_add_text(out, ", \"message\": {\"text\": ");
    json_add_text(out, said);
    bytes_add_text(out, "}");
    if (diagnostic->file != NULL) {
        bytes_add_text(out, ", \"locations\": [{\"physicalLocation\": {\"artifactLocation\": {\"uri\": ");
        bytes_add_text(out, "\"");
        bytes_add_uri(out, diagnostic->file);
        bytes_format(out,
                     "\"}, \"region\": {\"startLine\": %u, \"startColumn\": %u, \"endLine\": %u, \"endColumn\": %u}}}]",
                     diagnostic->line, diagnostic->column, diagnostic->end_line, diagnostic->end_column);
    }
    bytes_add_text(out, "}");
}

void report_add(Report *report, const PetriDiagnostic *diagnostic) {
    SCOPED_BYTES said = {0};
    remark(diagnostic, &said);
    if (report->form == REPORT_GCC) {
        add_gcc(report, diagnostic, said.data);
    } else if (report->form == REPORT_JSON) {
        add_json(report, diagnostic);
    } else {
        add_sarif(report, diagnostic, said.data);
    }
    report->count++;
}

static void frame_sarif(const Report *report, Bytes *out) {
    bytes_format(out,
                 "{\n  \"$schema\": \"https://json.schemastore.org/sarif-2.1.0.json\",\n  \"version\": \"2.1.0\",\n"
                 "  \"runs\": [{\n    \"tool\": {\"driver\": {\"name\": \"petri\", \"version\": \"%s\", \"rules\": [",
                 petri_version());
    for (size_t i = 0; i < report->codes.count; i++) {
        bytes_format(out, "%s{\"id\": \"%s\"}", i == 0 ? "" : ", ", report->codes.items[i]);
    }
    bytes_add_text(out, "]}},\n    \"columnKind\": \"unicodeCodePoints\",\n    \"results\": [");
    bytes_add(out, report->text.data, report->text.length);
    bytes_add_text(out, "\n    ]\n  }]\n}\n");
}

int report_end(Report *report, int status) {
    SCOPED_BYTES all = {0};
    bytes_add(&report->text, "", 0);
    if (report->form == REPORT_SARIF) {
        frame_sarif(report, &all);
    } else {
        bytes_add(&all, report->text.data, report->text.length);
    }
    if (report->form == REPORT_JSON) {
        bytes_add_text(&all, report->count == 0 ? "[]\n" : "\n]\n");
    }
    status = output_text(all.data, all.length, status);
    bytes_free(&report->text);
    texts_free(&report->codes);
    return status;
}
