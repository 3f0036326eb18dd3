// verify.c: `petri archive verify`, which computes a run again and compares it with its archive.
#include "archive/open.h"
#include "archive/ranks.h"
#include "archive/report.h"
#include "archive/segments.h"
#include "base/spec.h"
#include "cli/option_groups.h"
#include "cli/output.h"
#include "cli/script.h"

#include <inttypes.h>
#include <string.h>
#include <unistd.h>

// Options that no other command has.
typedef struct Own {
    int64_t sample_segments; // 0: all
    const char *spec;        // as for spec_find; NULL: the present version
    const char *report;      // file, or "-"; NULL: none
} Own;

static bool read_spec(const Args *args, void *field) {
    unsigned old_rules;
    return spec_find(args->value, &old_rules) ? option_text(args, field) : option_choice(args, &(int){0});
}

static void print_digest(char mark, const uint8_t digest[DIGEST_BYTES], const char *origin, Output *output) {
    SCOPED_TEXT digits = {0};
    text_add_hex(&digits, digest, DIGEST_BYTES);
    output_format(output, "%c digest %s  (%s)\n", mark, digits.bytes, origin);
}

static void print_difference(const Verification *verification, Output *output) {
    const SegmentResult *found = &verification->result;
    output_format(output, "frame %" PRId64 " differs\n", found->frame);
    if (found->has_digests) {
        print_digest('-', found->digests[0], "archive", output);
        print_digest('+', found->digests[1], "computed", output);
    }
    if (found->details.len > 0)
        output_write(output, found->details.bytes, found->details.len);
}

// Returns true if the segment that differs is the same by the rules of `spec`.
static bool is_same_by(const Verification *verification, const char *spec) {
    Options options = *verification->options;
    options.spec = spec;
    Verification again = {.context = verification->context,
                          .options = &options,
                          .file = verification->file,
                          .stride = 1,
                          .count = 1,
                          .chosen = 1};
    again.segments = memory_calloc(sizeof *again.segments);
    *again.segments = verification->segments[verification->differs_at];
    segments_verify(&again);
    bool same = !again.failed && !again.differs;
    segments_free(&again);
    return same;
}

// Prints the changes since the specification `spec` that cause the difference: one that does so alone, or all together.
static void print_changes(const Verification *verification, const char *spec, Output *output) {
    const SpecChange *cause = NULL;
    for (size_t i = 0; i < SPEC_CHANGE_COUNT && !cause; i++)
        if (SPEC_CHANGES[i].rule && is_same_by(verification, SPEC_CHANGES[i].alone))
            cause = &SPEC_CHANGES[i];
    output_format(output, "the specification has changed since %s, by which this run was computed: ", spec);
    for (size_t i = 0, found = 0; i < SPEC_CHANGE_COUNT; i++)
        if (cause ? cause == &SPEC_CHANGES[i] : SPEC_CHANGES[i].rule)
            output_format(output, "%s%s (lib/spec/%s)", found++ > 0 ? "; " : "", SPEC_CHANGES[i].sentence,
                          SPEC_CHANGES[i].section);
    SCOPED_TEXT command = {0};
    text_add_c(&command, "petri archive verify --spec ");
    shell_add_word(&command, spec);
    text_add_c(&command, " ");
    shell_add_word(&command, verification->file);
    output_format(output, "\nto compute by the rules of %s, run '%s'\n", spec, command.bytes);
}

// Says why the first frame differs, or how to find out.
static void print_cause(const Verification *verification, const char *spec, Output *output) {
    unsigned old_rules, chosen;
    bool other = spec_find(verification->options->spec, &chosen) && spec_find(spec, &old_rules) && old_rules != chosen;
    if (other && is_same_by(verification, spec)) {
        if (old_rules)
            print_changes(verification, spec, output);
        else
            output_format(output, "the run was computed by version %s of the specification, not by %s\n", spec,
                          verification->options->spec);
        return;
    }
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
    if (done && verification.differs) {
        print_difference(&verification, output);
        print_cause(&verification, info.spec, output);
    } else if (done)
        print_success(&verification, &info, output);
    if (done)
        status = verification.differs ? STATUS_FAILED : STATUS_DONE;
    const char *report = ((const Own *)options->own)->report;
    bool reports = status == STATUS_DONE && report && ranks_is_first(&verification);
    if (reports && !report_write(archive, options->spec, report))
        status = STATUS_FAILED;
    segments_free(&verification);
    return status;
}

static int verify_run(const CommandContext *context, Options *options) {
    if (((const Own *)options->own)->report && ((const Own *)options->own)->sample_segments > 0) {
        message("a report needs all frames; drop --sample");
        return STATUS_USAGE;
    }
    const char *report = ((const Own *)options->own)->report;
    if (report && petri_archive_is(report)) {
        message("cannot write a report to '%s': it is an archive", report);
        return STATUS_USAGE;
    }
    Output output;
    PetriArchive *archive = archive_open(options, options->script);
    if (!archive)
        return STATUS_DAMAGED;
    const char *spec = ((const Own *)options->own)->spec;
    options->spec = spec ? spec : SPEC_VERSION;
    output_start(&output, STDOUT_FILENO);
    int status = verify_archive(context, options, archive, &output);
    petri_archive_close(&archive);
    return output_finish(&output, status);
}

// clang-format off
static const OptionSpec ROWS[] = {
    LIMIT_OPTIONS
    OWN("spec", 0, "VERSION", ONE_OF(read_spec, SPEC_VERSION, SPEC_FIRST), spec, "compute by this version of the specification (default: " SPEC_VERSION ")")
    OWN("report", 0, "FILE", option_text, report, "if all frames are verified, write a report for a publication to FILE (-: standard output)")
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
                "  petri archive verify run.petri --report run.txt write a report that others can check\n"
                "  petri archive verify old.petri --spec 0.3       compute by the rules of petri 0.3\n"
                "  mpirun -n 16 petri archive verify run.petri     divide the segments among 16 processes\n",
    .missing_operand = "no archive given",
    .no_stdin = "cannot read an archive from standard input; give a file",
    .second_operand_error = "too many arguments: '%s'; petri archive verify takes one archive",
    .options = &VERIFY_OPTIONS,
    .run = verify_run,
};
