// report.h: the report of a verified run, a short text that a journal can print.
#pragma once

#include "petri-archive.h"

#include <stdbool.h>

// Writes the report to a file, or to standard output if `file` is "-". All frames must have been verified. `spec` is
// the version of the specification by which they were. Returns false after a message.
bool report_write(PetriArchive *archive, const char *spec, const char *file);
