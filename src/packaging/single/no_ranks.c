// no_ranks.c: replaces lib/ranks in petri.c, whose hosts cannot describe ranks.
#include "ranks/ranks.h"

bool ranks_available(void) {
    return false;
}

const PhysDivision *ranks_init(Ranks *ranks, const PetriRanks *calls) {
    (void)ranks;
    (void)calls;
    return NULL;
}

PetriRankStats ranks_stats(const PhysSystem *system) {
    return (PetriRankStats){.frames = system->frame, .steps = system->steps};
}
