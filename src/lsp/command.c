// command.c: `petri lsp`. The program petri contains only its help text; petri-lsp sets CommandContext.run_lsp.
#include "cli/options.h"

static int lsp_run(const CommandContext *context, Options *options) {
    if (!context->run_lsp) {
        message("cannot start the language server: this program is not petri-lsp");
        return STATUS_FAILED;
    }
    return context->run_lsp(context, options);
}

const Command LSP_COMMAND = {
    .name = "lsp",
    .operands = "",
    .summary = "start the language server (LSP) for editors",
    .details =
        "Implements the Language Server Protocol on standard input and output; editors start it. Reports the errors\n"
        "and warnings of petri check as you type, completes names, nodes, attributes and keys, shows help and values\n"
        "of constants, goes to definitions, renames, formats, and offers quick fixes. Evaluates the first frame, as\n"
        "petri check does, without drawing, printing or storing anything.",
    .examples = "  vim.lsp.start({ name = 'petri', cmd = { 'petri', 'lsp' } })    -- for Neovim\n",
    .options = FOR_LSP,
    .second_operand_error = "too many arguments: '%s'; the editor opens the scripts",
    .run = lsp_run,
};
