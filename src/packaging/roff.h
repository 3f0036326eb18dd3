// roff.h: functions that write manual pages with the macros of man(7).
#pragma once

#include "cli/output.h"

// Writes the head of a page.
void roff_begin(Output *output, const char *name, int section, const char *summary);
void roff_heading(Output *output, const char *text);
void roff_subheading(Output *output, const char *text);
// Writes text, with all characters that are special in roff escaped.
void roff_text(Output *output, const char *text);
void roff_bold(Output *output, const char *text);
// Writes paragraphs, which are separated by empty lines. Indented lines are examples and keep their line breaks.
void roff_paragraphs(Output *output, const char *text);
// Writes the head of an item: `head` in bold, then `rest`. The caller writes the text of the item next.
void roff_item(Output *output, const char *head, const char *rest);
// Writes the section SEE ALSO. `pages` are names such as "petri(1)", then NULL.
void roff_see_also(Output *output, const char *const *pages);
