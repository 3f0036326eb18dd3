// cache_compare.c: the report of a stored result that differs from the computed one (petri sweep --verify-cache).
#include "cli/state_text.h"
#include "sweep/cache.h"
#include "sweep/table.h"

#include <inttypes.h>
#include <string.h>

// Returns the next tab-separated cell of a row, and removes it.
static Str next_cell(Str *cells) {
    const char *tab = cells->len ? memchr(cells->bytes, '\t', cells->len) : NULL;
    Str cell = {cells->bytes, tab ? (size_t)(tab - cells->bytes) : cells->len};
    size_t used = cell.len + (tab != NULL);
    *cells = (Str){cells->bytes + used, cells->len - used};
    return cell;
}

// Appends the first metric that differs in two rows.
static void add_metric(const Sweep *sweep, Row stored, Row computed, Text *report) {
    static const char *const no_positions[2];
    next_cell(&stored.cells); // empty, because a tab precedes each cell
    next_cell(&computed.cells);
    for (size_t i = 0; i < sweep->metric_count; i++) {
        Str values[] = {next_cell(&stored.cells), next_cell(&computed.cells)};
        if (!str_equal(values[0], values[1])) {
            text_add_format(report, "frame %" PRId64 ": metric %s\n", stored.frame, sweep->metrics[i].name);
            state_add_values(report, values, no_positions);
            return;
        }
    }
}

// Appends the first row that differs.
static void add_row(const Sweep *sweep, const CacheEntry *stored, const CacheEntry *computed, Text *report) {
    const char *at[] = {stored->rows.bytes, computed->rows.bytes};
    Row rows[2];
    while (row_next(&at[0], &rows[0]) && row_next(&at[1], &rows[1])) {
        if (rows[0].frame != rows[1].frame)
            break;
        if (!str_equal(rows[0].cells, rows[1].cells)) {
            add_metric(sweep, rows[0], rows[1], report);
            return;
        }
    }
    if (stored->frames != computed->frames)
        text_add_format(report, "the run has %" PRId64 " frames, not %" PRId64 "\n", computed->frames, stored->frames);
    else
        text_add_format(report, "the metrics are the same, but the state after frame %" PRId64 " differs\n",
                        stored->frames - 1);
}

void cache_compare(const Sweep *sweep, size_t run, const CacheEntry *stored, const CacheEntry *computed, Text *report) {
    bool same = stored->frames == computed->frames && strcmp(stored->digest, computed->digest) == 0 &&
                strcmp(stored->rows.bytes, computed->rows.bytes) == 0;
    if (same)
        return;
    text_add_format(report, "petri: run %zu differs from its result in the cache\n--- cache\n+++ computed\n", run + 1);
    add_row(sweep, stored, computed, report);
    text_add_c(report, "  to find the first force that differs, run: ");
    int64_t frames = stored->frames > computed->frames ? stored->frames : computed->frames;
    table_diff_command(sweep, run, frames, report);
    text_add_c(report, " --with PROGRAM, where PROGRAM is the petri that filled the cache\n");
}
