; Indentation for Zed.
(suite) @indent
(_ "(" ")" @end) @indent
(_ "[" "]" @end) @indent
