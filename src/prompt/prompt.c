// prompt.c: executes inputs of the prompt; see prompt.h.
#include "prompt/prompt.h"

#include <stdlib.h>
#include <string.h>

// Writes to the output and keeps what is written; a PetriWriteCallback.
typedef struct Printed {
    Output *output;
    Text text;
} Printed;

static bool print_and_keep(void *user_data, const char *text, size_t length) {
    Printed *printed = user_data;
    text_add(&printed->text, (Str){text, length});
    return output_write(printed->output, text, length);
}

static void execute_statement(Prompt *prompt, const char *text, size_t length) {
    PetriPromptResult done;
    SCOPED_TEXT recalled = {0};
    SCOPED_TEXT expanded = {0};
    Printed printed = {.output = prompt->output};
    if (!recall_expand(prompt, text, length, &recalled) || !expression_expand(prompt, recalled.bytes, &expanded))
        return;
    if (expanded.len == 0)
        text_add(&expanded, text_str(&recalled));
    prompt_busy(prompt);
    PetriStatus status =
        petri_prompt(prompt->session, expanded.bytes, expanded.len, print_and_keep, &printed, &done, sizeof done);
    prompt_idle(prompt);
    if (status == PETRI_OK && done.values > 0)
        recall_add_value(prompt, &printed.text);
    text_free(&printed.text);
    if (done.shadowed) {
        SCOPED_STRING name = memory_strdup(done.shadowed);
        prompt_warn_shadowed(prompt, name);
    }
    if (done.nodes > 0)
        prompt_note(prompt, "nodes are added to the scene at the next step; .drop removes them");
    prompt_status(prompt, status);
}

// If the text begins with a dot and is not a number such as .5, executes it as a command. Otherwise tries to execute it
// as a command without its dot (bare_execute), and then as code.
static void execute_text(Prompt *prompt, const char *text, size_t length) {
    SCOPED_TEXT remark = {0};
    size_t start = strspn(text, " \t");
    if (text[start] == '.' && (text[start + 1] < '0' || text[start + 1] > '9') && text[start + 1] != '.')
        prompt_command(prompt, text + start);
    else if (!bare_execute(prompt, text, &remark))
        execute_statement(prompt, text, length);
    if (remark.len > 0 && (prompt->failed || bare_alias(text + start, strcspn(text + start, " \t\n"))))
        prompt_note(prompt, "%s", remark.bytes);
}

bool prompt_execute(Prompt *prompt, const char *text, size_t length) {
    prompt->failed = false;
    if (text[strspn(text, " \t\n")] != '\0') {
        recall_add_input(prompt, text);
        execute_text(prompt, text, length);
    } else if (prompt->repeated) {
        recall_add_input(prompt, prompt->repeated);
        prompt_command(prompt, prompt->repeated);
    }
    output_flush(prompt->output);
    return !prompt->failed;
}

void prompt_end(Prompt *prompt) {
    expressions_free(&prompt->watched);
    expressions_free(&prompt->breaks);
    texts_free(&prompt->inputs);
    texts_free(&prompt->values);
    free(prompt->repeated);
    texts_free(&prompt->definitions);
}
