#!/bin/sh
# terminal.sh: tests of `petri view` in a terminal, under tmux: cells, keys, the mouse, and that the terminal is
# restored.
# usage: tests/view/terminal.sh PATH-OF-PETRI chafa|none sdl|none
# shellcheck source=tests/view/support.sh
. "$(dirname "$0")/support.sh"
# shellcheck source=tests/view/tmux.sh
. "$(dirname "$0")/tmux.sh"

# start [options] SCRIPT: opens a view in the terminal. After the view has ended, the screen shows `status N`.
start() {
    wipe
    view="$(quoted "$petri") view $* 2>err; code=\$?"
    type_keys "clear; echo before; stty -a >stty.before; $view; stty -a >stty.after; echo status \$code" Enter
}
# ended STATUS: succeeds if the view has ended with this status and has restored the screen and the terminal.
ended() {
    soon shows "status $1" && shows before && cmp -s stty.before stty.after &&
        [ "$(mux display-message -p -t view '#{alternate_on} #{cursor_flag} #{mouse_any_flag}')" = '0 1 0' ]
}

# Circles in the left half of the picture. A picture of 640 by 384 fills 80 by 24 cells of 8 by 16 pixels.
cat >left.fl <<'END'
!window size=640;384 title='left'
    !canvas
        !rect size=640;384 color=0 fill=true
        for i in ..6
            for j in ..6
                !ellipse point=30+48*i;32+64*j radius=9 color=1 stroke=true stroke_width=3
END
start left.fl
check "the alternate screen is used" soon seen
check "the picture is shown" soon filled 1 24 1 38
check "empty areas stay empty" soon clear_of 1 24 42 80
check "all rows are used" soon filled 22 24 1 38
mux capture-pane -e -p -t view >coloured
check "the picture is in colour" grep -q "$(printf '\033')" coloured
type_keys h
check "h shows the status" soon shows 'fps'
type_keys h
check "h hides the status" soon hides 'fps'
type_keys Space
check "space pauses" soon shows 'paused'
type_keys s
check "s reports the saved file" soon shows 'saved left-'
check "s saves a file" sh -c 'ls left-*.png >/dev/null'
type_keys Space
check "space resumes" soon hides 'paused'
mux resize-window -t view -x 40 -y 12
check "the picture shrinks with the terminal" soon clear_of 1 12 22 40
check "the whole picture is visible" soon filled 11 12 1 18
mux resize-window -t view -x 80 -y 24
check "the picture grows with the terminal" soon filled 22 24 20 38
type_keys q
check "q quits and restores the terminal" ended 0
check "nothing is written to standard error" [ ! -s err ]
start left.fl
started
type_keys Escape
check "Escape quits" ended 0

# Effects are computed at the resolution of the cells.
cat >blurred.fl <<'END'
!window size=640;384
    !blur radius=8
        !canvas
            !ellipse point=320;192 radius=150 fill=true color=1
END
start blurred.fl --frames 3 --debug
check "a blurred picture is shown" ended 0
check "it is drawn in the terminal's resolution" grep -q 'pictures shown, the last of 240 x 144 pixels' err
start left.fl
check "a notice names the key that lists keys" soon shows 'h: keys'
check "the notice disappears after some seconds" soon hides 'h: keys'
type_keys q
check "q quits without a message" ended 0
start left.fl --quiet
started
check "--quiet shows no notice" hides 'h: keys'
type_keys q
check "q quits with --quiet" ended 0

# A tall picture is centred.
sed "s/size=640;384/size=192;384/; s/in ..6/in ..3/; s/left/high/" left.fl >high.fl
start high.fl
started
check "a tall picture is centred" soon filled 1 24 29 51
check "the left side is empty" soon clear_of 1 24 1 27
check "the right side is empty" soon clear_of 1 24 54 80
type_keys q
check "q quits" ended 0

# Keys and the mouse are passed to the script.
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
check "other areas stay empty" soon clear_of 10 24 1 80
type_keys -l "$(printf '\033[<0;60;16M')"
check "a button press reaches the script" soon filled 13 15 54 66
type_keys -l "$(printf '\033[<0;60;16m')"
check "a button release reaches the script" soon clear_of 10 13 50 70
type_keys x
check "a key reaches the script" soon filled 21 24 72 80
type_keys q
check "q quits" ended 0

