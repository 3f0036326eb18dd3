// block.c: which lines typed at the prompt belong together.
#include <string.h>

#include "repl/repl.h"

bool repl_is_blank(const char *line) {
    return line[strspn(line, " \t\n")] == '\0';
}

// Does a line go on with the lines above it?
static bool goes_on(const char *line) {
    return line[0] == ' ' || line[0] == '\t' || strncmp(line, "else", 4) == 0 || strncmp(line, "elif", 4) == 0;
}

// Where the last line begins.
static size_t last_line(const char *text, size_t length) {
    size_t at = length > 0 ? length - 1 : 0;
    while (at > 0 && text[at - 1] != '\n') {
        at--;
    }
    return at;
}

bool repl_wants_more(Repl *repl, const char *text, size_t length, size_t *taken) {
    size_t last = last_line(text, length);
    *taken = length;
    if (text[strspn(text, " \t")] == '.') {
        return false;
    }
    PetriInput above = last == 0 ? PETRI_INPUT_PART : petri_input(repl->session, text, last);
    if (above != PETRI_INPUT_PART && (repl_is_blank(text + last) || !goes_on(text + last))) {
        *taken = last;
        return false;
    }
    return petri_input(repl->session, text, length) != PETRI_INPUT_WHOLE;
}
