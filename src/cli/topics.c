// topics.c: help on words of the language; see help.h.
#include "cli/cli.h"
#include "cli/help.h"
#include "cli/text_table.h"
#include "petri.h"

#include <stdio.h>
#include <string.h>

const Topic TOPICS[] = {
#define TOPIC(word, form, help) {word, form, help},
#include "cli/topic_list.h"
#undef TOPIC
    {0},
};

bool topic_find_builtin(Str name, PetriBuiltin *builtin) {
    for (size_t i = 0; petri_builtin(i, builtin, sizeof *builtin); i++)
        if (str_equal(name, str_from(builtin->name)))
            return true;
    return false;
}

bool topic_find_kind(Str name, size_t *number, PetriNodeKind *kind) {
    for (; petri_node_kind(*number, kind, sizeof *kind); ++*number)
        if (str_equal(name, str_from(kind->name)))
            return true;
    return false;
}

const Topic *topic_find(Str word) {
    for (const Topic *topic = TOPICS; topic->word; topic++)
        if (str_equal(word, str_from(topic->word)))
            return topic;
    return NULL;
}

const EverydayWord EVERYDAY_WORDS[] = {
#define EVERYDAY(words, names, note) {words, names, note},
#include "cli/everyday_list.h"
    {0},
};

static bool print_word(Text *text, const char *word) {
    const Topic *topic = topic_find(str_from(word));
    if (topic)
        text_add_format(text, "%s\n    %s\n", topic->form, topic->help);
    return topic;
}

static bool print_builtin(Text *text, const char *name) {
    PetriBuiltin builtin;
    bool found = topic_find_builtin(str_from(name), &builtin);
    if (found)
        text_add_format(text, "%s(%s)\n    %s\n", builtin.name, builtin.parameters, builtin.help);
    return found;
}

// Adds a cell with the type and unit of an attribute.
static void add_type(TextTable *table, const PetriNodeAttribute *attribute) {
    char type[160];
    snprintf(type, sizeof type, "%s%s%s", attribute->type, attribute->unit[0] != '\0' ? ", in " : "", attribute->unit);
    text_table_add(table, type);
}

static void print_attributes(Text *text, size_t kind) {
    SCOPED_TEXT_TABLE table = text_table_new(4);
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_attribute(kind, i, &attribute, sizeof attribute); i++) {
        char head[80], default_text[120] = "";
        snprintf(head, sizeof head, "    %s", attribute.name);
        if (attribute.default_value[0] != '\0')
            snprintf(default_text, sizeof default_text, "default %s", attribute.default_value);
        text_table_add(&table, head);
        add_type(&table, &attribute);
        text_table_add(&table, default_text);
        text_table_add(&table, attribute.help);
    }
    table_text(&table, text);
}

const char FORMULA_LETTERS[] =
    "r radius, m mass, q charge, v velocity of a particle or of both particles of a pair; l distance of a pair; "
    "s distance from a wall; n number of dimensions; δ time step; F > 0 is repulsive; the unit of F is "
    "mass·length/time²";

void help_formula(Text *text, const PetriNodeKind *kind) {
    for (const char *line = kind->formula; *line != '\0'; line += line[0] == '\n') {
        size_t length = strcspn(line, "\n");
        text_add_format(text, "    %.*s\n", (int)length, line);
        line += length;
    }
}

// Adds the help for all kinds of nodes with this name. Some names, such as `!group`, occur in several areas.
static bool print_node(Text *text, const char *name) {
    PetriNodeKind kind;
    bool found = false;
    name += name[0] == '!';
    for (size_t i = 0; topic_find_kind(str_from(name), &i, &kind); i++) {
        text_add_format(text, "!%s (%s): %s\n", kind.name, kind.area, kind.help);
        help_formula(text, &kind);
        if (kind.formula[0] != '\0')
            text_add_format(text, "    (%s)\n", FORMULA_LETTERS);
        print_attributes(text, i);
        found = true;
    }
    return found;
}

