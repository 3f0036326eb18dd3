#!/bin/sh
# terminal.sh PETRI: `petri repl` on a real terminal, which tmux gives: completion, Ctrl-C, history, lines that belong
# together, a script that is changed meanwhile. Exit status 77 (skipped) where there is no tmux.
# shellcheck disable=SC2016 # dollars are for the prompt
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
if ! command -v tmux >/dev/null 2>&1; then
    echo "skipped: there is no tmux (Debian package tmux)"
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
patience=600 # tenths of a second, for the machine may have much else to do

t() { tmux -L "$server" -f /dev/null "$@" 2>/dev/null; }
screen() { t capture-pane -p; }

# start OPTIONS...: a fresh terminal with petri in it, which tells its exit status when it is done. Ctrl-C reaches the
# shell as well: dash would go with it, and is the shell of an ordinary user.
start() {
    t kill-server
    servers=$((servers + 1)) # a new one: the old one may take its time to go
    server=petri-repl-$$-$servers
    t new-session -d -x 120 -y 50 "trap : INT; LC_ALL=${locale:-C.UTF-8} $(quoted "$petri") repl $* 2>&1; echo left with \$?; exec sleep 1000"
    expect "the prompt comes ($*)" '> *$'
}

type_keys() { t send-keys "$@"; }

# expect NAME PATTERN: the screen must come to hold a line like this.
expect() {
    tries=0
    until screen | grep -q -e "$2"; do
        tries=$((tries + 1))
        if [ $tries -ge $patience ]; then
            patience=200 # what comes after is mostly in vain, too
            failed=$((failed + 1))
            echo "FAIL $1: no line like '$2' in"
            screen | sed -e 's/^/  | /' -e '/^  | $/d'
            return
        fi
        sleep 0.1
    done
    passed=$((passed + 1))
    echo "ok $1"
}

# refuse NAME PATTERN: no line like this must be there.
refuse() {
    if screen | grep -q -e "$2"; then
        failed=$((failed + 1))
        echo "FAIL $1: a line like '$2'"
    else
        passed=$((passed + 1))
        echo "ok $1"
    fi
}

# leave NAME: Ctrl-D at an empty prompt; before there is one, it would be lost.
leave() {
    expect "$1: the prompt" '^[^ ]*> *$'
    type_keys C-d
    expect "$1" '^left with 0$'
}

start --color never cells.fl
if screen | grep -q 'built without libedit'; then
    echo "skipped: completion and history, for this petri was built without libedit"
    edits=no
else
    edits=yes
fi

if [ $edits = yes ]; then
    type_keys '.ste' Tab ' 2' Enter
    expect "a command is completed" '^petri> \.step 2$'
    expect "and done" '^@1 time=0.01'
    type_keys '.re' Tab
    expect "what may follow is listed" '\.record .*\.reset .*\.restore'
    type_keys C-u 'pola' Tab '(0)' Enter
    expect "a built-in is completed" '^@1> polar(0)$'
    expect "and called" '^1;0$'
    type_keys 'COU' Tab '+1' Enter
    expect "a name of the script is completed" '^@1> COUNT+1$'
    type_keys '!parti' Tab ' rad' Tab '1 cha' Tab
    expect "a node and its attributes are completed" '^@1> !particle radius=1 charge=$'
    type_keys C-u '$(:cells;1' '\;' Tab Enter
    expect "a key of the state is completed" '^@1> \$(:cells;1;:velocity)$'
    type_keys '.help !elec' Tab Enter
    expect "a topic is completed" '^!electrostatic (physics)'
    type_keys '.load bro' Tab Enter
    expect "a file is completed" 'broken.fl:1:11: error: '
fi

