// pages.c: petri(1) and the pages of the commands, generated from the tables of `petri help`.
#include "cli/args.h"
#include "cli/help.h"
#include "packaging/packaging.h"
#include "packaging/roff.h"
#include "prompt/prompt.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

const PageRow PAGE_VARIABLES[] = {
    {"NO_COLOR", "if not empty, messages and terminal pictures have no colours"},
    {"PETRI_CPU",
     "highest level of vector instructions to use: scalar, avx2 or avx512; -fma or +fma after it disables or forces "
     "fused multiply-add; results do not change"},
    {"TMPDIR", "folder in which '-o -' stores its output until it is complete (default: /tmp)"},
    {"XDG_STATE_HOME", "folder that contains petri/history, the history of the prompt (default: ~/.local/state)"},
    {0},
};
const PageRow PAGE_STATUSES[] = {
    {"0", "success"},
    {"1", "error in a script, exceeded limit, file that cannot be written, or failed test"},
    {"2", "invalid command line; nothing was done"},
    {"128+N", "terminated by signal N"},
    {0},
};

static void write_items(Output *output, const PageRow *rows) {
    for (; rows->name; rows++) {
        roff_item(output, rows->name, "");
        roff_text(output, rows->help);
        output_format(output, "\n");
    }
}

void page_of_petri(Output *output) {
    roff_begin(output, "petri", 1, HELP_TITLE);
    roff_heading(output, "SYNOPSIS");
    output_format(output, ".B petri\n.I SCRIPT.fl\n.br\n.B petri\n.I COMMAND\n[options] ...\n");
    roff_heading(output, "DESCRIPTION");
    roff_paragraphs(output, HELP_BEGINNING);
    roff_heading(output, "COMMANDS");
    for (const CommandRow *row = COMMANDS; row->listed; row++) {
        output_format(output, ".TP\n.BR petri\\-%s (1)\n", row->name);
        roff_text(output, row->command->summary);
        output_format(output, "\n");
    }
    roff_heading(output, "EXIT STATUS");
    write_items(output, PAGE_STATUSES);
    roff_heading(output, "ENVIRONMENT");
    write_items(output, PAGE_VARIABLES);
    roff_see_also(output, (const char *const[]){"petri-run(1)", "petri(5)", "petri.h(3)", NULL});
}

static void write_option(Output *output, const OptionSpec *option) {
    output_format(output, ".TP\n");
    char name[64];
    if (option->letter != '\0') {
        snprintf(name, sizeof name, "-%c", option->letter);
        roff_bold(output, name);
        output_format(output, ", ");
    }
    snprintf(name, sizeof name, "--%s", option->name);
    roff_bold(output, name);
    if (option->value) {
        output_format(output, " \\fI");
        roff_text(output, option->value);
        output_format(output, "\\fR");
    }
    output_format(output, "\n");
    roff_text(output, option->help);
    output_format(output, "\n");
}

// Writes example lines. The description of an example starts in COMMENT_COLUMN.
static void write_examples(Output *output, const char *examples) {
    enum { COMMENT_COLUMN = 50 };
    while (*examples != '\0') {
        int length = (int)strcspn(examples, "\n"), end = length < COMMENT_COLUMN ? length : COMMENT_COLUMN;
        const char *comment = examples + end;
        while (end > 0 && examples[end - 1] == ' ')
            end--;
        char text[256];
        snprintf(text, sizeof text, "%.*s", end - 2, examples + 2);
        roff_item(output, text, "");
        snprintf(text, sizeof text, "%.*s", (int)(examples + length - comment), comment);
        roff_text(output, text);
        output_format(output, text[0] == '\0' ? "\\&\n" : "\n");
        examples += length + (examples[length] == '\n');
    }
}

static void write_prompt_commands(Output *output) {
    const PromptCommand *command;
    for (size_t i = 0; (command = prompt_command_at(i)); i++) {
        char rest[64];
        snprintf(rest, sizeof rest, "%s%s", command->operands[0] == '\0' ? "" : " ", command->operands);
        roff_item(output, command->name, rest);
        roff_text(output, command->help);
        output_format(output, "\n");
    }
}

static void write_synopsis(Output *output, const Command *command) {
    output_format(output, ".B petri %s\n%s", command->name, !command->options ? "" : "[options]\n");
    roff_text(output, command->operands);
    output_format(output, command->operands[0] == '\0' ? "" : "\n");
}

static void write_options(Output *output, const Command *command) {
    for (const OptionSpec *option = command_options(command); option->name; option++)
        write_option(output, option);
}

// Writes the description, options and examples of a part, in a separate section.
static void write_part(Output *output, const Command *part) {
    char heading[40];
    snprintf(heading, sizeof heading, "PETRI %s", part->name);
    for (char *letter = heading; *letter != '\0'; letter++)
        *letter = (char)toupper((unsigned char)*letter);
    roff_heading(output, heading);
    roff_paragraphs(output, part->details);
    write_options(output, part);
    write_examples(output, !part->examples ? "" : part->examples);
}

void page_of_command(Output *output, const Command *command) {
    char name[32];
    snprintf(name, sizeof name, "petri-%s", command->name);
    roff_begin(output, name, 1, command->summary);
    roff_heading(output, "SYNOPSIS");
    write_synopsis(output, command);
    for (const Command *const *part = command->parts; part && *part; part++) {
        output_format(output, ".br\n");
        write_synopsis(output, *part);
    }
    roff_heading(output, "DESCRIPTION");
    roff_paragraphs(output, command->details);
    if (command->options)
        roff_heading(output, "OPTIONS");
    write_options(output, command);
    if (command == &REPL_COMMAND) {
        roff_heading(output, "PROMPT COMMANDS");
        write_prompt_commands(output);
    }
    if (command->examples) {
        roff_heading(output, "EXAMPLES");
        write_examples(output, command->examples);
    }
    for (const Command *const *part = command->parts; part && *part; part++)
        write_part(output, *part);
    roff_see_also(output, (const char *const[]){"petri(1)", "petri(5)", NULL});
}
