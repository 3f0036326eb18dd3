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
cp -r "$root/src/editors/vim/ftplugin" "$root/src/editors/vim/ftdetect" vimfiles/
cat >script.fl <<'END'
let in2=sin(1:30) -- it
for i in ..3
    !particle id=:x #t y=beat z='a\n' w=!other v=func(x) x
%include "f.fl"
END
cat >session.vim <<'END'
set runtimepath^=vimfiles
filetype plugin on
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
check "each token has the expected class" diff wanted classes
check "the ftplugin sets the options for Flitter" [ "$(tr '\n' '|' <settings)" = "flitter|4|-- %s|petri fmt -|" ]
check ":make lists the messages of petri check" has faults "4:10 w cannot include"
check "gq formats a script with petri fmt" [ "$(head -n 1 formatted)" = "let in2=sin(1:30)  -- it" ]
finish
