// recall.c: earlier values (`_`, `_1` ...) and inputs (.history).
#include "prompt/prompt.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_VALUES = 100, MAX_INPUTS = 1000, DEFAULT_INPUTS = 20 };
static const size_t MAX_VALUE_BYTES = (size_t)1 << 16; // longer values are not kept

static void drop_first(TextList *list) {
    free(list->items[0]);
    list->count--;
    memmove(list->items, list->items + 1, list->count * sizeof *list->items);
}

void recall_add_input(Prompt *prompt, const char *text) {
    SCOPED_STRING line = argument_trimmed(text);
    if (prompt->inputs.count == MAX_INPUTS) {
        drop_first(&prompt->inputs);
        prompt->inputs_dropped = true;
    }
    texts_add(&prompt->inputs, line);
}

void recall_add_value(Prompt *prompt, const Text *output) {
    size_t end = output->len, start;
    while (end > 0 && output->bytes[end - 1] == '\n')
        end--;
    for (start = end; start > 0 && output->bytes[start - 1] != '\n';)
        start--;
    if (end - start > MAX_VALUE_BYTES || end == start || output->bytes[start] == '!')
        return; // nodes are not kept, because their printed form is not an expression
    SCOPED_STRING value = memory_strndup(output->bytes + start, end - start);
    if (prompt->values.count == MAX_VALUES)
        drop_first(&prompt->values);
    texts_add(&prompt->values, value);
}

// A text whose tokens are copied to `out`, with values instead of `_` and `_N`.
typedef struct Replacement {
    Prompt *prompt;
    const char *text;
    Text *out;
    size_t copied; // bytes of the text that were copied
    bool good;
} Replacement;

static bool is_bound(Prompt *prompt, Str word) {
    const char *name;
    for (size_t i = 0; (name = petri_visible_name(prompt->session, i)); i++)
        if (str_equal(str_from(name), word))
            return true;
    return false;
}

static void replace_token(void *user_data, const PetriToken *token) {
    Replacement *replacement = user_data;
    Prompt *prompt = replacement->prompt;
    Str word = {replacement->text + token->start, token->end - token->start};
    char *end = NULL;
    if (token->kind != PETRI_TOKEN_NAME || word.bytes[0] != '_' ||
        (word.len > 1 && !(word.bytes[1] >= '0' && word.bytes[1] <= '9')))
        return;
    unsigned long long ago = word.len == 1 ? 0 : strtoull(word.bytes + 1, &end, 10);
    if ((end && end != word.bytes + word.len) || is_bound(prompt, word) || !replacement->good)
        return;
    if (ago >= prompt->values.count) {
        replacement->good = prompt_fail(prompt, "'%.*s' has no value: there are %zu earlier values", (int)word.len,
                                        word.bytes, prompt->values.count);
        return;
    }
    text_add(replacement->out, (Str){replacement->text + replacement->copied, token->start - replacement->copied});
    text_add_format(replacement->out, "(%s)", prompt->values.items[prompt->values.count - 1 - ago]);
    replacement->copied = token->end;
}

bool recall_expand(Prompt *prompt, const char *text, size_t length, Text *out) {
    Replacement replacement = {.prompt = prompt, .text = text, .out = out, .good = true};
    if (strchr(text, '_'))
        petri_tokenise(prompt->session, text, length, replace_token, &replacement);
    if (replacement.good)
        text_add(out, (Str){text + replacement.copied, length - replacement.copied});
    return replacement.good;
}

static bool run_history(Prompt *prompt, const char *rest) {
    int64_t count = DEFAULT_INPUTS;
    if (!argument_count(prompt, rest, 1, &count))
        return false;
    size_t total = prompt->inputs.count - 1; // without this command
    for (size_t i = total > (size_t)count ? total - (size_t)count : 0; i < total; i++)
        output_format(prompt->output, "%s\n", prompt->inputs.items[i]);
    return true;
}

const PromptCommand RECALL_COMMANDS[] = {
    {".history", "[N]", NULL, "print the last N inputs (default: 20)", run_history, COMPLETE_LANGUAGE},
    {0},
};
