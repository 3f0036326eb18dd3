// hdf5.c: see hdf5.h.
#include "cli/hdf5.h"

#include "base/clock.h"
#include "base/file.h"
#include "base/os.h"
#include "cli/cli.h"
#include "cli/helper_exec.h"
#include "cli/memory.h"
#include "cli/script.h"
#include "cli/signal_cleanup.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

// How long petri-hdf5 may do nothing after a signal. A slow disk can take seconds to store a finished file.
static const double START_SECONDS = 0.2, FINISH_SECONDS = 10, SECOND_SIGNAL_SECONDS = 0.2;

// Returns true if the process has run since the last call with the same `before`.
static bool has_run(pid_t process, char before[64]) {
    char path[64], now[64] = "";
    snprintf(path, sizeof path, "/proc/%ld/schedstat", (long)process);
    int file = open(path, O_RDONLY | O_CLOEXEC);
    ssize_t length = file < 0 ? -1 : read(file, now, sizeof now - 1);
    if (file >= 0)
        close(file);
    bool same = length < 0 || strcmp(now, before) == 0;
    memcpy(before, now, sizeof now);
    return !same;
}

// Waits until petri-hdf5 reads (POLLOUT), has answered (POLLIN) or has exited. After a signal, continues petri-hdf5 if
// it is stopped, and kills it once it has done nothing for `patience` seconds. Returns false if even that has no
// effect.
static bool wait_for_event(Hdf5 *writer, short events, double patience) {
    enum { MILLISECONDS = 50 };
    struct pollfd stream = {.fd = writer->stream, .events = events};
    char before[64] = "";
    double since = clock_seconds();
    while (poll(&stream, 1, MILLISECONDS) <= 0) {
        bool has_signal = writer->pending_signal && writer->pending_signal() != 0;
        if (has_signal)
            kill(writer->process, SIGCONT);
        if (!has_signal || (has_run(writer->process, before) && !writer->killed)) {
            since = clock_seconds();
        } else if (clock_seconds() - since > patience) {
            if (writer->killed)
                return false;
            writer->killed = true;
            kill(writer->process, SIGKILL);
            since = clock_seconds();
        }
    }
    return true;
}

// Ends the stream and waits until petri-hdf5 has exited. Returns true if it has completed the file.
static bool finish(Hdf5 *writer, double patience) {
    int status = 0;
    pid_t done;
    shutdown(writer->stream, SHUT_WR);
    bool exits = wait_for_event(writer, 0, patience);
    signal_cleanup_end(writer->cleanup_id); // before the process id is free
    do {
        done = waitpid(writer->process, &status, exits ? 0 : WNOHANG);
    } while (done < 0 && errno == EINTR);
    writer->process = -1;
    if (writer->killed)
        message("petri-hdf5, which writes the file, did not respond and was killed");
    else if (done > 0 && WIFSIGNALED(status)) // otherwise petri-hdf5 has printed its own message
        message("petri-hdf5, which writes the file, was terminated by signal %d", WTERMSIG(status));
    return done > 0 && WIFEXITED(status) && WEXITSTATUS(status) == STATUS_DONE;
}

// Lets petri-hdf5 finish the file before a signal terminates this process. A SignalCleanup.
static void close_on_signal(void *context) {
    Hdf5 *writer = context;
    if (writer->process > 0)
        finish(writer, SECOND_SIGNAL_SECONDS);
}

