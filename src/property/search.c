// search.c: tries all cases, in several processes; see property.h.
#include "base/clock.h"
#include "cli/output.h"
#include "cli/subprocess.h"
#include "property/property.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

// Sets the values of a case: kept cases are first, then sampled ones.
static bool case_values(const Properties *properties, int64_t number, double *values) {
    if ((size_t)number < properties->kept.count)
        return case_read_text(properties, properties->kept.items[number], values);
    case_sample(properties, number - (int64_t)properties->kept.count, values);
    return true;
}

// --- in one of the processes

// Runs one case and adds the properties that it violates first. Returns false if there was not enough time.
static bool try_case(const Properties *properties, int64_t number, double deadline, bool *found, Text *out) {
    double *values = memory_calloc((properties->range_count + 1) * sizeof *values);
    Violation *violations = memory_calloc((properties->count + 1) * sizeof *violations);
    Attempt attempt = {
        .properties = properties, .values = values, .only = -1, .deadline = deadline, .violations = violations};
    for (size_t i = 0; i < properties->count; i++)
        violations[i].found = found[i]; // not checked again
    if (case_values(properties, number, values) && !attempt_run(&attempt) && !attempt.expired)
        text_add_format(out, "error %" PRId64 " %s\n", number,
                        attempt.first_problem.bytes ? attempt.first_problem.bytes : "");
    for (size_t i = 0; i < properties->count; i++) {
        if (violations[i].found && !found[i])
            text_add_format(out, "found %" PRId64 " %zu\n", number, i);
        found[i] = violations[i].found;
        violation_free(&violations[i]);
    }
    attempt_free(&attempt);
    free(violations);
    free(values);
    return !attempt.expired;
}

int search_part(const Properties *properties, int64_t jobs, int64_t part) {
    SCOPED_TEXT out = {0};
    bool *found = memory_calloc((properties->count + 1) * sizeof *found);
    double deadline = clock_seconds() + properties->seconds;
    int64_t total = properties->cases + (int64_t)properties->kept.count, tried = 0;
    for (int64_t number = part; number < total && clock_seconds() < deadline; number += jobs)
        tried += try_case(properties, number, deadline, found, &out) ? 1 : 0;
    text_add_format(&out, "tried %" PRId64 "\n", tried);
    free(found);
    return output_text(out.bytes, out.len, STATUS_DONE);
}

// --- in the process that starts the others

// Reads a line of a part. Returns false after a message.
static bool read_line(const Properties *properties, const char *line, Found *found, int64_t *tried) {
    int64_t number = 0, count = 0;
    size_t index = 0;
    int length = 0;
    if (sscanf(line, "found %" SCNd64 " %zu", &number, &index) == 2 && index < properties->count) {
        Found *item = &found[index];
        if (item->values && item->number <= number)
            return true;
        item->number = number;
        if (!item->values)
            item->values = memory_calloc((properties->range_count + 1) * sizeof *item->values);
        case_values(properties, number, item->values);
    } else if (sscanf(line, "tried %" SCNd64, &count) == 1) {
        *tried += count;
    } else if (sscanf(line, "error %" SCNd64 " %n", &number, &length) == 1 && length > 0) {
        SCOPED_TEXT text = {0};
        double *values = memory_calloc((properties->range_count + 1) * sizeof *values);
        case_values(properties, number, values);
        case_add_text(properties, values, true, &text);
        free(values);
        message("%s: error: the script fails with %s: %s", properties->file, text.len > 0 ? text.bytes : "its defaults",
                line + length);
        return false;
    }
    return true;
}

static bool start_part(const Properties *properties, int64_t jobs, int64_t part, Subprocess *child) {
    TextList words = {0};
    texts_add(&words, "petri");
    texts_add(&words, "--check-properties");
    texts_add(&words, properties->file);
    texts_add_format(&words, "%" PRId64, jobs);
    texts_add_format(&words, "%" PRId64, part);
    bool started = subprocess_start(child, properties->host->program, ".", words.items, SUBPROCESS_MAX_SECONDS);
    if (!started)
        message("cannot start a process: %s", strerror(errno));
    texts_free(&words);
    return started;
}

static bool end_part(const Properties *properties, Subprocess *child, Found *found, int64_t *tried) {
    SCOPED_TEXT output = {0}, errors = {0}, problem = {0};
    int status = subprocess_wait_for(child->pid);
    subprocess_collect(child, &output, &errors);
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        subprocess_describe(status, &errors, &problem);
        message("%s: error: a run %s", properties->file, problem.bytes);
        return false;
    }
    size_t at = 0;
    bool good = true;
    for (Str line; good && text_next_line(&output, &at, &line);) {
        SCOPED_STRING copy = memory_strndup(line.bytes, line.len);
        good = read_line(properties, copy, found, tried);
    }
    return good;
}

bool search_all(const Properties *properties, int64_t jobs, Found *found, int64_t *tried) {
    Subprocess *children = memory_calloc((size_t)jobs * sizeof *children);
    int64_t started = 0;
    bool good = true;
    *tried = 0;
    while (started < jobs && start_part(properties, jobs, started, &children[started]))
        started++;
    for (int64_t i = 0; i < started; i++)
        good = end_part(properties, &children[i], found, tried) && good;
    free(children);
    return good && started == jobs;
}
