#!/bin/sh
# terminal.sh PETRI: `petri repl` on a terminal, provided by tmux: completion, Ctrl-C, history, blocks, and scripts that
# change during the session. Exits with 77 (skipped) if tmux is not installed.
# shellcheck disable=SC2016 # dollars are input for the prompt
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
if ! command -v tmux >/dev/null 2>&1; then
    echo "skipped: tmux is not installed (Debian package tmux)"
    exit 77
fi
work=$(mktemp -d) || exit 1
servers=0
server=petri-repl-$$-0
trap 't kill-server; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
cp -R "$here"/*.fl "$here"/lib "$work"
cd "$work" || exit 1
XDG_STATE_HOME=$work/state
export XDG_STATE_HOME
unset NO_COLOR TMUX
patience=600 # in tenths of a second; long, because the machine may be busy

t() { tmux -L "$server" -f /dev/null "$@" 2>/dev/null; }
screen() { t capture-pane -p; }

# start OPTIONS...: opens a new terminal that runs petri and then prints its exit status. Ctrl-C also reaches the shell
# and would terminate dash, so the shell ignores it.
start() {
    t kill-server
    servers=$((servers + 1)) # a new name, because the old server may still be exiting
    server=petri-repl-$$-$servers
    t new-session -d -x 120 -y 50 "trap : INT; LC_ALL=${locale:-C.UTF-8} $(quoted "$petri") repl $* 2>&1; echo left with \$?; exec sleep 1000"
    expect "the prompt appears (repl $*)" '> *$'
}

type_keys() { t send-keys "$@"; }

# expect NAME PATTERN: waits until a line on the screen matches.
expect() {
    tries=0
    until screen | grep -q -e "$2"; do
        tries=$((tries + 1))
        if [ $tries -ge $patience ]; then
            patience=200 # later checks are likely to fail as well
            failed=$((failed + 1))
            echo "FAIL $1: no line matches '$2' in"
            screen | sed -e 's/^/  | /' -e '/^  | $/d'
            return
        fi
        sleep 0.1
    done
    passed=$((passed + 1))
    echo "ok $1"
}

# refuse NAME PATTERN: checks that no line on the screen matches.
refuse() {
    if screen | grep -q -e "$2"; then
        failed=$((failed + 1))
        echo "FAIL $1: a line matches '$2'"
    else
        passed=$((passed + 1))
        echo "ok $1"
    fi
}

# leave NAME: types Ctrl-D after waiting for an empty prompt, because it would be lost before.
leave() {
    expect "$1: the prompt appears" '^[^ ]*> *$'
    type_keys C-d
    expect "$1" '^left with 0$'
}

start --color never cells.fl
if screen | grep -q 'built without libedit'; then
    echo "skipped: completion and history: petri was built without libedit"
    edits=no
else
    edits=yes
fi

if [ $edits = yes ]; then
    type_keys '.ste' Tab ' 2' Enter
    expect "a command is completed" '^petri> \.step 2$'
    expect "the completed command is executed" '^@1 time=0.01'
    type_keys '.re' Tab
    expect "Tab lists several completions" '\.record .*\.reset .*\.restore'
    type_keys C-u 'pola' Tab '(0)' Enter
    expect "the name of a built-in is completed" '^@1> polar(0)$'
    expect "the completed built-in is called" '^1;0$'
    type_keys 'COU' Tab '+1' Enter
    expect "a name of the script is completed" '^@1> COUNT+1$'
    expect "its value is printed, and the prompt appears" '^@1> *$'
    type_keys '!parti' Tab ' rad' Tab '1 cha' Tab
    expect "a node and its attributes are completed" '^@1> !particle radius=1 charge=$'
    type_keys C-u '$(:cells;1' '\;' Tab Enter
    expect "a key of the state is completed" '^@1> \$(:cells;1;:velocity)$'
    type_keys '.why :h' Tab
    expect "the id of a particle is completed" '^@1> \.why :home$'
    type_keys C-u '.move :h' Tab ' vel' Tab '1 pos' Tab 'pola' Tab
    expect "the id, attributes and words of .move are completed" '^@1> \.move :home velocity=1 position=polar$'
    type_keys C-u '.help !elec' Tab Enter
    expect "a topic is completed" '^!electrostatic (physics)'
    type_keys '.load bro' Tab Enter
    expect "a file is completed" 'broken.fl:1:11: error: '
fi

type_keys '.goto 20' Enter
expect ".goto goes to a frame" '^@20> *$'
type_keys '.s 2' Enter
expect "a short name steps" '^@22> *$'
type_keys Enter
expect "an empty line repeats the step" '^@24> *$'
type_keys 'frame' Enter Enter
expect "an empty line repeats the last step, not the last input" '^@26> *$'
type_keys C-l
type_keys '.run' Enter
expect ".run makes frames" '^@[0-9][0-9][0-9]'
type_keys C-c
expect "Ctrl-C stops .run" '^petri: interrupted after [0-9]* frames*'
type_keys C-l '.goto 100000000' Enter
expect ".goto shows its progress" '/[0-9]* frames, .* left'
type_keys C-c
expect "Ctrl-C stops .goto" '^petri: interrupted$'
type_keys C-l 'frame > 0' Enter
expect "the prompt continues after .goto was stopped" '^1$'
type_keys 'nonsense((' C-c
type_keys '6*7' Enter
expect "Ctrl-C at the prompt clears the line" '^42$'
refuse "a cleared line is not evaluated" 'error: .*nonsense'
type_keys 'func f(n)' Enter '    if n' Enter '        f(n-1)+f(n-1)' Enter '    else' Enter '        1' Enter Enter
type_keys 'f(5)' Enter
expect "a block of several lines is one statement" '^32$'
type_keys 'f(40)' Enter
expect "a long evaluation starts" '> f(40)$'
sleep 1
type_keys C-c
expect "Ctrl-C stops an evaluation" '^petri: interrupted$'
type_keys 'func g(x)' Enter '    x' C-c
type_keys '7*11' Enter
expect "Ctrl-C discards an unfinished block" '^77$'
type_keys 'let unusual=100+23' Enter
type_keys 'unusual' Enter
expect "a name defined at the prompt is kept" '^123$'
if [ $edits = yes ] && ! grep -q '^unusual$' "$XDG_STATE_HOME/petri/history"; then
    failed=$((failed + 1))
    echo "FAIL lines are in the history file at once, because a terminal may be closed"
fi
leave "Ctrl-D quits"

# A script whose frames need much time for physics. The time grows with the number of steps.
printf '!physics state=:many dimensions=2 time=time\n    for i in ..400\n        !particle id=i position=i;0\n    !gravity\n' \
    >heavy.fl
start --color never heavy.fl
type_keys '.step 3' Enter
expect ".step 3 makes three frames" '^@2 time='
type_keys C-l '.particles' Enter
expect "a long table is cut to the screen" '^-- 3[0-9][0-9] more particles; .\.particles all. shows all'
expect "the first line of a long table is still visible" '^:many: 400 particles'
type_keys C-l '.state' Enter
expect "a long state is cut to the screen" '^-- 7[0-9][0-9] more lines; .\.state all. shows all lines'
type_keys C-l '.particles 7' Enter
expect ".particles 7 notes how many rows were omitted" '^-- 393 more particles; '
expect ".particles 7 prints the seventh row" '^6 '
refuse ".particles 7 prints no eighth row" '^7 '
type_keys C-l '.resolution 1/1000000' Enter
expect ".resolution sets finer steps" '^resolution = 1e-06'
type_keys '.run' Enter
expect "a long frame starts" '\.run$'
sleep 1
type_keys C-c
expect "Ctrl-C stops a long frame" '^petri: interrupted after [0-9]* frames*'
type_keys '.energy' Enter
expect ".energy shows the system after an interrupted frame" '^:many: 400 particles'
type_keys C-l '.particles 1' Enter
expect ".particles shows the system after an interrupted frame" '^-- 399 more'
type_keys '.quit' Enter
expect ".quit quits after an interrupted frame" '^left with 0$'

if [ $edits = yes ]; then
    start --color never cells.fl
    type_keys 'func g(n)' Enter '    if n' Enter '        polr' Tab '(n)' Enter '    els' Enter '        1'
    expect "a block is typed on several lines" '^        1$'
    type_keys Up End 'e' Up End Left Left Left BSpace BSpace 'lar' Down Down Enter
    expect "Up moves to an earlier line of the block, which can be changed" '^        polar(n)$'
    expect "a second line of the block can be changed" '^    else$'
    type_keys Enter 'g(0)+41' Enter
    expect "Enter continues at the end of the block" '^42$'
    type_keys C-l Up Up
    expect "the history returns the whole block" '^petri> func g(n)$'
    expect "the recalled block includes its last line" '^        1$'
    type_keys Up Up Up Up Home C-k 'func h(n)' Enter Enter 'h(0)+76' Enter
    expect "a recalled block can be changed and executed" '^77$'
    type_keys C-l 'for i in ..3' Enter Tab 'if i' Enter Tab Tab 'i*11' Enter Enter
    expect "Tab indents at the start of a line" '^        i\*11$'
    expect "a block indented by Tab is executed" '^11;22$'
    type_keys C-l 'func q(i)' Enter
    expect "a block is begun" '^petri> func q(i)$'
    sleep 0.3
    type_keys 'hypot(i)'
    expect "the line after the head of a block is indented" '^    hypot(i)$'
    type_keys Enter
    sleep 0.3
    type_keys '+1'
    expect "a line of a block is indented like the line above" '^    +1$'
    type_keys Enter
    sleep 0.3
    type_keys Enter 'q(3)' Enter
    expect "an indented empty line ends the block" '^3;1$'
    type_keys '_*2' Enter
    expect "_ is the last value" '^6;2$'
    type_keys C-l 'let five=5' Down '+1' Enter 'five' Enter
    expect "Down in the last line does not change the line" '^6$'
    expect "the prompt appears after Down" '^petri> *$'
    type_keys C-l 'func k(n)' Enter '    n' M-Enter '    n' Up Up C-c '8*8' Enter
    expect "Ctrl-C in the middle of a block discards it" '^64$'
    leave "Ctrl-D quits after blocks were edited"
    start --color never cells.fl
    type_keys C-r 'func h'
    expect "Ctrl-R finds a block of an earlier session" 'func h(n)'
    type_keys Enter Enter 'h(0)' Enter
    expect "a block found by Ctrl-R is executed" '^1$'
    leave "Ctrl-D quits after a search"
fi

if [ $edits = yes ]; then
    start --color never cells.fl
    type_keys 'let unusual=100+23' Enter
    type_keys 'unusual' Enter
    expect "the value of a new name is printed" '^123$'
    leave "Ctrl-D quits before the next session"
    start --color never cells.fl
    type_keys Up Up Enter
    expect "the next session has the history" '^petri> let unusual=100+23$'
    type_keys C-r 'sual=1'
    expect "Ctrl-R shows the line that it found" 'unusual=100+23'
    type_keys Enter
    type_keys '55*2' Enter
    expect "the prompt continues after a search" '^110$'
    leave "Ctrl-D quits the next session"
    if [ "$(grep -c 'let unusual=100+23' "$XDG_STATE_HOME/petri/history")" -lt 3 ]; then
        failed=$((failed + 1))
        echo "FAIL lines found by searching are added to the history: $(cat "$XDG_STATE_HOME/petri/history")"
    fi
fi

start --color never cells.fl
type_keys '1+'
expect "a line is begun" '^petri> 1+$'
shell=$(t display-message -p '#{pane_pid}')
kill -TERM "$(cut -d ' ' -f 1 "/proc/$shell/task/$shell/children")"
expect "SIGTERM ends petri" 'left with 143$'
if ! stty -a <"$(t display-message -p '#{pane_tty}')" | grep -q '[^-]icanon'; then
    failed=$((failed + 1))
    echo "FAIL the terminal's settings are restored when a signal ends petri"
fi

printf '!counter state=:n rate=60\n!shape size=1\n' >edited.fl
start --color never edited.fl
type_keys '.step 5' Enter
expect "frames of a script that will be edited are made" '^@4 '
printf '!counter state=:n rate=60\nlet SIZE=2\n!shape size=SIZE\n' >edited.fl
expect "a change of the script is noted" '^-- edited.fl changed: 2 lines added, 1 removed (SIZE)'
type_keys '.step' Enter
expect ".step reloads the changed script" '^-- edited.fl reloaded'
type_keys '.tree shape' Enter
expect "the changed script is running" '^!shape size=2$'
type_keys '$:n' Enter
expect "reloading keeps the state" '^5$'
printf '!shape size=\n' >edited.fl
expect "a change with an error is noted" '^-- edited.fl changed: 1 line added, 3 removed'
type_keys '.step 2' Enter
expect "the error is reported on reload" 'edited.fl:1:13: error: '
expect "the previous script continues" '^-- the previous script continues'
type_keys '.tree shape' Enter '7777-1' Enter
expect "the prompt returns after the error" '^7776$'
if [ "$(screen | grep -c '^!shape size=2$')" -ne 2 ]; then
    failed=$((failed + 1))
    echo "FAIL the previous script continues after the error"
    screen
fi
type_keys '.quit' Enter
expect ".quit quits" '^left with 0$'

start --color never cells.fl
t resize-window -x 50 -y 50
type_keys '.help .step' Enter '.help random' Enter
expect "help is wrapped at the terminal's width" '^    (r radius, m mass, q charge, v velocity of a$'
type_keys '.quit' Enter
expect ".quit quits in a narrow terminal" '^left with 0$'

locale=C
start --color always cells.fl
type_keys '.step 9' Enter '.plot $:ticks' Enter
expect ".plot uses ASCII in the C locale" '^ *1.33333 | *\*\*$'
type_keys '.show' Enter '4444+1' Enter
expect "the prompt returns after .show" '^4445$'
if screen | LC_ALL=C grep -q '[^ -~]'; then
    failed=$((failed + 1))
    echo "FAIL only ASCII is printed in the C locale"
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
