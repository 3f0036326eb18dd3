// completion.c: completion scripts for bash, zsh and fish.
//
// Each script is a short template filled with the commands, options and option values from petri's tables.
#include "cli/options.h"
#include "packaging/packaging.h"
#include "petri.h"

#include <stdio.h>
#include <string.h>

static void write_text(Output *output, const char *text) {
    output_format(output, "%s", text);
}

// Writes text for a string in single quotes in a shell script. Characters in `escaped` get a backslash.
static void write_quoted(Output *output, const char *text, const char *escaped) {
    for (const char *c = text; *c != '\0'; c++)
        if (*c == '\'')
            write_text(output, "'\\''");
        else
            output_format(output, strchr(escaped, *c) ? "\\%c" : "%c", *c);
}

// Writes the option's possible values, separated by spaces, between prefix and suffix.
static void write_wrapped(Output *output, const char *prefix, const OptionSpec *option, const char *suffix) {
    write_text(output, prefix);
    for (int i = 0; option->words[i]; i++)
        output_format(output, i == 0 ? "%s" : " %s", option->words[i]);
    write_text(output, suffix);
}

static void write_command_names(Output *output) {
    for (size_t i = 0; COMMANDS[i]; i++)
        output_format(output, i == 0 ? "%s" : " %s", COMMANDS[i]->name);
}

// Writes the topics of `petri help`: commands, functions and nodes.
static void write_topics(Output *output) {
    write_text(output, "builtins nodes version ");
    write_command_names(output);
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin); i++)
        output_format(output, " %s", builtin.name);
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind); i++)
        output_format(output, " %s", kind.name);
}

// Writes a bash pattern for `COMMAND --OPTION` or `COMMAND -O`. If the first word is not a command, it is a script; the
// pattern of `run` then applies.
static void write_bash_pattern(Output *output, const Command *command, const OptionSpec *option) {
    output_format(output, "    '%s --%s'", command->name, option->name);
    if (option->letter != '\0')
        output_format(output, " | '%s -%c'", command->name, option->letter);
    write_text(output, ") ");
}

static void write_bash_values(Output *output, const Command *command) {
    for (const OptionSpec *option = NULL; (option = option_after(command, option));) {
        if (!option->value)
            continue;
        write_bash_pattern(output, command, option);
        if (option->words) {
            write_wrapped(output, option_takes(option, "LIST") ? "_petri_list '" : "_petri_words '", option, "'");
        } else {
            write_text(output, option_takes(option, "FILE")  ? "_petri_files -f"
                               : option_takes(option, "DIR") ? "_petri_files -d"
                                                             : ":");
        }
        write_text(output, " ;;\n");
    }
}

void completion_bash(Output *output) {
    write_text(output, "# petri's completion for bash.\n"
                       "_petri_words() { mapfile -t COMPREPLY < <(compgen -W \"$1\" -- \"$current\"); }\n"
                       "_petri_list() {\n"
                       "    local before=${current%\"${current##*,}\"}\n"
                       "    compopt -o nospace\n"
                       "    mapfile -t COMPREPLY < <(compgen -P \"$before\" -W \"$1\" -- \"${current##*,}\")\n"
                       "}\n"
                       "_petri_files() {\n"
                       "    compopt -o filenames\n"
                       "    mapfile -t COMPREPLY < <(compgen \"$@\" -- \"$current\")\n"
                       "}\n"
                       "_petri_scripts() {\n"
                       "    compopt -o filenames\n"
                       "    mapfile -t -O \"${#COMPREPLY[@]}\" COMPREPLY < <(compgen -d -- \"$current\"\n"
                       "        compgen -f -X '!*.fl' -- \"$current\")\n"
                       "}\n"
                       "_petri() {\n"
                       "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
                       "    local command=${COMP_WORDS[1]} options=\n"
                       "    COMPREPLY=()\n"
                       "    if [[ $current == = ]]; then\n"
                       "        current=\n"
                       "    elif [[ $previous == = ]]; then\n"
                       "        previous=${COMP_WORDS[COMP_CWORD - 2]}\n"
                       "    fi\n"
                       "    case $command in\n"
                       "    ");
    for (size_t i = 0; COMMANDS[i]; i++)
        output_format(output, "%s%s", i == 0 ? "" : " | ", COMMANDS[i]->name);
    write_text(output, ") ;;\n"
                       "    *) command=run ;;\n"
                       "    esac\n"
                       "    if [[ $COMP_CWORD == 1 && $current != -* ]]; then\n"
                       "        _petri_words '");
    write_command_names(output);
    write_text(output, "'\n        _petri_scripts\n        return\n    fi\n    case \"$command $previous\" in\n");
    for (size_t i = 0; COMMANDS[i]; i++)
        write_bash_values(output, COMMANDS[i]);
    write_text(output, "    'help help') _petri_words '");
    write_topics(output);
    write_text(output, "' ;;\n    *)\n        case $command in\n");
    for (size_t i = 0; COMMANDS[i]; i++) {
        output_format(output, "        %s) options='--help", COMMANDS[i]->name);
        for (const OptionSpec *option = NULL; (option = option_after(COMMANDS[i], option));)
            output_format(output, " --%s", option->name);
        write_text(output, "' ;;\n");
    }
    write_text(output, "        esac\n"
                       "        if [[ $current == -* ]]; then\n"
                       "            _petri_words \"$options\"\n"
                       "        else\n"
                       "            _petri_scripts\n"
                       "        fi\n"
                       "        ;;\n"
                       "    esac\n"
                       "}\n"
                       "complete -F _petri petri\n");
}

