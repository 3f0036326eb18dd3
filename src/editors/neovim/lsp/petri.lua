-- petri.lua: the language server for `vim.lsp.enable('petri')` of Neovim 0.11 or later.
return require('petri').config
