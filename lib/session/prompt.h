// prompt.h: the statements of the prompt. A list never changes: configurations share it, and another takes its place.
#ifndef PETRI_SESSION_PROMPT_H
#define PETRI_SESSION_PROMPT_H

#include "session/unit.h"

// A statement typed at the prompt that is evaluated in each frame. Its parameters are the names in sight of it: the
// exports of the script and of the statements before it.
typedef struct PromptStatement {
    Unit *unit; // a reference
    const char *text;
    const Ast *ast;
    const Program *program;
    bool adds_nodes; // its value is nodes for the tree
} PromptStatement;

typedef struct PromptList {
    uint32_t references;
    uint32_t count;
    Names names; // what the host gives the script, exports of the script, then of each statement
    PromptStatement statements[];
} PromptList;

typedef struct Prompt {
    Arena arena; // of one expression
} Prompt;

// The list of a script without statements; without names for NULL. NULL if memory is used up. `given` begins with the
// script's parameters.
PromptList *prompt_list_new(Names host_names, const Program *script);
// A list with one statement more, or NULL.
PromptList *prompt_list_add(const PromptList *list, const PromptStatement *statement);
// Gives a reference back; NULL is fine.
void prompt_list_free(PromptList *list);
// Compiles the statements of a list anew for another script, without those that add nodes or without all bindings if
// they are not wanted. Within a protected call; *made has what is made so far, to be freed if that call is given up.
typedef enum PromptChoice { PROMPT_ALL, PROMPT_BINDINGS, PROMPT_NONE } PromptChoice;
void prompt_list_compile(PetriSession *session, const PromptList *list, const Program *script, PromptChoice choice,
                         PromptList **result);

#endif
