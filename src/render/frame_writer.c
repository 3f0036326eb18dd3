// frame_writer.c: threads that draw and write pictures; see frame_writer.h.
//
// Files are renamed to their final names in the order of their frames. An interrupted series thus has no gaps. If
// several frames write the same file, the last of them remains.
//
// States of a writer, which only set_failed and stop change:
//
//      WRITING ── a job fails ──▶ FAILED
//       │   │                      │  │      frame_writer_finish abandons; a file cannot be renamed;
//       │   └──────────────────────┼──┴───▶ STOPPED      a signal, if there is no video
//       │ a signal, if there       │           │
//       │ is a video               │ a signal  │ a signal
//       ▼                          ▼           │
//      CUT ──── a job fails ───▶ DROPPED ◀─────┘
//
//   WRITING  Jobs run, and written files are renamed.
//   FAILED   No more jobs start. Files of jobs before the failed one are still renamed.
//   STOPPED  No more jobs start, and no more files are renamed.
//   CUT      Videos are written, and the frame that was being drawn is abandoned: the worker sleeps until the process
//            ends. The videos end with the frame before it.
//   DROPPED  Like CUT, but the videos are discarded.
#include "render/frame_writer.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/os.h"
#include "base/replace.h"
#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/shader_test.h"
#include "render/recording.h"
#include "render/video.h"
#include "run/frames.h"

#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { QUEUE = 4, MAX_WORKERS = 16, MAX_READY = 32, MAX_FILMS = 64 };
static const double GRACE_SECONDS = 0.05; // after a signal, jobs that are not finished within this time are abandoned

// An image file or a frame of a video.
typedef struct Output {
    int window; // number of the window; -1: the one that the picture shows
    char *file; // owned by the output
    Replacement target;
    bool target_open; // true if `target` is in use
    int error;        // errno of the failure to rename the file; 0: none
} Output;

typedef struct Job Job;
struct Job {
    Job *next;
    PetriPicture *picture;
    bool needs_history;
    Output *outputs;
    size_t output_count;
    bool failed;
    uint64_t number; // from 0, in the order of frame_writer_add
};

// A video and its next frame.
typedef struct Film Film;
struct Film {
    Film *next;
    char *file;
    Video video;
    uint32_t *pixels; // buffer for a frame
    bool has_frame;   // true if the video has a frame
};

typedef enum WriterState { WRITER_WRITING, WRITER_FAILED, WRITER_STOPPED, WRITER_CUT, WRITER_DROPPED } WriterState;

struct FrameWriter {
    pthread_mutex_t lock; // protects the fields up to `seconds`
    pthread_cond_t changed;
    WriterState state;
    Job *waiting; // queue, oldest first
    Job **last;   // points to the pointer to which the next job is assigned
    int waiting_count;
    int running; // number of jobs taken from the queue and not finished
    Job *ready;  // written jobs that wait for earlier jobs, in any order
    int ready_count;
    uint64_t added;
    uint64_t next_committed; // number of the first job that is not committed: its file is not renamed yet
    Job *done;               // jobs to be reported and freed
    bool begun;              // true if the first worker has started
    bool ending;             // true if no more jobs will be added
    bool drawing;            // true while a frame of a video is drawn; such a frame can be abandoned
    int unfinished;          // number of abandoned jobs
    double seconds;          // time that all threads together spent on jobs
    bool makes_films;        // true if outputs are videos. `films` to `recording` are used by the first worker only
    Film *films;
    double fps;
    Recording recording;
    pthread_t workers[MAX_WORKERS];
    int worker_count;
    char error_text[600];
};

static bool has_failed(const FrameWriter *writer) {
    return writer->state != WRITER_WRITING && writer->state != WRITER_CUT;
}

static void set_failed(FrameWriter *writer) {
    if (!has_failed(writer))
        writer->state = writer->state == WRITER_CUT ? WRITER_DROPPED : WRITER_FAILED;
}

