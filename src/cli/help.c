// help.c: help on commands and their options, and the version.
#include "cli/help.h"

#include "cli/args.h"
#include "cli/memory.h"
#include "cli/progress.h"
#include "petri.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { OPTION_COLUMN = 28 };

Output *help_begin(void) {
    Output *output = memory_calloc(sizeof *output);
    output_start(output, STDOUT_FILENO);
    return output;
}

int help_end(Output *output) {
    int status = output_finish(output, STATUS_DONE);
    free(output);
    return status;
}

const char HELP_TITLE[] = "runs Flitter scripts with particle physics";
const char HELP_BEGINNING[] =
    "To start, run 'petri new dish', then 'petri view dish.fl', and edit dish.fl.\n\n"
    "'petri help COMMAND' lists a command's options, 'petri help builtins' lists all functions, and 'petri help\n"
    "nodes' lists all nodes. 'petri help WORD' explains a word in scripts, such as sin, particle or tempo. To read\n"
    "a script from standard input, write - instead of SCRIPT.fl. 'petri --version' prints the version.";

// Writes text that starts in `column`, wrapped at spaces. Continuation lines start in column `hang`.
static void write_words(Output *output, Str line, size_t column, size_t hang, size_t width) {
    for (size_t at = 0; at < line.len;) {
        size_t start = at, word;
        while (at < line.len && line.bytes[at] == ' ')
            at++;
        for (word = at; at < line.len && line.bytes[at] != ' ';)
            at++;
        size_t length = utf8_length((Str){line.bytes + word, at - word});
        if (column > hang && column + (word - start) + length > width) {
            output_format(output, "\n%*s", (int)hang, "");
            column = hang;
            start = word;
        }
        output_write(output, line.bytes + start, at - start);
        column += word - start + length;
    }
}

static void write_line(Output *output, Str line, size_t width) {
    // NARROWEST: minimum width for the last cell. If less is left, the cell is written below the other cells.
    enum { NARROWEST = 24, INDENT = 4 };
    size_t indent = 0, gap = 0;
    while (indent < line.len && line.bytes[indent] == ' ')
        indent++;
    for (size_t i = indent + 2; i < line.len; i++)
        gap = line.bytes[i] != ' ' && line.bytes[i - 1] == ' ' && line.bytes[i - 2] == ' ' ? i : gap;
    size_t hang = gap > 0 ? utf8_length((Str){line.bytes, gap}) : indent;
    if (utf8_length(line) > width && gap > 0 && hang + NARROWEST > width) {
        size_t end = gap;
        while (line.bytes[end - 1] == ' ')
            end--;
        write_words(output, (Str){line.bytes, end}, 0, indent + 2 * INDENT, width);
        hang = indent + INDENT;
        output_format(output, "\n%*s", (int)hang, "");
        write_words(output, (Str){line.bytes + gap, line.len - gap}, hang, hang, width);
    } else {
        write_words(output, line, 0, hang, width);
    }
    output_write(output, "\n", 1);
}

void help_wrap(Output *output, const Text *text, size_t columns) {
    enum { MIN_COLUMNS = 40 };
    Str line;
    for (size_t at = 0; text_next_line(text, &at, &line);)
        write_line(output, line, columns > MIN_COLUMNS ? columns : MIN_COLUMNS);
}

size_t help_columns(int fd) {
    int columns = 80, rows = 0;
    const char *wanted = getenv("COLUMNS");
    terminal_extent(fd, &columns, &rows);
    if (wanted && atoi(wanted) > 0)
        columns = atoi(wanted);
    return columns > 0 ? (size_t)columns : 0;
}

int help_print(const Text *text) {
    Output *output = help_begin();
    help_wrap(output, text, help_columns(output->fd));
    return help_end(output);
}

void help_prose(Text *text, const char *prose) {
    for (const char *at = prose; *at != '\0'; at++) {
        bool joins = at[0] == '\n' && at > prose && at[-1] != '\n' && at[1] != '\n' && at[1] != ' ' && at[1] != '\0';
        text_add(text, (Str){joins ? " " : at, 1});
    }
    text_add_c(text, "\n");
}

void help_option(Text *text, const OptionSpec *spec) {
    char letter[8] = "    ";
    if (spec->letter != '\0')
        snprintf(letter, sizeof letter, "-%c, ", spec->letter);
    char head[80];
    snprintf(head, sizeof head, "  %s--%s%s%s", letter, spec->name, !spec->value ? "" : " ",
             !spec->value ? "" : spec->value);
    text_add_format(text, "%-*s  %s\n", OPTION_COLUMN, head, spec->help);
}

// Adds the parts of a command, each with its operands and summary.
static void help_parts(Text *text, const Command *command) {
    enum { SUMMARY_COLUMN = 36 };
    if (!command->parts)
        return;
    text_add_c(text, "\n");
    for (const Command *const *part = command->parts; *part; part++) {
        char head[80];
        snprintf(head, sizeof head, "  petri %s %s", (*part)->name, (*part)->operands);
        text_add_format(text, "%-*s  %s\n", SUMMARY_COLUMN, head, (*part)->summary);
    }
    text_add_format(text, "\n'petri help %s' explains its options.\n", command->parts[0]->name);
}

int help_for(const Command *command) {
    SCOPED_TEXT text = {0};
    text_add_format(&text, "usage: petri %s%s%s%s\n\n", command->name, !command->options ? "" : " [options]",
                    command->operands[0] == '\0' ? "" : " ", command->operands);
    help_prose(&text, command->details);
    text_add_c(&text, !command->options ? "" : "\n");
    for (const OptionSpec *spec = command_options(command); spec->name; spec++)
        help_option(&text, spec);
    help_parts(&text, command);
    if (command->examples)
        text_add_format(&text, "\nExamples:\n%s", command->examples);
    return help_print(&text);
}

int help_version(void) {
    Output *output = help_begin();
    output_format(output, "petri %s\n", petri_version());
    return help_end(output);
}
