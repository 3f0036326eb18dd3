// open.c: see open.h.
#include "archive/open.h"

#include "cli/archive.h"

PetriArchive *archive_open(const Options *options, const char *file) {
    PetriArchive *archive = petri_archive_open(file, options->memory);
    if (archive_report_problem(archive, file))
        petri_archive_close(&archive);
    return archive;
}
