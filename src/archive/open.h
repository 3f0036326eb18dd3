// open.h: archives as operands of commands.
#pragma once

#include "cli/archive.h"
#include "cli/options.h"
#include "petri-archive.h"

enum { STATUS_DAMAGED = 2 }; // exit status for a damaged archive, or one that a newer version has made

// The options of actions that only read an archive.
extern const OptionTable ARCHIVE_OPTIONS;

// Opens an archive. Returns NULL after a message.
PetriArchive *archive_open(const Options *options, const char *file);
