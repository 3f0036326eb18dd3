// ranks.c: the hooks that lib/physics calls for a divided system (ranks.h).
#include "ranks/ranks.h"

#include "ranks/domain.h"

const PhysDivision *ranks_init(Ranks *ranks, const PetriRanks *calls) {
    if (!calls || calls->rank_count <= 1)
        return NULL;
    *ranks = (Ranks){{domain_begin, domain_step, domain_end, ranks_compute_pairs, domain_free}, *calls};
    return &ranks->division;
}

PetriRankStats ranks_stats(const PhysSystem *system) {
    const Domain *domain = system->division.bytes;
    PetriRankStats stats = domain ? domain->stats : (PetriRankStats){0};
    stats.frames = system->frame;
    stats.steps = system->steps;
    return stats;
}
