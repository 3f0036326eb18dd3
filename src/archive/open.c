// open.c: see open.h.
#include "archive/open.h"

#include "cli/archive.h"
#include "cli/option_groups.h"

PetriArchive *archive_open(const Options *options, const char *file) {
    PetriArchive *archive = replay_archive(options, file);
    if (archive_report_problem(archive, file))
        petri_archive_close(&archive);
    return archive;
}

// clang-format off
static const OptionSpec ROWS[] = {
    MEMORY_OPTION NO_MORE_OPTIONS
};
// clang-format on
const OptionTable ARCHIVE_OPTIONS = {.rows = ROWS};