// Lets no more files be renamed. If `cut`, also abandons the frame of the video that is being drawn.
static void stop(FrameWriter *writer, bool cut) {
    if (cut)
        writer->state = has_failed(writer) ? WRITER_DROPPED : WRITER_CUT;
    else if (writer->state == WRITER_WRITING || writer->state == WRITER_FAILED)
        writer->state = WRITER_STOPPED;
}

static void set_error_text(FrameWriter *writer, const char *text) {
    pthread_mutex_lock(&writer->lock);
    if (writer->error_text[0] == '\0')
        snprintf(writer->error_text, sizeof writer->error_text, "%s", text);
    pthread_mutex_unlock(&writer->lock);
}

// Draws a frame of a video. Never returns if the frame is abandoned in the meantime, because another thread then
// completes the videos.
static bool draw_for_film(FrameWriter *writer, const Film *film, PetriPicture *picture, PetriPainter *painter) {
    const Video *video = &film->video;
    pthread_mutex_lock(&writer->lock);
    writer->drawing = true;
    pthread_mutex_unlock(&writer->lock);
    PetriStatus status = petri_picture_draw(picture, painter, film->pixels, video->width, video->height,
                                            (size_t)video->width * sizeof(uint32_t));
    pthread_mutex_lock(&writer->lock);
    while (writer->state == WRITER_CUT || writer->state == WRITER_DROPPED)
        pthread_cond_wait(&writer->changed, &writer->lock); // sleeps until the process ends
    writer->drawing = false;
    pthread_mutex_unlock(&writer->lock);
    if (status == PETRI_OUT_OF_MEMORY)
        set_error_text(writer, "out of memory");
    return status == PETRI_OK && !shader_test_interrupted();
}

// Returns the video with this name, and adds it if it does not exist yet. Returns NULL after a failure.
static Film *find_film(FrameWriter *writer, const char *file) {
    int count = 0;
    for (Film *film = writer->films; film; film = film->next, count++)
        if (strcmp(film->file, file) == 0)
            return film;
    if (count == MAX_FILMS) {
        char text[sizeof writer->error_text];
        snprintf(text, sizeof text, "cannot write '%s': a run can write at most %d videos", file, MAX_FILMS);
        set_error_text(writer, text);
        return NULL;
    }
    Film *film = memory_calloc(sizeof *film);
    *film = (Film){.next = writer->films, .video = {.frames = -1, .errors = -1, .cleanup_id = -1}};
    film->file = memory_strdup(file);
    writer->films = film;
    return film;
}

static bool add_to_film(FrameWriter *writer, const char *file, PetriPicture *picture, PetriPainter *painter) {
    Film *film = find_film(writer, file);
    if (!film)
        return false;
    Video *video = &film->video;
    if (!film->pixels) {
        int width = 0, height = 0;
        petri_picture_size(picture, &width, &height);
        film->pixels = calloc((size_t)width * (size_t)height, sizeof(uint32_t));
        if (!film->pixels) {
            set_error_text(writer, "out of memory");
            return false;
        }
        if (!video_open(video, film->file, &(VideoOptions){.crf = NAN}, width, height, writer->fps)) {
            set_error_text(writer, video->error_text);
            return false;
        }
    }
    if (!draw_for_film(writer, film, picture, painter))
        return false;
    if (!video_add(video, film->pixels)) {
        set_error_text(writer, video->error_text);
        return false;
    }
    film->has_frame = true;
    return true;
}

static bool check_saved(FrameWriter *writer, PetriStatus status) {
    if (status == PETRI_OUT_OF_MEMORY)
        set_error_text(writer, "out of memory");
    return status == PETRI_OK && !shader_test_interrupted();
}

static bool cannot_write(FrameWriter *writer, const char *file) {
    char text[sizeof writer->error_text];
    snprintf(text, sizeof text, "cannot write '%s': %s", file, strerror(errno));
    set_error_text(writer, text);
    return false;
}

static bool write_bytes(FrameWriter *writer, const Output *output, const Text *bytes) {
    return file_write(output->target.file, bytes->bytes, bytes->len) || cannot_write(writer, output->file);
}

