// show.c: what a frame holds, as text: state and nodes.
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "repl/repl.h"
#include "repl/words.h"

enum { AROUND = 3 }; // lines of the screen that a long output leaves: the command, the closing line, the prompt

// Text that comes in pieces, cut into lines for a filter.
typedef struct Filter {
    Repl *repl;
    const char *wanted;
    size_t depth; // of the node whose subtree is being written, SIZE_MAX outside
    size_t found;
    size_t lines; // that were to be written, of which the first `most` are
    size_t most;
    bool header; // the `@` line is still to come
    Bytes line;
    void (*take)(struct Filter *filter, const char *line, size_t length);
} Filter;

static bool filter_lines(void *host, const char *text, size_t length) {
    Filter *filter = host;
    while (length > 0) {
        const char *end = memchr(text, '\n', length);
        size_t taken = end == NULL ? length : (size_t)(end - text) + 1;
        bytes_add(&filter->line, text, taken);
        text += taken;
        length -= taken;
        if (end != NULL) {
            if (!filter->header) {
                filter->take(filter, filter->line.data, filter->line.length);
            }
            filter->header = false;
            filter->line.length = 0;
        }
    }
    return filter->repl->output.error == 0 && !repl_interrupted();
}

// Writes a section of the frame's text through a filter; returns how much it has found.
static size_t print_filtered(Repl *repl, unsigned section, Filter *filter) {
    filter->repl = repl;
    filter->header = true;
    filter->depth = SIZE_MAX;
    repl_busy(repl);
    petri_print(repl->session, section, filter_lines, filter);
    repl_idle(repl);
    bytes_free(&filter->line);
    return filter->found;
}

static void write_line(Filter *filter, const char *line, size_t length) {
    if (filter->lines++ < filter->most) {
        output_write(&filter->repl->output, line, length);
    }
}

// What was left out, and how it is seen: `asked` is what was typed, without a number of lines.
static void tell_rest(const Filter *filter, const char *command, const char *asked) {
    if (filter->lines > filter->most) {
        repl_say(filter->repl, "%zu more lines; %s%s%s all shows all", filter->lines - filter->most, command,
                 asked[0] == '\0' ? "" : " ", asked);
    }
}

// `$:cells = …` and `$(:cells;0) = …` are both under `:cells`, and under `$:cells`, `(:cells)` and `cells` as well.
static void take_entry(Filter *filter, const char *line, size_t length) {
    const char *key = line + 1 + (line[1] == '(');
    key += key[0] == ':' && filter->wanted[0] != ':';
    size_t wanted = strlen(filter->wanted), rest = length - (size_t)(key - line);
    bool under = wanted == 0 || (rest > wanted && memcmp(key, filter->wanted, wanted) == 0 &&
                                 (key[wanted] == ';' || key[wanted] == ')' || key[wanted] == ' '));
    if (under) {
        filter->found++;
        write_line(filter, line, length);
    }
}

bool repl_show_state(Repl *repl, const char *rest) {
    char *asked = memory_copied(rest, strlen(rest));
    // A number alone is a key.
    size_t most = strpbrk(asked, " \t") != NULL || strcmp(asked, "all") == 0 ? word_lines(repl, asked, AROUND)
                                                                             : word_lines(repl, (char[]){""}, AROUND);
    const char *prefix = asked + (asked[0] == '$');
    bool enclosed = prefix[0] == '(';
    char *wanted = memory_copied(prefix + enclosed, strlen(prefix + enclosed));
    size_t length = strlen(wanted);
    if (enclosed && length > 0 && wanted[length - 1] == ')') {
        wanted[length - 1] = '\0';
    }
    Filter filter = {.wanted = wanted, .take = take_entry, .most = most};
    if (print_filtered(repl, PETRI_PRINT_STATE, &filter) == 0) {
        repl_say(repl, wanted[0] == '\0' ? "the state is empty" : "nothing in the state is under %s", wanted);
    }
    tell_rest(&filter, ".state", asked);
    free(wanted);
    free(asked);
    return true;
}

static void take_node(Filter *filter, const char *line, size_t length) {
    size_t depth = strspn(line, " "), wanted = strlen(filter->wanted);
    if (filter->depth == SIZE_MAX || depth <= filter->depth) {
        const char *kind = line + depth + 1;
        bool same = wanted == 0 || (strncmp(kind, filter->wanted, wanted) == 0 && strchr(" \n", kind[wanted]) != NULL);
        filter->depth = same ? depth : SIZE_MAX;
        filter->found += same;
    }
    if (filter->depth != SIZE_MAX) {
        size_t cut = wanted == 0 ? 0 : filter->depth;
        write_line(filter, line + cut, length - cut);
    }
}

static bool show_tree(Repl *repl, const char *asked, size_t most) {
    const char *kind = asked + (asked[0] == '!');
    repl_busy(repl);
    PetriStatus status = petri_preview(repl->session);
    repl_idle(repl);
    if (!repl_status(repl, status)) {
        return false;
    }
    Filter filter = {.wanted = kind, .take = take_node, .most = most};
    if (print_filtered(repl, PETRI_PRINT_TREE, &filter) == 0) {
        repl_say(repl, kind[0] == '\0' ? "the frame has no nodes" : "the frame has no node !%s", kind);
    }
    tell_rest(&filter, ".tree", asked);
    return true;
}

bool repl_show_tree(Repl *repl, const char *rest) {
    char *asked = memory_copied(rest, strlen(rest));
    size_t most = word_lines(repl, asked, AROUND);
    bool good = show_tree(repl, asked, most);
    free(asked);
    return good;
}
