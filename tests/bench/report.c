// report.c: see report.h.
#include "report.h"

#include <math.h>

static const Column workload_columns[] = {
    {"workload", "workload", ""},
    {"evaluation_us", "evalua-", "tion us"},
    {"physics_us", "physics", "us"},
    {"frame_us", "frame", "us"},
    {"frame_spread_percent", "spread", "%"},
    {"clean_rounds", "clean", "rounds"},
    {"rounds", "of", "rounds"},
    {"output_us", "output", "us"},
    {"unit", "counted", "by"},
    {"unit_ns", "ns", "each"},
    {"limit_ns", "limit", "ns"},
    {"of_limit_percent", "of limit", "%"},
    {"threads_physics_us", "threads:", "physics"},
    {"threads_frame_us", "threads:", "frame"},
    {"speed_up", "speed-", "up"},
    {"exponent", "expo-", "nent"},
    {"start_least_ms", "start", "min ms"},
    {"start_median_ms", "start", "ms"},
    {"load_ms", "load", "ms"},
    {"peak_mib", "peak", "MiB"},
    {"bytes_per_particle", "bytes", "each"},
    {"allocations", "heap", "calls"},
};

static double unit_seconds(const Case *c, const Figures *f) {
    double pairs = 0.5 * c->n * (c->n - 1.0);
    if (c->unit == PER_PARTICLE)
        return f->evaluation / c->n;
    return f->physics / f->steps / (c->unit == PER_PAIR ? pairs : c->n);
}

// Returns the time whose growth with the number of particles is reported. This is the time of the whole frame if most
// of the work is in the script, otherwise the time of the physics.
static double growing(const Case *c, const Figures *f) {
    return c->unit == PER_PARTICLE ? f->frame : f->physics;
}

static double exponent_of(const Results *results, size_t index) {
    size_t before = case_before(index);
    if (before == case_count || !results->figures[before].done)
        return NAN;
    double smaller = growing(&cases[before], &results->figures[before]);
    return log(growing(&cases[index], &results->figures[index]) / smaller) /
           log((double)cases[index].n / cases[before].n);
}

static void workload_row(const Results *results, size_t index, Cell *row) {
    static const char *const units[] = {"pair", "step", "particle"};
    const Case *c = &cases[index];
    const Figures *f = &results->figures[index];
    double unit = unit_seconds(c, f) * 1e9;
    int k = 0;
    row[k++] = cell_text(c->name);
    row[k++] = cell_number(f->evaluation * 1e6);
    row[k++] = cell_number(f->physics * 1e6);
    row[k++] = cell_number(f->frame * 1e6);
    row[k++] = cell_number((f->frame / f->fastest - 1) * 100);
    row[k++] = cell_number(f->clean);
    row[k++] = cell_number(f->rounds);
    row[k++] = cell_number(f->output * 1e6);
    row[k++] = cell_text(units[c->unit]);
    row[k++] = cell_number(unit);
    row[k++] = cell_number(f->limit);
    row[k++] = cell_number(f->limit / unit * 100);
    row[k++] = cell_number(f->physics_threads * 1e6);
    row[k++] = cell_number(f->frame_threads * 1e6);
    row[k++] = cell_number(f->physics / f->physics_threads);
    row[k++] = cell_number(exponent_of(results, index));
    row[k++] = cell_number(f->fastest_start * 1e3);
    row[k++] = cell_number(f->start_median * 1e3);
    row[k++] = cell_number(f->load * 1e3);
    row[k++] = cell_number(f->peak / 1048576);
    row[k++] = cell_number(f->per_particle);
    row[k++] = cell_number(f->allocations);
}

Table report_workloads(const Results *results) {
    Table table = table_new("Workloads", workload_columns, sizeof workload_columns / sizeof *workload_columns);
    for (size_t i = 0; i < case_count; i++)
        if (results->figures[i].done)
            workload_row(results, i, table_row(&table));
    return table;
}

static const Column build_columns[] = {
    {"workload", "workload", ""},
    {"physics_us", "physics", "us"},
    {"other_physics_us", "other:", "physics us"},
    {"physics_ratio", "other /", "this"},
    {"frame_us", "frame", "us"},
    {"other_frame_us", "other:", "frame us"},
    {"frame_ratio", "other /", "this"},
    {"evaluation_us", "evalua-", "tion us"},
    {"other_evaluation_us", "other: eva-", "luation us"},
    {"evaluation_ratio", "other /", "this"},
};