// Waits until all earlier jobs are committed. Returns false after a failure.
static bool wait_for_turn(FrameWriter *writer, const Job *job) {
    pthread_mutex_lock(&writer->lock);
    while (writer->next_committed < job->number && !has_failed(writer))
        pthread_cond_wait(&writer->changed, &writer->lock);
    bool good = !has_failed(writer);
    pthread_mutex_unlock(&writer->lock);
    return good;
}

// Writes a temporary file; commit_ready_jobs renames it. A target that is not a regular file is written directly.
static bool write_file(FrameWriter *writer, const Job *job, Output *output, PetriPainter *painter) {
    SCOPED_TEXT bytes = {0};
    if (!check_saved(writer, petri_picture_encode(job->picture, painter, output->file, text_collect, &bytes)))
        return false;
    output->target_open = replace_begin(&output->target, output->file, 0);
    if (!output->target_open)
        return cannot_write(writer, output->file);
    return (!output->target.direct || wait_for_turn(writer, job)) && write_bytes(writer, output, &bytes) &&
           (replace_flush(&output->target) || cannot_write(writer, output->file));
}

static bool write_output(FrameWriter *writer, const Job *job, Output *output, PetriPainter *painter) {
    if (output->window >= 0 && !check_saved(writer, petri_picture_select(job->picture, output->window)))
        return false;
    return writer->makes_films ? add_to_film(writer, output->file, job->picture, painter)
                               : write_file(writer, job, output, painter);
}

static bool run_job(FrameWriter *writer, Job *job, PetriPainter *painter) {
    bool good = true;
    for (size_t i = 0; good && i < job->output_count; i++)
        good = write_output(writer, job, &job->outputs[i], painter);
    if (good && job->needs_history) {
        good = recording_add(&writer->recording, job->picture, painter);
        if (!good && writer->recording.error_text)
            set_error_text(writer, writer->recording.error_text);
    }
    return good;
}

// Removes the next job to be committed from the ready jobs. Returns NULL if that job is not ready or has failed.
static Job *pop_ready_job(FrameWriter *writer) {
    Job **at = &writer->ready;
    while (*at && (*at)->number != writer->next_committed)
        at = &(*at)->next;
    Job *job = *at;
    if (!job || job->failed)
        return NULL;
    *at = job->next;
    writer->ready_count--;
    return job;
}

static bool rename_files(Job *job) {
    bool good = true;
    for (size_t i = 0; i < job->output_count; i++) {
        Output *output = &job->outputs[i];
        output->error = output->target_open && !replace_rename(&output->target) ? errno : 0;
        good = good && output->error == 0;
    }
    return good;
}

// Renames the files of ready jobs in order, up to the first job that is not ready. Returns the jobs of these files,
// which the caller passes to finish_jobs.
static Job *commit_ready_jobs(FrameWriter *writer) {
    Job *named = NULL, *job;
    while ((writer->state == WRITER_WRITING || writer->state == WRITER_FAILED) && (job = pop_ready_job(writer))) {
        if (!rename_files(job))
            stop(writer, false);
        writer->next_committed++;
        job->next = named;
        named = job;
    }
    return named;
}

// Completes renamed files. Returns false if one of them failed.
static bool finish_jobs(FrameWriter *writer, Job *named) {
    bool good = true;
    for (Job *job = named; job; job = job->next)
        for (size_t i = 0; i < job->output_count; i++) {
            Output *output = &job->outputs[i];
            errno = output->error;
            if (output->target_open && (output->error != 0 || !replace_end(&output->target)))
                good = cannot_write(writer, output->file);
        }
    return good;
}

static void add_done(FrameWriter *writer, Job *jobs) {
    while (jobs) {
        Job *next = jobs->next;
        jobs->next = writer->done;
        writer->done = jobs;
        jobs = next;
    }
}

// Waits for the next job. Returns NULL when no more jobs will be added. Only the first worker takes jobs that need
// history.
static Job *pop_job(FrameWriter *writer, bool first) {
    while (writer->waiting
               ? (writer->waiting->needs_history && !first) || (writer->ready_count >= MAX_READY && !has_failed(writer))
               : !writer->ending)
        pthread_cond_wait(&writer->changed, &writer->lock);
    Job *job = writer->waiting;
    if (job) {
        writer->waiting = job->next;
        writer->waiting_count--;
        if (!writer->waiting)
            writer->last = &writer->waiting;
        writer->running++;
        pthread_cond_broadcast(&writer->changed);
    }
    return job;
}

