// painting.c: draws and writes pictures in threads of their own. Files get their names in the order of their frames, so
// that a series that is given up has no gaps, and of frames with one name the last one's picture stays.
#include "render/painting.h"

#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/file.h"
#include "base/replace.h"
#include "cli/bytes.h"
#include "cli/cli.h"
#include "cli/progress.h"
#include "render/recording.h"
#include "render/video.h"
#include "run/frames.h"

enum { QUEUE = 4, MOST_WORKERS = 16, MOST_READY = 32 };
static const double PATIENCE = 0.05; // seconds

typedef struct Job Job;
struct Job {
    Job *next;
    PetriPicture *picture;
    bool for_film;
    bool looks_back;
    char *file; // owned, or NULL
    Replacement target;
    bool begun; // the target is
    bool failed;
    int error;       // why it could not be put in its place; 0: it could
    uint64_t number; // in the order in which they were added
};

struct Painting {
    pthread_mutex_t lock; // for what follows, up to the film
    pthread_cond_t changed;
    Job *waiting; // oldest first
    Job **last;
    int waiting_count;
    int running; // taken, and not done
    Job *ready;  // written, waiting for those before them; in any order
    int ready_count;
    uint64_t added;
    uint64_t put; // all before this one are where they belong
    Job *done;
    bool begun;  // there is a first worker
    bool ending; // no more will be added
    bool failed;
    bool abandoned; // no file gets its name any more
    bool drawing;   // a frame of the film, which nobody has to wait for
    bool given_up;  // the film ends without the frame that is being drawn
    bool filmed;    // it has a frame
    int left;       // that were given up in their midst
    double seconds;
    const char *film; // the rest is the threads' own
    double fps;
    Video video;
    uint32_t *pixels; // of the film's frames
    Recording recording;
    pthread_t workers[MOST_WORKERS];
    int worker_count;
    char trouble[600];
};

static void set_trouble(Painting *painting, const char *text) {
    pthread_mutex_lock(&painting->lock);
    if (painting->trouble[0] == '\0') {
        snprintf(painting->trouble, sizeof painting->trouble, "%s", text);
    }
    pthread_mutex_unlock(&painting->lock);
}

// Draws a frame of the film. If it is given up meanwhile, what the film has is no longer for this thread to touch.
static bool draw_for_film(Painting *painting, PetriPicture *picture, PetriPainter *painter) {
    const Video *video = &painting->video;
    pthread_mutex_lock(&painting->lock);
    painting->drawing = true;
    pthread_mutex_unlock(&painting->lock);
    PetriStatus status = petri_picture_draw(picture, painter, painting->pixels, video->width, video->height,
                                            (size_t)video->width * sizeof(uint32_t));
    pthread_mutex_lock(&painting->lock);
    while (painting->given_up) {
        pthread_cond_wait(&painting->changed, &painting->lock); // until the process ends
    }
    painting->drawing = false;
    pthread_mutex_unlock(&painting->lock);
    if (status == PETRI_MEMORY) {
        set_trouble(painting, "out of memory");
    }
    return status == PETRI_OK;
}

static bool add_to_film(Painting *painting, PetriPicture *picture, PetriPainter *painter) {
    Video *video = &painting->video;
    if (painting->pixels == NULL) {
        int width = 0, height = 0;
        petri_picture_size(picture, &width, &height);
        painting->pixels = calloc((size_t)width * (size_t)height, sizeof(uint32_t));
        if (painting->pixels == NULL) {
            set_trouble(painting, "out of memory");
            return false;
        }
        if (!video_open(video, painting->film, width, height, painting->fps)) {
            set_trouble(painting, video->trouble);
            return false;
        }
    }
    if (!draw_for_film(painting, picture, painter)) {
        return false;
    }
    if (!video_add(video, painting->pixels)) {
        set_trouble(painting, video->trouble);
        return false;
    }
    painting->filmed = true;
    return true;
}

static bool saved(Painting *painting, PetriStatus status) {
    if (status == PETRI_MEMORY) {
        set_trouble(painting, "out of memory");
    }
    return status == PETRI_OK;
}

static bool cannot_write(Painting *painting, const char *file) {
    char text[sizeof painting->trouble];
    snprintf(text, sizeof text, "cannot write '%s': %s", file, strerror(errno));
    set_trouble(painting, text);
    return false;
}

static bool write_bytes(Painting *painting, Job *job, const Bytes *bytes) {
    return file_write(job->target.file, bytes->data, bytes->length) || cannot_write(painting, job->file);
}

// Waits until all before it are put. False if that will not be.
static bool wait_for_turn(Painting *painting, const Job *job) {
    pthread_mutex_lock(&painting->lock);
    while (painting->put < job->number && !painting->failed) {
        pthread_cond_wait(&painting->changed, &painting->lock);
    }
    bool good = !painting->failed;
    pthread_mutex_unlock(&painting->lock);
    return good;
}

