// sweeps.c: see sweeps.h. The fastest round is reported, because disturbances only make rounds slower, especially when
// all processors are in use.
#include "sweeps.h"

#include <math.h>

static double time_sweep(const Plan *plan, int jobs, int runs) {
    char path[4096], seeds[32], processes[32];
    snprintf(path, sizeof path, "%s/petri_n50.fl", plan->scripts);
    snprintf(seeds, sizeof seeds, "--seeds=%d", runs);
    snprintf(processes, sizeof processes, "--jobs=%d", jobs);
    return measure_command(plan, (const char *[]){plan->petri, "sweep", path, seeds, processes, "--frames=100",
                                                  "--metric=x=$(:dish;3)", "--metric=seed=SEED", "--quiet", NULL});
}

Table sweeps_measure(const Plan *plan) {
    static const Column columns[] = {{"sweep", "sweep", ""},       {"jobs", "", "jobs"},
                                     {"seconds", "", "s"},         {"runs_per_s", "", "runs/s"},
                                     {"speed_up", "speed-", "up"}, {"of_jobs", "of", "jobs"}};
    Table table = table_new("1000 runs of 100 frames: a dish of 50 cells, petri sweep", columns,
                            sizeof columns / sizeof *columns);
    int runs = plan->tiny ? 8 : 1000;
    double fastest[2] = {INFINITY, INFINITY};
    for (int round = 0; round < plan->rounds; round++)
        for (int k = 0; k < 2; k++)
            fastest[k] = fmin(fastest[k], time_sweep(plan, k == 0 ? 1 : plan->threads, runs));
    for (int k = 0; k < 2; k++) {
        Cell *row = table_row(&table);
        int jobs = k == 0 ? 1 : plan->threads;
        row[0] = cell_text(k == 0 ? "one process" : "several processes");
        row[1] = cell_number(jobs);
        row[2] = cell_number(fastest[k]);
        row[3] = cell_number(runs / fastest[k]);
        row[4] = cell_number(fastest[0] / fastest[k]);
        row[5] = cell_number(fastest[0] / fastest[k] / jobs);
    }
    return table;
}
