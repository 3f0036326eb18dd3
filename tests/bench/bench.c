// bench.c: the benchmark of petri. Runs scripts through petri.h and compares the results with limit kernels, LAMMPS and
// another build. README.md explains what is measured; `bench --help` lists the options.
#include "base/os.h"
#include "machine.h"
#include "measure.h"
#include "peers.h"
#include "report.h"
#include "sweeps.h"
#include "table.h"
#include "worker.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char usage[] =
    "usage: bench [options]\n"
    "  --quick            use small sizes and few rounds (takes 20 seconds)\n"
    "  --only NAME        run only workloads whose name begins with these words, such as dish or dish 200\n"
    "  --threads N        compare one thread with N (default: number of processors, at most 2)\n"
    "  --rounds N         take medians over N rounds (default: 7)\n"
    "  --peers            compare with LAMMPS\n"
    "  --busy N           keep N other processes busy during the run\n"
    "  --against BENCH    compare with another build: the path of its bench executable\n"
    "  --csv FILE         also write the table of workloads as CSV; other tables go to FILE-targets.csv and so on\n"
    "  --markdown FILE    also write all tables as Markdown\n"
    "  --tiny             only test the bench; the figures mean nothing\n";

typedef struct Bench {
    Plan plan;
    bool quick, peers, help;
    int busy;
    const char *csv, *markdown;
    char self[4096];
    char machine[512];
    char lammps[128];
} Bench;

// Parses an integer from 1 to 1024. Returns 0 if it is invalid.
static int read_count(const char *text) {
    char *end;
    long n = strtol(text, &end, 10);
    return *end == '\0' && n >= 1 && n <= 1024 ? (int)n : 0;
}

static bool read_flag(Bench *bench, const char *option) {
    const struct {
        const char *name;
        bool *flag;
    } flags[] = {
        {"--quick", &bench->quick},
        {"--peers", &bench->peers},
        {"--tiny", &bench->plan.tiny},
        {"--help", &bench->help},
    };
    for (size_t i = 0; i < sizeof flags / sizeof *flags; i++)
        if (!strcmp(option, flags[i].name)) {
            *flags[i].flag = true;
            return true;
        }
    return false;
}

static bool read_value(Bench *bench, const char *option, const char *value) {
    const struct {
        const char *name;
        const char **text;
    } texts[] = {
        {"--only", &bench->plan.only},
        {"--against", &bench->plan.other},
        {"--csv", &bench->csv},
        {"--markdown", &bench->markdown},
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (!strcmp(option, texts[i].name)) {
            *texts[i].text = value;
            return true;
        }
    if (!strcmp(option, "--threads"))
        return (bench->plan.threads = read_count(value)) > 0;
    if (!strcmp(option, "--busy"))
        return (bench->busy = read_count(value)) > 0;
    if (!strcmp(option, "--rounds"))
        return (bench->plan.rounds = read_count(value)) > 0 && bench->plan.rounds <= ROUNDS_MAX;
    return false;
}

static bool read_options(Bench *bench, int argc, char **argv) {
    for (int i = 1; i < argc; i++) {
        if (read_flag(bench, argv[i]))
            continue;
        if (i + 1 >= argc || !read_value(bench, argv[i], argv[i + 1])) {
            fprintf(stderr, "bench: invalid option or value: '%s'\n%s", argv[i], usage);
            return false;
        }
        i++;
    }
    return true;
}

static void fill_plan(Bench *bench) {
    Plan *plan = &bench->plan;
    if (plan->threads == 0)
        plan->threads = os_processor_count() < 2 ? 1 : 2;
    if (plan->rounds == 0)
        plan->rounds = plan->tiny ? 1 : bench->quick ? 3 : 7;
    plan->budget = plan->tiny ? 0.001 : bench->quick ? 0.04 : 0.2;
    plan->warm_steps = plan->tiny ? 2 : bench->quick ? 40 : 100;
    plan->starts = plan->tiny ? 1 : bench->quick ? 2 : 3;
    plan->patience = bench->quick ? 5 : 60;
    plan->max_particles = bench->quick ? 20000 : UINT32_MAX;
}

// Finds the path of this executable, which workers also run.
static bool find_self(Bench *bench) {
    ssize_t length = readlink("/proc/self/exe", bench->self, sizeof bench->self - 1);
    if (length < 0)
        return false;
    bench->self[length] = '\0';
    bench->plan.self = bench->self;
    return true;
}

static Results measure_all(const Bench *bench) {
    const Plan *plan = &bench->plan;
    Results results = {.figures = calloc(case_count, sizeof *results.figures), .ratios = {{NAN, NAN}, {NAN, NAN}}};
    if (!results.figures) {
        fputs("bench: out of memory\n", stderr);
        exit(1);
    }
    for (size_t i = 0; i < case_count; i++)
        if (measure_wanted(plan, &cases[i])) {
            fprintf(stderr, "bench: %s", cases[i].name);
            results.figures[i] = measure_case(plan, &cases[i]);
            fprintf(stderr, ": %.4g us per frame, %.4g us on %d threads\n", results.figures[i].frame * 1e6,
                    results.figures[i].frame_threads * 1e6, plan->threads);
        }
    for (int k = 0; k < 2 && !plan->tiny && !plan->only; k++)
        results.kernels[k] = measure_kernel(plan, 2 + k);
    return results;
}

static FILE *open_file(const char *name) {
    FILE *file = fopen(name, "w");
    if (!file) {
        fprintf(stderr, "bench: cannot write %s: %s\n", name, strerror(errno));
        exit(1);
    }
    return file;
}

static void close_file(FILE *file, const char *name) {
    bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed) {
        fprintf(stderr, "bench: cannot write %s\n", name);
        exit(1);
    }
}