# Parameters are selected and changed while the script runs. The value of the key x in the state is kept.
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
check "the script starts with two dots" soon filled 2 6 2 14
check "there is no third dot" soon clear_of 1 10 17 80
check "the key's mark is shown" soon filled 21 24 75 80
type_keys Up
check "the first parameter key shows the selected parameter" soon shows 'DOTS = 2  (1..9)  dots in a row'
check "the first parameter key changes nothing" soon clear_of 1 10 17 80
type_keys Up
check "up increases the parameter" soon shows 'DOTS = 3  (1..9, default 2)  dots in a row'
check "the change is visible" soon filled 2 6 18 22
type_keys + =
check "+ and = increase the parameter" soon shows 'DOTS = 5'
check "the state is kept" soon filled 21 24 75 80
type_keys Down -
check "down and - decrease the parameter" soon shows 'DOTS = 3'
type_keys Space
soon shows 'paused'
type_keys Up
check "a change is visible while paused" soon filled 2 6 26 30
type_keys Space
type_keys BSpace
check "backspace restores the default" soon shows 'DOTS = 2  (1..9)'
check "the default is visible" soon clear_of 1 10 17 80
type_keys Tab
check "Tab selects the next parameter" soon shows 'HIGH = 0.3  (0.1..1|0.1, default 0.5)  height'
type_keys Up
check "the range's step is used" soon shows 'HIGH = 0.4'
type_keys NPage
check "page down takes ten steps, within the range" soon shows 'HIGH = 0.1 '
type_keys ']' Up
check "a parameter that is not a number is not changed" soon shows "NAME = 'dots': the keys change only numbers"
type_keys '[' '['
check "[ selects the previous parameter" soon shows 'DOTS = 2'
type_keys PPage
check "a key that the script binds is passed to the script" soon filled 21 24 68 72
check "a bound key changes no parameter" soon shows 'DOTS = 2'
type_keys Up
soon shows 'DOTS = 3'
cp dots.fl dots.saved
sed 's/-- 1..9 dots/-- 1..20 spots/' dots.saved >dots.fl
check "a reload keeps changed parameters" soon shows 'loaded the changed script'
type_keys h
check "h shows the selected parameter" soon shows 'DOTS = 3  (1..20, default 2)  spots in a row'
check "h shows the keys for parameters" soon shows 'tab parameter'
type_keys 0
check "0 restores the default" soon shows 'DOTS = 2  (1..20)'
type_keys q
check "q quits" ended 0
check "nothing is written to standard error" [ ! -s err ]
start left.fl
started
type_keys Up
check "a script without parameters reports it" soon shows 'the script has no parameters'
type_keys q
check "q quits" ended 0

# Errors are shown over the picture. The last version without errors keeps running.
start left.fl
started
cp left.fl good.fl
echo '        !rect size=(' >>left.fl
check "an error is shown" soon shows 'reload failed'
check "the error has a position" soon shows 'left.fl:'
check "the last good version keeps running" soon filled 12 24 1 38
sed 's/30+48/350+48/' good.fl >left.fl
check "the corrected script is loaded" soon clear_of 1 24 1 38
check "the message disappears" soon hides 'reload failed'
check "the new picture is shown" soon filled 1 24 42 80
type_keys q
check "q quits" ended 0
check "the error is printed on standard error at the end" has err 'error:'
mv good.fl left.fl

# If a shader crashes the driver, the last complete picture is shown.
cat >shader.fl <<'END'
!window size=640;384
    !shader fragment="""${HEADER}
in vec2 coord; out vec4 color;
float shade(float x) { return step(0.5, fract(10.0 * x)); }
void main() { color = vec4(coord.x < 0.5 ? shade(coord.x) : 0.0); }
"""
END
start shader.fl
started
if soon filled 22 24 1 38 && clear_of 1 24 42 80; then
    cp shader.fl good.fl
    sed 's/^float shade.*/float a[2000000000]; float shade(float x) { a[int(x)] = x; return a[int(2.0 * x)]; }/' good.fl >shader.fl
    check "a shader that crashes the driver is an error" soon shows 'bad-shader' # sanitizers: reported as too slow
    check "the message names the picture that is shown" soon shows 'showing the last complete picture'
    check "the last complete picture is shown" soon filled 22 24 1 38
    check "the last complete picture is not changed" soon clear_of 22 24 42 80
    sed 's/coord.x < 0.5/coord.x > 0.5/' good.fl >shader.fl
    check "the corrected shader draws" soon eval 'clear_of 1 24 1 38 && filled 22 24 42 80'
    check "the message disappears after the correction" soon hides 'bad-shader'
