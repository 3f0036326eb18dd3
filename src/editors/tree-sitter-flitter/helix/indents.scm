; Indentation for Helix.
[(suite) (parenthesised) (arguments) (parameters) (index)] @indent
(suite) @extend
[")" "]"] @outdent
