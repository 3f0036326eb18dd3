-- petri.lua: Flitter scripts in Neovim 0.7 or later. `require('petri').setup()` starts `petri lsp` for each script, and
-- colours by tree-sitter if the parser is installed.
local M = {}

-- The commands of code lenses, which `vim.lsp.codelens.run()` executes: each runs petri in a terminal below.
local lenses = { 'petri.run', 'petri.render', 'petri.test' }

M.config = {
    name = 'petri', cmd = { 'petri', 'lsp' }, filetypes = { 'flitter' }, root_markers = { '.git' },
    init_options = { commands = lenses },
    on_attach = function(_, buffer)
        vim.api.nvim_create_autocmd({ 'BufEnter', 'InsertLeave', 'BufWritePost' },
            { buffer = buffer, callback = vim.lsp.codelens.refresh })
        vim.schedule(vim.lsp.codelens.refresh)
    end,
}

for _, name in ipairs(lenses) do
    vim.lsp.commands[name] = function(command)
        local file = vim.uri_to_fname(command.arguments[1])
        local words = { M.config.cmd[1], name:match('[^.]*$'), file }
        if name == 'petri.render' then
            vim.list_extend(words, { '-o', (file:gsub('%.fl$', '.png')) })
        end
        vim.cmd('botright new')
        vim.fn.termopen(words)
    end
end

local clients = {} -- by root folder, for Neovim 0.7

local function root_of(buffer)
    local folder = vim.fn.fnamemodify(vim.api.nvim_buf_get_name(buffer), ':p:h')
    local git = vim.fn.finddir('.git', vim.fn.escape(folder, ' ') .. ';')
    return git ~= '' and vim.fn.fnamemodify(git, ':p:h:h') or folder
end

local function attach(buffer)
    local config = vim.tbl_extend('force', M.config, { root_dir = root_of(buffer) })
    if vim.lsp.start then
        vim.lsp.start(config, { bufnr = buffer })
        return
    end
    local root = config.root_dir
    if not (clients[root] and vim.lsp.get_client_by_id(clients[root])) then
        clients[root] = vim.lsp.start_client(config)
    end
    if clients[root] then
        vim.lsp.buf_attach_client(buffer, clients[root])
    end
end

-- Colours the buffer by tree-sitter. Without the parser, the syntax file applies.
local function colour(buffer)
    if vim.treesitter.start then
        pcall(vim.treesitter.start, buffer, 'flitter')
    elseif pcall(vim.treesitter.require_language, 'flitter') then
        local parser = vim.treesitter.get_parser(buffer, 'flitter')
        vim.treesitter.highlighter.new(parser, {})
    end
end

-- Sets up the file type, the server and the colours. `options` replaces parts of `config`, such as `cmd`.
function M.setup(options)
    M.config = vim.tbl_extend('force', M.config, options or {})
    vim.api.nvim_create_autocmd({ 'BufRead', 'BufNewFile' }, { pattern = '*.fl', command = 'setfiletype flitter' })
    vim.api.nvim_create_autocmd('FileType', { pattern = 'flitter', callback = function()
        local buffer = vim.api.nvim_get_current_buf()
        colour(buffer)
        attach(buffer)
    end })
end

return M
