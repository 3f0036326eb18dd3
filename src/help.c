// help.c: what the commands and their options are; the version.
#include "help.h"

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "cli.h"
#include "petri.h"

enum { OPTION_COLUMN = 28 };

Output *help_begin(void) {
    Output *output = malloc(sizeof *output);
    if (output == NULL) {
        message("out of memory");
        return NULL;
    }
    output_start(output, STDOUT_FILENO);
    return output;
}

int help_end(Output *output) {
    int status = output_finish(output, STATUS_DONE);
    free(output);
    return status;
}

int help_overview(void) {
    Output *output = help_begin();
    if (output == NULL) {
        return STATUS_FAILED;
    }
    output_format(output, "petri %s: runs Flitter scripts that hold systems of particles\n\n", petri_version());
    output_format(output, "usage: petri SCRIPT.fl\n       petri COMMAND [options] ...\n\n");
    for (size_t i = 0; COMMANDS[i] != NULL; i++) {
        output_format(output, "  %-8s %s\n", COMMANDS[i]->name, COMMANDS[i]->summary);
    }
    output_format(
        output, "\nSCRIPT.fl may be - for standard input. 'petri help COMMAND' lists a command's options. Scripts are\n"
                "made of functions ('petri help builtins') and nodes ('petri help nodes'); 'petri help WORD' tells of\n"
                "one, such as sin, particle or tempo. 'petri --version' prints the version.\n");
    return help_end(output);
}

void help_option(Output *output, const OptionSpec *spec) {
    char letter[8] = "    ";
    if (spec->letter != '\0') {
        snprintf(letter, sizeof letter, "-%c, ", spec->letter);
    }
    char head[80];
    snprintf(head, sizeof head, "  %s--%s%s%s", letter, spec->name, spec->value == NULL ? "" : " ",
             spec->value == NULL ? "" : spec->value);
    output_format(output, "%-*s  %s\n", OPTION_COLUMN, head, spec->help);
}

int help_for(const Command *command) {
    Output *output = help_begin();
    if (output == NULL) {
        return STATUS_FAILED;
    }
    output_format(output, "usage: petri %s%s %s\n\n%s\n", command->name,
                  command->options->name == NULL ? "" : " [options]", command->operands, command->details);
    for (const OptionSpec *spec = command->options; spec->name != NULL; spec++) {
        output_format(output, "%s", spec == command->options ? "\n" : "");
        help_option(output, spec);
    }
    return help_end(output);
}

int help_version(void) {
    Output *output = help_begin();
    if (output == NULL) {
        return STATUS_FAILED;
    }
    output_format(output, "petri %s\n", petri_version());
    return help_end(output);
}