// Adds the nodes that have an attribute of this name, each with the meaning of the attribute.
static bool print_owners(Text *text, const char *name) {
    SCOPED_TEXT_TABLE table = text_table_new(3);
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        for (size_t k = 0; petri_node_attribute(i, k, &attribute, sizeof attribute); k++) {
            if (strcmp(attribute.name, name) == 0) {
                char head[80];
                snprintf(head, sizeof head, "    !%s", kind.name);
                text_table_add(&table, head);
                add_type(&table, &attribute);
                text_table_add(&table, attribute.help);
            }
        }
    }
    bool found = table.count > 0;
    if (found) {
        text_add_format(text, "%s is an attribute of\n", name);
        table_text(&table, text);
    }
    return found;
}

// Adds the help for everything that has this name in petri.
static bool print_name(Text *text, const char *topic) {
    bool node_only = topic[0] == '!';
    bool found = !node_only && print_builtin(text, topic); // a name such as random can be a function and a node
    found = print_node(text, topic) || found;
    found = (!node_only && print_word(text, topic)) || found;
    return found || (!node_only && print_owners(text, topic));
}

// Returns the next word of a list and moves *list behind it. At the end, the word is empty.
static Str next_word(const char **list) {
    Str word = {*list, strcspn(*list, " ")};
    *list += word.len + ((*list)[word.len] == ' ');
    return word;
}

// Adds the names that are neither in the list nor the word itself.
static void add_names(Text *list, const char *names, Str word) {
    for (Str name; (name = next_word(&names)).len > 0;)
        if (!str_equal(name, word) && str_word_number(name, list->len > 0 ? list->bytes : "") < 0)
            text_add_format(list, "%s%.*s", list->len > 0 ? " " : "", STR_ARGS(name));
}

// Adds the names of an everyday word in petri, separated by spaces, and its notes. `!word` has only names of nodes.
static void find_everyday(Text *names, Text *notes, const char *topic) {
    bool node_only = topic[0] == '!';
    Str word = str_from(topic + node_only);
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++)
        if (str_word_number(word, kind.synonyms) >= 0)
            add_names(names, kind.name, word);
    for (const EverydayWord *row = EVERYDAY_WORDS; row->words && !node_only; row++) {
        if (str_word_number(word, row->words) >= 0) {
            add_names(names, row->names, word);
            text_add_format(notes, "%s%s%s", row->note[0] ? "    " : "", row->note, row->note[0] ? "\n" : "");
        }
    }
}

// Adds what petri calls an everyday word: the notes and the help for its names, or only the names if `known`. Returns
// false if the help knows nothing about it.
static bool print_everyday(Text *text, const char *topic, bool known) {
    SCOPED_TEXT names = {0}, notes = {0}, list = {0}, bodies = {0};
    find_everyday(&names, &notes, topic);
    const char *at = names.len > 0 ? names.bytes : "";
    for (Str word; (word = next_word(&at)).len > 0;) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", STR_ARGS(word));
        if (print_name(&bodies, name)) // the help does not know words of the manual
            text_add_format(&list, "%s%s", list.len > 0 ? ", " : "", name);
    }
    if (list.len > 0)
        text_add_format(text, "%s: %s%s\n", known ? "see also" : topic, known ? "" : "see ", list.bytes);
    else if (notes.len > 0)
        text_add_format(text, "%s\n", topic);
    text_add(text, text_str(&notes));
    if (!known)
        text_add(text, text_str(&bodies));
    return list.len + notes.len > 0;
}

bool topics_print(Text *text, const char *topic) {
    bool found = print_name(text, topic);
    return print_everyday(text, topic, found) || found;
}

void topics_offer(StrNearest *nearest) {
    Str topic = nearest->wanted;
    PetriBuiltin builtin;
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++)
        nearest_offer(nearest, builtin.name);
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        nearest->wanted = str_starts_with(topic, STR("!")) ? (Str){topic.bytes + 1, topic.len - 1} : topic;
        nearest_offer(nearest, kind.name);
        nearest->wanted = topic;
        for (size_t k = 0; petri_node_attribute(i, k, &attribute, sizeof attribute); k++)
            nearest_offer(nearest, attribute.name);
    }
    for (size_t i = 0; TOPICS[i].word; i++)
        nearest_offer(nearest, TOPICS[i].word);
}
