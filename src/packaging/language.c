// language.c: petri(5), the reference of words, functions and nodes of scripts, generated from petri's tables.
#include "cli/help.h"
#include "cli/memory.h"
#include "packaging/packaging.h"
#include "packaging/roff.h"
#include "petri.h"

#include <stdio.h>
#include <string.h>

static const char DESCRIPTION[] = "A script describes one frame. It is evaluated from the first line to the last in "
                                  "every frame and yields a tree of nodes:\n\n"
                                  "  -- drops.fl\n"
                                  "  !physics state=:drops dimensions=2\n"
                                  "      for i in ..80\n"
                                  "          !particle id=i radius=8 position=90*normal(:start)[2*i;2*i+1]\n"
                                  "      !gravity strength=5k\n"
                                  "  !window size=640;360\n"
                                  "      !canvas translate=320;180\n"
                                  "          for i in ..80\n"
                                  "              !ellipse point=$(:drops;i) radius=8 fill=true\n\n"
                                  "Indented nodes belong to the node above. Each value is a vector. Particle systems "
                                  "write positions and other values to the state, which the next frame reads with $.";

static void write_words(Output *output) {
    for (const Topic *topic = TOPICS; topic->word; topic++) {
        // Words with the same syntax, such as $ and state, have one entry.
        if (topic == TOPICS || strcmp(topic->form, topic[-1].form) != 0) {
            roff_item(output, topic->form, "");
            roff_text(output, topic->help);
            output_format(output, "\n");
        }
    }
}

static void write_functions(Output *output) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++) {
        char rest[128];
        snprintf(rest, sizeof rest, "(%s)", builtin.parameters);
        roff_item(output, builtin.name, rest);
        roff_text(output, builtin.help);
        output_format(output, "\n");
    }
}

static void write_attributes(Output *output, size_t kind) {
    PetriNodeAttribute attribute;
    if (!petri_node_attribute(kind, 0, &attribute, sizeof attribute))
        return;
    output_format(output, ".RS\n");
    for (size_t i = 0; petri_node_attribute(kind, i, &attribute, sizeof attribute); i++) {
        roff_item(output, attribute.name, "");
        roff_text(output, attribute.type);
        roff_text(output, attribute.unit[0] != '\0' ? ", in " : "");
        roff_text(output, attribute.unit);
        if (attribute.default_value[0] != '\0') {
            roff_text(output, " (");
            roff_text(output, attribute.default_value);
            roff_text(output, ")");
        }
        roff_text(output, attribute.help[0] != '\0' ? ": " : "");
        roff_text(output, attribute.help);
        output_format(output, "\n");
    }
    output_format(output, ".RE\n");
}

// Writes the formulas of a node, one per line. For the first node that has formulas, also explains the symbols.
static void write_formula(Output *output, const PetriNodeKind *kind) {
    for (const char *line = kind->formula; *line != '\0'; line += line[0] == '\n') {
        size_t length = strcspn(line, "\n");
        SCOPED_STRING text = memory_strndup(line, length);
        output_format(output, ".br\n");
        roff_text(output, text);
        output_format(output, "\n");
        line += length;
    }
    if (strcmp(kind->name, "constant") == 0) {
        output_format(output, ".br\n(");
        roff_text(output, FORMULA_LETTERS);
        output_format(output, ")\n");
    }
}

static void write_nodes(Output *output) {
    PetriNodeKind kind;
    const char *area = "";
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        if (strcmp(kind.area, area) != 0) {
            roff_subheading(output, kind.area);
            area = kind.area;
        }
        char name[64];
        snprintf(name, sizeof name, "!%s", kind.name);
        roff_item(output, name, "");
        roff_text(output, kind.help);
        output_format(output, "\n");
        write_formula(output, &kind);
        write_attributes(output, i);
    }
}

void page_of_language(Output *output) {
    roff_begin(output, "petri", 5, "the Flitter language as supported by petri");
    roff_heading(output, "DESCRIPTION");
    roff_paragraphs(output, DESCRIPTION);
    roff_heading(output, "WORDS");
    write_words(output);
    roff_heading(output, "FUNCTIONS");
    write_functions(output);
    roff_heading(output, "NODES");
    write_nodes(output);
    roff_see_also(output, (const char *const[]){"petri(1)", "petri-check(1)", NULL});
}
