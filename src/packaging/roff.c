// roff.c: see roff.h.
//
// Text passes through write_escaped, so that it cannot begin a request of roff and keeps its ASCII characters.
#include "packaging/roff.h"

#include "petri.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

// Returns the escape sequence for a character that is special in roff, else NULL.
static const char *escape_for(char c) {
    switch (c) {
    case '\\':
        return "\\e";
    case '-':
        return "\\-";
    case '\'':
        return "\\(aq";
    case '`':
        return "\\(ga";
    case '^':
        return "\\(ha";
    case '~':
        return "\\(ti";
    default:
        return NULL;
    }
}

static void write_escaped(Output *output, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++) {
        const char *other = escape_for(text[i]);
        if (other) {
            output_format(output, "%s", other);
        } else {
            // Without the escape, a dot at the start of a line would begin a roff request.
            output_format(output, "%s%c", i == 0 && text[i] == '.' ? "\\&" : "", text[i]);
        }
    }
}

void roff_text(Output *output, const char *text) {
    write_escaped(output, text, strlen(text));
}

void roff_begin(Output *output, const char *name, int section, const char *summary) {
    output_format(output, ".TH ");
    for (const char *c = name; *c != '\0'; c++)
        output_format(output, *c == '-' ? "\\-" : "%c", toupper((unsigned char)*c));
    output_format(output, " %d \"\" \"petri %s\" petri\n.SH NAME\n", section, petri_version());
    roff_text(output, name);
    output_format(output, " \\- ");
    roff_text(output, summary);
    output_format(output, "\n");
}

void roff_heading(Output *output, const char *text) {
    output_format(output, ".SH %s\n", text);
}

void roff_subheading(Output *output, const char *text) {
    output_format(output, ".SS \"%s\"\n", text);
}

void roff_bold(Output *output, const char *text) {
    output_format(output, "\\fB");
    roff_text(output, text);
    output_format(output, "\\fR");
}

void roff_paragraphs(Output *output, const char *text) {
    bool in_example = false, empty = false, first = true;
    while (*text != '\0') {
        size_t length = strcspn(text, "\n");
        bool indented = text[0] == ' ';
        if (in_example && !indented) {
            output_format(output, ".EE\n");
            in_example = false;
        }
        // A new paragraph begins after an empty line and at the first line of an example.
        if (length > 0 && !first && (empty || (indented && !in_example)))
            output_format(output, ".PP\n");
        if (indented && !in_example) {
            output_format(output, ".EX\n");
            in_example = true;
        }
        if (length > 0) {
            write_escaped(output, text, length);
            output_format(output, "\n");
            first = false;
        }
        empty = length == 0;
        text += length + (text[length] == '\n');
    }
    output_format(output, "%s", in_example ? ".EE\n" : "");
}

void roff_item(Output *output, const char *head, const char *rest) {
    output_format(output, ".TP\n");
    roff_bold(output, head);
    roff_text(output, rest);
    output_format(output, "\n");
}

void roff_see_also(Output *output, const char *const *pages) {
    roff_heading(output, "SEE ALSO");
    for (size_t i = 0; pages[i]; i++) {
        char name[64];
        size_t length = strcspn(pages[i], "(");
        snprintf(name, sizeof name, "%.*s", (int)length, pages[i]);
        output_format(output, ".BR ");
        roff_text(output, name);
        output_format(output, " %s%s\n", pages[i] + length, !pages[i + 1] ? "" : ",");
    }
}
