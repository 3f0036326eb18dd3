// ranks.c: the hooks that lib/physics calls for a divided system (ranks.h).
#include "ranks/ranks.h"

#include "ranks/domain.h"

bool ranks_available(void) {
    return true;
}

const PhysDivision *ranks_init(Ranks *ranks, const PetriRanks *calls) {
    if (!calls || calls->rank_count <= 1)
        return NULL;
    *ranks = (Ranks){{.begin_frame = domain_begin,
                      .step = domain_step,
                      .end_frame = domain_end,
                      .compute_pairs = ranks_compute_pairs,
                      .processes = ranks_processes,
                      .gather = ranks_gather,
                      .free = domain_free},
                     *calls};
    return &ranks->division;
}

PetriRankStats ranks_stats(const PhysSystem *system) {
    const Domain *domain = system->division.bytes;
    PetriRankStats stats = domain ? domain->stats : (PetriRankStats){0};
    stats.frames = system->frame;
    stats.steps = system->steps;
    return stats;
}
