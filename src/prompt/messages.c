// messages.c: notes, messages and interruption; the timeline of the prompt.
#include "prompt/prompt.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void prompt_note(Prompt *prompt, const char *format, ...) {
    char line[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    output_format(prompt->output, prompt->colour ? "\033[2m-- %s\033[0m\n" : "-- %s\n", line);
}

bool prompt_fail(Prompt *prompt, const char *format, ...) {
    char line[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(line, sizeof line, format, list);
    va_end(list);
    output_flush(prompt->output);
    prompt->host->complain(prompt, line);
    prompt->failed = true;
    return false;
}

bool prompt_status(Prompt *prompt, PetriStatus status) {
    prompt->failed = prompt->failed || status != PETRI_OK;
    if (status == PETRI_INTERRUPTED)
        return prompt_fail(prompt, "interrupted");
    if (status == PETRI_OUT_OF_MEMORY)
        return prompt_fail(prompt, "out of memory");
    return status == PETRI_OK;
}

void prompt_busy(Prompt *prompt) {
    if (prompt->host->begin)
        prompt->host->begin(prompt);
}

bool prompt_idle(Prompt *prompt) {
    if (prompt->host->end)
        prompt->host->end(prompt);
    return prompt->host->interrupted(prompt);
}

PetriHistoryInfo prompt_timeline(Prompt *prompt) {
    PetriHistoryInfo info = {.first = -1, .last = -1};
    if (prompt->host->timeline)
        prompt->host->timeline(prompt, &info);
    else
        petri_history_info(prompt->history, &info, sizeof info);
    return info;
}

PetriStatus prompt_go_to(Prompt *prompt, int64_t frame) {
    return prompt->host->go_to ? prompt->host->go_to(prompt, frame) : petri_history_goto(prompt->history, frame);
}

void prompt_complete_frame(Prompt *prompt) {
    if (!prompt->incomplete)
        return;
    prompt_busy(prompt);
    PetriStatus status = prompt->host->go_to ? prompt->host->go_to(prompt, petri_frame_number(prompt->session))
                                             : petri_history_recompute(prompt->history);
    prompt_idle(prompt);
    prompt->incomplete = status != PETRI_OK;
    prompt_status(prompt, status);
}
