// commands.c: see commands.h.
#include "main/commands.h"

#include <string.h>

#ifdef PETRI_PICTURES
const Command *const COMMANDS[] = {&RUN_COMMAND,  &VIEW_COMMAND,   &RENDER_COMMAND, &REPL_COMMAND,   &SWEEP_COMMAND,
                                   &TEST_COMMAND, &DIFF_COMMAND,   &CHECK_COMMAND,  &FMT_COMMAND,    &LSP_COMMAND,
                                   &SEND_COMMAND, &LINK_COMMAND,   &OPEN_COMMAND,   &VERIFY_COMMAND, &INFO_COMMAND,
                                   &CITE_COMMAND, &UNPACK_COMMAND, &NEW_COMMAND,    &HELP_COMMAND,   NULL};
#elif defined PETRI_RANKS
const Command *const COMMANDS[] = {&RUN_COMMAND, &SWEEP_COMMAND, &TEST_COMMAND, &DIFF_COMMAND,   &CHECK_COMMAND,
                                   &FMT_COMMAND, &SEND_COMMAND,  &NEW_COMMAND,  &VERIFY_COMMAND, NULL};
#else // petri: commands that never draw and read no archives
const Command *const COMMANDS[] = {&RUN_COMMAND, &SWEEP_COMMAND, &TEST_COMMAND, &DIFF_COMMAND, &CHECK_COMMAND,
                                   &FMT_COMMAND, &LSP_COMMAND,   &SEND_COMMAND, &NEW_COMMAND,  NULL};
#endif

const Command *command_find(const char *name) {
    for (size_t i = 0; COMMANDS[i]; i++)
        if (strcmp(COMMANDS[i]->name, name) == 0)
            return COMMANDS[i];
#ifdef PETRI_PICTURES
    if (strcmp(COMPLETE_COMMAND.name, name) == 0)
        return &COMPLETE_COMMAND;
#endif
    return NULL;
}
