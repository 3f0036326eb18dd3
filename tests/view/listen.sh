#!/bin/sh
# listen.sh: tests of `petri view --listen` and `petri view --send`, which evaluate text in a running view, under tmux.
# usage: tests/view/listen.sh PATH-OF-PETRI chafa|none

# shellcheck source=tests/view/support.sh
. "$(dirname "$0")/support.sh"
# shellcheck source=tests/view/tmux.sh
. "$here/tmux.sh"

send() {
    timeout 60 "$petri" view --send sock "$@" >out 2>err </dev/null
    status=$?
}
done_is() { tail -n 1 out | grep -Fq "{\"done\": $1"; }

cat >script.fl <<'END'
let SIZE=SIZE or 3          -- 1..9 how large
!counter state=:turns rate=SIZE
!physics state=:p dimensions=2 time=time
    !particle id=:dot
!window size=64;64
    !canvas
        !ellipse point=32;32 radius=SIZE fill=true color=1
END
type_keys "$(quoted "$petri") view --terminal --quiet --listen sock script.fl; echo status \$?" Enter
check "the view opens its socket" soon test -S sock
check "only the owner can use the socket" [ "$(stat -c %a sock)" = 600 ]
send '1+SIZE'
check "an expression is evaluated" has out '{"text": "4"}'
check "an expression reports that it is done" done_is true
check "an expression exits with status 0" status_is 0
send 'let a=coz(1)'
check "an error is reported as JSON" has out '"hint": "did you mean '"'cos'"'?"'
send 'let a=)'
check "a syntax error reports that it is not done" done_is false
check "a syntax error exits with status 1" status_is 1
send 'func twice(x)
    2*x
twice(SIZE)'
check "a function is defined" has out '{"text": "6"}'
send 'twice(5)'
check "a later text can call the function" has out '{"text": "10"}'
send '.set SIZE 7'
check ".set sets a parameter" done_is true
send 'SIZE'
check "the script has the new value" has out '{"text": "7"}'
send '.set SIZE'
send 'SIZE'
check ".set without a value restores the default" has out '{"text": "3"}'
send '.set NOTHING 1'
check ".set of an unknown parameter fails" done_is false
send '!n x=1'
check "nodes are added" has out '"nodes": 1'
send .drop
send 'twice(5)'
check ".drop removes what was sent" lacks out '"10"'
send .reset
check ".reset reports that it is done" done_is true
# While the view is paused, each text that is sent computes one frame, except .back.
number() { grep -o "\"$1\": *[\"0-9;.e-]*" out | tail -n 1 | sed 's/.*: *"*//; s/"$//'; }
type_keys Space
send 'frame;$:turns'
at=$(number text)
sleep_until_frames() { send frame && [ "$(number text)" -gt 20 ]; }
soon sleep_until_frames
send 'frame;$:turns'
at=$(number text)
check "the answer contains the frame number" [ "${at%%;*}" = "$(number frame)" ]
send '.back'
check ".back goes back a frame" [ "$(number frame)" = "${at%%;*}" ]
send 'frame;$:turns'
check ".back restores the same values" [ "$(number text)" = "$at" ]
send '.back 11'
check ".back N goes back N frames" [ "$(number frame)" = $((${at%%;*} + 1 - 11)) ]
check ".back N reports that it is done" done_is true
send '.back 1x'
check ".back without a number fails" done_is false
send '.back 100000'
check ".back beyond the start goes to the first frame" [ "$(number frame)" = 0 ]
send '.back'
check ".back at the start reports the reason" has out "cannot go back: this is the start"
check ".back at the start exits with status 1" status_is 1
send '.state turns'
check "a command of the prompt prints to the client" has out '{"text": "$:turns = '
check "a command of the prompt reports that it is done" done_is true
send '.parameters'
check ".parameters lists the parameters" has out '{"text": "SIZE  3  1..9  how large"}'
send '.why'
check "a command without its operand fails" has out '{"text": ".why needs the id of a particle"}'
send '.move :dot position=5;6'
check ".move moves a particle" done_is true
send '.back'
send '$(:p;:dot)'
check "a moved particle stays there, also after .back" has out '{"text": "5;6"}'
send '.move 77 position=1'
check ".move reports its errors" done_is false
send '.step 3'
check "a command that computes frames fails" has out '{"text": ".step works only in '"'petri repl'"
check "a command that fails exits with status 1" status_is 1
type_keys Space
send '1/0;"\x01é"'
check "any output is valid JSON" sh -c 'python3 -c "import json, sys; [json.loads(line) for line in sys.stdin]" <out'
echo '2*SIZE' | "$petri" view --send sock - >out
check "- reads standard input" has out '{"text": "6"}'
"$petri" view --terminal --quiet --listen sock script.fl >out 2>err </dev/null
status=$?
check "a second view does not take over the socket" has err "cannot listen on sock: "
# A client that connects and sends nothing.
python3 -c '
import socket, time
idle = socket.socket(socket.AF_UNIX)
idle.connect("sock")
open("connected", "w").close()
time.sleep(100)' &
idle=$!
soon test -e connected
timeout 60 "$petri" send sock '2*SIZE' >out
check "a silent client does not keep others out" has out '{"text": "6"}'
kill $idle
type_keys q
check "the view ends" soon shows "status 0"
check "the view removes its socket" [ ! -e sock ]
# A view that crashes while it answers.
python3 -c '
import socket
view = socket.socket(socket.AF_UNIX)
view.bind("sock")
view.listen()
client = view.accept()[0]
while client.recv(1000):
    pass
client.send(b"{\"text\": \"4\"}\n{\"done\": tr")' &
soon test -S sock
send 1
check "what came of a cut answer is printed" has out '{"text": "4"}'
check "a cut answer is reported" has err "the view closed the connection before the end of its answer"
check "a cut answer exits with status 1" status_is 1
rm sock
send 1
check "send without a view reports it" has err "cannot reach a view at sock"
send ''
check "code may be empty" has err "cannot reach a view at sock"
check "send without a view exits with status 1" status_is 1
finish
