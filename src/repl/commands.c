// commands.c: the commands of the prompt: their table and those that are short.
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/script.h"
#include "repl/repl.h"
#include "repl/words.h"

static bool run_step(Repl *repl, const char *rest) {
    int64_t count = 1;
    return word_count(repl, rest, 1, &count) && repl_walk(repl, &(Walk){.count = count});
}

static bool run_run(Repl *repl, const char *rest) {
    double seconds = 0;
    if (rest[0] == '\0') {
        return repl_walk(repl, &(Walk){.count = repl->limit, .limited = true});
    }
    if (!word_number(repl, rest, &seconds)) {
        return false;
    }
    if (seconds < 0) {
        return repl_fail(repl, "'%s' is no time: seconds, or a time code such as 1:30", rest);
    }
    double frames = ceil(seconds * petri_frame(repl->session).fps - 1e-9);
    bool limited = frames > (double)repl->limit;
    return repl_walk(repl, &(Walk){.count = limited ? repl->limit : (int64_t)frames, .limited = limited});
}

static bool run_until(Repl *repl, const char *rest) {
    char *expression = memory_copied(rest, strlen(rest));
    int64_t limit = repl->limit;
    bool good = word_limit(repl, expression, &limit);
    if (good && expression[0] == '\0') {
        good = repl_fail(repl, ".until needs an expression");
    }
    PetriResult result; // of the present frame: whether it is an expression at all
    good = good && repl_status(repl, petri_evaluate(repl->session, expression, PETRI_Z, &result, NULL, NULL));
    good = good && repl_walk(repl, &(Walk){.count = limit, .until = expression});
    free(expression);
    return good;
}

// Adds what the first frame of the history is.
static void add_start(const Repl *repl, Bytes *text) {
    const char *why = repl->history.why;
    if (why == NULL) {
        bytes_format(text, "this is the start");
    } else {
        bytes_format(text, "the history begins here (%s)", why);
    }
}

static bool run_back(Repl *repl, const char *rest) {
    int64_t count = 1, ago = petri_frame(repl->session).number - repl->history.first;
    if (!word_count(repl, rest, 1, &count)) {
        return false;
    }
    if (count <= ago) {
        return repl_goto(repl, petri_frame(repl->session).number - count);
    }
    Bytes start = {0};
    add_start(repl, &start);
    if (ago > 0) {
        repl_say(repl, "there are only %" PRId64 " frames to go back: %s", ago, start.data);
    } else {
        repl_fail(repl, "there is nothing to go back to: %s", start.data);
    }
    bytes_free(&start);
    return ago > 0 && repl_goto(repl, repl->history.first);
}

static bool run_go(Repl *repl, const char *rest) {
    int64_t frame = -1;
    if (rest[0] == '\0') {
        return repl_fail(repl, ".goto needs the number of a frame");
    }
    return word_count(repl, rest, -1, &frame) && repl_goto(repl, frame);
}

static bool run_reset(Repl *repl, const char *rest) {
    (void)rest;
    PetriStatus status = history_reset(&repl->history, repl->session);
    if (status == PETRI_OK && petri_frame(repl->session).number < repl->history.first &&
        !history_start(&repl->history, repl->session, NULL)) {
        status = PETRI_MEMORY;
    }
    if (!repl_status(repl, status)) {
        return false;
    }
    repl_show_frame(repl);
    return true;
}

static bool run_state(Repl *repl, const char *rest) {
    return repl_show_state(repl, rest);
}

static bool run_tree(Repl *repl, const char *rest) {
    return repl_show_tree(repl, rest);
}

static bool run_particles(Repl *repl, const char *rest) {
    return repl_show_particles(repl, rest);
}

static bool run_energy(Repl *repl, const char *rest) {
    return repl_show_energy(repl, rest);
}

static bool run_watch(Repl *repl, const char *rest) {
    PetriResult result;
    for (size_t i = 0; i < repl->watched_count && rest[0] == '\0'; i++) {
        repl_say(repl, "%s", repl->watched[i]);
    }
    if (rest[0] == '\0') {
        return true;
    }
    Bytes value = {0};
    if (petri_evaluate(repl->session, rest, PETRI_Z, &result, repl_collect, &value) != PETRI_OK) {
        bytes_free(&value);
        repl->failed = true;
        return false;
    }
    output_format(&repl->output, "%s = %s\n", rest, value.data);
    bytes_free(&value);
    for (size_t i = 0; i < repl->watched_count; i++) {
        if (strcmp(rest, repl->watched[i]) == 0) {
            return true; // once is enough
        }
    }
    repl->watched = memory_resized(repl->watched, (repl->watched_count + 1) * sizeof *repl->watched);
    repl->watched[repl->watched_count++] = memory_copied(rest, strlen(rest));
    return true;
}

static bool run_unwatch(Repl *repl, const char *rest) {
    size_t kept = 0, count = repl->watched_count;
    for (size_t i = 0; i < count; i++) {
        if (rest[0] == '\0' || strcmp(rest, repl->watched[i]) == 0) {
            free(repl->watched[i]);
        } else {
            repl->watched[kept++] = repl->watched[i];
        }
    }
    repl->watched_count = kept;
    return rest[0] == '\0' || kept < count || repl_fail(repl, "'%s' is not watched", rest);
}

static bool run_plot(Repl *repl, const char *rest) {
    return repl_plot(repl, rest);
}

static bool run_show(Repl *repl, const char *rest) {
    (void)rest;
    return repl_show_picture(repl);
}

static bool run_set(Repl *repl, const char *rest) {
    return repl_set(repl, rest);
}

static bool run_parameters(Repl *repl, const char *rest) {
    (void)rest;
    return repl_show_parameters(repl);
}

