// open.h: archives as operands of commands.
#pragma once

#include "cli/options.h"
#include "petri-archive.h"

enum { STATUS_DAMAGED = 2 }; // exit status for a damaged archive, or one that a newer version has made

// Opens an archive. Returns NULL after a message.
PetriArchive *archive_open(const Options *options, const char *file);
// Prints the problem of an archive, if there is one. Returns true if there is one.
bool archive_report_problem(const PetriArchive *archive, const char *file);
