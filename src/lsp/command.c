// command.c: `petri lsp`, of which this program may know no more than what help tells.
#include "cli/options.h"

static int lsp_run(const CommandContext *context, Options *options) {
    if (!context->run_lsp) {
        message("petri-lsp serves editors, and this is not it");
        return STATUS_FAILED;
    }
    return context->run_lsp(context, options);
}

const Command LSP_COMMAND = {
    .name = "lsp",
    .operands = "",
    .summary = "serve editors: errors as you type, completion, help, renaming",
    .details =
        "Speaks the Language Server Protocol on standard input and output; an editor starts it. It tells what petri\n"
        "check tells, while one types, completes names, nodes, attributes and keys, shows what they are and what\n"
        "constants come to, goes to definitions, renames, lays out, and corrects what is nearly right. It makes\n"
        "the first frame, as petri check does, of which nothing is printed, drawn or stored.",
    .examples = "  vim.lsp.start({ name = 'petri', cmd = { 'petri', 'lsp' } })    -- for Neovim\n",
    .options = FOR_LSP,
    .second_operand_error = "'%s' is too much: an editor tells which scripts there are",
    .run = lsp_run,
};