// Executes petri-hdf5 in the child process. petri-hdf5 ignores signals from the terminal, because it must finish the
// file. It exits at the end of the stream.
static void exec_writer(int stream, char **words) {
    static const int ignored[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    for (size_t i = 0; i < sizeof ignored / sizeof ignored[0]; i++)
        signal(ignored[i], SIG_IGN);
    os_signal_after_parent(SIGCONT); // if it is stopped, petri-hdf5 finishes the file once petri has ended
    // petri-hdf5 must not inherit standard output. Otherwise a program that reads petri's output would wait for
    // petri-hdf5.
    int cause = errno, nothing = open("/dev/null", O_WRONLY);
    if (nothing >= 0 && dup2(stream, STDIN_FILENO) >= 0 && dup2(nothing, STDOUT_FILENO) >= 0)
        cause = helper_exec(words[0], words);
    message("cannot write %s: cannot start petri-hdf5: %s%s", words[2], strerror(cause),
            cause == ENOENT ? "; petri was built without HDF5; on Debian, install libhdf5-dev and build petri again"
                            : "");
    _exit(STATUS_FAILED);
}

// Waits for the byte that petri-hdf5 sends when it is ready for data, and after each HDF5_SYNC. Returns false if
// petri-hdf5 has exited instead.
static bool wait_for_ready(Hdf5 *writer, double patience) {
    char word;
    return wait_for_event(writer, POLLIN, patience) && file_read_bytes(writer->stream, &word, 1);
}

static bool fork_writer(Hdf5 *writer, char **words) {
    int ends[2];
    if (!os_socket_pair(ends))
        return false;
    writer->stream = ends[0];
    writer->process = fork();
    if (writer->process == 0)
        exec_writer(ends[1], words);
    close(ends[1]);
    return writer->process > 0;
}

bool hdf5_start(Hdf5 *writer, const char *kind, const char *path, const char *after, int (*pending_signal)(void)) {
    char program[] = "petri-hdf5";
    SCOPED_STRING as_kind = memory_strdup(kind);
    SCOPED_STRING as_path = memory_strdup(path);
    SCOPED_STRING as_after = !after ? NULL : memory_strdup(after);
    char *words[] = {program, as_kind, as_path, as_after, NULL};
    *writer = (Hdf5){.process = -1, .stream = -1, .cleanup_id = -1, .pending_signal = pending_signal};
#ifdef __EMSCRIPTEN__ // there are no processes
    message("cannot write %s: petri for Node.js does not write HDF5; use the suffix .csv", path);
    return false;
#endif
    bool started = fork_writer(writer, words);
    if (!started) {
        message("cannot write %s: %s", path, strerror(errno));
    } else if (wait_for_ready(writer, START_SECONDS)) {
        writer->cleanup_id = signal_cleanup_begin(close_on_signal, writer);
        return true;
    }
    hdf5_end(writer);
    return false;
}

bool hdf5_write(void *context, const char *bytes, size_t length) {
    Hdf5 *writer = context;
    while (length > 0) {
        ssize_t sent = send(writer->stream, bytes, length, MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent < 0 && errno == EAGAIN) {
            if (!wait_for_event(writer, POLLOUT, FINISH_SECONDS)) {
                errno = EPIPE;
                return false;
            }
        } else if (sent < 0 && errno != EINTR) {
            return false;
        }
        bytes += sent < 0 ? 0 : sent;
        length -= sent < 0 ? 0 : (size_t)sent;
    }
    return true;
}

bool hdf5_wait(Hdf5 *writer) {
    return wait_for_ready(writer, FINISH_SECONDS);
}

bool hdf5_end(Hdf5 *writer) {
    bool good = writer->process > 0 && finish(writer, FINISH_SECONDS);
    if (writer->stream >= 0)
        close(writer->stream);
    return good;
}

bool hdf5_table(const char *path, Str cells, int (*pending_signal)(void)) {
    Hdf5 writer;
    Hdf5Head head = {HDF5_ADD, cells.len}, end = {HDF5_COMMIT, 0};
    if (!hdf5_start(&writer, "table", path, NULL, pending_signal))
        return false;
    bool sent = hdf5_write(&writer, (const char *)&head, sizeof head) && hdf5_write(&writer, cells.bytes, cells.len) &&
                hdf5_write(&writer, (const char *)&end, sizeof end);
    return hdf5_end(&writer) && sent;
}

bool hdf5_has_suffix(const char *path) {
    return script_suffix(path, ".h5 .hdf5") >= 0;
}
