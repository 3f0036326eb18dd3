// topics.c: see help.h.
#include "cli/help.h"

#include <stdio.h>
#include <string.h>

#include "cli/cli.h"
#include "cli/table.h"
#include "petri.h"

const Topic TOPICS[] = {
#define TOPIC(word, form, help) {word, form, help},
#include "cli/topic_list.h"
#undef TOPIC
    {0},
};

static bool tell_word(Output *output, const char *word) {
    for (size_t i = 0; TOPICS[i].word != NULL; i++) {
        if (strcmp(TOPICS[i].word, word) == 0) {
            output_format(output, "%s\n    %s\n", TOPICS[i].form, TOPICS[i].help);
            return true;
        }
    }
    return false;
}

static bool tell_builtin(Output *output, const char *name) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        if (strcmp(builtin.name, name) == 0) {
            output_format(output, "%s(%s)\n    %s\n", builtin.name, builtin.parameters, builtin.help);
            return true;
        }
    }
    return false;
}

// What an attribute takes, and in which unit.
static void add_type(Table *table, const PetriNodeAttribute *attribute) {
    char type[160];
    snprintf(type, sizeof type, "%s%s%s", attribute->type, attribute->unit[0] != '\0' ? ", in " : "", attribute->unit);
    table_add(table, type);
}

static void tell_attributes(Output *output, size_t kind) {
    SCOPED_TABLE table = table_new(4);
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_attribute(kind, i, &attribute); i++) {
        char head[80], fallback[120] = "";
        snprintf(head, sizeof head, "    %s", attribute.name);
        if (attribute.fallback[0] != '\0') {
            snprintf(fallback, sizeof fallback, "default %s", attribute.fallback);
        }
        table_add(&table, head);
        add_type(&table, &attribute);
        table_add(&table, fallback);
        table_add(&table, attribute.help);
    }
    table_write(&table, output);
}

const char FORMULA_LETTERS[] =
    "of a particle, or the first and the second of a pair: r radius, m mass, q charge, v velocity; l their distance, "
    "s that from a wall; n dimensions, δ a step; F > 0 pushes a pair apart, in your units of mass·length/time²";

void help_formula(Output *output, const PetriNodeKind *kind) {
    for (const char *line = kind->formula; *line != '\0'; line += line[0] == '\n') {
        size_t length = strcspn(line, "\n");
        output_format(output, "    %.*s\n", (int)length, line);
        line += length;
    }
}

// A kind may belong to several areas, such as `!group`.
static bool tell_node(Output *output, const char *name) {
    PetriNodeKind kind;
    bool found = false;
    name += name[0] == '!';
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        if (strcmp(kind.name, name) == 0) {
            output_format(output, "!%s (%s): %s\n", kind.name, kind.area, kind.help);
            help_formula(output, &kind);
            if (kind.formula[0] != '\0') {
                output_format(output, "    (%s)\n", FORMULA_LETTERS);
            }
            tell_attributes(output, i);
            found = true;
        }
    }
    return found;
}

// The nodes that have an attribute of this name, each with what it means there.
static bool tell_owners(Output *output, const char *name) {
    SCOPED_TABLE table = table_new(3);
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        for (size_t k = 0; petri_node_attribute(i, k, &attribute); k++) {
            if (strcmp(attribute.name, name) == 0) {
                char head[80];
                snprintf(head, sizeof head, "    !%s", kind.name);
                table_add(&table, head);
                add_type(&table, &attribute);
                table_add(&table, attribute.help);
            }
        }
    }
    bool found = table.count > 0;
    if (found) {
        output_format(output, "%s is an attribute of\n", name);
        table_write(&table, output);
    }
    return found;
}

bool topics_tell(Output *output, const char *topic) {
    bool node_only = topic[0] == '!';
    bool found = !node_only && tell_builtin(output, topic); // one name may be a function and a node, such as random
    found = tell_node(output, topic) || found;
    found = (!node_only && tell_word(output, topic)) || found;
    return found || (!node_only && tell_owners(output, topic));
}

void topics_offer(StrNearest *nearest) {
    Str topic = nearest->wanted;
    PetriBuiltin builtin;
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_builtin(i, &builtin); i++) {
        nearest_offer(nearest, builtin.name);
    }
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        nearest->wanted = str_starts_with(topic, STR("!")) ? (Str){topic.bytes + 1, topic.len - 1} : topic;
        nearest_offer(nearest, kind.name);
        nearest->wanted = topic;
        for (size_t k = 0; petri_node_attribute(i, k, &attribute); k++) {
            nearest_offer(nearest, attribute.name);
        }
    }
    for (size_t i = 0; TOPICS[i].word != NULL; i++) {
        nearest_offer(nearest, TOPICS[i].word);
    }
}
