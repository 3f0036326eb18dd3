// worker_result.c: results that workers send, and signals; see workers.h.
#include "sweep/workers.h"

#include <signal.h>
#include <string.h>

void result_add_diagnostic(void *context, PetriLevel level, const char *rendered) {
    enum { MAX_DIAGNOSTIC_BYTES = 1 << 16 };
    Text *diagnostics = context;
    if (diagnostics->len < MAX_DIAGNOSTIC_BYTES) {
        text_add_format(diagnostics, "%c", 'a' + (int)level);
        text_add(diagnostics, (Str){rendered, strlen(rendered) + 1});
    }
}

const ResultPacket *result_pack(const ResultPacket *head, Str rows, Str diagnostics, Text *bytes) {
    ResultPacket whole = *head;
    whole.rows = rows.len;
    whole.diagnostics = diagnostics.len;
    bytes->len = 0;
    text_add(bytes, (Str){(const char *)&whole, sizeof whole});
    text_add(bytes, rows);
    text_add(bytes, diagnostics);
    return (const ResultPacket *)(const void *)bytes->bytes;
}

size_t result_size(const ResultPacket *packet) {
    return sizeof *packet + (size_t)(packet->rows + packet->diagnostics);
}

const ResultPacket *result_execute(Measure *measure, int64_t run, Text *diagnostics, Text *bytes) {
    diagnostics->len = 0;
    measure_run(measure, (size_t)run);
    return result_pack(&(ResultPacket){.run = run, .frames = measure->result.frames, .origin = measure->origin},
                       text_str(&measure->result.rows), text_str(diagnostics), bytes);
}

bool result_store(Sweep *sweep, Journal *journal, const ResultPacket *packet) {
    size_t run = (size_t)packet->run;
    const char *end = packet->bytes + packet->rows + packet->diagnostics;
    for (const char *at = packet->bytes + packet->rows; at < end; at += strlen(at) + 1)
        sweep_report(sweep, (PetriLevel)(at[0] - 'a'), at + 1);
    sweep->origins[packet->origin]++;
    sweep_store_result(sweep, run, packet->frames, (Str){packet->bytes, (size_t)packet->rows});
    return journal_add(journal, run, &sweep->results[run]);
}

static volatile sig_atomic_t stopped; // number of the signal that stops the sweep; 0: none

static void on_signal(int number) {
    stopped = number;
}

void worker_catch_signals(void) {
    stopped = 0;
    signal_catch(SIGINT, on_signal, 0);
    signal_catch(SIGTERM, on_signal, 0);
    signal_catch(SIGHUP, on_signal, 0);
}

int worker_signal(void) {
    return (int)stopped;
}
