// tables.c: petri's tables of commands, functions, nodes and words as JSON, for the manual on the web (src/web/site).
#include "cli/args.h"
#include "cli/help.h"
#include "cli/json.h"
#include "cli/memory.h"
#include "packaging/packaging.h"
#include "petri.h"
#include "prompt/prompt.h"

static void begin_row(JsonWriter *json) {
    json_break(json, "\n");
    json_open(json, NULL, "{");
}

// Begins a line, opens an object and adds strings to it: names and values in turn.
#define OPEN_ROW(json, ...) (begin_row(json), JSON_PUT_TEXTS(json, __VA_ARGS__))
#define ROW(json, ...) (OPEN_ROW(json, __VA_ARGS__), json_close(json, "}"))

static const char *or_none(const char *text) {
    return !text ? "" : text;
}

static void add_command(JsonWriter *json, const Command *command) {
    OPEN_ROW(json, "name", command->name, "operands", command->operands, "summary", command->summary, "details",
             command->details, "examples", or_none(command->examples));
    json_open(json, "options", "[");
    for (const OptionSpec *option = command_options(command); option->name; option++) {
        ROW(json, "letter", (char[]){option->letter, '\0'}, "name", option->name, "value", or_none(option->value),
            "help", option->help);
    }
    json_close(json, "]}");
    for (const Command *const *part = command->parts; part && *part; part++)
        add_command(json, *part);
}

static void add_commands(JsonWriter *json) {
    for (const CommandRow *row = COMMANDS; row->listed; row++)
        add_command(json, row->command);
}

static void add_prompt(JsonWriter *json) {
    const PromptCommand *command;
    for (size_t i = 0; (command = prompt_command_at(i)); i++)
        ROW(json, "name", command->name, "operands", command->operands, "help", command->help);
}

static void add_words(JsonWriter *json) {
    for (const Topic *topic = TOPICS; topic->word; topic++)
        ROW(json, "word", topic->word, "form", topic->form, "help", topic->help);
}

static void add_everyday(JsonWriter *json) {
    for (const EverydayWord *row = EVERYDAY_WORDS; row->words; row++)
        ROW(json, "words", row->words, "names", row->names);
}

static void add_functions(JsonWriter *json) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++)
        ROW(json, "name", builtin.name, "parameters", builtin.parameters, "help", builtin.help);
}

static void add_nodes(JsonWriter *json) {
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        OPEN_ROW(json, "name", kind.name, "area", kind.area, "help", kind.help, "formula", kind.formula, "synonyms",
                 kind.synonyms);
        json_open(json, "attributes", "[");
        PetriNodeAttribute attribute;
        for (size_t k = 0; petri_node_attribute(i, k, &attribute, sizeof attribute); k++) {
            ROW(json, "name", attribute.name, "type", attribute.type, "defaultValue", attribute.default_value, "unit",
                attribute.unit, "help", attribute.help);
        }
        json_close(json, "]}");
    }
}

static void add_page_rows(JsonWriter *json, const PageRow *rows) {
    for (; rows->name; rows++)
        ROW(json, "name", rows->name, "help", rows->help);
}

static void add_statuses(JsonWriter *json) {
    add_page_rows(json, PAGE_STATUSES);
}

static void add_variables(JsonWriter *json) {
    add_page_rows(json, PAGE_VARIABLES);
}

void tables_as_json(Output *output) {
    SCOPED_TEXT out = {0};
    JsonWriter writer = {.out = &out, .spaced = true}, *json = &writer;
    text_add_c(&out, " ");
    OPEN_ROW(json, "version", petri_version(), "title", HELP_TITLE, "beginning", HELP_BEGINNING, "letters",
             FORMULA_LETTERS);
    static const struct {
        const char *name;
        void (*add)(JsonWriter *json);
    } lists[] = {{"commands", add_commands}, {"prompt", add_prompt},       {"words", add_words},
                 {"everyday", add_everyday}, {"functions", add_functions}, {"nodes", add_nodes},
                 {"statuses", add_statuses}, {"variables", add_variables}};
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++) {
        json_open(json, lists[i].name, "[");
        lists[i].add(json);
        json_close(json, "]");
    }
    json_close(json, "}\n");
    output_write(output, out.bytes, out.len);
}