static void *run_worker(void *context) {
    // After a signal, frame_writer_finish abandons the frame.
    static ShaderTester tester = {frames_signal, true};
    FrameWriter *writer = context;
    PetriPainter *painter = painter_open_tested(&tester);
    if (!painter)
        set_error_text(writer, "out of memory");
    pthread_mutex_lock(&writer->lock);
    bool first = !writer->begun;
    writer->begun = true;
    for (Job *job = pop_job(writer, first); job; job = pop_job(writer, first)) {
        bool good = painter && !has_failed(writer);
        pthread_mutex_unlock(&writer->lock);
        double start = clock_seconds();
        good = good && run_job(writer, job, painter);
        double seconds = clock_seconds() - start;
        pthread_mutex_lock(&writer->lock);
        writer->seconds += seconds;
        job->failed = !good;
        if (!good)
            set_failed(writer);
        job->next = writer->ready;
        writer->ready = job;
        writer->ready_count++;
        Job *named = commit_ready_jobs(writer);
        pthread_mutex_unlock(&writer->lock);
        good = finish_jobs(writer, named);
        pthread_mutex_lock(&writer->lock);
        if (!good)
            set_failed(writer);
        writer->running--;
        add_done(writer, named);
        pthread_cond_broadcast(&writer->changed);
    }
    pthread_mutex_unlock(&writer->lock);
    petri_painter_close(&painter);
    return NULL;
}

FrameWriter *frame_writer_start(bool films, double film_fps, double fps) {
    FrameWriter *writer = memory_calloc(sizeof *writer);
    long processors = os_processor_count();
    int wanted = films || processors < 1 ? 1 : processors > MAX_WORKERS ? MAX_WORKERS : (int)processors;
    pthread_mutex_init(&writer->lock, NULL);
    pthread_cond_init(&writer->changed, NULL);
    writer->last = &writer->waiting;
    writer->makes_films = films;
    writer->fps = film_fps;
    writer->recording.fps = fps;
    sigset_t all, before; // workers block all signals, because the main thread handles them
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    while (writer->worker_count < wanted &&
           pthread_create(&writer->workers[writer->worker_count], NULL, run_worker, writer) == 0)
        writer->worker_count++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    if (writer->worker_count == 0) {
#ifdef __EMSCRIPTEN__
        message("cannot draw pictures: petri for Node.js draws only PNG files, with the options -o, --frame, --frames, "
                "--every, --fps, --auto, --quiet and -D; use the native petri");
#else
        message("cannot start a thread");
#endif
        frame_writer_free(writer);
        return NULL;
    }
    return writer;
}

// Waits at most 20 ms for a change, because a signal does not wake the condition variable.
static void wait_briefly(FrameWriter *writer) {
    enum { NANOSECONDS = 20000000, SECOND = 1000000000 };
    struct timespec until;
    clock_gettime(CLOCK_REALTIME, &until);
    until.tv_nsec += NANOSECONDS;
    until.tv_sec += until.tv_nsec / SECOND;
    until.tv_nsec %= SECOND;
    pthread_cond_timedwait(&writer->changed, &writer->lock, &until);
}

static void free_job(Job *job) {
    petri_picture_free(&job->picture);
    for (size_t i = 0; i < job->output_count; i++)
        free(job->outputs[i].file);
    free(job->outputs);
    free(job);
}

bool frame_writer_add(FrameWriter *writer, PetriPicture *picture, const FrameOutput *outputs, size_t count) {
    Job *job = memory_calloc(sizeof *job);
    *job = (Job){.picture = picture, .needs_history = petri_picture_needs_history(picture), .output_count = count};
    job->outputs = count > 0 ? memory_calloc(count * sizeof *job->outputs) : NULL;
    for (size_t i = 0; i < count; i++)
        job->outputs[i] = (Output){.window = outputs[i].window, .file = memory_strdup(outputs[i].file)};
    pthread_mutex_lock(&writer->lock);
    job->number = writer->added++;
    while (writer->waiting_count >= QUEUE && !has_failed(writer) && frames_signal() == 0)
        wait_briefly(writer);
    *writer->last = job;
    writer->last = &job->next;
    writer->waiting_count++;
    bool good = !has_failed(writer);
    pthread_cond_broadcast(&writer->changed);
    pthread_mutex_unlock(&writer->lock);
    return good;
}

