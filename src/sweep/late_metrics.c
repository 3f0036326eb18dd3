// late_metrics.c: a hint for metrics that are one frame late; see measure.h. A name of the script has the value from
// before the steps of the frame, but an expression or a function reads the state after them.
#include "base/file.h"
#include "petri-inspect.h"
#include "sweep/measure.h"

#include <stdint.h>
#include <string.h>

typedef struct Names {
    Str text;
    PetriBinding *names;
    size_t count;
} Names;

static void add_name(void *user_data, const PetriBinding *name) {
    text_add(user_data, (Str){(const char *)name, sizeof *name});
}

// Returns true if a value reads the state, itself or by what it uses. Marks it, so that recursion ends.
static bool reads_state(const Names *all, PetriBinding *binding) {
    size_t start = binding->value_start, end = binding->value_end;
    if (binding->size == 0 || end > all->text.len || start >= end)
        return false;
    binding->size = 0;
    bool reads = memchr(all->text.bytes + start, '$', end - start) != NULL;
    for (size_t i = 0; i < all->count && !reads; i++) {
        const PetriBinding *use = &all->names[i];
        if (use->kind != PETRI_NAME_USE || use->start < start || use->start >= end || use->binding_start == SIZE_MAX)
            continue;
        for (size_t k = 0; k < all->count && !reads; k++)
            reads = all->names[k].kind != PETRI_NAME_USE && all->names[k].start == use->binding_start &&
                    reads_state(all, &all->names[k]);
    }
    return reads;
}

static bool is_late(const Names *all, Str metric) {
    for (size_t i = 0; i < all->count; i++) {
        PetriBinding *name = &all->names[i];
        Str text = {all->text.bytes + name->start, name->end - name->start};
        if (name->kind == PETRI_NAME_LET && name->depth == 0 && str_equal(text, metric) && reads_state(all, name))
            return true;
    }
    return false;
}

void measure_hint_late_metrics(Measure *measure) {
    SCOPED_TEXT text = {0};
    const Sweep *sweep = measure->sweep;
    const char *file = petri_source_file(measure->session, 0);
    if (!file || sweep->parts > 1 || sweep->options->verbosity <= LOG_QUIET || text_read_file(&text, file, SIZE_MAX))
        return;
    for (size_t i = 0; i < sweep->metric_count; i++) {
        SCOPED_TEXT names = {0};
        const Metric *metric = &sweep->metrics[i];
        if (!metric->expression || metric->column != TRUST_VALUE)
            continue;
        petri_bindings(measure->session, text.bytes, text.len, add_name, &names);
        Names all = {text_str(&text), (void *)names.bytes, names.len / sizeof(PetriBinding)};
        if (is_late(&all, str_trim(str_from(metric->expression))))
            message("'%s' is a 'let' that reads the state, so it is one frame late; "
                    "bind a function to measure the state after the frame",
                    metric->expression);
    }
}
