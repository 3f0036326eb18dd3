// fuzz_plan.c: fuzzes plans of sweeps. The input is a plan, whose words are then parsed as the command line of `petri
// sweep`. The runs are planned but not executed.
#include "cli/options.h"
#include "fuzz.h"
#include "sweep/options.h"
#include "sweep/plots.h"

#include <string.h>

static int plan_runs(const CommandContext *context, Options *options) {
    Design design = {0};
    // More runs are valid, but would only take more time here.
    const SweepOptions *own = sweep_options(options);
    bool small = own->seeds < 1000 && (!own->sample || strlen(own->sample) < 10);
    if (small && design_make(&design, options, context))
        for (size_t run = 0; run < design.run_count; run++)
            for (size_t i = 0; i < design.axis_count; i++)
                fuzz_sink(NULL, design_value(&design, run, i), 1);
    design_free(&design);
    return STATUS_DONE;
}

FUZZ_HARNESS(plan) {
    static const CommandContext context = {.program = "petri", .invoked_as = "petri", .stack_bytes = 1 << 20};
    Command command = SWEEP_COMMAND;
    TextList words = {0};
    command.run = plan_runs;
    fuzz_put("plan.yaml", data, size);
    if (plan_read(fuzz_file("plan.yaml"), &words))
        command_run(&command, &context, (int)words.count, words.items);
    texts_free(&words);
    return 0;
}
