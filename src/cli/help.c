// help.c: what the commands and their options are; the version.
#include "cli/help.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/bytes.h"
#include "cli/cli.h"
#include "petri.h"

enum { OPTION_COLUMN = 28 };

Output *help_begin(void) {
    Output *output = memory_zeroed(sizeof *output);
    output_start(output, STDOUT_FILENO);
    return output;
}

int help_end(Output *output) {
    int status = output_finish(output, STATUS_DONE);
    free(output);
    return status;
}

const char HELP_TITLE[] = "runs Flitter scripts that hold systems of particles";
const char HELP_BEGINNING[] =
    "To begin: petri new dish, then petri view dish.fl, and change dish.fl in an editor.\n\n"
    "'petri help COMMAND' lists a command's options. Scripts are made of functions ('petri help builtins') and\n"
    "nodes ('petri help nodes'); 'petri help WORD' tells of one, such as sin, particle or tempo. SCRIPT.fl may\n"
    "be - for standard input. 'petri --version' prints the version.";

int help_overview(const Command *const *commands) {
    Output *output = help_begin();
    output_format(output, "petri %s: %s\n\n", petri_version(), HELP_TITLE);
    output_format(output, "usage: petri SCRIPT.fl\n       petri COMMAND [options] ...\n\n");
    for (size_t i = 0; commands[i] != NULL; i++) {
        output_format(output, "  %-8s %s\n", commands[i]->name, commands[i]->summary);
    }
    output_format(output, "\n%s\n", HELP_BEGINNING);
    return help_end(output);
}

// Text whose first line begins in a column and whose other lines are put below it.
static void write_wrapped(Output *output, const char *text, int column) {
    enum { LAST_COLUMN = 108 };
    size_t most = (size_t)(LAST_COLUMN - column);
    while (strlen(text) > most) {
        size_t length = most;
        while (length > 0 && text[length] != ' ') {
            length--;
        }
        if (length == 0) {
            break; // a word that is too long
        }
        output_format(output, "%.*s\n%*s", (int)length, text, column, "");
        text += length + 1;
    }
    output_format(output, "%s\n", text);
}

void help_option(Output *output, const OptionSpec *spec) {
    char letter[8] = "    ";
    if (spec->letter != '\0') {
        snprintf(letter, sizeof letter, "-%c, ", spec->letter);
    }
    char head[80];
    snprintf(head, sizeof head, "  %s--%s%s%s", letter, spec->name, spec->value == NULL ? "" : " ",
             spec->value == NULL ? "" : spec->value);
    output_format(output, "%-*s  ", OPTION_COLUMN, head);
    write_wrapped(output, spec->help, OPTION_COLUMN + 2);
}

int help_for(const Command *command) {
    Output *output = help_begin();
    output_format(output, "usage: petri %s%s %s\n\n%s\n", command->name, command->options == 0 ? "" : " [options]",
                  command->operands, command->details);
    output_format(output, "%s", command->options == 0 ? "" : "\n");
    for (const OptionSpec *spec = OPTIONS; spec->name != NULL; spec++) {
        if (spec->commands & command->options) {
            help_option(output, spec);
        }
    }
    if (command->examples != NULL) {
        output_format(output, "\nExamples:\n%s", command->examples);
    }
    return help_end(output);
}

int help_version(void) {
    Output *output = help_begin();
    output_format(output, "petri %s\n", petri_version());
    return help_end(output);
}
