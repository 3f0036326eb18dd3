// help.c: see help.h.
#include "physics/help.h"

static const int64_t most_spared = 4000000; // that counts: about a turn of another process
static const uint64_t longest_pause = 1000000000;

bool phys_help_pauses(const PhysHelp *help, uint64_t now) {
    return now < help->ended;
}

// A pause after `lost` nanoseconds; a longer one, if the last one is not long over.
static void pause_for(PhysHelp *help, uint64_t lost, uint64_t now) {
    bool again = help->pause && now - help->ended < help->pause;
    help->doublings = !again ? 0 : help->doublings < PHYS_MOST_DOUBLINGS ? help->doublings + 1 : PHYS_MOST_DOUBLINGS;
    help->pause = lost < longest_pause ? lost * PHYS_LOSS_PART << help->doublings : longest_pause;
    help->pause = help->pause < longest_pause ? help->pause : longest_pause;
    help->ended = now + help->pause;
    help->unanswered = 0;
    help->spared = 0;
}

// With help the caller spares about half as long as it works.
void phys_help_learn(PhysHelp *help, const PhysJobTimes *job) {
    uint64_t took = job->end - job->begin;
    if (!job->answered) {
        if (help->unanswered++ == 0)
            help->silent = job->begin;
        if (help->unanswered == PHYS_MOST_UNANSWERED)
            pause_for(help, job->end - help->silent, job->end);
        return;
    }
    help->unanswered = 0;
    help->spared += ((int64_t)took - (int64_t)job->waited) / 2 - (int64_t)job->waited;
    if (help->spared > most_spared)
        help->spared = most_spared;
    else if (help->spared < 0)
        pause_for(help, job->waited, job->end);
}

bool phys_trial_asks(const PhysTrial *trial) {
    bool other = trial->jobs < PHYS_TRIAL_OTHER;
    return trial->alone_is_faster == other;
}

// A job that somebody disturbed counts no more than twice what is usual.
static void smooth(double *mean, double value) {
    enum { WEIGHT = 8 };
    double most = *mean * 2;
    *mean = *mean > 0 ? *mean + ((value < most ? value : most) - *mean) / WEIGHT : value;
}

static void count(PhysTrial *trial) {
    trial->jobs = trial->jobs + 1 < PHYS_TRIAL_ROUND ? trial->jobs + 1 : 0;
}

bool phys_trial_skips(PhysTrial *trial) {
    if (trial->jobs < 2 * PHYS_TRIAL_OTHER)
        return false;
    count(trial);
    return true;
}

void phys_trial_learn(PhysTrial *trial, bool helped, double nanoseconds) {
    uint32_t since = trial->jobs < PHYS_TRIAL_OTHER ? trial->jobs : trial->jobs - PHYS_TRIAL_OTHER;
    if (since >= PHYS_TRIAL_SETTLES)
        smooth(helped ? &trial->helped : &trial->alone, nanoseconds);
    count(trial);
    if (trial->jobs == 2 * PHYS_TRIAL_OTHER && trial->alone > 0 && trial->helped > 0)
        trial->alone_is_faster = trial->alone < trial->helped;
}
