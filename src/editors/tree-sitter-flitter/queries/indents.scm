; Indentation for Neovim.
[(suite) (parenthesised) (arguments) (parameters) (index)] @indent.begin
[")" "]"] @indent.branch