fi
type_keys q
check "the view ends after an error in a shader" ended 0

# Warnings of the running version: a corner of the picture shows their number, and the key w lists them.
sed 's/stroke_width=3/stroke_with=3/' left.fl >warn.fl
start warn.fl
check "a corner shows the number of warnings" soon shows '1 warning: w'
check "the number is in the first row" soon eval 'screen | head -n 1 | grep -q "1 warning: w *$"'
check "the picture is shown as well" soon filled 12 24 1 38
type_keys w
check "w lists the warning" soon shows "unknown attribute 'stroke_with'"
check "the warning has a position" soon shows 'warn.fl:6'
check "the list replaces the number" soon hides 'warning: w '
type_keys w
check "w hides the list" soon hides 'stroke_with'
check "the number is shown again" soon shows '1 warning: w'
sed '$d' warn.fl >other.fl && echo '                !elipse point=30+48*i;32+64*j radius=9 colr=1' >>other.fl && cp other.fl warn.fl
echo '        !rect size=9 fil=true clor=1' >>warn.fl
check "a reload updates the number" soon shows '3 warnings: w'
cp warn.fl other.fl
echo '        !rect size=(' >>warn.fl
check "an error is shown first" soon shows 'reload failed'
check "an error replaces the number" soon hides 'warnings: w'
cp other.fl warn.fl
check "the corrected script has its warnings again" soon shows '3 warnings: w'
cp left.fl warn.fl
check "a script without warnings has no number" soon hides 'warnings: w'
type_keys w
check "w reports that there are no warnings" soon shows 'No warnings'
type_keys q
check "q quits" ended 0
check "standard error has all warnings" has err "'stroke_with'"

# The view ends normally, by a signal or by a crash. In all cases, the terminal is restored.
start left.fl --frames 10
check "--frames ends it" ended 0
printf '%%pragma fps 20\n!counter state=:in_time time=frame rate=1-slow_frame\n' | cat - left.fl >in_time.fl
start in_time.fl --frames 30 --state in_time.state
check "a view with frames in time ends" ended 0
check "frames of a view are in time" grep -q '^\$(:in_time) = [1-9]' in_time.state
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
check "the last frame of a short run is shown" grep -aq '8;2;0;255;0m\|8;5;46m' typed
wipe
type_keys "clear; echo before; $(quoted "$petri") view left.fl --frames 12; echo status \$?" Enter
check "a summary is printed on the normal screen" soon shows 'petri: 12 frames in '
check "the previous content of the screen is restored" soon shows 'before'
check "a short run exits with status 0" soon shows 'status 0'
wipe
type_keys "clear; $(quoted "$petri") view left.fl --frames 12 --quiet; echo status \$?" Enter
check "--quiet exits with status 0" soon shows 'status 0'
check "--quiet prints no summary" soon hides 'frames in'
if [ "${3:-sdl}" = none ]; then
    wipe
    type_keys "clear; DISPLAY=:77 $(quoted "$petri") view left.fl --frames 3; echo status \$?" Enter
    check "a message explains how to get windows" soon shows "'./dev build' adds windows"
fi
# Other views may be running on this machine. The view of this test is the one in this folder.
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
    check "SIG${signal%:*} restores the terminal" ended "${signal#*:}"
done
start left.fl
started
type_keys C-c
check "Ctrl-C ends it" ended 130
start left.fl
started
type_keys C-z
check "Ctrl-Z restores the terminal for the shell" soon shows 'Stopped'
type_keys 'clear; fg' Enter
check "fg resumes" soon seen
check "fg shows the picture again" soon filled 1 24 1 38
type_keys q
soon shows 'left.fl'

# If the environment names a display that does not exist, as in old ssh sessions, the terminal is used without delay.
for place in DISPLAY=:9999 DISPLAY=localhost:99.0 WAYLAND_DISPLAY=wayland-none; do
    type_keys "clear; env XDG_RUNTIME_DIR=. $place $(quoted "$petri") view left.fl 2>err; echo status \$?" Enter
    check "with $place the terminal is used" started
    check "the picture fills the terminal" soon filled 22 24 1 38
    type_keys q
    check "q quits" soon shows 'status 0'
done

# Without a display and a terminal, the view exits with an error.
"$petri" view --terminal left.fl >out 2>err </dev/null
check "no terminal fails" [ $? -eq 1 ]
check "the message names the terminal" has err "terminal"

finish