// Writes all but the name; what is no regular file has its name already.
static bool write_file(Painting *painting, Job *job, PetriPainter *painter) {
    SCOPED_BYTES bytes = {0};
    if (!saved(painting, petri_picture_write(job->picture, painter, job->file, bytes_collect, &bytes))) {
        return false;
    }
    job->begun = replace_begin(&job->target, job->file, 0);
    if (!job->begun) {
        return cannot_write(painting, job->file);
    }
    return (!job->target.direct || wait_for_turn(painting, job)) && write_bytes(painting, job, &bytes) &&
           (replace_flush(&job->target) || cannot_write(painting, job->file));
}

static bool paint(Painting *painting, Job *job, PetriPainter *painter) {
    bool good = !job->for_film || add_to_film(painting, job->picture, painter);
    if (job->file != NULL) {
        good = good && write_file(painting, job, painter);
    }
    if (good && job->looks_back) {
        good = recording_add(&painting->recording, job->picture, painter);
        if (!good && painting->recording.trouble != NULL) {
            set_trouble(painting, painting->recording.trouble);
        }
    }
    return good;
}

// Takes the next job out of those that are ready; NULL: it is not among them, or has failed.
static Job *take_ready(Painting *painting) {
    Job **at = &painting->ready;
    while (*at != NULL && (*at)->number != painting->put) {
        at = &(*at)->next;
    }
    Job *job = *at;
    if (job == NULL || job->failed) {
        return NULL;
    }
    *at = job->next;
    painting->ready_count--;
    return job;
}

// Gives what is ready its name, as far as nothing is missing before it, for the caller to end (end_jobs).
static Job *put_ready(Painting *painting) {
    Job *named = NULL, *job;
    while (!painting->abandoned && (job = take_ready(painting)) != NULL) {
        job->error = job->begun && !replace_put(&job->target) ? errno : 0;
        painting->failed = painting->failed || job->error != 0;
        painting->abandoned = painting->abandoned || job->error != 0;
        painting->put++;
        job->next = named;
        named = job;
    }
    return named;
}

// False if one of them has failed.
static bool end_jobs(Painting *painting, Job *named) {
    bool good = true;
    for (Job *job = named; job != NULL; job = job->next) {
        errno = job->error;
        if (job->begun && (job->error != 0 || !replace_end(&job->target))) {
            good = cannot_write(painting, job->file);
        }
    }
    return good;
}

static void add_done(Painting *painting, Job *jobs) {
    while (jobs != NULL) {
        Job *next = jobs->next;
        jobs->next = painting->done;
        painting->done = jobs;
        jobs = next;
    }
}

// The next job, or NULL if there will be none. Those that look back are all made by the first worker.
static Job *take_job(Painting *painting, bool first) {
    while (painting->waiting != NULL
               ? (painting->waiting->looks_back && !first) || (painting->ready_count >= MOST_READY && !painting->failed)
               : !painting->ending) {
        pthread_cond_wait(&painting->changed, &painting->lock);
    }
    Job *job = painting->waiting;
    if (job != NULL) {
        painting->waiting = job->next;
        painting->waiting_count--;
        if (painting->waiting == NULL) {
            painting->last = &painting->waiting;
        }
        painting->running++;
        pthread_cond_broadcast(&painting->changed);
    }
    return job;
}

static void *work(void *context) {
    Painting *painting = context;
    PetriPainter *painter = petri_painter_open();
    if (painter == NULL) {
        set_trouble(painting, "out of memory");
    }
    pthread_mutex_lock(&painting->lock);
    bool first = !painting->begun;
    painting->begun = true;
    for (Job *job = take_job(painting, first); job != NULL; job = take_job(painting, first)) {
        bool good = painter != NULL && !painting->failed;
        pthread_mutex_unlock(&painting->lock);
        double start = clock_seconds();
        good = good && paint(painting, job, painter);
        double seconds = clock_seconds() - start;
        pthread_mutex_lock(&painting->lock);
        painting->seconds += seconds;
        job->failed = !good;
        painting->failed = painting->failed || !good;
        job->next = painting->ready;
        painting->ready = job;
        painting->ready_count++;
        Job *named = put_ready(painting);
        pthread_mutex_unlock(&painting->lock);
        good = end_jobs(painting, named);
        pthread_mutex_lock(&painting->lock);
        painting->failed = painting->failed || !good;
        painting->running--;
        add_done(painting, named);
        pthread_cond_broadcast(&painting->changed);
    }
    pthread_mutex_unlock(&painting->lock);
    petri_painter_close(&painter);
    return NULL;
}

