// tables.c: petri's tables of commands, functions, nodes and words as JSON, for the manual on the web (src/web/site).
#include "cli/help.h"
#include "cli/json.h"
#include "cli/memory.h"
#include "packaging/packaging.h"
#include "petri.h"
#include "repl/repl.h"

static void begin_row(Text *out) {
    text_add_c(out, out->bytes[out->len - 1] == '}' ? ",\n{" : "\n{");
}

// Adds a JSON object without its closing brace: names and values in turn.
#define ROW(out, ...) (begin_row(out), JSON_ADD(out, __VA_ARGS__))

static const char *or_none(const char *text) {
    return !text ? "" : text;
}

static void add_list(Text *out, const char *name) {
    text_add_format(out, ", \"%s\": [", name);
}

static void add_commands(Text *out) {
    for (size_t i = 0; COMMANDS[i]; i++) {
        const Command *command = COMMANDS[i];
        ROW(out, "name", command->name, "operands", command->operands, "summary", command->summary, "details",
            command->details, "examples", or_none(command->examples));
        add_list(out, "options");
        for (const OptionSpec *option = NULL; (option = option_after(command, option));) {
            ROW(out, "letter", (char[]){option->letter, '\0'}, "name", option->name, "value", or_none(option->value),
                "help", option->help);
            text_add_c(out, "}");
        }
        text_add_c(out, "]}");
    }
}

static void add_prompt(Text *out) {
    const ReplCommand *command;
    for (size_t i = 0; (command = repl_command_at(i)); i++) {
        ROW(out, "name", command->name, "operands", command->operands, "help", command->help);
        text_add_c(out, "}");
    }
}

static void add_words(Text *out) {
    for (const Topic *topic = TOPICS; topic->word; topic++) {
        ROW(out, "word", topic->word, "form", topic->form, "help", topic->help);
        text_add_c(out, "}");
    }
}

static void add_functions(Text *out) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++) {
        ROW(out, "name", builtin.name, "parameters", builtin.parameters, "help", builtin.help);
        text_add_c(out, "}");
    }
}

static void add_nodes(Text *out) {
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        ROW(out, "name", kind.name, "area", kind.area, "help", kind.help, "formula", kind.formula);
        add_list(out, "attributes");
        PetriNodeAttribute attribute;
        for (size_t k = 0; petri_node_attribute(i, k, &attribute, sizeof attribute); k++) {
            ROW(out, "name", attribute.name, "type", attribute.type, "defaultValue", attribute.default_value, "unit",
                attribute.unit, "help", attribute.help);
            text_add_c(out, "}");
        }
        text_add_c(out, "]}");
    }
}

static void add_page_rows(Text *out, const PageRow *rows) {
    for (; rows->name; rows++) {
        ROW(out, "name", rows->name, "help", rows->help);
        text_add_c(out, "}");
    }
}

void tables_as_json(Output *output) {
    SCOPED_TEXT out = {0};
    text_add_c(&out, " ");
    ROW(&out, "version", petri_version(), "title", HELP_TITLE, "beginning", HELP_BEGINNING, "letters", FORMULA_LETTERS);
    static const struct {
        const char *name;
        void (*add)(Text *out);
    } lists[] = {{"commands", add_commands},
                 {"prompt", add_prompt},
                 {"words", add_words},
                 {"functions", add_functions},
                 {"nodes", add_nodes}};
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        add_list(&out, lists[i].name);
        lists[i].add(&out);
        text_add_c(&out, "]");
    }
    add_list(&out, "statuses");
    add_page_rows(&out, PAGE_STATUSES);
    text_add_c(&out, "]");
    add_list(&out, "variables");
    add_page_rows(&out, PAGE_VARIABLES);
    text_add_c(&out, "]}\n");
    output_write(output, out.bytes, out.len);
}
