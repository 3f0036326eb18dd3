// stats.c: the table that `petri run --stats` prints at the end.
#include "run/stats.h"

#include "cli/motion.h"
#include "petri-ranks.h"

#include <inttypes.h>
#include <stdio.h>

void stats_count(Stats *stats, const PetriFrame *frame, PetriSession *session) {
    stats->frames++;
    stats->physics_steps += frame->physics_steps;
    stats->evaluation_seconds += frame->evaluation_seconds;
    stats->physics_seconds += frame->physics_seconds;
    PetriSystem system;
    for (size_t i = 0; session && frame->physics_steps > 0 && petri_system(session, i, &system, sizeof system); i++)
        stats->particle_steps += (double)system.steps * system.particle_count;
}

// Prints communication statistics of a system. Each value is the maximum over all ranks.
static void print_traffic(PetriSession *session, size_t number, const PetriRanks *ranks) {
    static const char *const how[] = {
        "replicated: the system is small, has one step per frame or has forces that cannot be distributed", "by pairs",
        "by region"};
    enum { OWN, HALO, BYTES, MESSAGES, FRAME_BYTES, REDUCTIONS, NUMBERS };
    PetriRankStats traffic;
    if (!ranks || !petri_rank_stats(session, number, &traffic, sizeof traffic))
        return;
    double steps = traffic.steps > 0 ? (double)traffic.steps : 1,
           frames = traffic.frames > 0 ? (double)traffic.frames : 1;
    double max[NUMBERS] = {
        [OWN] = (double)traffic.own / steps,
        [HALO] = (double)traffic.halo / steps,
        [BYTES] = (double)traffic.step_bytes / steps,
        [MESSAGES] = (double)traffic.step_messages / steps,
        [FRAME_BYTES] = (double)traffic.frame_bytes / frames,
        [REDUCTIONS] = (double)traffic.reductions / steps,
    };
    ranks->allreduce_max(ranks->user_data, max, NUMBERS);
    fprintf(stderr, "    on %d ranks        %s\n", ranks->rank_count, how[traffic.decomposition]);
    if (traffic.decomposition == PETRI_REPLICATED)
        return;
    if (traffic.decomposition == PETRI_DOMAIN_DECOMPOSED)
        fprintf(stderr, "      particles       at most %.6g per rank, plus a halo of %.6g\n", max[OWN], max[HALO]);
    fprintf(stderr, "      sent by a rank  at most %.6g bytes in %.3g messages per step, %.6g bytes per frame\n",
            max[BYTES], max[MESSAGES], max[FRAME_BYTES]);
    fprintf(stderr, "      reductions      %.3g per step\n", max[REDUCTIONS]);
}

static void print_row(void *user_data, const char *name, const char *value) {
    (void)user_data;
    fprintf(stderr, "    %-16s  %s\n", name, value);
}

static void print_system(PetriSession *session, size_t number, const PetriSystem *system) {
    enum { MAX_COMPONENTS = 4, DIGITS = 9 };
    uint32_t moving = motion_count(system), anchors = system->particle_count - moving;
    fprintf(stderr, "  system %s, %" PRIu32 "-dimensional: %" PRIu32 " particle%s", system->name, system->dimensions,
            moving, moving == 1 ? "" : "s");
    if (anchors > 0)
        fprintf(stderr, ", %" PRIu32 " anchor%s", anchors, anchors == 1 ? "" : "s");
    fputs("\n", stderr);
    motion_rows(session, number, system, DIGITS, MAX_COMPONENTS, print_row, NULL);
}

static void print_time(const char *what, double seconds, int64_t frames) {
    fprintf(stderr, "  %-18s%.4f ms per frame\n", what, frames > 0 ? seconds * 1e3 / (double)frames : 0);
}

void stats_print(const Stats *stats, PetriSession *session, double seconds, const PetriRanks *ranks) {
    fprintf(stderr, "statistics\n  %-18s%" PRId64 "\n  %-18s%" PRIu64 "\n  %-18s%.3f s\n", "frames", stats->frames,
            "simulation steps", stats->physics_steps, "wall time", seconds);
    print_time("evaluation", stats->evaluation_seconds, stats->frames);
    print_time("physics", stats->physics_seconds, stats->frames);
    print_time("output", stats->output_seconds, stats->frames);
    double rate = stats->physics_seconds > 0 ? stats->particle_steps / stats->physics_seconds : 0;
    fprintf(stderr, "  %-18s%.4g million per second of physics\n", "particle-steps", rate * 1e-6);
    PetriSystem system;
    for (size_t i = 0; petri_system(session, i, &system, sizeof system); i++) {
        print_system(session, i, &system);
        print_traffic(session, i, ranks);
    }
}