Painting *painting_start(const char *film, double film_fps, double fps) {
    Painting *painting = memory_zeroed(sizeof *painting);
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    int wanted = film != NULL || processors < 1 ? 1 : processors > MOST_WORKERS ? MOST_WORKERS : (int)processors;
    pthread_mutex_init(&painting->lock, NULL);
    pthread_cond_init(&painting->changed, NULL);
    painting->last = &painting->waiting;
    painting->film = film;
    painting->fps = film_fps;
    painting->recording.fps = fps;
    painting->video = (Video){.frames = -1, .errors = -1, .unfinished = -1};
    sigset_t all, before; // signals are for the thread that makes the frames
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (painting->worker_count < wanted &&
           pthread_create(&painting->workers[painting->worker_count], NULL, work, painting) == 0) {
        painting->worker_count++;
    }
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (painting->worker_count == 0) {
        message("cannot start a thread");
        painting_free(painting);
        return NULL;
    }
    return painting;
}

// Waits for a change, but not long: a signal is none.
static void wait_a_moment(Painting *painting) {
    enum { NANOSECONDS = 20000000, SECOND = 1000000000 };
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += NANOSECONDS;
    until.tv_sec += until.tv_nsec / SECOND;
    until.tv_nsec %= SECOND;
    pthread_cond_timedwait(&painting->changed, &painting->lock, &until);
}

bool painting_add(Painting *painting, PetriPicture *picture, bool for_film, const char *file) {
    Job *job = memory_zeroed(sizeof *job);
    *job = (Job){.picture = picture, .for_film = for_film, .looks_back = petri_picture_looks_back(picture)};
    job->file = file == NULL ? NULL : memory_text(file);
    pthread_mutex_lock(&painting->lock);
    job->number = painting->added++;
    while (painting->waiting_count >= QUEUE && !painting->failed && frames_signal() == 0) {
        wait_a_moment(painting);
    }
    *painting->last = job;
    painting->last = &job->next;
    painting->waiting_count++;
    bool good = !painting->failed;
    pthread_cond_broadcast(&painting->changed);
    pthread_mutex_unlock(&painting->lock);
    return good;
}

void painting_tell(Painting *painting, PetriSession *session) {
    pthread_mutex_lock(&painting->lock);
    Job *done = painting->done;
    painting->done = NULL;
    pthread_mutex_unlock(&painting->lock);
    while (done != NULL) {
        Job *next = done->next;
        petri_picture_tell(session, done->picture);
        petri_picture_free(&done->picture);
        free(done->file);
        free(done);
        done = next;
    }
}

// Waits until nothing is drawn any more; after a signal for a moment only, and until what is drawn for a film is in it.
// Returns how many are given up.
static int wait_for_end(Painting *painting) {
    double signalled = 0;
    for (;;) {
        if (painting->running == 0 && painting->waiting == NULL) {
            return 0;
        }
        if (frames_signal() != 0) {
            signalled = signalled == 0 ? clock_seconds() : signalled;
            bool patient = clock_seconds() - signalled <= PATIENCE;
            if (!patient && (painting->film == NULL || painting->drawing)) {
                painting->failed = painting->failed || painting->film == NULL; // what waits is not begun any more
                painting->abandoned = true;
                painting->given_up = painting->film != NULL;
                return (int)(painting->added - painting->put);
            }
        }
        wait_a_moment(painting);
    }
}

bool painting_finish(Painting *painting, PetriSession *session, bool abandon, const char **trouble) {
    pthread_mutex_lock(&painting->lock);
    painting->ending = true;
    painting->failed = painting->failed || abandon;
    painting->abandoned = abandon;
    pthread_cond_broadcast(&painting->changed);
    painting->left = wait_for_end(painting);
    pthread_mutex_unlock(&painting->lock);
    while (painting->left == 0 && painting->worker_count > 0) {
        pthread_join(painting->workers[--painting->worker_count], NULL);
    }
    for (Job *job = painting->left == 0 ? painting->ready : NULL; job != NULL; job = job->next) {
        if (job->begun) {
            replace_abandon(&job->target); // one before it has failed
        }
    }
    if (painting->left == 0) {
        add_done(painting, painting->ready);
        painting->ready = NULL;
    }
    painting_tell(painting, session);
    if (painting->failed || (painting->given_up && !painting->filmed)) {
        video_abandon(&painting->video);
    } else if (painting->video.open) {
        double start = clock_seconds();
        if (!video_close(&painting->video)) {
            painting->failed = true;
            set_trouble(painting, painting->video.trouble);
        }
        painting->seconds += clock_seconds() - start;
    }
    if (!recording_end(&painting->recording, abandon)) {
        painting->failed = true;
        set_trouble(painting, painting->recording.trouble != NULL ? painting->recording.trouble : "out of memory");
    }
    *trouble = painting->trouble[0] == '\0' ? NULL : painting->trouble;
    return !painting->failed;
}

int painting_left(const Painting *painting) {
    return painting->left;
}

double painting_seconds(const Painting *painting) {
    return painting->seconds;
}

void painting_free(Painting *painting) {
    if (painting == NULL) {
        return;
    }
    pthread_mutex_destroy(&painting->lock);
    pthread_cond_destroy(&painting->changed);
    recording_free(&painting->recording);
    free(painting->pixels);
    free(painting);
}
