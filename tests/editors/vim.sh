#!/bin/sh
# vim.sh: tests the syntax file and the ftplugin in Neovim. Skipped without Neovim.
# usage: tests/editors/vim.sh PATH-OF-PETRI SYNTAX-FILE

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
syntax=$(realpath "$2")
command -v nvim >/dev/null || {
    echo "skipped: nvim is not installed (Debian: neovim)"
    exit 77
}
scratch
export HOME="$work"
PATH=$(dirname "$petri"):$PATH
mkdir -p vimfiles/syntax
cp "$syntax" vimfiles/syntax/
cp -r "$root/src/editors/vim/ftplugin" "$root/src/editors/vim/ftdetect" "$root/src/editors/vim/indent" vimfiles/
mkdir samples
cp "$root"/samples/*.fl "$root"/tests/golden/*.fl samples
cat >script.fl <<'END'
let in2=sin(1:30) -- it
for i in ..3
    !particle id=:x #t y=beat z='a\n' w=!other v=func(x) x
%include "f.fl"
END
cat >session.vim <<'END'
set runtimepath^=vimfiles
filetype plugin indent on
syntax on
edit script.fl
let words = [['let', 1, 1], ['in2', 1, 5], ['=', 1, 8], ['sin', 1, 9], ['1:30', 1, 13], ['--', 1, 19], ['for', 2, 1],
    \ ['in', 2, 7], ['..', 2, 10], ['!particle', 3, 5], ['id=', 3, 15], [':x', 3, 18], ['#t', 3, 21], ['beat', 3, 26],
    \ ['string', 3, 33], ['escape', 3, 35], ['!other', 3, 41], ['func', 3, 50], ['%include', 4, 1]]
call writefile(map(words, 'v:val[0] . " " . synIDattr(synID(v:val[1], v:val[2], 1), "name")'), 'classes')
call writefile([&filetype, &shiftwidth, &commentstring, &formatprg], 'settings')
normal gggqG
call writefile(getline(1, '$'), 'formatted')
silent! make!
call writefile(map(getqflist(), 'v:val.lnum . ":" . v:val.col . " " . v:val.type . " " . v:val.text'), 'faults')
enew!
setfiletype flitter
exe "normal ifor i in ..3  -- three\<CR>!n\<CR>if i  -- yes\<CR>!a\<CR>for k in ..2\<CR>!b\<CR>elif k\<CR>!c\<CR>else\<CR>!d"
exe "normal Go\<C-U>let a=\<CR>1\<CR>\<C-U>func f(x)\<CR>x\<CR>\<C-U>let b=2\<CR>!e"
call writefile(getline(1, '$'), 'typed')
for file in glob('samples/*.fl', 0, 1)
    exe 'edit! ' . file
    normal gg=G
    silent write
endfor
qa!
END
timeout 60 nvim --headless -u NONE -S session.vim >out 2>err </dev/null
status=$?
cat >wanted <<'END'
let flitterKeyword
in2 flitterAttribute
= flitterOperator
sin flitterFunction
1:30 flitterNumber
-- flitterComment
for flitterKeyword
in flitterKeyword
.. flitterOperator
!particle flitterNode
id= flitterAttribute
:x flitterSymbol
#t flitterTag
beat flitterValue
string flitterString
escape flitterEscape
!other flitterOtherNode
func flitterKeyword
%include flitterKeyword
END
cat >expected <<'END'
for i in ..3  -- three
    !n
    if i  -- yes
        !a
        for k in ..2
            !b
    elif k
        !c
    else
        !d
let a=
    1
func f(x)
    x
let b=2
!e
END
check "lines are indented while they are typed" diff expected typed
changed=$(cd samples && for file in *.fl; do
    cmp -s "$file" "$root/samples/$file" || cmp -s "$file" "$root/tests/golden/$file" || echo "$file"
done)
check "indenting scripts again changes none" [ -z "$changed" ]
check "each token has the expected class" diff wanted classes
check "the ftplugin sets the options for Flitter" [ "$(tr '\n' '|' <settings)" = "flitter|4|-- %s|petri fmt -|" ]
check ":make lists the messages of petri check" has faults "4:10 w cannot include"
check "gq formats a script with petri fmt" [ "$(head -n 1 formatted)" = "let in2=sin(1:30)  -- it" ]
finish
