#!/bin/sh
# neovim.sh: Neovim's LSP client with petri lsp: diagnostics, completion and hover. Skipped without nvim.
# usage: tests/lsp/neovim.sh PATH-OF-PETRI

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
command -v nvim >/dev/null || {
    echo "skipped: nvim is not installed (Debian: neovim)"
    exit 77
}
scratch
export HOME="$work" XDG_CONFIG_HOME="$work" XDG_DATA_HOME="$work" XDG_STATE_HOME="$work" XDG_CACHE_HOME="$work"
printf 'let speed=coz(1)\n!particle \n!n a=spe\n' >script.fl
cat >session.lua <<END
local function write(name, lines)
    vim.fn.writefile(lines, name)
end
vim.cmd('edit script.fl')
local client = vim.lsp.start_client({ name = 'petri', cmd = { [[$petri]], 'lsp' } })
vim.lsp.buf_attach_client(0, client)
vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end, 10)
write('diagnostics', vim.tbl_map(function(d)
    return d.lnum .. ':' .. d.col .. ' ' .. d.message:gsub('\n', ' ')
end, vim.diagnostic.get(0)))
local function ask(method, line, character)
    local params = { textDocument = vim.lsp.util.make_text_document_params(0),
        position = { line = line, character = character } }
    return (vim.lsp.buf_request_sync(0, method, params, 20000)[client] or {}).result
end
write('completion', vim.tbl_map(function(item) return item.label end, ask('textDocument/completion', 1, 10)))
write('names', vim.tbl_map(function(item) return item.label end, ask('textDocument/completion', 2, 8)))
write('hover', vim.split(ask('textDocument/hover', 1, 3).contents.value, '\n'))
vim.lsp.stop_client(client)
vim.cmd('qa!')
END
timeout 60 nvim --headless -u NONE -S session.lua >out 2>err </dev/null
status=$?
check "Neovim exits with 0" status_is 0
check "Neovim shows diagnostics" has diagnostics "0:10 unbound name 'coz' is null did you mean 'cos'?"
check "Neovim completes attributes" has completion "radius="
check "Neovim completes names" has names "speed"
check "Neovim shows help for a node" has hover "a particle"
finish
