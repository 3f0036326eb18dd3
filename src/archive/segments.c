// segments.c: see segments.h.
//
// Threads take the segments in order. The result is the first segment that differs, whatever the number of threads: a
// segment is abandoned only if an earlier one is known to differ. If one cannot be computed, the whole verification
// fails.
#include "archive/segments.h"

#include "archive/details.h"
#include "archive/open.h"
#include "base/clock.h"
#include "base/os.h"
#include "cli/progress.h"
#include "petri-inspect.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { MAX_THREADS = 256 };

// --- choice

// Returns a random number below n. A check by samples must not be predictable.
static size_t random_below(size_t n) {
    uint64_t bits = 0;
    if (!os_random(&bits, sizeof bits))
        bits = (uint64_t)clock_read(CLOCK_REALTIME);
    return (size_t)(bits % n);
}

static int compare_frames(const void *a, const void *b) {
    int64_t x = ((const PetriArchiveKeyframe *)a)->frame, y = ((const PetriArchiveKeyframe *)b)->frame;
    return x < y ? -1 : x > y;
}

void segments_choose(Verification *verification, PetriArchive *archive, int64_t sample) {
    PetriArchiveKeyframe keyframe;
    size_t capacity = 0;
    for (size_t i = 0; petri_archive_keyframe(archive, i, &keyframe, sizeof keyframe); i++) {
        verification->given += keyframe.given;
        if (keyframe.end == keyframe.frame)
            continue;
        if (verification->count == capacity) {
            capacity = 2 * capacity + 16;
            verification->segments = memory_realloc(verification->segments, capacity * sizeof keyframe);
        }
        verification->segments[verification->count++] = keyframe;
    }
    verification->chosen = verification->count;
    if (sample <= 0 || (uint64_t)sample >= verification->count)
        return;
    verification->chosen = (size_t)sample;
    for (size_t i = 0; i < verification->chosen; i++) {
        size_t other = i + random_below(verification->count - i);
        keyframe = verification->segments[i];
        verification->segments[i] = verification->segments[other];
        verification->segments[other] = keyframe;
    }
    qsort(verification->segments, verification->chosen, sizeof *verification->segments, compare_frames);
}

// --- one segment

typedef struct Worker {
    Verification *verification;
    Options options;
    PetriArchive *archive;
    PetriSession *session;
    bool failed;
    pthread_t thread;
    bool started;
} Worker;

static void on_diagnostic(void *context, const PetriDiagnostic *diagnostic) {
    Verification *verification = ((Worker *)context)->verification;
    pthread_mutex_lock(&verification->mutex);
    if (diagnostic->level == PETRI_ERROR && !texts_contain(&verification->reported, diagnostic->rendered)) {
        texts_add(&verification->reported, diagnostic->rendered);
        fputs(diagnostic->rendered, stderr);
    }
    pthread_mutex_unlock(&verification->mutex);
}

// Compares the current frame with the archive. Returns true if they are the same, or if nothing was recorded.
static bool frame_is_same(Worker *worker, SegmentResult *result) {
    uint8_t *recorded = result->digests[0], *computed = result->digests[1];
    result->frame = petri_frame_number(worker->session);
    result->has_digests = petri_archive_digest(worker->archive, result->frame, recorded);
    if (result->has_digests) {
        worker->failed = petri_digest(worker->session, computed) != PETRI_OK;
        if (memcmp(recorded, computed, DIGEST_BYTES) != 0)
            return false;
        result->has_digests = false;
    }
    return !petri_archive_keyframe_differs(worker->archive);
}

// Returns true if a segment before number `number` is known to differ, so that this one need not be verified.
static bool is_needless(Verification *verification, size_t number) {
    pthread_mutex_lock(&verification->mutex);
    bool needless = verification->failed || (verification->differs && verification->differs_at < number);
    pthread_mutex_unlock(&verification->mutex);
    return needless;
}

static bool open_worker(Worker *worker) {
    Verification *verification = worker->verification;
    petri_close(&worker->session);
    petri_archive_close(&worker->archive);
    worker->archive = archive_open(verification->options, verification->file);
    if (!worker->archive)
        return false;
    worker->options.read = petri_archive_read;
    worker->options.unsaved_host = worker->archive;
    return options_open(&worker->options, verification->context, on_diagnostic, worker, &worker->session) ==
           OPTIONS_READ;
}

static void note_difference(Verification *verification, size_t number, SegmentResult *result) {
    pthread_mutex_lock(&verification->mutex);
    if (!verification->differs || number < verification->differs_at) {
        text_free(&verification->result.details);
        verification->result = *result;
        verification->differs_at = number;
        verification->differs = true;
        result->details = (Text){0};
    }
    pthread_mutex_unlock(&verification->mutex);
}

