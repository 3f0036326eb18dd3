// printed.c: sides that are read as text: goldens, and the output of another program.
#include "cli/subprocess.h"
#include "diff/diff.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// Reads a line without its newline. Returns false at the end of the stream.
static bool read_line(FILE *stream, Text *line) {
    int c;
    line->len = 0;
    while ((c = getc(stream)) != EOF && c != '\n')
        text_add_char(line, (char)c);
    text_add_c(line, "");
    return c != EOF || line->len > 0;
}

static void read_header(Side *side) {
    const char *time = strstr(side->current.bytes, " time=");
    side->frame = strtoll(side->current.bytes + 1, NULL, 10);
    side->time = time ? strtod(time + 6, NULL) : NAN;
}

static bool read_frame(Side *side) {
    side->current.len = 0;
    if (side->ahead.len == 0)
        return false;
    do {
        text_add(&side->current, text_str(&side->ahead));
        text_add_c(&side->current, "\n");
        if (!read_line(side->stream, &side->ahead)) {
            side->ahead.len = 0;
            break;
        }
    } while (side->ahead.bytes[0] != '@');
    read_header(side);
    return true;
}

// Skips lines before the first frame.
static void skip_head(Side *side) {
    bool more;
    do
        more = read_line(side->stream, &side->ahead);
    while (more && side->ahead.bytes[0] != '@');
    if (!more)
        side->ahead.len = 0;
}

static void print_current(Side *side, Text *text) {
    text_add(text, text_str(&side->current));
}

static void close_stream(Side *side) {
    if (side->stream)
        fclose(side->stream);
    if (side->process > 0) {
        kill(side->process, SIGTERM);
        subprocess_wait_for(side->process);
    }
}

// --- goldens

static const SideKind GOLDEN_SIDE = {.next = read_frame, .print = print_current, .close = close_stream};

bool printed_open_golden(Side *side) {
    side->kind = &GOLDEN_SIDE;
    side->stream = fopen(side->source, "r");
    if (!side->stream) {
        message("cannot read %s: %s", side->source, strerror(errno));
        return false;
    }
    skip_head(side);
    return true;
}

// --- the output of another program

static bool next_printed(Side *side) {
    if (read_frame(side))
        return true;
    int status = side->process > 0 ? subprocess_wait_for(side->process) : 0;
    side->process = 0;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        message("%s failed; the messages above give the reason", side->with);
        side->failed = true;
    }
    return false;
}

static const SideKind PROCESS_SIDE = {.next = next_printed, .print = print_current, .close = close_stream};

static void add_options(TextList *words, const Side *side) {
    static const char *const when[] = {"auto", "never", "always"};
    const Options *options = side->options;
    texts_add_format(words, "--frames=%" PRId64, side->frames);
    for (size_t i = 0; i < options->definitions.count; i++)
        texts_add_format(words, "--define=%s", options->definitions.items[i]);
    for (size_t i = 0; i < options->read_folders.count; i++)
        texts_add_format(words, "--allow-read=%s", options->read_folders.items[i]);
    if (options->fps_given)
        texts_add_format(words, "--fps=%.17g", options->fps);
    if (options->threads > 0)
        texts_add_format(words, "--threads=%" PRId64, options->threads);
    if (options->memory > 0)
        texts_add_format(words, "--memory=%" PRIu64, options->memory);
    if (options->work > 0)
        texts_add_format(words, "--work=%" PRIu64, options->work);
    if (options->neighbours > 0)
        texts_add_format(words, "--neighbours=%s", when[options->neighbours]);
    if (options->unsimplified)
        texts_add(words, "--nosimplify");
    if (options->no_batches)
        texts_add(words, "--no-batches");
    if (options->no_files)
        texts_add(words, "--no-files");
}

bool printed_open_process(Side *side) {
    TextList words = {0};
    int ends[2] = {-1, -1};
    side->kind = &PROCESS_SIDE;
    texts_add(&words, side->with);
    texts_add(&words, "run");
    texts_add(&words, "--print=state");
    add_options(&words, side);
    texts_add(&words, "--");
    texts_add(&words, side->source);
    if (pipe(ends) == 0) {
        fcntl(ends[0], F_SETFD, FD_CLOEXEC);
        fcntl(ends[1], F_SETFD, FD_CLOEXEC);
        const int files[] = {-1, ends[1], STDERR_FILENO};
        side->process = subprocess_spawn(side->with, (const char *const *)words.items, files, 3, false);
        int error = errno;
        close(ends[1]);
        side->stream = fdopen(ends[0], "r");
        errno = error;
    }
    texts_free(&words);
    if (side->process <= 0 || !side->stream) {
        message("cannot start %s: %s", side->with, strerror(errno));
        side->process = 0;
        return false;
    }
    skip_head(side);
    return true;
}
