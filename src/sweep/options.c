// options.c: see options.h.
#include "sweep/options.h"

#include "cli/motion.h"
#include "cli/option_groups.h"

#include <stdlib.h>
#include <string.h>

typedef SweepOptions Own;

// Reads NAME=EXPR or the name of a quantity (motion.h).
static bool read_metric(const Args *args, void *field) {
    if (motion_quantity(args->value) == MOTION_QUANTITIES && !strchr(args->value, '='))
        return option_invalid(args,
                              "NAME=EXPR, energy, kinetic_energy, potential_energy, momentum or angular_momentum");
    if (strchr(args->value, '=') == args->value)
        return option_invalid(args, args->option->value);
    texts_add(field, args->value);
    return true;
}

static bool read_percentage(const Args *args, void *field) {
    char *end = NULL;
    double value = *(double *)field = strtod(args->value, &end);
    bool good = end != args->value && end[*end == '%'] == '\0' && value >= 0 && value <= 100;
    return good || option_invalid(args, "a percentage such as 1%");
}

// clang-format off
static const OptionSpec ROWS[] = {
    OWN("define", 'D', "NAME=VALUES", IS_LIST(option_definition), axes, "set the values of a parameter, such as 1..10, 0..1|0.05 or 1;5;20; may be repeated")
    OWN("sample", 0, "latin:N", option_text, sample, "choose N runs by Latin hypercube sampling instead of all combinations; latin:N:SEED sets its seed")
    OWN("seeds", 0, "N", WHOLE(1, 1000000), seeds, "repeat each combination N times, with SEED from 1 to N")
    OWN("where", 0, "EXPR", option_text, where, "run only combinations for which EXPR is true, such as 'A < B'")
    OWN("metric", 0, "NAME=EXPR", IS_LIST(read_metric), metrics, "measure EXPR as column NAME, or one of: energy, kinetic_energy, potential_energy, momentum, angular_momentum; may be repeated")
    SHARED("frames", 0, "N", WHOLE(0, INT64_MAX), frames, "end each run after N frames (default: 600)")
    OWN("until", 0, "EXPR", option_text, until, "end each run after the first frame in which EXPR is true")
    OWN("every", 0, "K", WHOLE(1, INT64_MAX), row_every, "also write a row for every K-th frame (default: only the last)")
    OWN("trust", 0, NULL, option_flag, trust, "also write how many digits of each metric can be trusted; each run takes nine times as long")
    OWN("output", 'o', "FILE", option_text, output, "write the table to FILE and resume if it is partial (default: standard output)")
    OWN("summary", 0, "FILE", option_text, summary, "write the mean, standard deviation and quartiles of each metric over the seeds to FILE")
    OWN("plot", 0, "FILE", option_text, plot, "plot each metric against each parameter in FILE (.svg, .png or .pdf)")
    OWN("plan", 0, "FILE", option_text, plan, "read the script and the options from FILE; the command line overrides them")
    OWN("jobs", 0, "N", WHOLE(1, 1024), jobs, "execute N runs in parallel (default: number of CPUs)")
    OWN("cache", 0, "DIR", option_text, cache, "store the results of runs in the folder DIR, and do not compute runs again whose results are there")
    OWN("verify-cache", 0, "P%", read_percentage, verify_cache, "compute P % of the runs that have a result in the cache again, and report differences (default: 0)")
    OWN("shard", 0, "I/N", option_text, shard, "divide the runs into N parts and execute only part I")
    FPS_OPTION READ_OPTIONS
    SHARED("threads", 0, "N", WHOLE(1, 1024), threads, "use N worker threads per run (default: 1); does not change results")
    LIMIT_OPTIONS METHOD_OPTIONS QUIET_OPTION COLOUR_OPTION NO_MORE_OPTIONS
};
// clang-format on
const OptionTable SWEEP_OPTIONS = {ROWS, sizeof(Own), NULL};
