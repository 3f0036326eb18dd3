// hdf5.c: see hdf5.h.
#include "cli/hdf5.h"

#include "base/file.h"
#include "cli/byte_buffer.h"
#include "cli/cli.h"
#include "cli/helper_exec.h"
#include "cli/script.h"
#include "cli/signal_cleanup.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

static bool wait_for(pid_t process) {
    int status = 0;
    pid_t done;
    do {
        done = waitpid(process, &status, 0);
    } while (done < 0 && errno == EINTR);
    if (done == process && WIFSIGNALED(status)) // otherwise petri-hdf5 has printed its own message
        message("petri-hdf5, which writes the file, was terminated by signal %d", WTERMSIG(status));
    return done == process && WIFEXITED(status) && WEXITSTATUS(status) == STATUS_DONE;
}

// Lets petri-hdf5 finish the file before a signal terminates this process. A SignalCleanup.
static void close_on_signal(void *context) {
    Hdf5 *writer = context;
    close(writer->stream);
    wait_for(writer->process);
}

// Executes petri-hdf5 in the child process. petri-hdf5 ignores signals from the terminal, because it must finish the
// file. It exits at the end of the stream.
static void exec_writer(int stream, char **words) {
    static const int ignored[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT};
    for (size_t i = 0; i < sizeof ignored / sizeof ignored[0]; i++)
        signal(ignored[i], SIG_IGN);
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
static bool wait_for_ready(int stream) {
    char word;
    ssize_t length;
    do {
        length = read(stream, &word, 1);
    } while (length < 0 && errno == EINTR);
    return length == 1;
}

static bool fork_writer(Hdf5 *writer, char **words) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        return false;
    writer->stream = ends[0];
    writer->process = fork();
    if (writer->process == 0)
        exec_writer(ends[1], words);
    close(ends[1]);
    return writer->process > 0;
}

bool hdf5_start(Hdf5 *writer, const char *kind, const char *path, const char *after) {
    char program[] = "petri-hdf5";
    SCOPED_TEXT as_kind = memory_strdup(kind);
    SCOPED_TEXT as_path = memory_strdup(path);
    SCOPED_TEXT as_after = !after ? NULL : memory_strdup(after);
    char *words[] = {program, as_kind, as_path, as_after, NULL};
    *writer = (Hdf5){.process = -1, .stream = -1, .cleanup_id = -1};
    bool started = fork_writer(writer, words);
    if (!started) {
        message("cannot write %s: %s", path, strerror(errno));
    } else if (wait_for_ready(writer->stream)) {
        writer->cleanup_id = signal_cleanup_begin(close_on_signal, writer);
        return true;
    }
    hdf5_end(writer);
    return false;
}

bool hdf5_wait(Hdf5 *writer) {
    return wait_for_ready(writer->stream);
}

bool hdf5_end(Hdf5 *writer) {
    if (writer->stream >= 0)
        close(writer->stream);
    bool good = writer->process > 0 && wait_for(writer->process);
    signal_cleanup_end(writer->cleanup_id);
    return good;
}

bool hdf5_table(const char *path, const char *csv, size_t length) {
    Hdf5 writer;
    Hdf5Head head = {HDF5_ADD, length}, end = {HDF5_COMMIT, 0};
    if (!hdf5_start(&writer, "table", path, NULL))
        return false;
    bool sent = file_write(writer.stream, (const char *)&head, sizeof head) && file_write(writer.stream, csv, length) &&
                file_write(writer.stream, (const char *)&end, sizeof end);
    return hdf5_end(&writer) && sent;
}

bool hdf5_has_suffix(const char *path) {
    return script_suffix(path, ".h5 .hdf5") >= 0;
}