static void show_number(Repl *repl, const char *name, double value) {
    output_format(&repl->output, "%s = %.12g\n", name, value);
}

static bool read_rate(Repl *repl, const char *rest, double *value) {
    return word_number(repl, rest, value) && (*value > 0 || repl_fail(repl, "'%s' is no number above 0", rest));
}

static bool run_tempo(Repl *repl, const char *rest) {
    double tempo = 0;
    if (rest[0] != '\0' && !(read_rate(repl, rest, &tempo) && petri_set_tempo(repl->session, tempo) == PETRI_OK)) {
        return false;
    }
    repl->rates_changed = repl->rates_changed || rest[0] != '\0';
    show_number(repl, "tempo", petri_frame(repl->session).tempo);
    return true;
}

static bool run_fps(Repl *repl, const char *rest) {
    double fps = 0;
    if (rest[0] != '\0' && !(read_rate(repl, rest, &fps) && petri_set_fps(repl->session, fps) == PETRI_OK)) {
        return false;
    }
    repl->rates_changed = repl->rates_changed || rest[0] != '\0';
    show_number(repl, "fps", petri_frame(repl->session).fps);
    return true;
}

static bool run_resolution(Repl *repl, const char *rest) {
    double step = 0;
    bool off = strcmp(rest, "off") == 0;
    if (rest[0] != '\0' && !off && !read_rate(repl, rest, &step)) {
        return false;
    }
    if (rest[0] != '\0') {
        petri_set_resolution(repl->session, step);
    }
    step = petri_resolution(repl->session);
    if (step > 0) {
        show_number(repl, "resolution", step);
    } else {
        repl_say(repl, "each system's own resolution counts");
    }
    return true;
}

static bool run_drop(Repl *repl, const char *rest) {
    if (rest[0] != '\0' && strcmp(rest, "all") != 0) {
        return repl_fail(repl, ".drop takes out nodes, .drop all also names; not '%s'", rest);
    }
    uint32_t count = petri_drop(repl->session, rest[0] != '\0');
    repl_say(repl, "%" PRIu32 " statement%s dropped", count, count == 1 ? "" : "s");
    return true;
}

static bool run_load(Repl *repl, const char *rest) {
    if (rest[0] == '\0') {
        return repl_fail(repl, ".load needs a file");
    }
    if (script_is_stdin(rest)) {
        return repl_fail(repl, "the prompt reads what is typed from standard input: the script must be a file");
    }
    if (!repl_load(repl, rest)) {
        return false;
    }
    petri_clear(repl->session);
    return history_start(&repl->history, repl->session, NULL) || repl_status(repl, PETRI_MEMORY);
}

static bool run_reload(Repl *repl, const char *rest) {
    (void)rest;
    return repl_reload(repl);
}

static bool run_save(Repl *repl, const char *rest) {
    if (rest[0] == '\0') {
        return repl_fail(repl, ".save needs a file");
    }
    if (petri_save(repl->session, rest) != PETRI_OK) {
        repl->failed = true;
        return false;
    }
    repl_say(repl, "the state after frame %" PRId64 " is in %s", petri_frame(repl->session).number, rest);
    return true;
}

static bool run_restore(Repl *repl, const char *rest) {
    if (rest[0] == '\0') {
        return repl_fail(repl, ".restore needs a file");
    }
    if (access(rest, R_OK) != 0) {
        return repl_fail(repl, "cannot read '%s': %s", rest, strerror(errno));
    }
    if (petri_restore(repl->session, rest) != PETRI_OK) {
        repl->failed = true;
        return false;
    }
    repl_say(repl, "the next frame is the one after %" PRId64, petri_frame(repl->session).number);
    return history_start(&repl->history, repl->session, "a state was restored there") ||
           repl_status(repl, PETRI_MEMORY);
}

static bool run_record(Repl *repl, const char *rest) {
    return repl_record(repl, rest);
}

static bool run_time(Repl *repl, const char *rest) {
    return repl_time(repl, rest);
}

static bool run_help(Repl *repl, const char *rest) {
    return repl_help(repl, rest);
}

static bool run_quit(Repl *repl, const char *rest) {
    (void)rest;
    repl->quit = true;
    return true;
}

const ReplCommand REPL_COMMANDS[] = {
#define REPL_ROW(function, name, operands, help) {name, operands, help, run_##function},
#include "repl/command_list.h"
#undef REPL_ROW
    {0},
};

static void unknown(Repl *repl, const char *name) {
    const char *nearest = NULL;
    size_t best = SIZE_MAX;
    for (const ReplCommand *command = REPL_COMMANDS; command->name != NULL; command++) {
        nearest = is_nearer(name, command->name, &best) ? command->name : nearest;
    }
    if (nearest != NULL) {
        repl_fail(repl, "there is no command '%.40s', did you mean '%s'?", name, nearest);
    } else {
        repl_fail(repl, "there is no command '%.40s'; .help lists the commands", name);
    }
}

void repl_command(Repl *repl, const char *line) {
    size_t length = strcspn(line, " \t\n");
    char *name = memory_copied(line, length);
    char *rest = word_trimmed(line + length);
    const char *alias = bare_alias(name + 1, length - 1); // .exit, .q
    const ReplCommand *command = REPL_COMMANDS;
    while (command->name != NULL && strcmp(command->name, alias != NULL ? alias : name) != 0) {
        command++;
    }
    if (command->name == NULL) {
        unknown(repl, name);
    } else if (command->operands[0] == '\0' && rest[0] != '\0') {
        repl_fail(repl, "%s takes nothing, not '%.40s'", name, rest);
    } else if (!command->run(repl, rest)) {
        repl->failed = true;
    }
    free(name);
    free(rest);
}
