// commands.c: see commands.h. Each program compiles this file with its own bit as THIS_PROGRAM, so that it links only
// the commands that it can execute.
#include "main/commands.h"

#include <string.h>

const unsigned PROGRAM = THIS_PROGRAM;

#define ROW(word, constant, where, is_listed)                                                                          \
    {.name = word,                                                                                                     \
     .programs = where,                                                                                                \
     .command = (where)&THIS_PROGRAM ? &constant##_COMMAND : NULL,                                                     \
     .listed = is_listed},
#define COMMAND(word, constant, where) ROW(word, constant, where, true)
#define HIDDEN(word, constant, where) ROW(word, constant, where, false)
const CommandRow COMMANDS[] = {
#include "main/command_list.h"
    {.name = NULL},
};

const CommandRow *command_find(const char *name) {
    for (const CommandRow *row = COMMANDS; row->name; row++)
        if (strcmp(row->name, name) == 0)
            return row;
    return NULL;
}
