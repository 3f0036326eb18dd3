// template.c: fills the templates of editor files with the names in petri's tables.
//
// `@builtins|@` is replaced by the names of all functions, separated by `|`. `@nodes|@` and `@values|@` are replaced by
// the names of nodes and of predefined values. The separator can be any text without `@`.
#include "base/file.h"
#include "cli/help.h"
#include "cli/memory.h"
#include "packaging/packaging.h"
#include "petri.h"

#include <stdio.h>
#include <string.h>

static void add_unique(TextList *list, const char *name) {
    if (!texts_contain(list, name))
        texts_add(list, name);
}

static void list_builtins(TextList *list) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++)
        add_unique(list, builtin.name);
}

static void list_nodes(TextList *list) {
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++)
        add_unique(list, kind.name);
}

// Lists the constants and the values that petri sets in each frame: all topics before `let`, the first keyword.
static void list_values(TextList *list) {
    for (size_t i = 0; TOPICS[i].word && strcmp(TOPICS[i].word, "let") != 0; i++)
        add_unique(list, TOPICS[i].word);
    add_unique(list, "tau");
}

static const struct {
    const char *name;
    void (*list)(TextList *list);
} lists[] = {{"builtins", list_builtins}, {"nodes", list_nodes}, {"values", list_values}};

// Writes the list for the text between two `@`. Returns false if the text is not a mark.
static bool write_list(Output *output, Str between) {
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        Str name = str_from(lists[i].name);
        if (!str_starts_with(between, name))
            continue;
        TextList words = {0};
        lists[i].list(&words);
        for (size_t k = 0; k < words.count; k++) {
            output_write(output, between.bytes + name.len, k == 0 ? 0 : between.len - name.len);
            output_format(output, "%s", words.items[k]);
        }
        texts_free(&words);
        return true;
    }
    return false;
}

bool template_fill(Output *output, const char *path) {
    SCOPED_TEXT text = {0};
    if (text_read_file(&text, path, SIZE_MAX))
        return false;
    for (const char *at = text.bytes; at && *at != '\0';) {
        const char *open = strchr(at, '@'), *close = !open ? NULL : strchr(open + 1, '@');
        if (!close) {
            output_format(output, "%s", at);
            break;
        }
        output_write(output, at, (size_t)(open - at));
        bool filled = write_list(output, (Str){open + 1, (size_t)(close - open - 1)});
        output_write(output, open, filled ? 0 : 1);
        at = filled ? close + 1 : open + 1;
    }
    return true;
}
