#!/bin/sh
# terminal.sh: `petri view` in a terminal, under tmux: what the cells show, keys, the mouse, and that the terminal is
# given back as it was.
# usage: tests/view/terminal.sh PATH-OF-PETRI chafa|none sdl|none
# shellcheck source=tests/view/support.sh
. "$(dirname "$0")/support.sh"
# shellcheck source=tests/view/tmux.sh
. "$(dirname "$0")/tmux.sh"

# start [options] SCRIPT: a view in the terminal; `status N` is on the screen when it has ended.
start() {
    wipe
    view="$(quoted "$petri") view $* 2>err; code=\$?"
    type_keys "clear; echo before; stty -a >stty.before; $view; stty -a >stty.after; echo status \$code" Enter
}
# ended STATUS: it has ended so, the screen is as it was, and so is the terminal.
ended() {
    soon shows "status $1" && shows before && cmp -s stty.before stty.after &&
        [ "$(mux display-message -p -t view '#{alternate_on} #{cursor_flag} #{mouse_any_flag}')" = '0 1 0' ]
}

# Circles in the left half only. A picture of 640 by 384 fills 80 by 24 cells of 8 by 16.
cat >left.fl <<'END'
!window size=640;384 title='left'
    !canvas
        !rect size=640;384 color=0 fill=true
        for i in ..6
            for j in ..6
                !ellipse point=30+48*i;32+64*j radius=9 color=1 stroke=true stroke_width=3
END
start left.fl
check "the other screen is used" soon seen
check "the picture is there" soon filled 1 24 1 38
check "where nothing is drawn, nothing is" soon clear_of 1 24 42 80
check "all rows are used" soon filled 22 24 1 38
mux capture-pane -e -p -t view >coloured
check "in colour" grep -q "$(printf '\033')" coloured
type_keys h
check "h tells more" soon shows 'fps'
type_keys h
check "and less" soon hides 'fps'
type_keys Space
check "space pauses" soon shows 'paused'
type_keys s
check "s saves" soon shows 'saved left-'
check "a file" sh -c 'ls left-*.png >/dev/null'
type_keys Space
check "space goes on" soon hides 'paused'
mux resize-window -t view -x 40 -y 12
check "a smaller terminal has a smaller picture" soon clear_of 1 12 22 40
check "with all of it" soon filled 11 12 1 18
mux resize-window -t view -x 80 -y 24
check "and back" soon filled 22 24 20 38
type_keys q
check "q quits, and the terminal is as before" ended 0
check "nothing was said" [ ! -s err ]
start left.fl
started
type_keys Escape
check "Escape quits" ended 0

# Effects are drawn with the pixels that the cells show.
cat >blurred.fl <<'END'
!window size=640;384
    !blur radius=8
        !canvas
            !ellipse point=320;192 radius=150 fill=true color=1
END
start blurred.fl --frames 3 --debug
check "a blurred picture is shown" ended 0
check "in the size of the terminal" grep -q 'pictures shown, the last of 240 x 144 pixels' err
start left.fl
check "the start names the key that lists keys" soon shows 'h: keys'
check "for some seconds" soon hides 'h: keys'
type_keys q
check "q quits, with or without it" ended 0
start left.fl --quiet
started
check "--quiet does not name it" hides 'h: keys'
type_keys q
check "q quits as quietly" ended 0

# A high picture stands in the middle.
sed "s/size=640;384/size=192;384/; s/in ..6/in ..3/; s/left/high/" left.fl >high.fl
start high.fl
started
check "a high picture is there" soon filled 1 24 29 51
check "nothing beside it" soon clear_of 1 24 1 27
check "on either side" soon clear_of 1 24 54 80
type_keys q
check "q quits" ended 0

# Keys and the mouse reach the script.
cat >hands.fl <<'END'
!window size=640;384 title='hands'
    !pointer state=:mouse
    !key name=:x state=:x
    !canvas
        !rect size=640;384 color=0 fill=true
        if $:mouse
            !ellipse point=$:mouse*(640;384) radius=(40 if $(:mouse;:left) else 15) color=1 stroke=true stroke_width=3
        if $(:x;:toggled)
            !rect point=600;340 size=30;30 color=1 stroke=true stroke_width=3
END
start hands.fl
soon seen
type_keys -l "$(printf '\033[<35;20;5M')"
check "the pointer moves" soon filled 4 6 17 23
check "nothing elsewhere" soon clear_of 10 24 1 80
type_keys -l "$(printf '\033[<0;60;16M')"
check "a button is pressed" soon filled 13 15 54 66
type_keys -l "$(printf '\033[<0;60;16m')"
check "and let go" soon clear_of 10 13 50 70
type_keys x
check "a key reaches the script" soon filled 21 24 72 80
type_keys q
check "q quits" ended 0

