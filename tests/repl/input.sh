#!/bin/sh
# input.sh PETRI: input that no one means to give at the prompt: an answer each, never a crash.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
scratch
cp -R "$here"/*.fl "$here"/lib .
LC_ALL=C.UTF-8
export LC_ALL

# The prompt's answer to the file in; status and output are kept.
petri() {
    timeout 100 "$petri" repl "$@" <in >out 2>&1
    status=$?
}
says() { has out "$1"; }

{ printf 'sum(0' && repeat 500000 ';1' && printf ')\n1+1\n'; } >in
petri
check "a line of 1 MB is evaluated" says 500000
check "what comes after it, too" says "
2"
check "1 MB is not echoed" [ "$(wc -c <out)" -lt 2000 ]
check "nothing is wrong with 1 MB" status_is 0
{ printf '0' && repeat 500000 ';1' && printf ';;\n1+1\n'; } >in
petri
check "a mistake at the end of 1 MB has its column" says "prompt:1:1000003: error: "
check "a mistake is seen in the exit status" status_is 1
{ printf '.' && repeat 1000000 'x' && printf '\n.step ' && repeat 100000 '9' && printf '\n'; } >in
petri
check "a command of 1 MB is none" says "there is no command '.xxx"
check "a number of 100000 digits is none" says "is no whole number"
check "messages stay short" [ "$(wc -c <out)" -lt 3000 ]
{ repeat 3000 '(' && printf '\n1+1\n'; } >in
petri
check "3000 open parentheses are one error" says "1000"
{ printf 'func f(x)\n' && repeat 2000 '    x
' && printf '\nf(1)\n'; } >in
petri
check "a suite of 2000 lines" status_is 0
printf '1\0002\n3\n\377\376\n4\n\r\n5\r\n' >in
petri
check "no text is an error" status_is 1
check "and the prompt goes on" says "
5"
: >in
petri cells.fl
check "no input at all is fine" status_is 0
printf 'for i in ..3' >in
petri
check "the end of the input in a statement is an error" status_is 1
check "which is told" says "expected an indented block"
printf '1+2' >in
petri
check "the last line needs no end" says "
3"

printf '1\n' >in
"$petri" repl --frames 3 <in >out 2>&1
status=$?
check "an unknown option" status_is 2
"$petri" repl a.fl b.fl <in >out 2>&1
status=$?
check "two scripts" status_is 2
"$petri" repl -D nothing <in >out 2>&1
status=$?
check "a definition without a value" status_is 2
petri --state missing.state cells.fl
check "a state file that is missing" says "cannot read 'missing.state'"
printf '.step 3\n.save here.state\n' >in
petri cells.fl
printf '.step\n' >in
petri --state here.state cells.fl
check "a session that begins with a state" says "@3 time=0.05"

# Endless work is stopped by a signal, and with it the session, for nobody types.
(
    printf '.until 0 --limit 100000000\n'
    sleep 3
) | {
    timeout -s INT 2 "$petri" repl cells.fl >out 2>&1
    echo $? >code
}
check "a signal stops .until" says "interrupted after"
(
    printf 'func f(n)\n    if n\n        f(n-1)+f(n-1)\n    else\n        1\n\nf(100)\n'
    sleep 3
) | timeout -s INT 2 "$petri" repl >out 2>&1
check "and an evaluation" says "petri: interrupted"
"$petri" repl <&- >out 2>&1
status=$?
check "closed standard input is the end" [ "$status" -le 1 ]
yes 1 | head -n 20000 | "$petri" repl 2>err | head -n 2 >out
check "a closed pipe ends it quietly" [ ! -s err ]

finish
