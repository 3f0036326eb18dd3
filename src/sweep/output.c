// output.c: the files that `petri sweep` writes at its end.
#include "cli/output.h"

#include "base/file.h"
#include "cli/hdf5.h"
#include "sweep/plots.h"
#include "sweep/sweep.h"
#include "sweep/table.h"
#include "sweep/worker_pool.h"

bool sweep_can_write(const Sweep *sweep) {
    const char *output = sweep->options->output;
    Hdf5 writer;
    return !output || !hdf5_has_suffix(output) ||
           (hdf5_start(&writer, "table", output, NULL, NULL) && hdf5_end(&writer));
}

static bool write_table(const Sweep *sweep) {
    SCOPED_TEXT table = {0}, commands = {0}, path = {0};
    const char *output = sweep->options->output;
    bool csv = !output || !hdf5_has_suffix(output);
    table_make(sweep, csv, &table);
    if (!output)
        return output_text(table.bytes, table.len, STATUS_DONE) == STATUS_DONE;
    table_commands(sweep, &commands);
    text_add_format(&path, "%s.runs", output);
    return output_file(path.bytes, text_str(&commands)) &&
           (csv ? output_file(output, text_str(&table))
                : hdf5_table(output, table_width(sweep), text_str(&table), worker_pool_signal));
}

bool sweep_write_all(const Sweep *sweep) {
    SCOPED_TEXT summary = {0};
    bool good = true;
    if (sweep->options->summary) {
        summary_make(sweep, &summary);
        good = output_file(sweep->options->summary, text_str(&summary));
    }
    good = (!sweep->options->plot || plot_grid_draw(sweep, sweep->options->plot)) && good;
    return write_table(sweep) && good;
}
