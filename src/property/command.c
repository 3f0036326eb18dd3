// command.c: the command `petri --check-properties FILE JOBS [PART | SHOWN]`, which petri test executes; see
// property.h.
//
// PART is a number: the process tries a part of the cases. SHOWN is the path of the script in the commands of the
// report. Exits with 0 if all properties hold. Otherwise prints a line `LINE REASON` and details, and exits with 1;
// after an error, with 2.
#include "base/clock.h"
#include "cli/output.h"
#include "cli/script.h"
#include "property/property.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { HOLDS = 0, VIOLATED = 1, TROUBLE = 2 };

// Time to simplify each violated case, and then the script, relative to the time for the search.
static const double SHRINK_TIME = 0.6, SCRIPT_TIME = 0.3;

// Evaluates all expressions once, to find mistakes in them. Returns false after a message.
static bool check_expressions(const Properties *properties) {
    Attempt attempt = {.properties = properties, .deadline = INFINITY};
    PetriSession *session = attempt_open(&attempt, NULL);
    bool good = session && petri_step(session) == PETRI_OK && petri_step(session) == PETRI_OK;
    if (!good)
        message("%s: error: the script cannot be run: %s", properties->script,
                attempt.first_problem.bytes ? attempt.first_problem.bytes : "");
    for (size_t i = 0; good && i < properties->count; i++) {
        const Property *property = &properties->items[i];
        SCOPED_TEXT code = {0};
        PetriEvaluation result;
        if (!property->expression)
            continue;
        attempt.first_problem.len = 0;
        text_add_format(&code, "(%s)", property->expression);
        uint64_t before = attempt.problems;
        PetriStatus status = petri_evaluate(session, code.bytes, code.len, &result, sizeof result, NULL, NULL);
        good = status == PETRI_OK && attempt.problems == before;
        if (!good)
            message("%s:%" PRIu32 ": error: %s", properties->file, property->line,
                    attempt.first_problem.len > 0 ? attempt.first_problem.bytes : petri_status_text(status));
    }
    petri_close(&session);
    attempt_free(&attempt);
    return good;
}

// Adds the command that goes to the frame of a violation.
static void add_command(const Properties *properties, const Found *found, const char *shown, Text *out) {
    const Violation *violation = &found->violation;
    text_add_c(out, "petri repl ");
    shell_add_word(out, shown);
    for (size_t i = 0; i < properties->range_count; i++) {
        SCOPED_TEXT definition = {0};
        if (found->values[i] == properties->ranges[i].usual)
            continue;
        text_add_format(&definition, "%s=%.17g", properties->ranges[i].name, found->values[i]);
        text_add_c(out, " -D ");
        shell_add_word(out, definition.bytes);
    }
    text_add_format(out, " --execute '.step %" PRId64 "'", violation->frame + 1);
    if (violation->particle.len > 0) {
        SCOPED_TEXT why = {0};
        text_add_format(&why, ".why %s all", violation->particle.bytes);
        text_add_c(out, " --execute ");
        shell_add_word(out, why.bytes);
    }
    text_add_c(out, "\n");
}

static void add_report(const Properties *properties, size_t index, const Found *found, const char *shown, Text *out) {
    const Violation *violation = &found->violation;
    SCOPED_TEXT values = {0};
    case_add_text(properties, found->values, true, &values);
    text_add_format(out, "%s\n", properties->items[index].text);
    text_add_format(out, "violated in frame %" PRId64 " with %s%s%s", violation->frame,
                    values.len > 0 ? values.bytes : "the defaults", violation->what.len > 0 ? ": " : "",
                    violation->what.len > 0 ? violation->what.bytes : "");
    text_add_format(out, violation->particle.len > 0 ? " (particle %s)\n" : "%s\n",
                    violation->particle.len > 0 ? violation->particle.bytes : "");
    text_add_format(out, "case %" PRId64 ", simplified by %zu runs\n", found->number + 1, found->tries);
    if (found->lines.len > 0)
        text_add_format(out, "it needs only these lines of the script: %s\n", found->lines.bytes);
    add_command(properties, found, shown, out);
}

// Simplifies and reports the violated cases. Returns the number of violated properties.
static size_t report_all(Properties *properties, Found *found, const char *shown, Text *out) {
    size_t count = 0;
    for (size_t i = 0; i < properties->count; i++) {
        SCOPED_TEXT kept = {0};
        if (!found[i].values || !violation_refresh(properties, i, INFINITY, &found[i]))
            continue;
        shrink_case(properties, i, SHRINK_TIME * properties->seconds, &found[i]);
        case_add_text(properties, found[i].values, false, &kept);
        kept_add(properties, kept.len > 0 ? kept.bytes : "");
        smaller_script(properties, i, SCRIPT_TIME * properties->seconds, &found[i]);
        violation_refresh(properties, i, INFINITY, &found[i]); // with the whole script again
        if (count == 0)
            text_add_format(out, "%" PRIu32 " %s: violated\n", properties->items[i].line, properties->items[i].text);
        add_report(properties, i, &found[i], shown, out);
        count++;
    }
    return count;
}

static int check(Properties *properties, int64_t jobs, const char *shown) {
    SCOPED_TEXT out = {0};
    Found *found = memory_calloc((properties->count + 1) * sizeof *found);
    int64_t tried = 0;
    int status = TROUBLE;
    if (check_expressions(properties) && search_all(properties, jobs, found, &tried)) {
        size_t count = report_all(properties, found, shown, &out);
        text_add_format(&out, "%" PRId64 " cases of %" PRId64 " frames, %zu of %zu properties violated\n", tried,
                        properties->frames, count, properties->count);
        if (count == 0 && tried == 0)
            message("%s:1: error: no case ended within %g s; add a line such as 'seconds %g'", properties->file,
                    properties->seconds, 10 * properties->seconds);
        else
            status = output_text(out.bytes, out.len, count > 0 ? VIOLATED : HOLDS);
    }
    for (size_t i = 0; i < properties->count; i++) {
        free(found[i].values);
        violation_free(&found[i].violation);
        text_free(&found[i].lines);
    }
    free(found);
    return status;
}

static int check_run(const CommandContext *host, Options *options) {
    Properties properties = {0};
    int64_t jobs = options->argc > 2 ? strtoll(options->argv[1], NULL, 10) : 0;
    if (jobs < 1) {
        message("expected a file and the number of processes");
        return TROUBLE;
    }
    const char *last = options->argv[2];
    bool part = last[0] != '\0' && last[strspn(last, "0123456789")] == '\0';
    int status = TROUBLE;
    if (properties_read(&properties, host, options->argv[0]))
        status = part ? search_part(&properties, jobs, strtoll(last, NULL, 10)) : check(&properties, jobs, last);
    properties_free(&properties);
    return status;
}

const Command CHECK_PROPERTIES_COMMAND = {.name = "--check-properties", .parses_arguments = true, .run = check_run};
