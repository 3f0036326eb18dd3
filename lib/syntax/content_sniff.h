// content_sniff.h: files that are no scripts at all: one message for them instead of one for each line.
#ifndef PETRI_SYNTAX_CONTENT_SNIFF_H
#define PETRI_SYNTAX_CONTENT_SNIFF_H

#include "base/diag.h"

// What a text in another encoding is, or NULL: it may be a script.
const char *content_sniff_encoding(const Source *source);
// Looks at a text that does not parse and what was said of it. If it is binary, or most lines of a file whose name does
// not end in .fl make no sense, the sink gets one error in place of all others.
void content_sniff_report(const Source *source, DiagSink *diags);

#endif
