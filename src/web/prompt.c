// prompt.c: the prompt of the page, which is that of `petri repl` (prompt/prompt.h). JavaScript moves the session,
// because the page also records changes and renders the pictures of frames that later ones need.
#include "prompt/prompt.h"

#include "web/host.h"

#include <string.h>

enum { LINES = 200, LIMIT = 100000 }; // lines that are printed without a number; frames without --limit

typedef struct WebPrompt {
    Prompt prompt;
    Output output;
    double first; // first and last frame of the timeline
    double last;
} WebPrompt;

static PetriStatus step(Prompt *prompt) {
    (void)prompt;
    return host_prompt("step", 0, NULL, NULL);
}

static PetriStatus go_to(Prompt *prompt, int64_t frame) {
    const WebPrompt *web = prompt->user_data;
    return (double)frame < web->first ? PETRI_INVALID : host_prompt("goTo", (double)frame, NULL, NULL);
}

static void get_timeline(Prompt *prompt, PetriHistoryInfo *info) {
    const WebPrompt *web = prompt->user_data;
    info->first = (int64_t)web->first;
    info->last = (int64_t)web->last;
}

static PetriStatus set_parameter(Prompt *prompt, const char *name, const char *value) {
    (void)prompt;
    return host_prompt("set", 0, name, value);
}

static PetriStatus move(Prompt *prompt, size_t system, uint32_t particle, const double *position,
                        const double *velocity) {
    PetriSystem found;
    return petri_system(prompt->session, system, &found, sizeof found)
               ? host_move((uint32_t)system, particle, found.dimensions, position, velocity)
               : PETRI_INVALID;
}

static bool was_interrupted(Prompt *prompt) {
    (void)prompt;
    return host_should_interrupt();
}

static void complain(Prompt *prompt, const char *text) {
    output_format(prompt->output, "%s\n", text);
}

static size_t rows(Prompt *prompt) {
    (void)prompt;
    return LINES;
}

static bool run_run(Prompt *prompt, const char *rest) {
    return rest[0] != '\0' ? prompt_find_command(".run", 4)->run(prompt, rest)
                           : prompt_status(prompt, host_prompt("run", 0, NULL, NULL));
}

// Lets the page plot an expression over all frames.
static bool run_plot(Prompt *prompt, const char *rest) {
    SCOPED_STRING expression = memory_strdup(rest);
    int64_t count = 0; // unused: the page shows all frames
    PetriEvaluation result;
    argument_last_count(expression, &count);
    return prompt_status(prompt, petri_evaluate(prompt->session, expression, PETRI_NUL_TERMINATED, &result,
                                                sizeof result, NULL, NULL)) &&
           prompt_status(prompt, host_prompt("plot", 0, expression, NULL));
}

// Shows a rate. The page cannot set it, because its links do not record rates.
static bool show_rate(Prompt *prompt, const char *rest, const char *command) {
    return rest[0] == '\0' ? prompt_find_command(command, strlen(command))->run(prompt, rest)
                           : prompt_fail(prompt, "%s cannot set the %s in a page; write %%pragma %s(%s) in the script",
                                         command, command + 1, command + 1, rest);
}

static bool run_tempo(Prompt *prompt, const char *rest) {
    return show_rate(prompt, rest, ".tempo");
}

static bool run_fps(Prompt *prompt, const char *rest) {
    return show_rate(prompt, rest, ".fps");
}

#define ONLY "works only in 'petri repl'"

static const PromptHostCommand COMMANDS[] = {
    {".run", run_run, NULL},
    {".plot", run_plot, NULL},
    {".show", NULL, ONLY "; the page always shows the picture"},
    {".tempo", run_tempo, NULL},
    {".fps", run_fps, NULL},
    {".resolution", NULL, ONLY "; in the page, set the attribute resolution of !physics"},
    {".load", NULL, ONLY "; in the page, use Open"},
    {".reload", NULL, ONLY "; in the page, Run loads the script"},
    {".save", NULL, ONLY "; in the page, use Export or Copy link"},
    {".restore", NULL, ONLY "; the page opens links and archives"},
    {".quit", NULL, ONLY "; close the page instead"},
    {0},
};

static const PromptHost HOST = {
    .complain = complain,
    .interrupted = was_interrupted,
    .commands = COMMANDS,
    .rows = rows,
    .step = step,
    .go_to = go_to,
    .timeline = get_timeline,
    .set_parameter = set_parameter,
    .move = move,
};

static bool send_output(void *user_data, const char *text, size_t length) {
    (void)user_data;
    host_write(text, length);
    return true;
}

// Returns a prompt, which works with any session.
EXPORT(WebPrompt *, web_prompt_open, void) {
    WebPrompt *web = memory_calloc(sizeof *web);
    output_start(&web->output, -1);
    web->output.send = send_output;
    web->prompt = (Prompt){.host = &HOST, .user_data = web, .output = &web->output, .limit = LIMIT};
    return web;
}

// Executes an input and writes its output. `first` and `last` are the bounds of the timeline. Returns false if the
// input failed.
EXPORT(bool, web_prompt_execute, WebPrompt *web, PetriSession *session, double first, double last, const char *text,
       size_t length) {
    web->prompt.session = session;
    web->first = first;
    web->last = last;
    return prompt_execute(&web->prompt, text, length);
}
