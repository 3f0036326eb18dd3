#!/bin/sh
# listen.sh: `petri view --listen` and `petri send`: texts for a running view, under tmux.
# usage: tests/view/listen.sh PATH-OF-PETRI chafa|none

# shellcheck source=tests/view/support.sh
. "$(dirname "$0")/support.sh"
# shellcheck source=tests/view/tmux.sh
. "$here/tmux.sh"

send() {
    timeout 60 "$petri" send sock "$@" >out 2>err </dev/null
    status=$?
}
done_is() { tail -n 1 out | grep -Fq "{\"done\": $1"; }

cat >script.fl <<'END'
let SIZE=SIZE or 3          -- 1..9 how large
!counter state=:turns rate=SIZE
!window size=64;64
    !canvas
        !ellipse point=32;32 radius=SIZE fill=true color=1
END
type_keys "$(quoted "$petri") view --terminal --quiet --listen sock script.fl; echo status \$?" Enter
check "the view opens its socket" soon test -S sock
check "… which its owner alone may use" [ "$(stat -c %a sock)" = 600 ]
send '1+SIZE'
check "an expression is evaluated" has out '{"text": "4"}'
check "… and done" done_is true
check "… with status 0" status_is 0
send 'let a=coz(1)'
check "what is wrong is told as JSON" has out '"hint": "did you mean '"'cos'"'?"'
send 'let a=)'
check "what does not parse is not done" done_is false
check "… with status 1" status_is 1
send 'func twice(x)
    2*x
twice(SIZE)'
check "functions are kept" has out '{"text": "6"}'
send 'twice(5)'
check "… from one text to the next" has out '{"text": "10"}'
send '.set SIZE 7'
check ".set sets a parameter" done_is true
send 'SIZE'
check "… which the script then has" has out '{"text": "7"}'
send '.set SIZE'
send 'SIZE'
check "… or its default" has out '{"text": "3"}'
send '.set NOTHING 1'
check "what is no parameter is refused" done_is false
send '!n x=1'
check "nodes are added" has out '"nodes": 1'
send .drop
send 'twice(5)'
check ".drop forgets what was sent" lacks out '"10"'
send .reset
check ".reset starts anew" done_is true
# Each text makes one frame while the view is paused, but for .back.
number() { grep -o "\"$1\": *[\"0-9;.e-]*" out | tail -n 1 | sed 's/.*: *"*//; s/"$//'; }
type_keys Space
send 'frame;$:turns'
at=$(number text)
sleep_until_frames() { send frame && [ "$(number text)" -gt 20 ]; }
soon sleep_until_frames
send 'frame;$:turns'
at=$(number text)
check "the frame is told" [ "${at%%;*}" = "$(number frame)" ]
send '.back'
check ".back goes back a frame" [ "$(number frame)" = "${at%%;*}" ]
send 'frame;$:turns'
check "… to the same bits" [ "$(number text)" = "$at" ]
send '.back 11'
check ".back N goes back N frames" [ "$(number frame)" = $((${at%%;*} + 1 - 11)) ]
check "… and is done" done_is true
send '.back 1x'
check "what is no number is refused" done_is false
send '.back 100000'
check "beyond the start it goes to the first frame" [ "$(number frame)" = 0 ]
send '.back'
check "… before which there is nothing" has out "cannot go back: this is the start"
check "… with status 1" status_is 1
type_keys Space
send '1/0;"\x01é"'
check "text of any kind is JSON" sh -c 'python3 -c "import json, sys; [json.loads(line) for line in sys.stdin]" <out'
echo '2*SIZE' | "$petri" send sock - >out
check "- is standard input" has out '{"text": "6"}'
"$petri" view --terminal --quiet --listen sock script.fl >out 2>err </dev/null
status=$?
check "a socket in use is not taken" has err "cannot listen on sock: "
type_keys q
check "the view ends" soon shows "status 0"
check "… and takes its socket along" [ ! -e sock ]
send 1
check "without a view it is said so" has err "cannot reach a view at sock"
check "… with status 1" status_is 1
finish
