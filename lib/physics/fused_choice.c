// fused_choice.c: see fused_choice.h.
#include "physics/fused_choice.h"

// Starts to measure a way.
static void begin_way(FusedChoice *choice, bool fused) {
    choice->fused = fused;
    choice->probes = 0;
    choice->time = 0;
    choice->best[fused] = 0;
}

// Records the step that has ended. Changes to the other way, or chooses the faster way, after enough steps.
static void end_probe(FusedChoice *choice) {
    double each = (double)choice->step_time / (double)choice->step_pairs, *best = &choice->best[choice->fused];
    if (*best == 0 || each < *best)
        *best = each;
    choice->time += choice->step_time;
    choice->probes++;
    if (choice->probes < FUSED_MIN_PROBES || (choice->probes < FUSED_MAX_PROBES && choice->time < FUSED_MAX_TIME))
        return;
    if (!choice->fused) {
        begin_way(choice, true);
    } else {
        choice->measures = false;
        choice->fused = choice->best[true] < choice->best[false];
    }
}

void phys_fused_next_step(FusedChoice *choice) {
    if (choice->use != CPU_FMA_FASTER)
        return;
    if (choice->steps++ % FUSED_PERIOD == 0) {
        begin_way(choice, false);
        choice->measures = true;
    } else if (choice->measures && choice->step_pairs >= FUSED_MIN_PAIRS) {
        end_probe(choice);
    }
    choice->step_pairs = choice->step_time = 0;
}

void phys_fused_learn(FusedChoice *choice, uint64_t pairs, uint64_t nanoseconds) {
    choice->step_pairs += pairs;
    choice->step_time += nanoseconds;
}
