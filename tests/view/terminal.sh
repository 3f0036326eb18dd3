#!/bin/sh
# terminal.sh: `petri view` in a terminal, under tmux: what the cells show, keys, the mouse, and that the terminal is
# given back as it was.
# usage: tests/view/terminal.sh PATH-OF-PETRI chafa|none
# shellcheck source=tests/view/support.sh
. "$(dirname "$0")/support.sh"
# shellcheck source=tests/view/tmux.sh
. "$(dirname "$0")/tmux.sh"

# start [options] SCRIPT: a view in the terminal; `status N` is on the screen when it has ended.
start() {
    wipe
    view="$petri view $* 2>err; code=\$?"
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
check "where nothing is drawn, nothing is" clear_of 1 24 42 80
check "all rows are used" filled 22 24 1 38
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

# A high picture stands in the middle.
sed "s/size=640;384/size=192;384/; s/in ..6/in ..3/; s/left/high/" left.fl >high.fl
start high.fl
started
check "a high picture is there" soon filled 1 24 29 51
check "nothing beside it" clear_of 1 24 1 27
check "on either side" clear_of 1 24 54 80
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
check "nothing elsewhere" clear_of 10 24 1 80
type_keys -l "$(printf '\033[<0;60;16M')"
check "a button is pressed" soon filled 13 15 54 66
type_keys -l "$(printf '\033[<0;60;16m')"
check "and let go" soon clear_of 10 13 50 70
type_keys x
check "a key reaches the script" soon filled 21 24 72 80
type_keys q
check "q quits" ended 0

# Mistakes are told over the picture, and the last good version goes on.
start left.fl
started
cp left.fl good.fl
echo '        !rect size=(' >>left.fl
check "a mistake is told" soon shows 'cannot be loaded'
check "with its place" shows 'left.fl:'
check "the last good version is running" filled 12 24 1 38
sed 's/30+48/350+48/' good.fl >left.fl
check "the mended script is loaded" soon clear_of 1 24 1 38
check "the message goes" hides 'cannot be loaded'
check "the picture is another" filled 1 24 42 80
type_keys q
check "q quits" ended 0
check "afterwards the mistake is on standard error" has err 'error:'
mv good.fl left.fl

# It ends by itself, by signals, and by its own death: the terminal is as before.
start left.fl --frames 10
check "--frames ends it" ended 0
start left.fl --runtime 1 --lockstep
check "--runtime ends it" ended 0
wipe
type_keys "clear; echo before; $petri view left.fl --frames 12; echo status \$?" Enter
check "on the screen that is there again one line sums up" soon shows 'petri: 12 frames in '
check "the rest of it is as before" soon shows 'before'
check "and it ended well" soon shows 'status 0'
wipe
type_keys "clear; $petri view left.fl --frames 12 --quiet; echo status \$?" Enter
check "not with --quiet" soon shows 'status 0'
check "which says nothing" hides 'frames in'
viewer() { pgrep -f "^$petri view left.fl" | head -n 1; }
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
    type_keys "clear; env XDG_RUNTIME_DIR=. $place $petri view left.fl 2>err; echo status \$?" Enter
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
