// report.h: reports of test results, as text and in formats that CI systems read.
#pragma once

#include "cli/output.h"
#include "golden/golden.h"

typedef enum ReportFormat { REPORT_TEXT, REPORT_JUNIT, REPORT_TAP, REPORT_GITHUB } ReportFormat;

// Prints what comes before the first of `count` results.
void report_begin(Output *output, ReportFormat format, size_t count);
// Prints a result, number `number` from 1. As text: `ok NAME`, or `FAIL NAME`, a line that begins with the position of
// the failure, and details. GitHub also gets an annotation. JUnit gets nothing.
void report_result(Output *output, ReportFormat format, size_t number, const Result *result, bool colour);

// report_ci.c: formats of CI systems.

void report_tap(Output *output, size_t number, const Result *result);
// Adds a command of GitHub's workflows that annotates the line of a failure.
void report_github(Output *output, const Result *result);
// Adds a JUnit XML file.
void report_junit(Text *out, const Result *const *results, size_t count);