type_keys '.run' Enter
expect "frames are made" "^> 'four'"
type_keys C-c
expect "Ctrl-C stops .run" '^petri: interrupted after [0-9]* frames*'
type_keys C-l '.goto 100000000' Enter
expect ".goto shows how far it is" '/[0-9]* frames, .* left'
type_keys C-c
expect "Ctrl-C stops .goto" '^petri: interrupted$'
type_keys C-l 'frame > 0' Enter
expect "which goes on from there" '^1$'
type_keys 'nonsense((' C-c
type_keys '6*7' Enter
expect "Ctrl-C at the prompt clears the line" '^42$'
refuse "and does nothing with it" 'error: .*nonsense'
type_keys 'func f(n)' Enter '    if n' Enter '        f(n-1)+f(n-1)' Enter '    else' Enter '        1' Enter Enter
type_keys 'f(5)' Enter
expect "lines that belong together" '^32$'
type_keys 'f(40)' Enter
expect "an endless evaluation" '> f(40)$'
sleep 1
type_keys C-c
expect "Ctrl-C stops an evaluation" '^petri: interrupted$'
type_keys 'func g(x)' Enter '    x' C-c
type_keys '7*11' Enter
expect "Ctrl-C gives up lines begun" '^77$'
type_keys 'let unusual=100+23' Enter
type_keys 'unusual' Enter
expect "a name is kept" '^123$'
if [ $edits = yes ] && ! grep -q '^unusual$' "$XDG_STATE_HOME/petri/history"; then
    failed=$((failed + 1))
    echo "FAIL lines are in the history at once, for a terminal may be closed"
fi
leave "Ctrl-D leaves"

# A frame of this one takes some time in its physics, the more the finer its steps.
printf '!physics state=:many dimensions=2 time=time\n    for i in ..400\n        !particle id=i position=i;0\n    !gravity\n' \
    >heavy.fl
start --color never heavy.fl
type_keys '.step 3' Enter
expect "three frames" '^@2 time='
type_keys C-l '.particles' Enter
expect "a long table ends after a screen" '^-- 3[0-9][0-9] more; \.particles all shows all'
expect "with its first line still there" '^:many: 400 particles'
type_keys C-l '.state' Enter
expect "so does the state" '^-- 7[0-9][0-9] more lines; \.state all shows all'
type_keys C-l '.particles 7' Enter
expect "or after as many lines as one likes" '^-- 393 more; '
expect "the last of which is" '^6 '
refuse "and nothing more" '^7 '
type_keys C-l '.resolution 1/1000000' Enter
expect "finer steps" '^resolution = 1e-06'
type_keys '.run' Enter
expect "a frame that takes long" '\.run$'
sleep 1
type_keys C-c
expect "Ctrl-C stops it" '^petri: interrupted after [0-9]* frames*'
type_keys '.energy' Enter
expect ".energy shows the system" '^:many: 400 particles'
type_keys C-l '.particles 1' Enter
expect ".particles, too" '^-- 399 more'
type_keys '.quit' Enter
expect "and on it goes" '^left with 0$'

if [ $edits = yes ]; then
    start --color never cells.fl
    type_keys 'func g(n)' Enter '    if n' Enter '        polr' Tab '(n)' Enter '    els' Enter '        1'
    expect "lines of a block" '^        1$'
    type_keys Up End 'e' Up End Left Left Left BSpace BSpace 'lar' Down Down Enter
    expect "Up goes to an earlier line, which can be changed" '^        polar(n)$'
    expect "as well as another" '^    else$'
    type_keys Enter 'g(0)+41' Enter
    expect "Enter goes on at the end" '^42$'
    type_keys C-l Up Up
    expect "the history has the whole block" '^petri> func g(n)$'
    expect "to its last line" '^        1$'
    type_keys Up Up Up Up Home C-k 'func h(n)' Enter Enter 'h(0)+76' Enter
    expect "which can be changed and taken again" '^77$'
    type_keys C-l 'for i in ..3' Enter Tab 'if i' Enter Tab Tab 'i*11' Enter Enter
    expect "Tab indents where there is no word yet" '^        i\*11$'
    expect "and the block is taken" '^11;22$'
    type_keys C-l 'let five=5' Down '+1' Enter 'five' Enter
    expect "Down below the last line leaves the line alone" '^6$'
    expect "the prompt after it" '^petri> *$'
    type_keys C-l 'func k(n)' Enter '    n' M-Enter '    n' Up Up C-c '8*8' Enter
    expect "Ctrl-C in the middle of a block gives it up" '^64$'
    leave "and leaves"
    start --color never cells.fl
    type_keys C-r 'func h'
    expect "a block of an earlier session" 'func h(n)'
    type_keys Enter Enter 'h(0)' Enter
    expect "can be found and taken" '^1$'
    leave "and leaves again"
