// shader_test.c: see shader_test.h.
//
// The tested process gets two texts on standard input, each with a terminating NUL, and writes the driver's message to
// standard output. Its exit status tells the result (SHADER_GOOD ...).
#include "cli/shader_test.h"

#include "base/arena.h"
#include "base/file.h"
#include "base/os.h"
#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/subprocess.h"
#include "petri-draw.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { SHADER_GOOD = 0, SHADER_REJECTED = 10, SHADER_REJECTED_VERTEX = 11 };
// Limits of a test. Common shaders take less than a second and 300 MB with llvmpipe.
enum { MAX_SECONDS = 4, MAX_WAIT_SECONDS = 30, MAX_GIBIBYTES = 2, MAX_SOURCE = 1 << 24 };

static atomic_bool interrupted; // see shader_test_interrupted

static bool has_signal(const ShaderTester *tester) {
    return tester->pending_signal && tester->pending_signal() != 0;
}

// Waits until the process writes or ends. Returns false if a signal came first.
static bool wait_for_output(const ShaderTester *tester, int fd) {
    enum { MILLISECONDS = 50 };
    struct pollfd output = {.fd = fd, .events = POLLIN};
    while (poll(&output, 1, MILLISECONDS) <= 0)
        if (has_signal(tester))
            return false;
    return true;
}

// Returns true if a signal has ended the test. The terminal sends Ctrl-C to the tested process too, perhaps before this
// process has handled the signal.
static bool was_interrupted(const ShaderTester *tester, int status) {
    enum { TRIES = 20, NANOSECONDS = 10000000 };
    int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    bool from_terminal = number == SIGINT || number == SIGTERM || number == SIGHUP || number == SIGQUIT;
    for (int i = 0; from_terminal && i < TRIES && !has_signal(tester); i++)
        nanosleep(&(struct timespec){.tv_nsec = NANOSECONDS}, NULL);
    return from_terminal || has_signal(tester);
}

static void describe_failure(const ShaderTester *tester, int status, PetriShaderProblem *problem) {
    int number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    problem->failed = true;
    if (was_interrupted(tester, status)) {
        interrupted = true;
        while (tester->never_returns && has_signal(tester))
            pause();
        snprintf(problem->text, sizeof problem->text, "interrupted while the shader was tested");
    } else if (number == SIGXCPU || number == SIGKILL || number == SIGALRM) {
        snprintf(problem->text, sizeof problem->text,
                 "the shader takes more than %d s to compile and to draw %d pixels", MAX_SECONDS,
                 PETRI_SHADER_TRY_PIXELS);
    } else {
        snprintf(problem->text, sizeof problem->text,
                 "OpenGL crashed, or needed more than %d GiB of memory, while it compiled the shader", MAX_GIBIBYTES);
    }
}

// A PetriShaderTest. If no process can be started, the shader is not compiled.
static bool test_shader(void *user_data, const char *vertex, const char *fragment, PetriShaderProblem *problem) {
    const ShaderTester *tester = user_data;
    int input[2], output[2];
    snprintf(problem->text, sizeof problem->text, "cannot start a process that compiles the shader");
    problem->failed = true;
    if (!os_pipe(input))
        return false;
    if (!os_pipe(output)) {
        close(input[0]);
        close(input[1]);
        return false;
    }
    char path[PATH_MAX];
    const char *program = os_program(path);
    pid_t pid = !program ? -1
                         : subprocess_spawn(program, (const char *const[]){"petri", SHADER_TEST_COMMAND.name, NULL},
                                            (const int[]){input[0], output[1], -1}, 3, false);
    close(input[0]);
    close(output[1]);
    // The process reads all of its input before it writes. If it ends early, writing fails, because SIGPIPE is ignored.
    bool sent = pid > 0 && file_write(input[1], vertex, strlen(vertex) + 1) &&
                file_write(input[1], fragment, strlen(fragment) + 1);
    close(input[1]);
    SCOPED_TEXT text = {0};
    text_add_c(&text, "");
    if (pid > 0 && !wait_for_output(tester, output[0]))
        kill(pid, SIGINT);
    if (pid > 0)
        text_read(&text, output[0], sizeof problem->text - 1);
    close(output[0]);
    int status = pid > 0 ? subprocess_wait_for(pid) : -1;
    if (status < 0)
        return false;
    int code = WIFEXITED(status) && sent ? WEXITSTATUS(status) : -1;
    if (code == SHADER_REJECTED || code == SHADER_REJECTED_VERTEX) {
        problem->failed = false;
        problem->in_vertex = code == SHADER_REJECTED_VERTEX;
        snprintf(problem->text, sizeof problem->text, "%s", text.bytes);
    } else if (code != SHADER_GOOD) {
        describe_failure(tester, status, problem);
    }
    return code == SHADER_GOOD;
}

PetriPainter *painter_open_tested(ShaderTester *tester) {
    PetriPainter *painter = petri_painter_open();
    petri_painter_test_shaders(painter, test_shader, tester);
    return painter;
}

bool shader_test_interrupted(void) {
    return interrupted;
}

static void set_limits(void) {
    struct rlimit seconds = {MAX_SECONDS, MAX_SECONDS + 1},
                  bytes = {(rlim_t)MAX_GIBIBYTES << 30, (rlim_t)MAX_GIBIBYTES << 30};
    struct rlimit none = {0, 0};
    setrlimit(RLIMIT_CPU, &seconds);
    setrlimit(RLIMIT_CORE, &none);
#if !ARENA_POISONS // the address sanitizer reserves terabytes
    setrlimit(RLIMIT_AS, &bytes);
#else
    (void)bytes;
#endif
    alarm(MAX_WAIT_SECONDS);         // ends a driver that waits forever
    os_signal_after_parent(SIGKILL); // ends this process with the one that waits for it
    static const int ending[] = {SIGINT, SIGTERM, SIGHUP, SIGALRM, SIGXCPU}; // may have been ignored before exec
    for (size_t i = 0; i < sizeof ending / sizeof *ending; i++)
        signal(ending[i], SIG_DFL);
}

// Tests the shader on standard input within limits. Does not return if it can be read.
static int shader_test_run(const CommandContext *context, struct Options *options) {
    (void)context;
    (void)options;
    set_limits();
    SCOPED_TEXT input = {0};
    if (!text_read(&input, STDIN_FILENO, MAX_SOURCE) || input.len > MAX_SOURCE)
        return STATUS_FAILED;
    size_t length = strlen(input.bytes);
    if (length + 1 >= input.len)
        return STATUS_FAILED;
    PetriShaderProblem problem = {0};
    int status = SHADER_GOOD;
    if (!petri_shader_try(input.bytes, input.bytes + length + 1, &problem, sizeof problem))
        status = problem.failed ? STATUS_FAILED : problem.in_vertex ? SHADER_REJECTED_VERTEX : SHADER_REJECTED;
    fputs(problem.text, stdout);
    fflush(stdout);
    _exit(status); // without the exit handlers of the driver, which may crash
}

const Command SHADER_TEST_COMMAND = {.name = "--test-shader", .parses_arguments = true, .run = shader_test_run};