static void write_zsh_option(Output *output, const OptionSpec *option) {
    output_format(output, "            ");
    if (option->letter != '\0')
        output_format(output, "{-%c+,--%s=}", option->letter, option->name);
    else
        output_format(output, "--%s%s", option->name, !option->value ? "" : "=");
    write_text(output, "'[");
    write_quoted(output, option->help, "[]:\\");
    write_text(output, "]");
    if (option->value) {
        output_format(output, ":%s:", option->value);
        bool list = option_takes(option, "LIST");
        if (option->words) {
            write_wrapped(output, list ? "_values -s , LIST " : "(", option, list ? "" : ")");
        } else {
            write_text(output, option_takes(option, "FILE")  ? "_files"
                               : option_takes(option, "DIR") ? "_files -/"
                                                             : " ");
        }
    }
    write_text(output, "' \\\n");
}

void completion_zsh(Output *output) {
    write_text(output, "#compdef petri\n"
                       "# petri's completion for zsh.\n"
                       "_petri() {\n"
                       "    local curcontext=$curcontext context state line command=run\n"
                       "    typeset -A opt_args\n"
                       "    local -a commands\n"
                       "    commands=(\n");
    for (size_t i = 0; COMMANDS[i]; i++) {
        output_format(output, "        '%s:", COMMANDS[i]->name);
        write_quoted(output, COMMANDS[i]->summary, ":\\");
        write_text(output, "'\n");
    }
    write_text(output, "    )\n"
                       "    if ((CURRENT == 2)) && [[ $PREFIX != -* ]]; then\n"
                       "        _alternative 'commands:command:{ _describe command commands }' \\\n"
                       "            'scripts:script:_files -g \"*.fl\"'\n"
                       "        return\n"
                       "    fi\n"
                       "    if ((${commands[(I)$words[2]:*]})); then\n"
                       "        command=$words[2]\n"
                       "        shift words\n"
                       "        ((CURRENT--))\n"
                       "    fi\n"
                       "    case $command in\n"
                       "    help) compadd -- ");
    write_topics(output);
    write_text(output, " ;;\n");
    for (size_t i = 0; COMMANDS[i]; i++) {
        if (COMMANDS[i]->parses_arguments)
            continue;
        output_format(output, "    %s)\n        _arguments -s -S \\\n", COMMANDS[i]->name);
        for (const OptionSpec *option = NULL; (option = option_after(COMMANDS[i], option));)
            write_zsh_option(output, option);
        write_text(output, "            '--help[show help for the command]' \\\n"
                           "            '*:script:_files -g \"*.fl\"'\n"
                           "        ;;\n");
    }
    write_text(output, "    esac\n"
                       "}\n"
                       "if [[ $funcstack[1] == _petri ]]; then\n"
                       "    _petri \"$@\"\n"
                       "else\n"
                       "    compdef _petri petri\n"
                       "fi\n");
}

static void write_fish_option(Output *output, const OptionSpec *option, const char *condition) {
    output_format(output, "complete -c petri -n '%s' -l %s", condition, option->name);
    if (option->letter != '\0')
        output_format(output, " -s %c", option->letter);
    if (option->words && option_takes(option, "LIST")) {
        write_wrapped(output, " -x -a '(__fish_append , ", option, ")'");
    } else if (option->words) {
        write_wrapped(output, " -x -a '", option, "'");
    } else if (option->value) {
        write_text(output, option_takes(option, "FILE")  ? " -r -F"
                           : option_takes(option, "DIR") ? " -x -a '(__fish_complete_directories)'"
                                                         : " -x");
    }
    write_text(output, " -d '");
    write_quoted(output, option->help, "\\");
    write_text(output, "'\n");
}

void completion_fish(Output *output) {
    write_text(output, "# petri's completion for fish.\n");
    for (size_t i = 0; COMMANDS[i]; i++) {
        output_format(output, "complete -c petri -n __fish_use_subcommand -a %s -d '", COMMANDS[i]->name);
        write_quoted(output, COMMANDS[i]->summary, "\\");
        write_text(output, "'\n");
    }
    for (size_t i = 0; COMMANDS[i]; i++) {
        ByteBuffer condition = {0};
        if (COMMANDS[i] == &RUN_COMMAND) { // also applies if the first word is a script instead of a command
            byte_buffer_add_text(&condition, "not __fish_seen_subcommand_from");
            for (size_t k = 0; COMMANDS[k]; k++) {
                byte_buffer_format(&condition, "%s%s", COMMANDS[k] == &RUN_COMMAND ? "" : " ",
                                   COMMANDS[k] == &RUN_COMMAND ? "" : COMMANDS[k]->name);
            }
        } else {
            byte_buffer_format(&condition, "__fish_seen_subcommand_from %s", COMMANDS[i]->name);
        }
        for (const OptionSpec *option = NULL; (option = option_after(COMMANDS[i], option));)
            write_fish_option(output, option, condition.data);
        byte_buffer_free(&condition);
    }
    write_text(output, "complete -c petri -l help -d 'show help for the command'\n"
                       "complete -c petri -n '__fish_seen_subcommand_from help' -f -a '");
    write_topics(output);
    write_text(output, "'\n");
}
