// info.c: `petri archive info`, which prints what is in an archive.
#include "archive/open.h"
#include "cli/output.h"

#include <inttypes.h>
#include <unistd.h>

// Prints a line with a text from the archive, which may come from a stranger.
static void print_line(Output *output, const char *label, const char *text) {
    SCOPED_TEXT line = {0};
    text_add_printable(&line, str_from(text), "");
    output_format(output, "%-12s%s\n", label, line.bytes ? line.bytes : "");
}

static void print_files(PetriArchive *archive, Output *output) {
    PetriArchiveFile file;
    for (size_t i = 0; petri_archive_file(archive, i, &file, sizeof file); i++) {
        SCOPED_TEXT line = {0};
        text_add_format(&line, "%s: ", file.name);
        if (!file.bytes)
            text_add_c(&line, "removed");
        else
            text_add_format(&line, "%zu bytes", file.length);
        if (file.frame > 0)
            text_add_format(&line, ", from frame %" PRId64, file.frame);
        print_line(output, "file", line.bytes);
    }
}

static void print_info(PetriArchive *archive, Output *output) {
    PetriArchiveInfo info;
    const char *name, *value;
    if (!petri_archive_info(archive, &info, sizeof info))
        return;
    print_line(output, "script", info.script);
    print_line(output, "command", info.command);
    print_line(output, "petri", info.version);
    print_line(output, "spec", info.spec);
    for (size_t i = 0; petri_archive_parameter(archive, i, &name, &value); i++) {
        SCOPED_TEXT line = {0};
        text_add_format(&line, "%s=%s", name, value);
        print_line(output, "parameter", line.bytes);
    }
    print_files(archive, output);
    if (info.last_frame < info.first_frame)
        output_format(output, "frames      none\n");
    else
        output_format(output, "frames      %" PRId64 " to %" PRId64 "\n", info.first_frame, info.last_frame);
    output_format(output, "keyframes   %" PRId64 "\ndigests     %" PRId64 "\ninputs      %" PRId64 "\n", info.keyframes,
                  info.digests, info.inputs);
    SCOPED_TEXT digest = {0};
    text_add_c(&digest, info.sha256);
    if (info.sealed_frame < info.last_frame)
        text_add_c(&digest, " (does not cover the last frames)");
    print_line(output, "digest", digest.bytes);
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
    .name = "archive info",
    .operands = "RUN.petri",
    .summary = "print what is in an archive of a run",
    .details =
        "Prints the script, command line, parameters, files, frames and digest of an archive. Control characters\n"
        "in them are printed as '?'. Exits with 2 if the archive is damaged or was made by a newer version of\n"
        "petri; 'petri archive verify' checks it completely.",
    .examples = "  petri archive info run.petri\n",
    .missing_operand = "no archive given",
    .no_stdin = "cannot read an archive from standard input; give a file",
    .second_operand_error = "too many arguments: '%s'; petri archive info takes one archive",
    .options = &ARCHIVE_OPTIONS,
    .run = info_run,
};
