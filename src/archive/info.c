// info.c: `petri info`, which prints what is in an archive.
#include "archive/open.h"
#include "cli/output.h"

#include <inttypes.h>
#include <unistd.h>

static void print_files(PetriArchive *archive, Output *output) {
    PetriArchiveFile file;
    for (size_t i = 0; petri_archive_file(archive, i, &file, sizeof file); i++) {
        output_format(output, "file        %s: ", file.name);
        if (!file.bytes)
            output_format(output, "removed");
        else
            output_format(output, "%zu bytes", file.length);
        if (file.frame > 0)
            output_format(output, ", from frame %" PRId64, file.frame);
        output_format(output, "\n");
    }
}

static void print_info(PetriArchive *archive, Output *output) {
    PetriArchiveInfo info;
    const char *name, *value;
    if (!petri_archive_info(archive, &info, sizeof info))
        return;
    output_format(output, "script      %s\n", info.script);
    output_format(output, "command     %s\n", info.command);
    output_format(output, "petri       %s\n", info.version);
    for (size_t i = 0; petri_archive_parameter(archive, i, &name, &value); i++)
        output_format(output, "parameter   %s=%s\n", name, value);
    print_files(archive, output);
    if (info.last_frame < info.first_frame)
        output_format(output, "frames      none\n");
    else
        output_format(output, "frames      %" PRId64 " to %" PRId64 "\n", info.first_frame, info.last_frame);
    output_format(output, "keyframes   %" PRId64 "\ndigests     %" PRId64 "\ninputs      %" PRId64 "\n", info.keyframes,
                  info.digests, info.inputs);
    output_format(output, "digest      %s%s\n", info.sha256,
                  info.sealed_frame < info.last_frame ? " (does not cover the last frames)" : "");
}

static int info_run(const CommandContext *context, Options *options) {
    (void)context;
    Output output;
    PetriArchive *archive = archive_open(options, options->script);
    if (!archive)
        return STATUS_DAMAGED;
    output_start(&output, STDOUT_FILENO);
    print_info(archive, &output);
    int status = archive_report_problem(archive, options->script) ? STATUS_DAMAGED : STATUS_DONE;
    petri_archive_close(&archive);
    return output_finish(&output, status);
}

const Command INFO_COMMAND = {
    .name = "info",
    .operands = "RUN.petri",
    .summary = "print what is in an archive of a run",
    .details =
        "Prints the script, command line, parameters, files, frames and digest of an archive. Control characters\n"
        "are not removed: do not print archives from strangers to a terminal that interprets them. Exits with 2\n"
        "if the archive is damaged or was made by a newer version of petri; 'petri verify' checks it completely.",
    .examples = "  petri run dish.fl --archive run.petri    write an archive\n"
                "  petri info run.petri                     print what is in it\n",
    .missing_operand = "no archive given",
    .no_stdin = "cannot read an archive from standard input; give a file",
    .second_operand_error = "too many arguments: '%s'; petri info takes one archive",
    .options = FOR_INFO,
    .run = info_run,
};
