// overlay_text.h: the text over a picture.
#ifndef PETRI_SRC_OVERLAY_TEXT_H
#define PETRI_SRC_OVERLAY_TEXT_H

#include <stdbool.h>
#include <stddef.h>

// Texts that are shown over a picture; empty ones are not. UTF-8 without control characters but newlines.
typedef struct Overlay {
    char status[400];      // frame rate and clocks, some lines
    char notice[400];      // what was done just now, one line
    char error_text[4000]; // what is wrong with the script, some lines
    char mark[40];         // that there is more to tell, a few words in a corner
    bool is_warning;       // `trouble` tells of nothing that stops anything
} Overlay;

// Sets one of them from any text: escape sequences and what is no UTF-8 are left out, tabs become blanks, and what does
// not fit is cut off. True if the text is another one than before.
bool overlay_set(char *text, size_t size, const char *from);

// Lines, and characters of the longest.
int overlay_lines(const char *text);
int overlay_columns(const char *text);
// The text in lines of at most so many characters (at least 2): longer ones go on in the next line, at a blank if there
// is one. Those that begin with a blank are a script's, and the marks under them: they are cut, so that they stay below
// each other. What does not fit into `size` bytes is left out.
void overlay_fit(char *out, size_t size, const char *text, int columns);

#endif
