// peers.c: see peers.h.
#include "peers.h"

#include "worker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STYLES = 2 };

static const char *const styles[STYLES] = {"harmonic", "hooke"};

// Rates of LAMMPS on two ranks in million particle-steps per second, from tests/bench/PEERS.md, section 2. They were
// measured with a newer LAMMPS on another machine.
static const struct {
    const char *peer;
    int side;
    double rate[STYLES];
} published[] = {
    {"soft2d", 100, {42.3, 25.4}}, {"soft2d", 316, {33.3, 21.0}}, {"soft2d", 1000, {26.5, 15.9}},
    {"soft3d", 22, {18.5, 13.4}},  {"soft3d", 46, {15.6, 8.65}},  {"soft3d", 100, {13.8, 7.66}},
};

// One run of LAMMPS, or one round of petri.
typedef struct PeerRun {
    char style[16];   // force style that LAMMPS used; empty for petri
    double rate;      // particle-steps per second
    double cpu_share; // processor time as a percentage of run time, of each rank or of petri's script thread
} PeerRun;

static FILE *open_command(const char *folder, const char *arguments) {
    char command[256];
    snprintf(command, sizeof command, "\"$PETRI_PEERS/lammps.sh\" %s", arguments);
    // The folder is passed in a variable, because the shell does not parse a variable's value. So the path may contain
    // quotes.
    FILE *pipe = setenv("PETRI_PEERS", folder, 1) == 0 ? popen(command, "r") : NULL;
    if (!pipe) {
        fputs("bench: cannot run lammps.sh\n", stderr);
        exit(1);
    }
    return pipe;
}

bool peers_available(const char *folder, char *version, size_t size) {
    FILE *pipe = open_command(folder, "version");
    bool found = fgets(version, (int)size, pipe) != NULL;
    version[found ? strcspn(version, "\n") : 0] = '\0';
    return pclose(pipe) == 0 && found;
}

static PeerRun run_peer(const char *folder, const Case *c, const char *style, const Plan *plan) {
    char arguments[128];
    int steps = plan->tiny ? 20 : c->peer_steps;
    snprintf(arguments, sizeof arguments, "%d %d %d %s %d", strcmp(c->peer, "soft2d") ? 3 : 2, c->side, steps, style,
             plan->threads);
    PeerRun run = {0};
    FILE *pipe = open_command(folder, arguments);
    int found = fscanf(pipe, "%15s %lf %lf", run.style, &run.rate, &run.cpu_share);
    if (pclose(pipe) != 0 || found != 3) {
        fputs("bench: LAMMPS failed; omit --peers to measure petri only\n", stderr);
        exit(1);
    }
    return run;
}

// Returns the median rate. Runs that shared their processors are included only if all of them did.
static double clean_median(const PeerRun *runs, int count, int *clean) {
    double values[ROUNDS_MAX];
    *clean = 0;
    for (int i = 0; i < count; i++)
        if (runs[i].cpu_share >= 97)
            values[(*clean)++] = runs[i].rate;
    for (int i = 0; i < count && *clean == 0; i++)
        values[i] = runs[i].rate;
    return measure_median(values, *clean ? *clean : count);
}

static const Column columns[] = {
    {"workload", "workload", ""},
    {"steps", "steps per", "frame"},
    {"petri_million_per_s", "petri", "M/s"},
    {"lammps_style", "LAMMPS", "style"},
    {"lammps_million_per_s", "LAMMPS", "M/s"},
    {"ratio", "petri /", "LAMMPS"},
    {"petri_clean_runs", "clean", "petri"},
    {"lammps_clean_runs", "clean", "LAMMPS"},
    {"runs", "of", "runs"},
    {"published_million_per_s", "published", "M/s"},
};

static double published_rate(const Case *c, int style) {
    for (size_t i = 0; i < sizeof published / sizeof *published; i++)
        if (!strcmp(published[i].peer, c->peer) && published[i].side == c->side)
            return published[i].rate[style];
    return NAN;
}

static void store_ratio(PeerRatios *ratios, const Case *c, int ten, double ratio) {
    if (!strcmp(c->peer, "soft2d") && c->side == 316)
        ratios->discs_1e5[ten] = ratio;
    if (!strcmp(c->peer, "soft2d") && c->side == 1000)
        ratios->discs_1e6[ten] = ratio;
}

// Measures a workload. c[0] has frames of one step, c[1] frames of ten steps.
static void measure_peer(const Plan *plan, const char *folder, const Case *c, Table *table, PeerRatios *ratios) {
    Worker workers[2];
    int frames[2];
    PeerRun ours[2][ROUNDS_MAX], runs[STYLES][ROUNDS_MAX];
    int rounds = c->n > 200000 && plan->rounds > 3 ? 3 : plan->rounds < 5 ? plan->rounds : 5;
    for (int k = 0; k < 2; k++) {
        workers[k] = measure_warm_worker(plan, &c[k], plan->self, plan->threads);
        frames[k] = measure_round_frames(&workers[k], &c[k], plan->budget);
    }
    double start = clock_now();
    int done = 0;
    for (; done < rounds && (done == 0 || clock_now() - start < 2 * plan->patience); done++)
        for (int k = 0; k < 2; k++) {
            Sample s = worker_run(&workers[k], frames[k], false);
            ours[k][done] = (PeerRun){.rate = c->n * s.steps / s.frame, .cpu_share = s.cpu_share * 100};
            runs[k][done] = run_peer(folder, c, styles[k], plan);
        }
    for (int k = 0; k < 2; k++)
        worker_stop(&workers[k]);
    for (int style = 0; style < STYLES; style++)
        for (int k = 0; k < 2; k++) {
            int clean[2];
            double mine = clean_median(ours[k], done, &clean[0]), theirs = clean_median(runs[style], done, &clean[1]);
            Cell *row = table_row(table);
            row[0] = cell_text(c->name);
            row[1] = cell_number(c[k].steps);
            row[2] = cell_number(mine * 1e-6);
            row[3] = cell_text(runs[style][0].style);
            row[4] = cell_number(theirs * 1e-6);
            row[5] = cell_number(mine / theirs);
            row[6] = cell_number(clean[0]);
            row[7] = cell_number(clean[1]);
            row[8] = cell_number(done);
            row[9] = cell_number(published_rate(c, style));
            if (style == 0)
                store_ratio(ratios, c, k, mine / theirs);
        }
}

Table peers_measure(const Plan *plan, const char *folder, PeerRatios *ratios) {
    Table table =
        table_new("Particle-steps per second compared with LAMMPS", columns, sizeof columns / sizeof *columns);
    for (size_t i = 0; i < case_count; i++)
        if (cases[i].peer && cases[i].steps == 1 && measure_wanted(plan, &cases[i])) {
            fprintf(stderr, "bench: %s compared with LAMMPS\n", cases[i].name);
            measure_peer(plan, folder, &cases[i], &table, ratios);
        }
    return table;
}
