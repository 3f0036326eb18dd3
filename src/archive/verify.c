// verify.c: `petri archive verify`, which computes a run again and compares it with its archive.
#include "archive/open.h"
#include "archive/ranks.h"
#include "archive/segments.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/script.h"

#include <inttypes.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    int64_t sample_segments; // 0: all
} Own;

static void print_difference(const Verification *verification, Output *output) {
    const SegmentResult *found = &verification->result;
    output_format(output, "frame %" PRId64 " differs\n", found->frame);
    if (found->has_digests)
        output_format(output, "- digest %s  (archive)\n+ digest %s  (computed)\n", found->digests[0],
                      found->digests[1]);
    if (found->details.len > 0)
        output_write(output, found->details.bytes, found->details.len);
    // An archive has digests and states, but no forces. They are known only to the program that computed them.
    SCOPED_TEXT command = {0};
    text_add_c(&command, "petri diff ");
    shell_add_word(&command, verification->file);
    output_format(output, "to compare the forces, run '%s --with PROGRAM' with the petri that wrote the archive\n",
                  command.bytes);
}

static void print_success(const Verification *verification, const PetriArchiveInfo *info, Output *output) {
    output_format(output, "verified: %" PRId64 " of %" PRId64 " frames, %zu of %zu segments", verification->frames,
                  info->last_frame - info->first_frame + 1, verification->chosen, verification->count);
    if (verification->given > 1)
        output_format(output, "; states that were given, not computed: %zu", verification->given - 1);
    output_format(output, "\ndigest %s%s\n", info->sha256,
                  info->sealed_frame < info->last_frame ? " (does not cover the last frames)" : "");
}

static int verify_archive(const CommandContext *context, const Options *options, PetriArchive *archive,
                          Output *output) {
    PetriArchiveInfo info;
    if (petri_archive_check(archive) != PETRI_OK || !petri_archive_info(archive, &info, sizeof info)) {
        archive_report_problem(archive, options->script);
        return STATUS_DAMAGED;
    }
    if (info.keyframes == 0) {
        message("cannot verify '%s': it has no frames", options->script);
        return STATUS_DAMAGED;
    }
    CommandContext alone = *context; // each rank computes its segments itself
    alone.ranks = NULL;
    Verification verification = {.context = &alone, .options = options, .file = options->script, .stride = 1};
    segments_choose(&verification, archive, ((const Own *)options->own)->sample_segments);
    ranks_divide(&verification);
    segments_verify(&verification);
    ranks_combine(&verification);
    bool done = !verification.failed;
    int status = STATUS_DAMAGED;
    if (done && verification.differs)
        print_difference(&verification, output);
    else if (done)
        print_success(&verification, &info, output);
    if (done)
        status = verification.differs ? STATUS_FAILED : STATUS_DONE;
    segments_free(&verification);
    return status;
}

static int verify_run(const CommandContext *context, Options *options) {
    Output output;
    PetriArchive *archive = archive_open(options, options->script);
    if (!archive)
        return STATUS_DAMAGED;
    output_start(&output, STDOUT_FILENO);
    int status = verify_archive(context, options, archive, &output);
    petri_archive_close(&archive);
    return output_finish(&output, status);
}

// clang-format off
static const OptionSpec ROWS[] = {
    LIMIT_OPTIONS
    OWN("sample", 0, "K", WHOLE(1, INT64_MAX), sample_segments, "verify only K segments, chosen at random")
    SHARED("threads", 0, "N", WHOLE(1, 1024), threads, "verify N segments at a time (default: number of CPUs)")
    QUIET_OPTION NO_MORE_OPTIONS
};
// clang-format on
static const OptionTable VERIFY_OPTIONS = {ROWS, sizeof(Own), NULL};

const Command VERIFY_COMMAND = {
    .name = "archive verify",
    .operands = "RUN.petri",
    .summary = "compute an archived run again and compare every frame",
    .details =
        "Checks that an archive is not damaged, computes its run again and compares all recorded digests and states.\n"
        "The frames between two keyframes are a segment; segments are verified in parallel. Under\n"
        "mpirun, the processes share them. Exits with 0 if the run is verified, 1 if a frame differs, and 2 if the\n"
        "archive is damaged or was made by a newer version of petri.",
    .examples = "  petri run dish.fl --archive run.petri           write an archive\n"
                "  petri archive verify run.petri                  verify all frames\n"
                "  petri archive verify run.petri --sample 5       verify five random segments\n"
                "  mpirun -n 16 petri archive verify run.petri     divide the segments among 16 processes\n",
    .missing_operand = "no archive given",
    .no_stdin = "cannot read an archive from standard input; give a file",
    .second_operand_error = "too many arguments: '%s'; petri archive verify takes one archive",
    .options = &VERIFY_OPTIONS,
    .run = verify_run,
};
