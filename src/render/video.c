// video.c: videos, encoded by an ffmpeg process; see video.h.
//
// ffmpeg writes to the open temporary file of base/replace.h, which gets its name when ffmpeg has succeeded. A signal
// can arrive at any time between video_open and video_close; abort_on_signal then kills ffmpeg and removes the file.
#include "render/video.h"

#include "base/file.h"
#include "cli/memory.h"
#include "cli/signal_cleanup.h"
#include "cli/subprocess.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PIPE_BYTES = 1 << 20 };

// Returns ffmpeg's name of the pixel format. Pixels are 32-bit integers, but ffmpeg's names give the order of bytes.
static const char *pixel_format(void) {
    const uint32_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first == 1 ? "bgra" : "argb";
}

static pid_t spawn_ffmpeg(Video *video, const VideoArguments *arguments, int input, double fps) {
    char size[32], rate[32];
    snprintf(size, sizeof size, "%dx%d", video->width, video->height);
    snprintf(rate, sizeof rate, "%.9g", fps);
    const char *words[64] = {
        "ffmpeg",   "-hide_banner", "-nostdin",      "-loglevel",   "error",   "-xerror",    "-y",       "-f",
        "rawvideo", "-pix_fmt",     pixel_format(),  "-video_size", size,      "-framerate", rate,       "-i",
        "pipe:0",   "-an",          "-map_metadata", "-1",          "-fflags", "+bitexact",  "-flags:v", "+bitexact"};
    size_t count = 0;
    while (words[count])
        count++;
    for (size_t i = 0; i < arguments->count; i++)
        words[count++] = arguments->words[i];
    words[count] = "file:/dev/fd/3"; // the video is still an unnamed file, open as descriptor 3

    const int files[] = {input, -1, video->errors, video->film.file};
    return subprocess_spawn("ffmpeg", words, files, sizeof files / sizeof *files, true);
}

__attribute__((format(printf, 2, 3))) static void set_error_text(Video *video, const char *format, ...) {
    va_list list;
    va_start(list, format);
    vsnprintf(video->error_text, sizeof video->error_text, format, list);
    va_end(list);
}

static void reset_video(Video *video) {
    if (video->frames >= 0)
        close(video->frames);
    if (video->errors >= 0)
        close(video->errors);
    signal_cleanup_end(video->cleanup_id);
    replace_abort(&video->film);
    video->open = false;
    video->cleanup_id = video->frames = video->errors = -1;
}

// Kills ffmpeg and discards the video. Called when a signal terminates this process.
static void abort_on_signal(void *context) {
    Video *video = context;
    pid_t pid = atomic_exchange(&video->pid, 0);
    if (pid > 0) {
        kill(pid, SIGKILL);
        subprocess_wait_for(pid);
    }
    replace_abort(&video->film);
}

bool video_open(Video *video, const char *file, const VideoOptions *options, int width, int height, double fps) {
    int ends[2] = {-1, -1};
    VideoArguments arguments;
    *video = (Video){.file = file, .open = true, .width = width, .height = height, .frames = -1};
    if (!video_arguments(&arguments, file, options)) {
        set_error_text(video, "cannot write '%s': %s", file, arguments.problem);
        video->open = false;
        video->errors = video->cleanup_id = -1;
        return false;
    }
    video->errors = subprocess_temporary_file();
    if (!replace_begin(&video->film, file, 0)) {
        set_error_text(video, "cannot write '%s': %s", file, strerror(errno));
        video->cleanup_id = -1;
        reset_video(video);
        return false;
    }
    video->cleanup_id = signal_cleanup_begin(abort_on_signal, video);
    if (video->errors < 0 || pipe(ends) != 0) {
        set_error_text(video, "cannot start ffmpeg: %s", strerror(errno));
        reset_video(video);
        return false;
    }
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
#ifdef F_SETPIPE_SZ
    fcntl(ends[1], F_SETPIPE_SZ, PIPE_BYTES);
#endif
    video->frames = ends[1];
    pid_t pid = spawn_ffmpeg(video, &arguments, ends[0], fps);
    int error = errno;
    video->pid = pid < 0 ? 0 : pid;
    close(ends[0]);
    if (pid < 0) {
        set_error_text(video, "cannot write '%s': cannot start ffmpeg: %s%s", file, strerror(error),
                       error == ENOENT ? "; on Debian, run: apt install ffmpeg" : "");
        reset_video(video);
        return false;
    }
    return true;
}

// Sets error_text from the exit status and the last line that ffmpeg wrote.
static void report_failure(Video *video, int status) {
    SCOPED_TEXT text = {0};
    text_add_c(&text, "");
    if (lseek(video->errors, 0, SEEK_SET) == 0)
        text_read(&text, video->errors, SIZE_MAX);
    while (text.len > 0 && (text.bytes[text.len - 1] == '\n' || text.bytes[text.len - 1] == '\r'))
        text.bytes[--text.len] = '\0';
    const char *line = strrchr(text.bytes, '\n');
    line = !line ? text.bytes : line + 1;
    if (WIFSIGNALED(status)) {
        set_error_text(video, "cannot write '%s': ffmpeg was killed by signal %d (%s)", video->file, WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
    } else {
        set_error_text(video, "cannot write '%s': ffmpeg failed with status %d%s%.300s", video->file,
                       WEXITSTATUS(status), line[0] == '\0' ? "" : ": ", line);
    }
}

// Closes ffmpeg's input and waits until it exits. If it failed, discards the video, sets error_text and returns false.
static bool finish_ffmpeg(Video *video) {
    close(video->frames);
    video->frames = -1;
    int status = subprocess_wait_for(video->pid);
    video->pid = 0;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    report_failure(video, status);
    reset_video(video);
    return false;
}

bool video_add(Video *video, const uint32_t *pixels) {
    size_t length = (size_t)video->width * (size_t)video->height * sizeof *pixels;
    if (file_write(video->frames, (const char *)pixels, length))
        return true;
    // ffmpeg has exited too early. Even if it reports success, frames are missing.
    if (finish_ffmpeg(video)) {
        set_error_text(video, "cannot write '%s': ffmpeg ended early", video->file);
        reset_video(video);
    }
    return false;
}

bool video_close(Video *video) {
    if (!video->open || !finish_ffmpeg(video))
        return false;
    bool done = replace_commit(&video->film);
    if (!done)
        set_error_text(video, "cannot write '%s': %s", video->file, strerror(errno));
    reset_video(video);
    return done;
}

void video_abandon(Video *video) {
    if (video->open) {
        abort_on_signal(video);
        reset_video(video);
    }
}
