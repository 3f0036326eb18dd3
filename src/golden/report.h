// report.h: how results of tests are told: a line each, and as a file for CI systems.
#ifndef PETRI_SRC_REPORT_H
#define PETRI_SRC_REPORT_H

#include "cli/bytes.h"
#include "cli/output.h"

typedef struct Result {
    const char *name;
    bool passed;
    bool updated;  // the golden was rewritten
    Bytes trouble; // why it failed
    double seconds;
} Result;

// `ok NAME`, or `FAIL NAME` and why.
void report_result(Output *output, const Result *result);
// Writes a JUnit file. False after a message if that fails.
bool report_junit(const char *path, Result *const *results, size_t count);

#endif
