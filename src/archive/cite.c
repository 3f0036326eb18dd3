// cite.c: `petri archive cite`, which prints how to cite an archived run.
#include "archive/open.h"
#include "cli/output.h"

#include <string.h>
#include <unistd.h>

static const char BIBTEX_SPECIAL[] = "#$%&_{}\\~^";
enum { SHORT_DIGEST = 12 }; // digits of the digest in the key of BibTeX

// Adds a text with each character of `special` escaped by a backslash. The text may come from a stranger.
static void add_escaped(Text *text, const char *part, const char *special) {
    SCOPED_TEXT printable = {0};
    text_add_printable(&printable, str_from(part), "");
    text_add_c(text, "");
    for (size_t i = 0; i < printable.len; i++) {
        if (strchr(special, printable.bytes[i]))
            text_add_char(text, '\\');
        text_add_char(text, printable.bytes[i]);
    }
}

static void print_citation(const PetriArchiveInfo *info, Output *output) {
    SCOPED_TEXT bibtex = {0};
    SCOPED_TEXT yaml = {0};
    SCOPED_TEXT version = {0};
    add_escaped(&bibtex, info->script, BIBTEX_SPECIAL);
    add_escaped(&yaml, info->script, "\"\\");
    add_escaped(&version, info->version, BIBTEX_SPECIAL);
    output_format(output, "digest: %s\n\n", info->sha256);
    output_format(output,
                  "@misc{petri-%.*s,\n  title = {Archive of a run of %s},\n  note = {petri %s, run digest %s},\n"
                  "  howpublished = {verify with: petri archive verify}\n}\n\n",
                  SHORT_DIGEST, info->sha256, bibtex.bytes, version.bytes, info->sha256);
    output_format(
        output,
        "cff-version: 1.2.0\nmessage: If you use this run, please cite it.\ntype: dataset\n"
        "title: \"Archive of a run of %s\"\nauthors:\n  - name: \"your name\"\nidentifiers:\n"
        "  - type: other\n    value: \"sha256:%s\"\n    description: digest of the run, see petri archive verify\n",
        yaml.bytes, info->sha256);
}

static int cite_run(const CommandContext *context, Options *options) {
    (void)context;
    PetriArchiveInfo info;
    Output output;
    PetriArchive *archive = archive_open(options, options->script);
    if (!archive)
        return STATUS_DAMAGED;
    output_start(&output, STDOUT_FILENO);
    int status = STATUS_DONE;
    if (petri_archive_check(archive) != PETRI_OK || !petri_archive_info(archive, &info, sizeof info)) {
        archive_report_problem(archive, options->script);
        status = STATUS_DAMAGED;
    } else if (info.sealed_frame < info.last_frame || info.last_frame < 0) {
        message("cannot cite '%s': its digest does not cover all frames, because its run did not end regularly",
                options->script);
        status = STATUS_FAILED;
    } else {
        print_citation(&info, &output);
    }
    petri_archive_close(&archive);
    return output_finish(&output, status);
}

const Command CITE_COMMAND = {
    .name = "archive cite",
    .operands = "RUN.petri",
    .summary = "print how to cite an archived run",
    .details =
        "Prints the digest of a run, an entry for BibTeX, and the text of a file CITATION.cff. The digest covers\n"
        "everything in the archive: script, files, inputs and results. A run that has another digest is another run.\n"
        "Checks first that the archive is not damaged.",
    .examples = "  petri archive cite run.petri\n",
    .missing_operand = "no archive given",
    .no_stdin = "cannot read an archive from standard input; give a file",
    .second_operand_error = "too many arguments: '%s'; petri archive cite takes one archive",
    .options = &ARCHIVE_OPTIONS,
    .run = cite_run,
};