Table report_builds(const Results *results) {
    Table table =
        table_new("Comparison with the other build", build_columns, sizeof build_columns / sizeof *build_columns);
    for (size_t i = 0; i < case_count; i++) {
        const Figures *f = &results->figures[i];
        if (!f->done)
            continue;
        // With plan->threads == 1, there is no separate variant with several threads.
        double physics = isnan(f->physics_threads) ? f->physics : f->physics_threads;
        double frame = isnan(f->frame_threads) ? f->frame : f->frame_threads;
        double evaluation = isnan(f->evaluation_threads) ? f->evaluation : f->evaluation_threads;
        Cell *row = table_row(&table);
        row[0] = cell_text(cases[i].name);
        row[1] = cell_number(physics * 1e6);
        row[2] = cell_number(f->other_physics * 1e6);
        row[3] = cell_number(f->other_physics / physics);
        row[4] = cell_number(frame * 1e6);
        row[5] = cell_number(f->other_frame * 1e6);
        row[6] = cell_number(f->other_frame / frame);
        row[7] = cell_number(evaluation * 1e6);
        row[8] = cell_number(f->other_evaluation * 1e6);
        row[9] = cell_number(f->other_evaluation / evaluation);
    }
    return table;
}

// ---- targets

// What a target measures.
typedef enum Measure {
    FRAME_MS,
    PHYSICS_MS,
    EVALUATION_MS,
    START_MS,
    LOAD_MS,
    BYTES,
    GROWTH,
    BEYOND_STEP_NS,
    KERNEL_2D,
    KERNEL_3D,
    PEER_1E5,
    PEER_1E5_X10,
    PEER_1E6,
    PEER_1E6_X10,
} Measure;

typedef struct Target {
    const char *what;
    const char *unit;
    const char *workload; // name in cases.c; NULL: the target has no row there
    Measure measure;
    double reference; // figure of the reference implementation; 0: none
    double must, aim; // required value, and desired value (0: none)
} Target;

// The reference implementation's figures were published with the workloads (tests/bench/PEERS.md, section 1).
static const Target targets[] = {
    {"dish 200: whole frame", "ms", "dish 200", FRAME_MS, 0.68, 0.055, 0.03},
    {"dish 1000: whole frame", "ms", "dish 1000", FRAME_MS, 10.4, 0.6, 0.4},
    {"packed box 4000: whole frame", "ms", "packed box 4000", FRAME_MS, 90.7, 0.6, 0.3},
    {"gravity 4000: physics", "ms", "gravity 4000", PHYSICS_MS, 147, 9, 6.5},
    {"soft discs 1e4: physics", "ms", "soft discs 10000", PHYSICS_MS, 647, 0.4, 0.12},
    {"soft discs 1e5: one step compared with LAMMPS", "times", NULL, PEER_1E5, 0, 1.2, 3},
    {"soft discs 1e6: one step compared with LAMMPS", "times", NULL, PEER_1E6, 0, 1.2, 3},
    {"soft discs 1e5: ten steps compared with LAMMPS", "times", NULL, PEER_1E5_X10, 0, 2, 4},
    {"soft discs 1e6: ten steps compared with LAMMPS", "times", NULL, PEER_1E6_X10, 0, 2, 4},
    {"script 2000: evaluation", "ms", "script 2000", EVALUATION_MS, 11.5, 1.2, 0.7},
    {"dish 200: start to first frame", "ms", "dish 200", START_MS, 315, 10, 4},
    {"electrostatic pairs: rate of the limit", "%", NULL, KERNEL_2D, 0, 85, 95},
    {"gravity pairs: rate of the limit", "%", NULL, KERNEL_3D, 0, 85, 95},
    {"dish: growth from 50 to 4000", "exponent", "dish 4000", GROWTH, 0, 2.05, 0},
    {"soft discs: growth from 1e4 to 1e6", "exponent", "soft discs 1000000", GROWTH, 0, 1.1, 0},
    {"soft discs 1e6: memory per particle", "bytes", "soft discs 1000000", BYTES, 0, 400, 0},
    {"soft discs 1e6: loading", "ms", "soft discs 1000000", LOAD_MS, 0, 3000, 0},
    {"soft discs 1e6: frame beyond its step per particle", "ns", "soft discs 1000000", BEYOND_STEP_NS, 0, 25, 0},
};

