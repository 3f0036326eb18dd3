// warnings.c: see warnings.h.
#include "view/warnings.h"

#include <stdio.h>

enum { MOST_TEXT = 3500 };

void warnings_add(Warnings *warnings, const PetriDiagnostic *diagnostic) {
    warnings->count += diagnostic->level == PETRI_NOTE ? 0 : 1;
    if (warnings->text.length < MOST_TEXT) {
        bytes_add_text(&warnings->text, diagnostic->rendered);
    }
}

void warnings_forget(Warnings *warnings) {
    bytes_free(&warnings->text);
    *warnings = (Warnings){0};
}

void warnings_mark(const Warnings *warnings, char *text, size_t size) {
    text[0] = '\0';
    if (warnings->count > 0) {
        snprintf(text, size, "%d warning%s: w", warnings->count, warnings->count == 1 ? "" : "s");
    }
}

void warnings_list(const Warnings *warnings, char *text, size_t size) {
    if (warnings->count == 0) {
        snprintf(text, size, "No warnings. w hides this.");
        return;
    }
    snprintf(text, size, "%d warning%s. w hides this.\n%s%s", warnings->count, warnings->count == 1 ? "" : "s",
             warnings->text.data, warnings->text.length < MOST_TEXT ? "" : "… more are on standard error.");
}
