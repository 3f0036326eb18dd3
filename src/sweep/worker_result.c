// worker_result.c: see worker_result.h.
#include "sweep/worker_result.h"

#include <string.h>

void result_add_diagnostic(void *context, PetriLevel level, const char *rendered) {
    enum { MAX_DIAGNOSTIC_BYTES = 1 << 16 };
    Text *diagnostics = context;
    if (diagnostics->len < MAX_DIAGNOSTIC_BYTES) {
        text_add_format(diagnostics, "%c", 'a' + (int)level);
        text_add(diagnostics, (Str){rendered, strlen(rendered) + 1});
    }
}

void result_execute(Measure *measure, int64_t run, Text *diagnostics, Text *packet) {
    diagnostics->len = packet->len = 0;
    measure_run(measure, (size_t)run);
    ResultHeader head = {run, measure->frames, measure->origin, measure->rows.len, diagnostics->len};
    text_add(packet, (Str){(const char *)&head, sizeof head});
    text_add(packet, (Str){measure->rows.bytes, measure->rows.len});
    text_add(packet, (Str){diagnostics->bytes, diagnostics->len});
}

bool result_store(Sweep *sweep, Journal *journal, const ResultHeader *head, const char *bytes) {
    size_t run = (size_t)head->run, length = (size_t)(head->rows + head->diagnostics);
    for (const char *diagnostics = bytes + head->rows; diagnostics < bytes + length;
         diagnostics += strlen(diagnostics) + 1)
        sweep_report(sweep, (PetriLevel)(diagnostics[0] - 'a'), diagnostics + 1);
    sweep->origins[head->origin]++;
    sweep_store_result(sweep, run, head->frames, bytes, (size_t)head->rows);
    return journal_add(journal, head->run, &sweep->results[run]);
}
