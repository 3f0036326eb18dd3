// content_sniff.h: detection of files that are not scripts, so that one error is reported instead of one per line.
#ifndef PETRI_SYNTAX_CONTENT_SNIFF_H
#define PETRI_SYNTAX_CONTENT_SNIFF_H

#include "base/diag.h"

// Returns the name of the source's encoding, such as "UTF-16", if it is not UTF-8; else NULL.
const char *content_sniff_encoding(const Source *source);
// Called if a source failed to parse. If it is not a script, replaces its diagnostics with a single error. That is the
// case if it is binary, or if at least half of its lines are invalid and it does not claim to be a script.
void content_sniff_report(const Source *source, DiagSink *diags);

#endif
