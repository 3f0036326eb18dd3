// lsp.h: the language server, which is a separate program, petri-lsp, because it needs a JSON library.
#pragma once

#include "cli/cli.h"
#include "cli/options.h"

// Handles messages from standard input until the editor ends the session. Returns the exit status. For
// CommandContext.run_lsp.
int lsp_serve(const CommandContext *context, Options *options);