static double on_threads(double threads, double one) {
    return isnan(threads) ? one : threads;
}

// Returns the exponent with which time grows with n, from the row `last` and the smaller rows of its family. It is the
// least-squares slope of log time over log n. Returns NaN if one of these rows was not measured.
static double growth_of(const Results *results, size_t last) {
    double count = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (size_t i = last; i != case_count; i = case_before(i)) {
        if (!results->figures[i].done)
            return NAN;
        double u = log(cases[i].n), v = log(growing(&cases[i], &results->figures[i]));
        count++, x += u, y += v, xx += u * u, xy += u * v;
    }
    return (count * xy - x * y) / (count * xx - x * x);
}

// Returns B, the part of a frame's time that does not depend on the number of steps. A frame of one step takes B + S
// seconds (row `index`), and a frame of ten steps takes B + 10 S seconds (the next row).
static double beyond_step(const Results *results, size_t index) {
    const Figures *one = &results->figures[index], *ten = one + 1;
    if (!ten->done)
        return NAN;
    return (10 * on_threads(one->frame_threads, one->frame) - on_threads(ten->frame_threads, ten->frame)) / 9;
}

static double of_workload(const Results *results, const Target *t) {
    size_t i = case_find(t->workload);
    const Figures *f = &results->figures[i];
    if (!f->done)
        return NAN;
    switch (t->measure) {
    case FRAME_MS:
        return on_threads(f->frame_threads, f->frame) * 1e3;
    case PHYSICS_MS:
        return on_threads(f->physics_threads, f->physics) * 1e3;
    case EVALUATION_MS:
        return f->evaluation * 1e3;
    case START_MS:
        return f->start_median * 1e3;
    case LOAD_MS:
        return f->load * 1e3;
    case BYTES:
        return f->per_particle;
    case GROWTH:
        return growth_of(results, i);
    default:
        return beyond_step(results, i) / cases[i].n * 1e9;
    }
}

static double ours_of(const Results *results, const Target *t) {
    if (t->workload)
        return of_workload(results, t);
    switch (t->measure) {
    case KERNEL_2D:
    case KERNEL_3D: {
        const KernelFigures *k = &results->kernels[t->measure == KERNEL_3D];
        return k->ours > 0 && k->limit > 0 ? k->limit / k->ours * 100 : NAN;
    }
    case PEER_1E5:
        return results->ratios.discs_1e5[0];
    case PEER_1E5_X10:
        return results->ratios.discs_1e5[1];
    case PEER_1E6:
        return results->ratios.discs_1e6[0];
    default:
        return results->ratios.discs_1e6[1];
    }
}

static const Column target_columns[] = {
    {"target", "target", ""},     {"petri", "petri", ""}, {"unit", "", ""},   {"reference", "reference", ""},
    {"ratio", "times", "faster"}, {"must", "must", ""},   {"aim", "aim", ""}, {"met", "met", ""},
};

Table report_targets(const Results *results, bool all) {
    Table table = table_new("Targets (issue 5)", target_columns, sizeof target_columns / sizeof *target_columns);
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
        const Target *t = &targets[i];
        double ours = ours_of(results, t);
        if (isnan(ours) && !all)
            continue;
        // For rates, higher values are better; for all other quantities, lower values.
        bool high = t->measure >= KERNEL_2D;
        bool must = high ? ours >= t->must : ours <= t->must, aim = high ? ours >= t->aim : ours <= t->aim;
        char wanted[TABLE_TEXT];
        snprintf(wanted, sizeof wanted, "%s %g", high ? ">=" : "<=", t->must);
        Cell *row = table_row(&table);
        row[0] = cell_text(t->what);
        row[1] = cell_number(ours);
        row[2] = cell_text(t->unit);
        row[3] = cell_number(t->reference > 0 ? t->reference : NAN);
        row[4] = cell_number(t->reference > 0 ? t->reference / ours : NAN);
        row[5] = cell_text(wanted);
        row[6] = cell_number(t->aim > 0 ? t->aim : NAN);
        row[7] = isnan(ours) ? cell_number(NAN) : cell_text(t->aim > 0 && aim ? "aim" : must ? "yes" : "no");
    }
    return table;
}
