// roff.h: text as pages of the manual have it, in the macros of man(7).
#ifndef PETRI_SRC_ROFF_H
#define PETRI_SRC_ROFF_H

#include "cli/output.h"

// The page's first lines, with its name, its section and what it is about.
void roff_begin(Output *output, const char *name, int section, const char *summary);
void roff_heading(Output *output, const char *text);
void roff_subheading(Output *output, const char *text);
// Plain text: whatever it holds is written as it is.
void roff_text(Output *output, const char *text);
void roff_bold(Output *output, const char *text);
// Paragraphs with empty lines between them; lines that are indented stay as they are.
void roff_paragraphs(Output *output, const char *text);
// An item's head in bold, and then `rest`; its text follows.
void roff_item(Output *output, const char *head, const char *rest);
// The other pages to read, each such as "petri(1)", ended by NULL.
void roff_see_also(Output *output, const char *const *pages);

#endif
