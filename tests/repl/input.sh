#!/bin/sh
# input.sh PETRI: checks that very long, invalid, binary and interrupted input at the prompt is answered and never
# crashes petri.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
scratch
cp -R "$here"/*.fl "$here"/lib .
LC_ALL=C.UTF-8
export LC_ALL

# petri ARGUMENTS...: runs the prompt with the file `in` as input. Sets `status`; the output is in the file `out`.
petri() {
    timeout 500 "$petri" repl "$@" <in >out 2>&1
    status=$?
}
says() { has out "$1"; }

{ printf 'sum(0' && repeat 500000 ';1' && printf ')\n1+1\n'; } >in
petri
check "a line of 1 MB is evaluated" says 500000
check "the line after a line of 1 MB is evaluated" says "
2"
check "1 MB is not echoed" [ "$(wc -c <out)" -lt 2000 ]
check "a valid line of 1 MB leaves the exit status 0" status_is 0
{ printf '0' && repeat 500000 ';1' && printf ';;\n1+1\n'; } >in
petri
check "an error at the end of 1 MB is reported with its column" says "prompt:1:1000003: error: "
check "an error sets the exit status to 1" status_is 1
{ printf '.' && repeat 1000000 'x' && printf '\n.step ' && repeat 100000 '9' && printf '\n'; } >in
petri
check "a command name of 1 MB is unknown" says "no such command: '.xxx"
check "a number of 100000 digits is rejected" says "not an integer >= 1"
check "messages quote at most a part of long input" [ "$(wc -c <out)" -lt 3000 ]
{ repeat 3000 '(' && printf '\n1+1\n'; } >in
petri
check "3000 open parentheses cause one error" says "1000"
{ printf 'func f(x)\n' && repeat 2000 '    x
' && printf '\nf(1)\n'; } >in
petri
check "a block of 2000 lines is accepted" status_is 0
printf '1\0002\n3\n\377\376\n4\n\r\n5\r\n' >in
petri
check "a line with a NUL byte or invalid UTF-8 is an error" status_is 1
check "lines after invalid bytes are evaluated" says "
5"
: >in
petri cells.fl
check "empty input is not an error" status_is 0
printf 'for i in ..3' >in
petri
check "the end of the input within a statement is an error" status_is 1
check "the end of the input within a statement is reported" says "expected an indented block"
printf '1+2' >in
petri
check "the last line needs no line feed" says "
3"

printf '1\n' >in
"$petri" repl --frames 3 <in >out 2>&1
status=$?
check "an unknown option is an error" status_is 2
"$petri" repl a.fl b.fl <in >out 2>&1
status=$?
check "two scripts are an error" status_is 2
"$petri" repl -D nothing <in >out 2>&1
status=$?
check "a definition without a value is an error" status_is 2
petri --state missing.state cells.fl
check "a missing state file is reported" says "cannot read 'missing.state'"
printf '.step 3\n.save here.state\n' >in
petri cells.fl
printf '.step\n' >in
petri --state here.state cells.fl
check "--state continues from the saved state" says "@3 time=0.05"

# SIGINT stops long computations and, because the input is not a terminal, the session.
(
    printf '.until 0 --limit 100000000\n'
    sleep 3
) | {
    timeout -s INT 2 "$petri" repl cells.fl >out 2>&1
    echo $? >code
}
check "SIGINT stops .until" says "interrupted after"
(
    printf 'func f(n)\n    if n\n        f(n-1)+f(n-1)\n    else\n        1\n\nf(100)\n'
    sleep 3
) | timeout -s INT 2 "$petri" repl >out 2>&1
check "SIGINT stops an evaluation" says "petri: interrupted"
"$petri" repl <&- >out 2>&1
status=$?
check "closed standard input ends the session" [ "$status" -le 1 ]
yes 1 | head -n 20000 | "$petri" repl 2>err | head -n 2 >out
check "a closed output pipe ends the session without a message" [ ! -s err ]

finish
