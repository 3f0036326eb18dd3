// open.c: see open.h.
#include "archive/open.h"

#include "cli/cli.h"

bool archive_report_problem(const PetriArchive *archive, const char *file) {
    const char *problem = archive ? petri_archive_problem(archive) : "out of memory";
    if (problem)
        message("cannot read '%s': %s", file, problem);
    return problem;
}

PetriArchive *archive_open(const Options *options, const char *file) {
    PetriArchive *archive = petri_archive_open(file, options->memory);
    if (archive_report_problem(archive, file))
        petri_archive_close(&archive);
    return archive;
}
