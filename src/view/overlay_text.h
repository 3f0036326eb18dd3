// overlay_text.h: the texts shown over a picture, and their wrapping.
#pragma once

#include "view/sliders.h"

#include <stdbool.h>
#include <stddef.h>

// Texts, and sliders, shown over a picture. Texts are in UTF-8 without control characters except newlines. Empty texts
// are not shown.
typedef struct Overlay {
    char status[400];      // frame rate and clocks, several lines
    char notice[400];      // last action, one line
    char error_text[4000]; // errors of the script, several lines
    char mark[40];         // number of warnings, shown in a corner
    bool is_warning;       // `error_text` is a list of warnings, which do not stop the script
    Sliders sliders;
} Overlay;

// Sets `text`, one of the texts of an overlay, to `from`. Removes escape sequences and control characters except
// newlines. Replaces tabs by blanks and invalid UTF-8 by `?`. Truncates what does not fit. Returns true if the text has
// changed.
bool overlay_set(char *text, size_t size, const char *from);

// overlay_lines returns the number of lines. overlay_columns returns the number of characters in the longest line.
int overlay_lines(const char *text);
int overlay_columns(const char *text);
// Wraps text to at most `columns` characters per line (at least 2), at blanks where possible. Lines that begin with a
// blank quote a script or contain carets below a quoted line. To keep them aligned, they are truncated, not wrapped.
// Text that exceeds `size` bytes is omitted.
void overlay_fit(char *out, size_t size, const char *text, int columns);
