// lsp.h: the language server, which is a program of its own because it takes a library for JSON.
#ifndef PETRI_SRC_LSP_H
#define PETRI_SRC_LSP_H

#include "cli/cli.h"
#include "cli/options.h"

// Serves standard input until the editor says that it ends; returns the exit status. For CommandContext.serve.
int lsp_serve(const CommandContext *context, Options *options);

#endif
