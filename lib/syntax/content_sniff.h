// content_sniff.h: detection of files that are not scripts, so that they give one error instead of one per line.
#ifndef PETRI_SYNTAX_CONTENT_SNIFF_H
#define PETRI_SYNTAX_CONTENT_SNIFF_H

#include "base/diag.h"

// Returns the name of a text's encoding if it is not UTF-8, such as "UTF-16", else NULL.
const char *content_sniff_encoding(const Source *source);
// Replaces the diagnostics of a text that failed to parse by a single error if it is not a script: the text is binary,
// or most lines of a file whose name does not end with .fl are invalid.
void content_sniff_report(const Source *source, DiagSink *diags);

#endif
