// report.h: diagnostics in machine-readable formats.
#pragma once

#include "cli/memory.h"
#include "petri.h"

typedef enum ReportForm { REPORT_TEXT, REPORT_GCC, REPORT_JSON, REPORT_SARIF } ReportForm;

typedef struct Report {
    ReportForm form;
    Text text;
    size_t count;
    const char *script; // the checked script, for diagnostics without a position; NULL: none
    bool incomplete;    // true if a file was not checked
    TextList codes;     // distinct codes of the diagnostics so far; SARIF lists them as rules
} Report;

void report_add(Report *report, const PetriDiagnostic *diagnostic);
// Writes the report to standard output and frees it. Returns `status`, or STATUS_FAILED after a write error.
int report_end(Report *report, int status);
