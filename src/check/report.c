// report.c: see report.h.
#include "check/report.h"

#include "cli/json.h"
#include "cli/output.h"

// Adds text and hint as one message.
static void add_message_text(const PetriDiagnostic *diagnostic, ByteBuffer *out) {
    byte_buffer_format(out, "%s%s%s", diagnostic->text, diagnostic->hint[0] != '\0' ? "; " : "", diagnostic->hint);
}

// Adds a line `FILE:LINE:COLUMN: level: text [code]`.
static void add_gcc(Report *report, const PetriDiagnostic *diagnostic, const char *message_text) {
    ByteBuffer *out = &report->text;
    if (diagnostic->file)
        byte_buffer_format(out, "%s:%u:%u: ", diagnostic->file, diagnostic->line, diagnostic->column);
    byte_buffer_format(out, "%s: %s", level_word(diagnostic->level), message_text);
    if (diagnostic->code)
        byte_buffer_format(out, " [%s]", diagnostic->code);
    byte_buffer_add_text(out, "\n");
}

static void add_json(Report *report, const PetriDiagnostic *diagnostic) {
    byte_buffer_add_text(&report->text, report->count == 0 ? "[\n  " : ",\n  ");
    json_add_diagnostic(&report->text, diagnostic);
}

static void add_sarif(Report *report, const PetriDiagnostic *diagnostic, const char *message_text) {
    ByteBuffer *out = &report->text;
    byte_buffer_format(out, "%s\n      {\"level\": \"%s\"", report->count == 0 ? "" : ",",
                       level_word(diagnostic->level));
    if (diagnostic->code) {
        byte_buffer_format(out, ", \"ruleId\": \"%s\"", diagnostic->code);
        if (!texts_contain(&report->codes, diagnostic->code))
            texts_add(&report->codes, diagnostic->code);
    }
    byte_buffer_add_text(out, ", \"message\": {\"text\": ");
    json_add_text(out, message_text);
    byte_buffer_add_text(out, "}");
    if (diagnostic->file) {
        byte_buffer_add_text(out, ", \"locations\": [{\"physicalLocation\": {\"artifactLocation\": {\"uri\": ");
        byte_buffer_add_text(out, "\"");
        byte_buffer_add_uri(out, diagnostic->file);
        byte_buffer_format(
            out, "\"}, \"region\": {\"startLine\": %u, \"startColumn\": %u, \"endLine\": %u, \"endColumn\": %u}}}]",
            diagnostic->line, diagnostic->column, diagnostic->end_line, diagnostic->end_column);
    }
    byte_buffer_add_text(out, "}");
}

void report_add(Report *report, const PetriDiagnostic *diagnostic) {
    SCOPED_BYTE_BUFFER message_text = {0};
    add_message_text(diagnostic, &message_text);
    if (report->form == REPORT_GCC)
        add_gcc(report, diagnostic, message_text.data);
    else if (report->form == REPORT_JSON)
        add_json(report, diagnostic);
    else
        add_sarif(report, diagnostic, message_text.data);
    report->count++;
}

static void frame_sarif(const Report *report, ByteBuffer *out) {
    byte_buffer_format(
        out,
        "{\n  \"$schema\": \"https://json.schemastore.org/sarif-2.1.0.json\",\n  \"version\": \"2.1.0\",\n"
        "  \"runs\": [{\n    \"tool\": {\"driver\": {\"name\": \"petri\", \"version\": \"%s\", \"rules\": [",
        petri_version());
    for (size_t i = 0; i < report->codes.count; i++)
        byte_buffer_format(out, "%s{\"id\": \"%s\"}", i == 0 ? "" : ", ", report->codes.items[i]);
    byte_buffer_add_text(out, "]}},\n    \"columnKind\": \"unicodeCodePoints\",\n    \"results\": [");
    byte_buffer_add(out, report->text.data, report->text.length);
    byte_buffer_add_text(out, "\n    ]\n  }]\n}\n");
}

int report_end(Report *report, int status) {
    SCOPED_BYTE_BUFFER all = {0};
    byte_buffer_add(&report->text, "", 0);
    if (report->form == REPORT_SARIF)
        frame_sarif(report, &all);
    else
        byte_buffer_add(&all, report->text.data, report->text.length);
    if (report->form == REPORT_JSON)
        byte_buffer_add_text(&all, report->count == 0 ? "[]\n" : "\n]\n");
    status = output_text(all.data, all.length, status);
    byte_buffer_free(&report->text);
    texts_free(&report->codes);
    return status;
}
