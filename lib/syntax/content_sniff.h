// content_sniff.h: detection of files that are not scripts, so that one error is reported instead of one per line.
#pragma once

#include "base/diag.h"

// If the source has another encoding than UTF-8, returns the name of the encoding, such as "UTF-16". Otherwise returns
// NULL.
const char *content_sniff_encoding(const Source *source);
// Called if a source failed to parse. If the source is not a script, replaces its diagnostics with a single error. A
// binary file is not a script. Nor is a text in which at least three lines and at least half of all lines are
// invalid, unless its name or hashbang line shows that it is meant to be one.
void content_sniff_report(const Source *source, DiagSink *diags);
