// breaks.c: conditions that end stepping commands, forward and backward: `.until` and `.break`.
#include "prompt/prompt.h"

#include <string.h>

PetriStatus breaks_remember_all(Prompt *prompt, Expressions *list) {
    PetriStatus status = PETRI_OK;
    for (size_t i = 0; i < list->count && status == PETRI_OK; i++)
        status = expression_remember(prompt, &list->items[i]);
    return status;
}

PetriStatus breaks_remember(Prompt *prompt, Expression *until) {
    PetriStatus status = breaks_remember_all(prompt, &prompt->watched);
    if (status == PETRI_OK)
        status = breaks_remember_all(prompt, &prompt->breaks);
    return status == PETRI_OK && until ? expression_remember(prompt, until) : status;
}

PetriStatus breaks_test(Prompt *prompt, const Expression *until, StepOutcome *outcome, size_t *number) {
    PetriEvaluation result = {0};
    PetriStatus status = until ? expression_evaluate(prompt, until, &result, NULL) : PETRI_OK;
    *outcome = result.is_true ? STEP_REACHED : STEP_RUNNING;
    for (size_t i = 0; i < prompt->breaks.count && status == PETRI_OK && *outcome == STEP_RUNNING; i++) {
        status = expression_evaluate(prompt, &prompt->breaks.items[i], &result, NULL);
        if (status == PETRI_OK && result.is_true) {
            *outcome = STEP_STOPPED;
            *number = i;
        }
    }
    return status;
}

void breaks_note(Prompt *prompt, size_t number) {
    prompt_note(prompt, "stopped by .break %s", prompt->breaks.items[number].typed);
}

// Computes frames `start` to `end` again, and notes the last of them in which the search ends.
static PetriStatus search_part(Prompt *prompt, BreakSearch *search, int64_t start, int64_t end) {
    PetriStatus status = prompt_go_to(prompt, start > search->first ? start - 1 : start);
    for (int64_t frame = start; frame <= end && status == PETRI_OK; frame++) {
        StepOutcome outcome = STEP_RUNNING;
        size_t number = 0;
        if (frame > search->first)
            status = breaks_remember(prompt, search->until);
        if (status == PETRI_OK && frame > search->first)
            status = prompt_go_to(prompt, frame);
        if (status == PETRI_OK)
            status = breaks_test(prompt, search->until, &outcome, &number);
        if (status == PETRI_OK && outcome != STEP_RUNNING) {
            search->found = frame;
            search->outcome = outcome;
            search->number = number;
        }
        if (prompt->host->interrupted(prompt))
            status = PETRI_INTERRUPTED;
    }
    return status;
}

PetriStatus breaks_search(Prompt *prompt, BreakSearch *search, int64_t min) {
    enum { MIN_PART = 64 };
    PetriHistoryInfo history = prompt_timeline(prompt);
    int64_t part = (history.last - history.first) / (int64_t)(history.keyframes + 1) + MIN_PART;
    PetriStatus status = PETRI_OK;
    search->first = history.first;
    search->found = INT64_MIN;
    for (int64_t end = petri_frame_number(prompt->session) - 1;
         end >= min && search->found == INT64_MIN && status == PETRI_OK; end -= part)
        status = search_part(prompt, search, end - part + 1 < min ? min : end - part + 1, end);
    return status;
}

static bool run_break(Prompt *prompt, const char *rest) {
    Expression expression;
    for (size_t i = 0; i < prompt->breaks.count && rest[0] == '\0'; i++)
        prompt_note(prompt, "%s", prompt->breaks.items[i].typed);
    if (rest[0] == '\0' && prompt->breaks.count == 0)
        prompt_note(prompt, "no breaks; .break EXPR adds one");
    if (rest[0] == '\0' || expressions_find(&prompt->breaks, rest) < prompt->breaks.count)
        return true;
    if (!expression_parse(prompt, rest, &expression))
        return false;
    expressions_add(&prompt->breaks, &expression);
    return true;
}

static bool run_unbreak(Prompt *prompt, const char *rest) {
    return expressions_remove(&prompt->breaks, rest) || prompt_fail(prompt, "no such break: '%.40s'", rest);
}

const PromptCommand BREAK_COMMANDS[] = {
    {".break", "[EXPR]", NULL, "end these commands in frames in which EXPR is true; without EXPR, list the breaks",
     run_break, COMPLETE_LANGUAGE},
    {".unbreak", "[EXPR]", NULL, "remove the break EXPR, or all breaks", run_unbreak, COMPLETE_BREAKS},
    {0},
};