# Parameters are chosen and changed, and the world goes on: what the script keeps of the key x stays.
cat >dots.fl <<'END'
let DOTS=DOTS or 2 -- 1..9 dots in a row
    HIGH=HIGH or 0.5 -- 0.1..1|0.1 height
    NAME=NAME or 'dots'
!window size=640;384 title=NAME
    !key name=:x state=:x
    !key name=:page_up state=:up
    !canvas
        !rect size=640;384 color=0 fill=true
        for i in ..DOTS
            !rect point=16+64*i;16 size=32;320*HIGH color=1 stroke=true stroke_width=3
        if $(:x;:toggled)
            !rect point=600;340 size=30;30 color=1 stroke=true stroke_width=3
        if $(:up;:toggled)
            !rect point=540;340 size=30;30 color=1 stroke=true stroke_width=3
END
start dots.fl -D HIGH=0.3
soon seen
type_keys x
check "two dots" soon filled 2 6 2 14
check "and no third" soon clear_of 1 10 17 80
check "and the mark" soon filled 21 24 75 80
type_keys Up
check "the first key tells what is chosen" soon shows 'DOTS = 2  (1..9)  dots in a row'
check "and changes nothing" soon clear_of 1 10 17 80
type_keys Up
check "up changes it" soon shows 'DOTS = 3  (1..9, default 2)  dots in a row'
check "which is seen" soon filled 2 6 18 22
type_keys + =
check "+ and = as well" soon shows 'DOTS = 5'
check "what the world keeps is kept" soon filled 21 24 75 80
type_keys Down -
check "down and - go back" soon shows 'DOTS = 3'
type_keys Space
soon shows 'paused'
type_keys Up
check "while paused it is seen as well" soon filled 2 6 26 30
type_keys Space
type_keys BSpace
check "backspace sets the default" soon shows 'DOTS = 2  (1..9)'
check "which is seen, too" soon clear_of 1 10 17 80
type_keys Tab
check "Tab chooses the next" soon shows 'HIGH = 0.3  (0.1..1|0.1, default 0.5)  height'
type_keys Up
check "by steps of its own" soon shows 'HIGH = 0.4'
type_keys NPage
check "page down takes ten, and stays in the range" soon shows 'HIGH = 0.1 '
type_keys ']' Up
check "what is no number is not changed" soon shows "NAME = 'dots': keys change numbers only"
type_keys '[' '['
check "[ chooses the one before" soon shows 'DOTS = 2'
type_keys PPage
check "a key that the script asks for is the script's" soon filled 21 24 68 72
check "and changes no parameter" soon shows 'DOTS = 2'
type_keys Up
soon shows 'DOTS = 3'
cp dots.fl dots.saved
sed 's/-- 1..9 dots/-- 1..20 spots/' dots.saved >dots.fl
check "a saved script keeps what was set" soon shows 'loaded the changed script'
type_keys h
check "h shows it, and the keys" soon shows 'DOTS = 3  (1..20, default 2)  spots in a row'
check "with theirs" soon shows 'tab parameter'
type_keys 0
check "0 sets the default" soon shows 'DOTS = 2  (1..20)'
type_keys q
check "q quits" ended 0
check "nothing was said of all that" [ ! -s err ]
start left.fl
started
type_keys Up
check "a script without parameters has none" soon shows 'the script has no parameters'
type_keys q
check "q quits" ended 0

# Mistakes are told over the picture, and the last good version goes on.
start left.fl
started
cp left.fl good.fl
echo '        !rect size=(' >>left.fl
check "a mistake is told" soon shows 'reload failed'
check "with its place" soon shows 'left.fl:'
check "the last good version is running" soon filled 12 24 1 38
sed 's/30+48/350+48/' good.fl >left.fl
check "the mended script is loaded" soon clear_of 1 24 1 38
check "the message goes" soon hides 'reload failed'
check "the picture is another" soon filled 1 24 42 80
type_keys q
check "q quits" ended 0
check "afterwards the mistake is on standard error" has err 'error:'
mv good.fl left.fl