fi

if [ $edits = yes ]; then
    start --color never cells.fl
    type_keys 'let unusual=100+23' Enter
    type_keys 'unusual' Enter
    expect "its value" '^123$'
    leave "what the next session will find"
    start --color never cells.fl
    type_keys Up Up Enter
    expect "history is there in the next session" '^petri> let unusual=100+23$'
    type_keys C-r 'sual=1'
    expect "what is searched" 'unusual=100+23'
    type_keys Enter
    type_keys '55*2' Enter
    expect "the line that was found is taken" '^110$'
    leave "and can be searched"
    if [ "$(grep -c 'let unusual=100+23' "$XDG_STATE_HOME/petri/history")" -lt 3 ]; then
        failed=$((failed + 1))
        echo "FAIL searching in the history: $(cat "$XDG_STATE_HOME/petri/history")"
    fi
fi

start --color never cells.fl
type_keys '1+'
expect "a line begun" '^petri> 1+$'
shell=$(t display-message -p '#{pane_pid}')
kill -TERM "$(cut -d ' ' -f 1 "/proc/$shell/task/$shell/children")"
expect "a signal ends petri" 'left with 143$'
if ! stty -a <"$(t display-message -p '#{pane_tty}')" | grep -q '[^-]icanon'; then
    failed=$((failed + 1))
    echo "FAIL the terminal is as it was when a signal has ended petri"
fi

printf '!counter state=:n rate=60\n!shape size=1\n' >edited.fl
start --color never edited.fl
type_keys '.step 5' Enter
expect "a script that will be edited" '^@4 '
printf '!counter state=:n rate=60\nlet SIZE=2\n!shape size=SIZE\n' >edited.fl
expect "the change is noticed" '^-- edited.fl was changed: 2 lines added, 1 removed (SIZE)'
type_keys '.step' Enter
expect "and the script loaded anew" '^-- edited.fl is loaded anew'
type_keys '.tree shape' Enter
expect "and counts" '^!shape size=2$'
type_keys '$:n' Enter
expect "while the state stays" '^5$'
printf '!shape size=\n' >edited.fl
expect "a mistake is noticed" '^-- edited.fl was changed: 1 line added, 3 removed'
type_keys '.step 2' Enter
expect "and told" 'edited.fl:1:13: error: '
expect "the script as it was goes on" '^-- the script as it was goes on'
type_keys '.tree shape' Enter '7777-1' Enter
expect "the prompt comes back" '^7776$'
if [ "$(screen | grep -c '^!shape size=2$')" -ne 2 ]; then
    failed=$((failed + 1))
    echo "FAIL the old script does not go on"
    screen
fi
type_keys '.quit' Enter
expect ".quit leaves" '^left with 0$'

start --color never cells.fl
t resize-window -x 50 -y 50
type_keys '.help .step' Enter '.help random' Enter
expect "help is wrapped at the terminal's width" '^    a pair: r radius, m mass, q charge, v$'
type_keys '.quit' Enter
expect ".quit leaves the narrow terminal" '^left with 0$'

locale=C
start --color always cells.fl
type_keys '.step 9' Enter '.plot $:ticks' Enter
expect "a plot in ASCII" '^ *1.33333 | *\*\*$'
type_keys '.show' Enter '4444+1' Enter
expect "a picture, or why not" '^4445$'
if screen | LC_ALL=C grep -q '[^ -~]'; then
    failed=$((failed + 1))
    echo "FAIL there are other characters than ASCII where the locale has none"
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
