// report.h: diagnostics for programs that read them.
#ifndef PETRI_SRC_CHECK_REPORT_H
#define PETRI_SRC_CHECK_REPORT_H

#include "cli/byte_buffer.h"
#include "petri.h"

typedef enum ReportForm { REPORT_TEXT, REPORT_GCC, REPORT_JSON, REPORT_SARIF } ReportForm;

typedef struct Report {
    ReportForm form;
    ByteBuffer text;
    size_t count;
    TextList codes; // that have come, for the rules of SARIF
} Report;

void report_add(Report *report, const PetriDiagnostic *diagnostic);
// Writes all to standard output and frees the report; returns the exit status.
int report_end(Report *report, int status);

#endif