void frame_writer_report(FrameWriter *writer, PetriSession *session) {
    pthread_mutex_lock(&writer->lock);
    Job *done = writer->done;
    writer->done = NULL;
    pthread_mutex_unlock(&writer->lock);
    while (done) {
        Job *next = done->next;
        petri_picture_report(session, done->picture);
        free_job(done);
        done = next;
    }
}

// Waits until all jobs are finished. After a signal, waits only GRACE_SECONDS, but does not stop while a frame is
// partly written to the video, or if only renamed files are not completed yet. Returns the number of abandoned jobs.
static int wait_for_end(FrameWriter *writer) {
    double signalled = 0;
    for (;;) {
        if (writer->running == 0 && !writer->waiting)
            return 0;
        if (frames_signal() != 0) {
            signalled = signalled == 0 ? clock_seconds() : signalled;
            bool patient = clock_seconds() - signalled <= GRACE_SECONDS;
            if (!patient && writer->next_committed < writer->added &&
                (!writer->makes_films || writer->drawing || shader_test_interrupted())) {
                stop(writer, writer->makes_films);
                return (int)(writer->added - writer->next_committed);
            }
        }
        wait_briefly(writer);
    }
}

// Completes the videos, or discards them after a failure.
static void close_films(FrameWriter *writer) {
    double start = clock_seconds();
    for (Film *film = writer->films; film; film = film->next) {
        if (has_failed(writer) || (writer->state == WRITER_CUT && !film->has_frame)) {
            video_abandon(&film->video);
        } else if (film->video.open && !video_close(&film->video)) {
            set_failed(writer);
            set_error_text(writer, film->video.error_text);
        }
    }
    writer->seconds += clock_seconds() - start;
}

bool frame_writer_finish(FrameWriter *writer, PetriSession *session, bool abandon, const char **error_text) {
    pthread_mutex_lock(&writer->lock);
    writer->ending = true;
    if (abandon)
        stop(writer, false);
    pthread_cond_broadcast(&writer->changed);
    writer->unfinished = wait_for_end(writer);
    pthread_mutex_unlock(&writer->lock);
    while (writer->unfinished == 0 && writer->worker_count > 0)
        pthread_join(writer->workers[--writer->worker_count], NULL);
    for (Job *job = writer->unfinished == 0 ? writer->ready : NULL; job; job = job->next)
        for (size_t i = 0; i < job->output_count; i++)
            if (job->outputs[i].target_open)
                replace_abort(&job->outputs[i].target); // the file is not renamed, because an earlier job has failed
    if (writer->unfinished == 0) {
        add_done(writer, writer->ready);
        writer->ready = NULL;
    }
    frame_writer_report(writer, session);
    close_films(writer);
    if (!recording_end(&writer->recording, abandon)) {
        set_failed(writer);
        set_error_text(writer, writer->recording.error_text ? writer->recording.error_text : "out of memory");
    }
    *error_text = writer->error_text[0] == '\0' ? NULL : writer->error_text;
    return !has_failed(writer);
}

int frame_writer_unfinished_count(const FrameWriter *writer) {
    return writer->unfinished;
}

double frame_writer_seconds(const FrameWriter *writer) {
    return writer->seconds;
}

void frame_writer_free(FrameWriter *writer) {
    if (!writer)
        return;
    pthread_mutex_destroy(&writer->lock);
    pthread_cond_destroy(&writer->changed);
    recording_free(&writer->recording);
    for (Film *film = writer->films, *next; film; film = next) {
        next = film->next;
        free(film->pixels);
        free(film->file);
        free(film);
    }
    free(writer);
}
