// fuzz_journal.c: fuzzes journals of sweeps. If the first byte of the input is '#', the rest is the journal. Otherwise,
// the input is a list of results, separated by a byte 30. The first two bytes of a result are its run and its number of
// frames. Results are written with valid checksums. The table and the summary are made from the accepted results.
#include "base/hash_index.h"
#include "fuzz.h"
#include "sweep/journal.h"
#include "sweep/options.h"
#include "sweep/table.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { RUNS = 4 };

static void add_result(FuzzText *journal, const char *result, size_t length) {
    char line[100];
    uint64_t run = length > 0 ? (uint64_t)result[0] % 8 : 0;
    int64_t frames = length > 1 ? result[1] : 0;
    size_t used = length < 2 ? length : 2;
    uint64_t sum = hash_bytes(run * 31 + (uint64_t)frames, result + used, length - used);
    int count = snprintf(line, sizeof line, "run %" PRIu64 " %" PRId64 " %zu %016" PRIx64 "\n", run, frames,
                         length - used, sum);
    fuzz_append(journal, line, (size_t)count);
    fuzz_append(journal, result + used, length - used);
    fuzz_append(journal, "\n", 1);
}

static void put_journal(const Sweep *sweep, const uint8_t *data, size_t size) {
    FuzzText journal = {0};
    fuzz_append(&journal, "petri sweep 2 ", 14);
    fuzz_append(&journal, sweep->identity, strlen(sweep->identity));
    fuzz_append(&journal, "\n", 1);
    fuzz_put_parts("table.csv.part", &journal, data, size, add_result);
}

// Calls the functions that print results, which need a result for each run.
static void print_results(Sweep *sweep) {
    SCOPED_TEXT table = {0}, cells = {0}, summary = {0}, commands = {0}, rows = {0};
    cell_add(&rows, (Cell){CELL_INTEGER, {.integer = 3}});
    cell_add(&rows, (Cell){CELL_NUMBER, {.number = 1}});
    cell_add(&rows, (Cell){CELL_TEXT, {.text = "2;3"}});
    cell_add(&rows, (Cell){.kind = CELL_NONE});
    for (size_t run = 0; run < RUNS; run++) {
        sweep_store_result(sweep, run, 3, text_str(&rows));
        fuzz_sink(NULL, "", sweep_is_failed(sweep, run));
    }
    table_make(sweep, true, &table);
    table_make(sweep, false, &cells);
    table_commands(sweep, &commands);
    summary_make(sweep, &summary);
}

FUZZ_HARNESS(journal) {
    static const CommandContext context = {.program = "petri", .invoked_as = "petri"};
    static SweepOptions own = {.seeds = RUNS};
    static Options options = {.script = "s.fl", .own = &own};
    static Metric metrics[] = {{.name = "speed", .expression = "1"}, {.name = "size", .expression = "2"}};
    Sweep sweep = {
        .host = &context, .options = &options, .own = &own, .metrics = metrics, .metric_count = 2, .shards = 1};
    Journal journal = {.file = -1};
    text_add_c(&sweep.shared, "");
    memset(sweep.identity, 'a', SHA256_DIGITS);
    if (!design_make(&sweep.design, &options, &context))
        fuzz_fail("cannot plan the runs");
    sweep.results = calloc(sweep.design.run_count, sizeof *sweep.results);
    put_journal(&sweep, data, size);
    const char *output = fuzz_file("table.csv");
    if (journal_open(&journal, &sweep, output) == STATUS_DONE) {
        print_results(&sweep);
        if (!journal_add(&journal, 0, &sweep.results[0]))
            fuzz_fail("cannot extend the journal");
    }
    journal_close(&journal);
    for (size_t run = 0; run < sweep.design.run_count; run++)
        free((char *)sweep.results[run].rows.bytes);
    free(sweep.results);
    text_free(&sweep.shared);
    design_free(&sweep.design);
    return 0;
}
