#!/bin/sh
# neovim.sh: tests the module `petri` and the tree-sitter grammar in Neovim. Skipped without Neovim.
# usage: tests/editors/neovim.sh PATH-OF-PETRI HIGHLIGHTS

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
highlights=$(realpath "$2")
command -v nvim >/dev/null || {
    echo "skipped: nvim is not installed (Debian: neovim)"
    exit 77
}
scratch
export HOME="$work" XDG_CONFIG_HOME="$work" XDG_DATA_HOME="$work" XDG_STATE_HOME="$work" XDG_CACHE_HOME="$work"
grammar=$root/src/editors/tree-sitter-flitter
mkdir -p site/parser site/queries/flitter
cp -r "$root/src/editors/neovim/." site/
cp "$grammar"/queries/*.scm "$highlights" site/queries/flitter/
${CC:-cc} -shared -fPIC -I "$grammar/src" "$grammar/src/parser.c" "$grammar/src/scanner.c" -o site/parser/flitter.so
printf 'let speed=coz(1)\n!particle x=speed\n' >script.fl
cat >session.lua <<END
vim.opt.runtimepath:append('site')
local petri = require('petri')
petri.setup({ cmd = { [[$petri]], 'lsp' } })
vim.cmd('edit script.fl')
vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end, 10)
local lines = { vim.bo.filetype, vim.diagnostic.get(0)[1].message:match('[^\n]*'),
    tostring(vim.treesitter.highlighter.active[vim.api.nvim_get_current_buf()] ~= nil) }
local tree = vim.treesitter.get_parser(0, 'flitter'):parse()[1]
for _, name in ipairs({ 'highlights', 'folds' }) do
    local query = (vim.treesitter.query.get or vim.treesitter.get_query)('flitter', name)
    for id, node in query:iter_captures(tree:root(), 0, 0, -1) do
        local line, column = node:range()
        table.insert(lines, query.captures[id] .. ' ' .. line .. ':' .. column)
    end
end
table.insert(lines, dofile('site/lsp/petri.lua').cmd[2]) -- for Neovim 0.11
vim.fn.writefile(lines, 'out')
vim.cmd('qa!')
END
timeout 60 nvim --headless -u NONE -S session.lua >err 2>&1 </dev/null
status=$?
check "Neovim exits with 0" status_is 0
check "the file type is set, the server runs and the parser colours the script" \
    [ "$(head -n 3 out | tr '\n' '|')" = "flitter|unbound name 'coz' is null|true|" ]
check "the queries find a node" has out "tag 1:0"
check "the queries find an attribute" has out "attribute 1:10"
check "vim.lsp.enable has a configuration" [ "$(tail -n 1 out)" = lsp ]
# The code lens "run" starts a terminal, whose first lines are the output of the script.
printf '!print a=1\nlet b=debug("from the lens")\n' >lens.fl
cat >lens.lua <<END
vim.opt.runtimepath:append('site')
require('petri').setup({ cmd = { [[$petri]], 'lsp' } })
vim.cmd('edit lens.fl')
local titles, seen = {}, nil
vim.wait(20000, function() return #(vim.lsp.codelens.get(0) or {}) > 0 end, 10)
for _, lens in ipairs(vim.lsp.codelens.get(0)) do table.insert(titles, lens.command.title) end
local run = vim.lsp.codelens.get(0)[1].command
vim.lsp.commands[run.command](run)
vim.wait(20000, function()
    seen = table.concat(vim.api.nvim_buf_get_lines(0, 0, -1, false), ' '):match('from the lens')
    return seen
end, 10)
vim.fn.writefile({ table.concat(titles, ' '), seen or 'nothing' }, 'out')
vim.cmd('qa!')
END
timeout 60 nvim --headless -u NONE -S lens.lua >err 2>&1 </dev/null
check "a code lens runs the script in a terminal" [ "$(tr '\n' '|' <out)" = "run render|from the lens|" ]
# As installed and without a parser: Neovim finds the file type and the colours of Vim's syntax file, with and without
# setup(). `-u NORC` starts Neovim like an empty init.lua.
DESTDIR=$work/installed meson install -C "$(dirname "$(dirname "$petri")")" --no-rebuild --tags editors >log 2>&1 || cat log
share=$(dirname "$(dirname "$(find installed -path '*/nvim/site')")")
cat >colours.lua <<END
vim.cmd('edit script.fl')
local groups = { vim.bo.filetype, vim.bo.commentstring }
for _, column in ipairs({ 1, 5, 15 }) do
    table.insert(groups, vim.fn.synIDattr(vim.fn.synID(1, column, 1), 'name'))
end
vim.fn.writefile(groups, 'out')
vim.cmd('qa!')
END
for start in 'local none' "require('petri').setup({ cmd = { '$petri', 'lsp' } })"; do
    XDG_DATA_DIRS=$work/$share timeout 60 nvim --headless -u NORC -c "lua $start" -c 'luafile colours.lua' >err 2>&1 </dev/null
    check "scripts have colours as installed: $start" \
        [ "$(tr '\n' '|' <out)" = "flitter|-- %s|flitterKeyword|flitterAttribute|flitterNumber|" ]
done
finish
