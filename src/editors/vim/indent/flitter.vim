" Indentation of Flitter scripts (petri): a block follows lines that need one; elif and else end it.
if exists('b:did_indent')
    finish
endif
let b:did_indent = 1
setlocal indentexpr=FlitterIndent() indentkeys=!^F,o,O,0=elif,0=else autoindent
let b:undo_indent = 'setlocal indentexpr< indentkeys< autoindent<'
if exists('*FlitterIndent')
    finish
endif

function FlitterIndent() abort
    let above = prevnonblank(v:lnum - 1)
    let text = substitute(getline(above), '\s*--.*$', '', '')
    let opens = text =~# '^\s*\%(if\|elif\|else\|for\|func\)\>' || text =~# '^\s*let\>.*=$' ? 1 : 0
    " `elif` and `else` are below the last `if` or `elif` that is less indented than the block above.
    if getline(v:lnum) =~# '^\s*\%(elif\|else\)\>'
        let at = above
        while at > 0 && (indent(at) >= indent(above) + opens || getline(at) !~# '^\s*\%(if\|elif\)\>')
            let at = prevnonblank(at - 1)
        endwhile
        return at > 0 ? indent(at) : -1
    endif
    " Indentation has a meaning, so that of a line with text is kept.
    if getline(v:lnum) =~# '\S'
        return -1
    endif
    return above > 0 ? indent(above) + opens * shiftwidth() : 0
endfunction
