// painting.c: draws and writes pictures in threads of their own.
#include "render/painting.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/source.h"
#include "cli/bytes.h"
#include "cli/cli.h"
#include "cli/progress.h"
#include "render/recording.h"
#include "render/video.h"
#include "run/frames.h"

enum { QUEUE = 4, MOST_WORKERS = 16 };
static const double PATIENCE = 0.05; // seconds

typedef struct Job Job;
struct Job {
    Job *next;
    PetriPicture *picture;
    bool for_film;
    bool looks_back;
    char *file; // owned, or NULL
};

struct Painting {
    pthread_mutex_t lock; // for what follows, up to the film
    pthread_cond_t changed;
    Job *waiting; // oldest first
    Job **last;
    int waiting_count;
    Job *running[MOST_WORKERS]; // in any order; NULL: none
    Job *done;
    bool begun;  // there is a first worker
    bool ending; // no more will be added
    bool failed;
    bool drawing;  // a frame of the film, which nobody has to wait for
    bool given_up; // the film ends without the frame that is being drawn
    bool filmed;   // it has a frame
    int left;      // that were given up in their midst
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
        strncpy(painting->trouble, text, sizeof painting->trouble - 1);
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

static bool paint(Painting *painting, const Job *job, PetriPainter *painter) {
    bool good = !job->for_film || add_to_film(painting, job->picture, painter);
    if (job->file != NULL) {
        good = good && saved(painting, petri_picture_save(job->picture, painter, job->file));
    }
    if (good && job->looks_back) {
        good = recording_add(&painting->recording, job->picture, painter);
        if (!good && painting->recording.trouble != NULL) {
            set_trouble(painting, painting->recording.trouble);
        }
    }
    return good;
}

static const char *last_part(const char *file) {
    return file + path_directory(str_from(file)).len;
}

// Whether two jobs may write the same file. Paths may differ and lead to the same: names count.
static bool share_file(const Job *a, const Job *b) {
    return a->file != NULL && b->file != NULL && strcmp(last_part(a->file), last_part(b->file)) == 0;
}

static Job **find_running(Painting *painting, const Job *job) {
    int i = 0;
    while (painting->running[i] != job) {
        i++;
    }
    return &painting->running[i];
}

// Frames that write the same file do so one after the other, so that the last one's picture stays. Those that look back
// are all made by the first worker.
static bool may_run(const Painting *painting, const Job *job, bool first) {
    if (job->looks_back && !first) {
        return false;
    }
    for (int i = 0; i < MOST_WORKERS; i++) {
        if (painting->running[i] != NULL && share_file(painting->running[i], job)) {
            return false;
        }
    }
    return true;
}

// The next job, or NULL if there will be none.
static Job *take_job(Painting *painting, bool first) {
    while (painting->waiting != NULL ? !may_run(painting, painting->waiting, first) : !painting->ending) {
        pthread_cond_wait(&painting->changed, &painting->lock);
    }
    Job *job = painting->waiting;
    if (job != NULL) {
        painting->waiting = job->next;
        painting->waiting_count--;
        if (painting->waiting == NULL) {
            painting->last = &painting->waiting;
        }
        *find_running(painting, NULL) = job; // no more run than there are threads
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
        painting->failed = painting->failed || !good;
        *find_running(painting, job) = NULL;
        job->next = painting->done;
        painting->done = job;
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
        int running = 0;
        for (int i = 0; i < MOST_WORKERS; i++) {
            running += painting->running[i] != NULL;
        }
        if (running == 0 && painting->waiting == NULL) {
            return 0;
        }
        if (frames_signal() != 0) {
            signalled = signalled == 0 ? clock_seconds() : signalled;
            bool patient = clock_seconds() - signalled <= PATIENCE;
            if (!patient && (painting->film == NULL || painting->drawing)) {
                painting->failed = painting->failed || painting->film == NULL; // what waits is not begun any more
                painting->given_up = painting->film != NULL;
                return running + painting->waiting_count;
            }
        }
        wait_a_moment(painting);
    }
}

bool painting_finish(Painting *painting, PetriSession *session, bool abandon, const char **trouble) {
    pthread_mutex_lock(&painting->lock);
    painting->ending = true;
    painting->failed = painting->failed || abandon;
    pthread_cond_broadcast(&painting->changed);
    painting->left = wait_for_end(painting);
    pthread_mutex_unlock(&painting->lock);
    while (painting->left == 0 && painting->worker_count > 0) {
        pthread_join(painting->workers[--painting->worker_count], NULL);
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
