// archive.c: `petri archive`, whose parts are the other files of this folder.
#include "cli/options.h"

static int archive_run(const CommandContext *context, Options *options) {
    (void)context;
    StrNearest nearest = str_nearest(str_from(options->script));
    for (const Command *const *part = ARCHIVE_COMMAND.parts; *part; part++)
        nearest_offer(&nearest, (*part)->name + sizeof "archive");
    if (nearest.found.bytes)
        message("no such action: '%s'; did you mean 'petri archive %s'?", options->script, nearest.found.bytes);
    else
        message("no such action: '%s'; see 'petri help archive'", options->script);
    return STATUS_USAGE;
}

const Command ARCHIVE_COMMAND = {
    .name = "archive",
    .operands = "ACTION RUN.petri ...",
    .summary = "verify, inspect, cite or unpack an archived run",
    .details =
        "An archive contains a run with its script, files and results. 'petri run --archive' writes one, and 'petri\n"
        "run RUN.petri' replays it. 'petri help archive ACTION' lists the options of an action.",
    .examples = "  petri run dish.fl --archive run.petri           write an archive\n"
                "  petri archive verify run.petri                  compute it again\n",
    .missing_operand = "no action given",
    .second_operand_error = "too many arguments: '%s'; see 'petri help archive'",
    .accepts_two = true,
    .parts = (const Command *const[]){&VERIFY_COMMAND, &INFO_COMMAND, &CITE_COMMAND, &UNPACK_COMMAND, NULL},
    .run = archive_run,
};
