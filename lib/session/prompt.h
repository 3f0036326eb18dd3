// prompt.h: statements retained by the prompt, in immutable lists that configurations share.
#pragma once

#include "session/unit.h"

// A statement of the prompt that is evaluated in each frame. Its parameters are the names visible to it: those set by
// the host, and the exports of the script and of earlier statements.
typedef struct PromptStatement {
    Unit *unit; // counted reference
    const char *text;
    const Ast *ast;
    const Program *program;
    bool adds_nodes; // true if its value is added to the tree
} PromptStatement;

typedef struct PromptList {
    uint32_t references;
    uint32_t count; // number of statements
    Names names;    // names set by the host, exports of the script, then exports of each statement
    PromptStatement statements[];
} PromptList;

typedef struct Prompt {
    Arena arena; // temporary data of the current input, such as an expression
} Prompt;

// Returns a list without statements. Its names are the parameters and exports of the script, or none if `script` is
// NULL. The parameters are the first names in `host_names`; those that follow were set after the script was loaded.
// Returns NULL if out of memory.
PromptList *prompt_list_new(Names host_names, const Program *script);
// Returns a copy of a list with one more statement, or NULL if out of memory.
PromptList *prompt_list_add(const PromptList *before, const PromptStatement *statement);
// Releases a reference. Frees the list when no reference is left. NULL is ignored.
void prompt_list_free(PromptList *list);
// Recompiles statements of a list for another script and stores them as a new list in *result. `choice` says which
// statements the new list keeps: all, only bindings, or none. Called within a protected call. If that is aborted, the
// caller frees the incomplete list in *result.
typedef enum PromptChoice { PROMPT_ALL, PROMPT_BINDINGS, PROMPT_NONE } PromptChoice;
void prompt_list_compile(PetriSession *session, const PromptList *list, const Program *script, PromptChoice choice,
                         PromptList **result);