// Computes a segment and compares its frames. Sets worker->failed if it cannot be computed.
static void verify_segment(Worker *worker, size_t number) {
    Verification *verification = worker->verification;
    const PetriArchiveKeyframe *segment = &verification->segments[number];
    SegmentResult result = {0};
    if (!open_worker(worker)) {
        worker->failed = true;
        return;
    }
    PetriStatus status = petri_archive_load(worker->archive, worker->session, segment->frame);
    bool same = true;
    while (status == PETRI_OK && same && !worker->failed && petri_frame_number(worker->session) < segment->end) {
        if (is_needless(verification, number))
            break;
        status = petri_step(worker->session);
        same = status == PETRI_OK && frame_is_same(worker, &result);
        pthread_mutex_lock(&verification->mutex);
        verification->frames += same;
        pthread_mutex_unlock(&verification->mutex);
    }
    if (status != PETRI_OK) {
        if (!archive_report_problem(worker->archive, verification->file))
            message("cannot compute frame %" PRId64 ": %s", petri_frame_number(worker->session) + 1,
                    petri_status_text(status));
        worker->failed = true;
    } else if (!same && !worker->failed) {
        details_add(worker->archive, worker->session, segment->end, &result.details);
        note_difference(verification, number, &result);
    }
    text_free(&result.details);
}

// --- threads

static void *run_worker(void *context) {
    Worker *worker = context;
    Verification *verification = worker->verification;
    for (;;) {
        pthread_mutex_lock(&verification->mutex);
        verification->failed = verification->failed || worker->failed;
        bool more = !verification->failed && verification->next < verification->chosen;
        size_t number = verification->next;
        verification->next += more ? verification->stride : 0;
        verification->running -= !more;
        pthread_mutex_unlock(&verification->mutex);
        if (!more)
            break;
        if (!is_needless(verification, number))
            verify_segment(worker, number);
    }
    petri_close(&worker->session);
    petri_archive_close(&worker->archive);
    return NULL;
}

static int64_t count_frames(const Verification *verification) {
    int64_t count = 0;
    for (size_t i = verification->next; i < verification->chosen; i += verification->stride)
        count += verification->segments[i].end - verification->segments[i].frame;
    return count;
}

// Shows the progress until all threads have ended.
static void wait_for_workers(Verification *verification) {
    Progress progress = {0};
    bool shows = verification->options->verbosity > LOG_QUIET && progress_possible();
    progress_start(&progress, shows, count_frames(verification));
    for (bool running = true; running;) {
        pthread_mutex_lock(&verification->mutex);
        running = verification->running > 0;
        int64_t frames = verification->frames;
        pthread_mutex_unlock(&verification->mutex);
        progress_update(&progress, frames);
        nanosleep(&(struct timespec){.tv_nsec = 5000000}, NULL);
    }
    progress_erase(&progress);
}

static bool start_worker(Worker *worker, size_t stack_bytes) {
    pthread_attr_t attributes;
    if (pthread_attr_init(&attributes) != 0)
        return false;
    worker->started = pthread_attr_setstacksize(&attributes, stack_bytes) == 0 &&
                      pthread_create(&worker->thread, &attributes, run_worker, worker) == 0;
    pthread_attr_destroy(&attributes);
    return worker->started;
}

void segments_verify(Verification *verification) {
    const size_t reserve = (size_t)1 << 20; // of the stack, for functions that are not limited by the script's limit
    // mpirun starts one process per processor.
    long processors = verification->context->channel ? 1 : os_processor_count();
    int64_t wanted = verification->options->threads > 0 ? verification->options->threads : processors;
    size_t count = wanted < 1 ? 1 : wanted > MAX_THREADS ? MAX_THREADS : (size_t)wanted;
    size_t per_segment = verification->chosen > 0 && count > verification->chosen ? count / verification->chosen : 1;
    count = count > verification->chosen ? verification->chosen : count;
    Worker *workers = memory_calloc(count * sizeof *workers);
    pthread_mutex_init(&verification->mutex, NULL);
    verification->running = count;
    for (size_t i = 0; i < count; i++) {
        workers[i] = (Worker){.verification = verification, .options = *verification->options};
        workers[i].options.threads = (int64_t)per_segment;
        workers[i].options.definitions = (TextList){0};
        if (start_worker(&workers[i], verification->context->stack_bytes + reserve))
            continue;
        if (i == 0) {
            run_worker(&workers[0]); // in this thread, because there are no others, as in WebAssembly
            continue;
        }
        pthread_mutex_lock(&verification->mutex);
        verification->running--;
        pthread_mutex_unlock(&verification->mutex);
    }
    wait_for_workers(verification);
    for (size_t i = 0; i < count; i++)
        if (workers[i].started)
            pthread_join(workers[i].thread, NULL);
    free(workers);
    pthread_mutex_destroy(&verification->mutex);
}

void segments_free(Verification *verification) {
    free(verification->segments);
    text_free(&verification->result.details);
    texts_free(&verification->reported);
}