typedef struct NamedTable {
    const char *name;
    Table table;
} NamedTable;

// Writes the first table to FILE.csv and the others to FILE-NAME.csv.
static void write_csv(const char *csv, const NamedTable *tables, size_t count) {
    for (size_t i = 0; i < count; i++) {
        char name[4200];
        size_t stem = strlen(csv);
        if (stem > 4 && !strcmp(csv + stem - 4, ".csv"))
            stem -= 4;
        if (i == 0)
            snprintf(name, sizeof name, "%s", csv);
        else
            snprintf(name, sizeof name, "%.*s-%s.csv", (int)stem, csv, tables[i].name);
        FILE *file = open_file(name);
        table_write_csv(&tables[i].table, file);
        close_file(file, name);
    }
}

static const char notes[] =
    "Medians over rounds, on one thread unless the column says threads. The figures of the reference implementation\n"
    "and the published ones of LAMMPS on 2 ranks are from tests/bench/PEERS.md, measured on a similar machine (Zen 4,\n"
    "3.7 GHz, 2 processors); all others are from this run. tests/bench/README.md explains the columns.\n";

static void write_markdown(const Bench *bench, const NamedTable *tables, size_t count) {
    FILE *file = open_file(bench->markdown);
    fprintf(file, "# petri's speed\n\n%s%s%s.\n\n%s", bench->machine, bench->lammps[0] ? "; LAMMPS " : "",
            bench->lammps, notes);
    for (size_t i = 0; i < count; i++)
        table_write_markdown(&tables[i].table, file);
    close_file(file, bench->markdown);
}

// Warns that figures may be too high if the machine was busy.
static void warn_if_busy(const Results *results) {
    int rows = 0, disturbed = 0;
    for (size_t i = 0; i < case_count; i++)
        if (results->figures[i].done) {
            rows++;
            disturbed += results->figures[i].clean == 0;
        }
    if (disturbed > 0)
        fprintf(stderr, "bench: the machine was busy: %d of %d rows have no clean round, and are too slow\n", disturbed,
                rows);
}

static void run_bench(const Bench *bench) {
    enum { TABLES_MAX = 5 };
    NamedTable tables[TABLES_MAX];
    size_t count = 0;
    Table peers = {0};
    Results results = measure_all(bench);
    if (bench->peers)
        peers = peers_measure(&bench->plan, BENCH_SOURCE "/peers", &results.ratios);
    tables[count++] = (NamedTable){"workloads", report_workloads(&results)};
    if (bench->plan.other)
        tables[count++] = (NamedTable){"builds", report_builds(&results)};
    if (bench->peers)
        tables[count++] = (NamedTable){"peers", peers};
    if (!bench->plan.only || !strcmp(bench->plan.only, "sweep"))
        tables[count++] = (NamedTable){"sweeps", sweeps_measure(&bench->plan)};
    tables[count++] = (NamedTable){"targets", report_targets(&results, bench->plan.only == NULL)};

    printf("%s%s%s\n\n%s", bench->machine, bench->lammps[0] ? "; LAMMPS " : "", bench->lammps, notes);
    for (size_t i = 0; i < count; i++)
        table_write_text(&tables[i].table, stdout);
    fflush(stdout);
    warn_if_busy(&results);
    if (bench->csv)
        write_csv(bench->csv, tables, count);
    if (bench->markdown)
        write_markdown(bench, tables, count);
    for (size_t i = 0; i < count; i++)
        table_free(&tables[i].table);
    free(results.figures);
}

// Starts processes that keep processors busy until this process ends.
static void start_busy(int count) {
    for (pid_t parent = getpid(); count > 0; count--)
        if (fork() == 0) {
            while (getppid() == parent)
                for (volatile int i = 0; i < 1000000; i++)
                    continue;
            _exit(0);
        }
}

int main(int argc, char **argv) {
    if (argc > 1 && !strcmp(argv[1], "worker"))
        return worker_main(argc - 2, argv + 2);
    static Bench bench = {.plan = {.scripts = BENCH_SOURCE "/workloads", .petri = BENCH_PETRI}};
    if (!read_options(&bench, argc, argv))
        return 2;
    if (bench.help) {
        fputs(usage, stdout);
        return 0;
    }
    fill_plan(&bench);
    if (!find_self(&bench)) {
        perror("bench: cannot find its executable");
        return 1;
    }
    if (bench.peers && !peers_available(BENCH_SOURCE "/peers", bench.lammps, sizeof bench.lammps))
        return 1;
    machine_describe(bench.machine, sizeof bench.machine, bench.plan.threads);
    start_busy(bench.busy);
    run_bench(&bench);
    return 0;
}
