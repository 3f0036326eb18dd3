// backoff.c: decides from earlier jobs whether to use helper threads (backoff.h).
#include "physics/backoff.h"

static const int64_t max_saved = 4000000; // ns: upper limit of PhysBackoff.saved; about a time slice of another process
static const uint64_t max_pause = 1000000000; // ns: maximum length of a pause

bool phys_backoff_pauses(const PhysBackoff *backoff, uint64_t now) {
    return now < backoff->pause_end;
}

// Starts a pause after a loss of `lost` nanoseconds. The pause is longer if the last pause ended recently.
static void start_pause(PhysBackoff *backoff, uint64_t lost, uint64_t now) {
    bool again = backoff->pause_length && now - backoff->pause_end < backoff->pause_length;
    backoff->doublings = !again                                    ? 0
                         : backoff->doublings < PHYS_MAX_DOUBLINGS ? backoff->doublings + 1
                                                                   : PHYS_MAX_DOUBLINGS;
    backoff->pause_length = lost < max_pause ? lost * PHYS_LOSS_DIVISOR << backoff->doublings : max_pause;
    backoff->pause_length = backoff->pause_length < max_pause ? backoff->pause_length : max_pause;
    backoff->pause_end = now + backoff->pause_length;
    backoff->unanswered = 0;
    backoff->saved = 0;
}

// The time saved by helpers is estimated as half of the time in which the caller did not wait.
void phys_backoff_learn(PhysBackoff *backoff, const PhysJobTimes *job) {
    uint64_t took = job->end - job->begin;
    if (!job->answered) {
        if (backoff->unanswered++ == 0)
            backoff->unanswered_since = job->begin;
        if (backoff->unanswered == PHYS_MAX_UNANSWERED)
            start_pause(backoff, job->end - backoff->unanswered_since, job->end);
        return;
    }
    backoff->unanswered = 0;
    backoff->saved += ((int64_t)took - (int64_t)job->waited) / 2 - (int64_t)job->waited;
    if (backoff->saved > max_saved)
        backoff->saved = max_saved;
    else if (backoff->saved < 0)
        start_pause(backoff, job->waited, job->end);
}

bool phys_tuner_should_help(const PhysTuner *tuner) {
    bool other = tuner->jobs < PHYS_TUNER_PROBES;
    return tuner->alone_is_faster == other;
}

// Updates a smoothed mean. Limits outliers to twice the mean.
static void update_mean(double *mean, double value) {
    enum { WEIGHT = 8 };
    double max = *mean * 2;
    *mean = *mean > 0 ? *mean + ((value < max ? value : max) - *mean) / WEIGHT : value;
}

static void count_job(PhysTuner *tuner) {
    tuner->jobs = tuner->jobs + 1 < PHYS_TUNER_PERIOD ? tuner->jobs + 1 : 0;
}

bool phys_tuner_skip(PhysTuner *tuner) {
    if (tuner->jobs < 2 * PHYS_TUNER_PROBES)
        return false;
    count_job(tuner);
    return true;
}

void phys_tuner_learn(PhysTuner *tuner, bool helped, double nanoseconds) {
    uint32_t since = tuner->jobs < PHYS_TUNER_PROBES ? tuner->jobs : tuner->jobs - PHYS_TUNER_PROBES;
    if (since >= PHYS_TUNER_WARMUP)
        update_mean(helped ? &tuner->helped : &tuner->alone, nanoseconds);
    count_job(tuner);
    if (tuner->jobs == 2 * PHYS_TUNER_PROBES && tuner->alone > 0 && tuner->helped > 0)
        tuner->alone_is_faster = tuner->alone < tuner->helped;
}