# Warnings: a mark in a corner has their number, w lists them; they are those of the version that is running.
sed 's/stroke_width=3/stroke_with=3/' left.fl >warn.fl
start warn.fl
check "a corner shows that there is a warning" soon shows '1 warning: w'
check "in the first row" soon eval 'screen | head -n 1 | grep -q "1 warning: w *$"'
check "the picture is there all the same" soon filled 12 24 1 38
type_keys w
check "w lists it" soon shows "unknown attribute 'stroke_with'"
check "with its place" soon shows 'warn.fl:6'
check "the mark is not needed then" soon hides 'warning: w '
type_keys w
check "w hides the list" soon hides 'stroke_with'
check "and the mark is back" soon shows '1 warning: w'
sed '$d' warn.fl >other.fl && echo '                !elipse point=30+48*i;32+64*j radius=9 colr=1' >>other.fl && cp other.fl warn.fl
echo '        !rect size=9 fil=true clor=1' >>warn.fl
check "after a reload there are others" soon shows '3 warnings: w'
cp warn.fl other.fl
echo '        !rect size=(' >>warn.fl
check "a mistake comes first" soon shows 'reload failed'
check "without the mark" soon hides 'warnings: w'
cp other.fl warn.fl
check "the mended script has its own again" soon shows '3 warnings: w'
cp left.fl warn.fl
check "one without a fault has no mark" soon hides 'warnings: w'
type_keys w
check "w says so" soon shows 'No warnings'
type_keys q
check "q quits" ended 0
check "standard error has all of them" has err "'stroke_with'"

# It ends by itself, by signals, and by its own death: the terminal is as before.
start left.fl --frames 10
check "--frames ends it" ended 0
start left.fl --runtime 1 --lockstep
check "--runtime ends it" ended 0
cat >last.fl <<'END'
!window size=640;384
    !canvas
        !rect size=640;384 fill=true color=((0;1;0) if frame==4 else (1;0;0))
END
wipe
type_keys "clear; script -qec $(quoted "$(quoted "$petri") view --terminal --lockstep --frames 5 last.fl") typed >/dev/null; echo status \$?" Enter
check "a short run ends" soon shows 'status 0'
check "and its last frame was seen, however quick it was" grep -aq '8;2;0;255;0m\|8;5;46m' typed
wipe
type_keys "clear; echo before; $(quoted "$petri") view left.fl --frames 12; echo status \$?" Enter
check "on the screen that is there again one line sums up" soon shows 'petri: 12 frames in '
check "the rest of it is as before" soon shows 'before'
check "and it ended well" soon shows 'status 0'
wipe
type_keys "clear; $(quoted "$petri") view left.fl --frames 12 --quiet; echo status \$?" Enter
check "not with --quiet" soon shows 'status 0'
check "which says nothing" soon hides 'frames in'
if [ "${3:-sdl}" = none ]; then
    wipe
    type_keys "clear; DISPLAY=:77 $(quoted "$petri") view left.fl --frames 3; echo status \$?" Enter
    check "where there could be a window, it says how to get one" soon shows "'./dev build' adds windows"
fi
# Others may be at work on this machine: ours is that in this folder.
viewer() {
    for id in $(pgrep -f "^$petri view left.fl"); do
        [ "$(readlink "/proc/$id/cwd")" != "$work" ] || echo "$id"
    done
}
running() { [ -n "$(viewer)" ]; }
for signal in TERM:143 HUP:129 INT:130 ABRT:134 SEGV:139 QUIT:131; do
    start left.fl
    soon running && started
    kill "-${signal%:*}" "$(viewer)"
    check "SIG${signal%:*} gives the terminal back" ended "${signal#*:}"
done
start left.fl
started
type_keys C-c
check "Ctrl-C ends it" ended 130
start left.fl
started
type_keys C-z
check "Ctrl-Z gives the terminal to the shell" soon shows 'Stopped'
type_keys 'clear; fg' Enter
check "fg goes on" soon seen
check "with the picture" soon filled 1 24 1 38
type_keys q
soon shows 'left.fl'

# A display that is not there, as an old ssh session leaves it: the terminal it is, and soon.
for place in DISPLAY=:9999 DISPLAY=localhost:99.0 WAYLAND_DISPLAY=wayland-none; do
    type_keys "clear; env XDG_RUNTIME_DIR=. $place $(quoted "$petri") view left.fl 2>err; echo status \$?" Enter
    check "with $place it is the terminal" started
    check "which shows the picture" soon filled 22 24 1 38
    type_keys q
    check "q quits" soon shows 'status 0'
done

# Without a terminal there is nothing to show on.
"$petri" view --terminal left.fl >out 2>err </dev/null
check "no terminal fails" [ $? -eq 1 ]
check "with a message" has err "terminal"

finish
