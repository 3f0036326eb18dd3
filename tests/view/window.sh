#!/bin/sh
# window.sh: tests of `petri view` in a window: pictures, keys, the pointer, reloading, closing.
# usage: tests/view/window.sh PATH-OF-PETRI sdl|none [PATH-OF-close_window]
# shellcheck source=tests/view/support.sh
. "$(dirname "$0")/support.sh"

[ "${2:-sdl}" = sdl ] || skip "petri was built without SDL (Debian: libsdl2-dev)"
closer=${3:-}
[ -n "$closer" ] || skip "no Xlib to close windows with (Debian: libx11-dev)"
case $closer in
/*) ;;
*) closer=$PWD/$closer ;;
esac
needs Xvfb xvfb
needs xdotool xdotool
needs import imagemagick
needs compare imagemagick
needs xprop x11-utils

work=$(mktemp -d) || exit 1
server=
viewer=
manager=
clean_up() {
    [ -z "$viewer" ] || kill "$viewer" 2>/dev/null
    [ -z "$manager" ] || kill "$manager" 2>/dev/null
    [ -z "$server" ] || kill "$server" 2>/dev/null
    rm -rf "$work"
}
trap clean_up EXIT
trap 'exit 130' INT TERM
cd "$work" || exit 1
unset WAYLAND_DISPLAY
# SDL loads libraries that leak memory and then unloads them, so a suppression list could not name them.
ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0
export ASAN_OPTIONS
SDL_VIDEODRIVER=x11
SDL_RENDER_DRIVER=software
export SDL_VIDEODRIVER SDL_RENDER_DRIVER

Xvfb -displayfd 3 -screen 0 1000x700x24 -nolisten tcp -noreset >server.log 2>&1 3>number &
server=$!
has_number() { [ -s number ]; }
soon has_number || skip "Xvfb does not start: $(cat server.log)"
DISPLAY=:$(cat number)
export DISPLAY

print_details() {
    sed 's/^/  stderr: /' err | head -n 20
    [ -z "${KEEP:-}" ] || cp -r "$work" "$KEEP"
}

# view NAME [options] SCRIPT: starts a view and waits for its window, which is called NAME. Sets $window.
none_is_left() { ! find_window; }
find_window() {
    window=$(xdotool search --onlyvisible --name "^$title\$" 2>/dev/null | tail -n 1)
    [ -n "$window" ]
}
view() {
    title=$1
    shift
    soon none_is_left
    "$petri" view "$@" >out 2>err </dev/null &
    viewer=$!
    if ! soon find_window; then
        check "a window called $title opens" false
        finish
        exit 1
    fi
    xdotool windowfocus "$window" 2>/dev/null
    # Moves the pointer off the picture, so that tests do not depend on its position.
    xdotool mousemove 999 699
}
# ended STATUS: succeeds if the view ends without being killed, with this status.
gone() { ! kill -0 "$viewer" 2>/dev/null; }
ended() {
    soon gone || return 1
    wait "$viewer"
    status=$?
    viewer=
    [ "$status" -eq "$1" ] || { echo "  status $status" && false; }
}
# Keys that are typed before the window has the focus would be lost.
focused() { [ "$(xdotool getwindowfocus 2>/dev/null)" = "$window" ] || { xdotool windowfocus "$window" 2>/dev/null && false; }; }
press() {
    soon focused
    xdotool key "$@"
}

# import may hang if a window changes in the meantime.
look() { timeout 10 import -silent -window "$window" seen.png 2>/dev/null; }
# shows FILE: succeeds if the window shows exactly this image.
same_pixels() { look && [ "$(compare -metric AE seen.png "$1" null: 2>&1)" = 0 ]; }
shows() { soon same_pixels "$1"; }
# point X Y COLOUR: succeeds if the pixel of the window has this colour, given as RRGGBB.
colour_is() { look && [ "$(convert seen.png -alpha off -depth 8 -crop "1x1+$1+$2" rgb:- | od -An -tx1 | tr -d ' \n')" = "$3" ]; }
point() { soon colour_is "$@"; }
# dark X Y: succeeds if the pixel belongs to the background of a text panel.
is_dark() {
    look && set -- $(convert seen.png -alpha off -depth 8 -crop "1x1+$1+$2" rgb:- | od -An -tu1) &&
        [ "$1" -gt 0 ] && [ "$1" -lt 90 ] && [ "$2" -lt 90 ] && [ "$3" -lt 90 ]
}
dark() { soon is_dark "$@"; }
size_is() { xdotool getwindowgeometry --shell "$window" | grep -Eq "^WIDTH=$1\$" && xdotool getwindowgeometry --shell "$window" | grep -Eq "^HEIGHT=$2\$"; }
render() { "$petri" render "$@" >/dev/null 2>&1; }
# pictures COUNT: succeeds if there are COUNT screenshots.
count_is() { [ "$(find . -maxdepth 1 -name "$1" | wc -l)" -eq "$2" ]; }
# shot: presses s and waits for the screenshot. Sets $shot.
shot() {
    before=$(find . -maxdepth 1 -name '*-[0-9]*.png' | wc -l)
    press s
    soon count_is '*-[0-9]*.png' $((before + 1)) || return 1
    shot=$(find . -maxdepth 1 -name '*-[0-9]*.png' -newer mark | head -n 1)
    soon has err "saved ${shot#./}" || return 1
    sleep 0.02
    touch mark
}

cat >still.fl <<'END'
!window size=320;240 title='still'
    !canvas
        !rect size=320;240 color=0.2;0.4;0.6 fill=true
        !ellipse point=100;120 radius=60 color=1;0.5;0 fill=true
        !line points=200;40;300;200 color=0;1;0 stroke_width=5 stroke=true
        !text text='petri' point=240;180
END
render still.fl --frames 1 -o still.png
render still.fl --frames 1 --scale 2 -o large.png

# The picture, its size and the title of the window.
view still still.fl
check "the window has the script's size" size_is 320 240
check "the window shows the picture of petri render" soon shows still.png
press q
check "q closes it" ended 0
check "nothing is written to standard error" [ ! -s err ]
check "nothing is printed" [ ! -s out ]

# A picture that needs OpenGL is drawn, although SDL has another OpenGL context in the same thread.
cat >ball.fl <<'END'
!window size=200;200 title='ball'
    !bloom radius=4
        !canvas3d viewpoint=0;0;4 near=0.1 far=9
            !light color=1
            !sphere color=1;0.2;0.1
END
"$petri" render ball.fl --frames 1 -o ball.png >/dev/null 2>err
if lacks err needs-gpu; then
    check "petri render draws the ball" [ "$(convert ball.png -depth 8 -crop 1x1+100+100 rgb:- | od -An -tu1 | awk '{ print ($1 > 200) }')" = 1 ]
    view ball ball.fl
    check "the window shows the picture of petri render" soon shows ball.png
    press q
    check "q closes it" ended 0
    check "nothing is written to standard error" [ ! -s err ]
    # With OpenGL ES, pictures stay in GPU memory.
    unset SDL_RENDER_DRIVER
    view ball ball.fl --debug
    check "the window shows the picture of petri render" soon shows ball.png
    press h
    check "text is shown over the picture" dark 150 178
    press h
    check "text is removed again" soon shows ball.png
    press q
    check "q closes it" ended 0
    check "nothing is read back" has err "read back from the graphics card: 0"
    touch mark
    view ball ball.fl --debug
    check "s saves a screenshot" shot
    check "the screenshot equals the picture" cmp -s "$shot" ball.png
    press q
    check "q closes it" ended 0
    check "the screenshot is read back" has err "read back from the graphics card: 1"
    view still still.fl
    check "canvases are shown with OpenGL" soon shows still.png
    xdotool windowsize "$window" 640 480
    check "canvases are drawn in the window's size" soon shows large.png
    press q
    check "q closes it" ended 0
    check "nothing is written to standard error" [ ! -s err ]
    SDL_RENDER_DRIVER=software
    export SDL_RENDER_DRIVER
fi

# Views that end without being closed.
short() { timeout 60 "$petri" view "$@" >out 2>err </dev/null; }
check "--frames ends it" short still.fl --frames 20
check "--runtime ends it" short still.fl --runtime 1
check "--lockstep runs to the end" short still.fl --lockstep --frames 20 --verbose
check "--verbose prints a summary" has err "20 frames"
view still still.fl
press Escape
check "Escape closes it" ended 0
view still still.fl
"$closer" "$window"
check "closing the window ends it" ended 0
view still still.fl
kill -TERM "$viewer"
check "SIGTERM ends it" ended 143

# In a window of any size, the picture is scaled to the largest possible size and centred.
view still still.fl
xdotool windowsize "$window" 640 480
check "the picture is drawn in the window's size" soon shows large.png
xdotool windowsize "$window" 640 600
check "bars are black" point 5 5 000000
check "the picture is centred" point 5 70 336699
press q
ended 0

# Keys. The pictures encode the frame number.
cat >count.fl <<'END'
let n=frame+1
!window size=256;64 title='count'
    !canvas
        !rect size=256;64 color=0 fill=true
        for i in ..16
            if n//2**i%2
                !rect point=16*i;0 size=16;64 color=1 fill=true
END
touch mark
view count count.fl
press space
check "space pauses and s saves" shot
first=$shot
check "while paused, the frame stays" shot
check "a frame always has the same picture" cmp -s "$first" "$shot"
number=$(echo "${first#./count-}" | sed 's/^0*//; s/\.png$//')
render count.fl --frame "${number:-0}" -o wanted.png
check "the picture is that of the frame" cmp -s "$first" wanted.png
press period
render count.fl --frame $((number + 1)) -o wanted.png
check ". takes one step" soon exists wanted.png
shot
check ". takes only one step" cmp -s "$shot" wanted.png
check "the file name contains the frame number" [ "$shot" = "$(printf './count-%05d.png' $((number + 1)))" ]
press r
render count.fl --frame 0 -o wanted.png
sleep 0.2
shot
check "r restarts" cmp -s "$shot" wanted.png
xdotool windowsize "$window" 400 300
check "the notice disappears" point 395 295 000000
press h
check "h shows the status" dark 30 285
press h
check "h hides the status" point 30 285 000000
press space
sleep 0.3
shot
check "space resumes" [ "$shot" != ./count-00000.png ]
check "no errors are printed" lacks err error
press q
check "q quits" ended 0

# Warnings: a corner shows their number, and a key lists them.
sed 's/radius=60/radus=60 radius=60/' still.fl >warn.fl
view still warn.fl
check "the corner shows the number of warnings" dark 300 16
check "the list is not shown" point 20 20 336699
press w
check "w shows the list" dark 20 20
press w
check "w hides the list" point 20 20 336699
cp still.fl warn.fl
check "a reload without warnings removes the number" point 300 16 336699
press q
check "q quits" ended 0

# Full screen without a window manager: the window gets the size of the screen.
view still still.fl
press f
check "f fills the screen without a window manager" soon size_is 1000 700
check "the window is at the corner of the screen" soon eval 'xdotool getwindowgeometry "$window" | grep -q "Position: 0,0"'
check "the picture fills the height" point 40 5 336699
check "the picture is centred" point 960 690 336699
check "there are bars beside the picture" point 20 350 000000
press f
check "f restores the size" soon size_is 320 240
check "f restores the picture" soon shows still.png
press q
check "q quits" ended 0

# Options for the screen.
view still still.fl --fullscreen
check "--fullscreen fills the screen" soon size_is 1000 700
press f
check "f ends --fullscreen" soon size_is 320 240
press q
ended 0
view still still.fl --screen 0
check "--screen 0 opens the window" soon size_is 320 240
press q
ended 0
"$petri" view still.fl --screen 7 --frames 3 >out 2>err
check "--screen with a number beyond the last is an error" [ $? -eq 1 ]
check "the message names the last screen" has err "no such screen: 7; the last one is 0"

# Full screen with a window manager.
if command -v openbox >/dev/null 2>&1; then
    openbox >openbox.log 2>&1 &
    manager=$!
    has_manager() { xprop -root _NET_SUPPORTED 2>/dev/null | grep -q FULLSCREEN; }
    soon has_manager
    view still still.fl
    press f
    check "f fills the screen with a window manager" soon size_is 1000 700
    press f
    check "f restores the size with a window manager" soon size_is 320 240
    press q
    ended 0
    kill -KILL "$manager"  # the window manager sometimes ignores SIGTERM
    wait "$manager" 2>/dev/null
    manager=
else
    echo "skipped: full screen, for there is no openbox"
fi

# Built-ins that read the picture have values.
cat >sampled.fl <<'END'
!window size=200;100 title='sampled'
    !canvas id=:pic
        let seen=sample(:pic, 0.5;0.5)
        !rect size=200;100 color=((0;1;0) if seen else (1;0;0)) if measure_text('a') > 2 else 1 fill=true
END
view sampled sampled.fl
check "sample() and measure_text() have values" point 100 50 00ff00
press q
check "a script that samples ends" ended 0
check "a script that samples writes nothing to standard error" [ ! -s err ]

# Ignored nodes are reported once.
cat >ignored.fl <<'END'
!osc
!window size=200;100 title='ignored'
    !video
    !canvas
        !rect size=200;100 color=0;1;0 fill=true
    if frame > 5
        !shade
        !video
END
short() { timeout 60 "$petri" view "$@" >out 2>err </dev/null; }
check "a script with ignored nodes runs" short ignored.fl --frames 30
check "an ignored node at the top level is reported once" [ "$(grep -c "ignored.fl:1:1: warning: .*'*!osc" err)" -eq 1 ]
check "an ignored node in the window is reported once" [ "$(grep -c 'ignored.fl:3:5: warning: ' err)" -eq 1 ]
check "an unknown node of later frames is reported once" [ "$(grep -c 'ignored.fl:7:9: warning: ' err)" -eq 1 ]

# Each window of the script has a window on the screen.
cat >two.fl <<'END'
!window size=300;200 title='left'
    !canvas
        !rect size=300;200 color=0.2;0.4;0.6 fill=true
!offscreen id=:spare size=300;200
    !canvas
!window size=200;100 id=:right title='right'
    !pointer state=:mouse
    !canvas
        !rect size=200;100 color=0;1;0 fill=true
        if $:mouse
            !ellipse point=$:mouse*(200;100) radius=10 color=1;0;0 fill=true
if $(:k)
    !window size=100;100 title='third'
        !canvas
            !rect size=100;100 color=1;1;0 fill=true
!window title='empty'
!window title='keys'
    !key name=:k state=:k
END
switch_to() { title=$1; soon find_window; }
has_no_window() { title=$1; none_is_left; }
for driver in software ''; do
    if [ -n "$driver" ]; then
        SDL_RENDER_DRIVER=$driver
        export SDL_RENDER_DRIVER
        which="a second window"
    else
        unset SDL_RENDER_DRIVER
        which="a second window with OpenGL"
    fi
    view left two.fl
    check "$which opens" switch_to right
    xdotool windowmove "$window" 0 0 # without a window manager, all windows are centred
    switch_to left
    check "$which: the first window shows its picture" point 150 100 336699
    switch_to right
    check "$which has the size of its !window" size_is 200 100
    check "$which shows its picture" point 100 50 00ff00
    check "a window without content does not open" has_no_window empty
    switch_to right
    xdotool mousemove --window "$window" 50 50
    check "$which has the pointer relative to its picture" point 50 50 ff0000
    xdotool windowsize "$window" 400 200
    check "$which is drawn in its own size" point 300 190 00ff00
    sed 's/color=0;1;0/color=0;0;1/' two.fl >two.tmp
    cp two.fl two.old
    mv two.tmp two.fl
    check "$which shows changes" point 300 190 0000ff
    cp two.old two.fl
    check "$which can be closed alone" eval '"$closer" "$window"; soon has_no_window right'
    switch_to left
    check "$which: the first window remains" point 150 100 336699
    "$closer" "$window"
    check "$which: closing the last window ends the view" ended 0
    check "$which: nothing is written to standard error" [ ! -s err ]
done
SDL_RENDER_DRIVER=software
export SDL_RENDER_DRIVER
view left two.fl
switch_to right
touch mark
check "s saves the picture of the window with the focus" shot
check "the picture has the size of this window" [ "$(identify -format '%wx%h' "$shot")" = 200x100 ]
switch_to left
"$closer" "$window"
check "the first window can be closed" soon has_no_window left
switch_to right
check "the second window continues without the first" point 100 50 00ff00
sed '/^!window.*right/,/1;0;0/d' two.fl >two.tmp
mv two.tmp two.fl
check "the view ends if the script removes its last window" ended 0
cp two.old two.fl
for wanted in right 2; do
    view right two.fl --window $wanted
    check "--window $wanted shows only this window" point 100 50 00ff00
    check "--window $wanted opens no other" has_no_window left
    switch_to right
    press q
    check "--window $wanted ends" ended 0
    check "--window $wanted writes nothing to standard error" [ ! -s err ]
done
timeout 60 "$petri" view two.fl --window none --frames 3 >out 2>err </dev/null
check "a window that does not exist is reported" has err "the frame has no window with this number or id"

# The pointer and keys are passed to the script. Keys that the script uses have no other function.
cat >hands.fl <<'END'
!window size=300;200 title='hands'
    !pointer state=:mouse
    !key name=:q state=:q
    !key name=:w state=:w
    !canvas
        !rect size=300;200 color=0 fill=true
        if $(:q;:toggled)
            !rect point=250;150 size=50;50 color=0;0;1 fill=true
        if $:mouse
            let colour=(1;0;0) if $(:mouse;:left) else (0;1;0)
            !ellipse point=$:mouse*(300;200) radius=10 color=colour fill=true
END
view hands hands.fl --state hands.state
check "the pointer is outside at first" point 150 100 000000
xdotool mousemove --window "$window" 150 100
check "the pointer's position reaches the script" point 150 100 00ff00
xdotool mousedown 1
check "a button press reaches the script" point 150 100 ff0000
xdotool mouseup 1
check "a button release reaches the script" point 150 100 00ff00
xdotool mousemove --window "$window" 75 50
check "a pointer movement reaches the script" point 75 50 00ff00
press q
check "a key reaches the script" point 275 175 0000ff
xdotool windowsize "$window" 600 600
xdotool mousemove --window "$window" 300 50
check "a pointer beside the picture is outside" point 300 300 000000
xdotool mousemove --window "$window" 450 200
check "the pointer is scaled with the picture" point 450 200 00ff00
press ctrl+w
press ctrl+q
check "Control and q quit" ended 0
"$petri" run hands.fl --state hands.state --frames 1 --print state >out 2>err
check "the state has the pointer's position" has out '$:mouse = 0.75'
check "the state has the script's key" has out '$(:q;:toggled) = 1'
check "a key with Control does not reach the script" has out '$(:w;:toggled) = 0'
if "$petri" run hands.fl --frames 1 --archive probe.petri >out 2>err; then # otherwise built without SQLite
    view hands hands.fl --archive hands.petri
    xdotool mousemove --window "$window" 150 100
    check "a recorded view sees the pointer" point 150 100 00ff00
    press q
    check "a recorded view sees keys" point 275 175 0000ff
    press ctrl+q
    check "a recorded view ends" ended 0
    "$petri" verify hands.petri >out 2>err
    check "the recorded input is replayed exactly" has out "verified: "
    view hands hands.petri
    check "a replay shows the recorded input" point 275 175 0000ff
    press ctrl+q
    check "a view of an archive ends" ended 0
fi

# Parameters: a change has the same effect as -D, but the script keeps running.
cat >steps.fl <<'END'
let PARTS=PARTS or 2 -- 1..7 parts
    SHADE=SHADE or 0.5 -- 0.1..1|0.1
!counter state=:c rate=0 initial=PARTS
!window size=400;300 title='steps'
    !canvas
        !rect size=400;300 color=0 fill=true
        for i in ..PARTS
            !rect point=50*i;0 size=40;100 color=SHADE fill=true
        !rect point=0;150 size=50*($:c);30 color=0;1;0 fill=true
END
view steps steps.fl
check "the script starts with two parts" point 70 50 808080
check "there is no third part" point 120 50 000000
press Up
check "the first parameter key shows the selected parameter" dark 384 284
press Up
check "up adds a third part" point 120 50 808080
press plus KP_Add
check "plus adds two parts" point 220 50 808080
check "the state is kept" point 110 165 000000
press minus
check "minus removes a part" point 220 50 000000
press Tab Down
check "another parameter changes by its own step" point 70 50 666666
press bracketleft BackSpace
check "the default is restored" point 120 50 000000
check "the other parameter is kept" point 70 50 666666
press q
check "q quits" ended 0
check "nothing is written to standard error" [ ! -s err ]

# Sliders: the pointer drags them. The script sees it only elsewhere.
cat >slide.fl <<'END'
let PARTS=PARTS or 2 -- 1..7 parts
    PLAIN=PLAIN or 3
!window size=400;300 title='slide'
    !pointer state=:mouse
    !canvas
        !rect size=400;300 color=0 fill=true
        for i in ..PARTS
            !rect point=50*i;200 size=40;60 color=1 fill=true
        if $:mouse
            !rect point=350;270 size=50;30 color=1;0;0 fill=true
END
view slide slide.fl
check "two parts are shown" point 70 230 ffffff
press p
check "a slider is shown" dark 240 25
check "a parameter without a range has none" point 240 57 000000
xdotool mousemove --window "$window" 300 100
check "the script sees the pointer beside the sliders" point 375 285 ff0000
xdotool mousemove --window "$window" 200 25
check "the script does not see the pointer over a slider" point 375 285 000000
xdotool mousedown 1
check "a click sets the parameter" point 270 230 ffffff
check "a click sets the value at the pointer" point 320 230 000000
xdotool mousemove --window "$window" 300 100
check "dragging sets the parameter" point 320 230 ffffff
check "the script does not see the pointer that drags a slider" point 375 285 000000
xdotool mouseup 1 mousemove --window "$window" 301 101
check "the script sees the pointer after dragging" point 375 285 ff0000
press p
check "the sliders are hidden" point 240 25 000000
press q
check "a view with sliders ends" ended 0

# When the script is saved, it is reloaded and keeps its state and clock. Errors are shown, and the last version without
# errors keeps running.
cat >work.fl <<'END'
!counter state=:c rate=0 initial=7
!window size=500;300 title='work'
    !canvas
        !rect size=500;300 color=0.5;0;0 fill=true
        !rect point=0;200 size=($:c)*10;100 color=1 fill=true
END
view work work.fl
check "the first version is shown" point 480 250 800000
check "the first version has its state" point 60 250 ffffff
sed 's/0.5;0;0/0;0;0.5/; s/initial=7/initial=3/' work.fl >next.fl && mv next.fl work.fl
check "a changed script is loaded" point 480 250 000080
check "the state is kept" point 60 250 ffffff
echo '        !rect size=(' >>work.fl
check "an error is shown in the window" dark 400 18
check "the error is printed on standard error" soon has err "work.fl:"
check "the last good version keeps running" point 60 250 ffffff
sed '$d; s/0;0;0.5/0;0.5;0/' work.fl >next.fl && cat next.fl >work.fl
check "the corrected script is loaded" point 480 250 008000
check "the message disappears" point 400 18 008000
rm work.fl
sleep 0.5
check "a deleted script keeps running" point 60 250 ffffff
press q
check "q quits" ended 0

# A frame that fails is reported, and the view waits until the script changes.
cat >loop.fl <<'END'
%pragma fps 30
func f(n)
    f(n+1)+1
!window size=400;200 title='loop'
    !canvas
        !rect size=400;200 color=0;0.5;0 fill=true
END
sed 's/title=/width=f(0) title=/' loop.fl >never.fl
view loop never.fl
check "infinite recursion does not crash the view" point 390 190 008000
press q
check "q quits after a failed frame" ended 0

# Recording: after the window is closed, only complete files must remain.
cat >film.fl <<'END'
!window size=400;400 title='film'
    !record filename='film/'; frame; '.png'
        !canvas
            for i in ..200
                !ellipse point=400*uniform(:x;frame)[i];400*uniform(:y;frame)[i] radius=9 color=hsv(i/200;1;1) fill=true
END
sed -i "s/'film\/'; frame; '.png'/concat('film\/';frame;'.png')/" film.fl
mkdir film
view film film.fl
soon exists film/3.png
"$closer" "$window"
check "closing while recording exits with status 0" ended 0
check "all files are complete" sh -c 'for file in film/*; do convert "$file" null: || exit 1; done'
check "there are no other files" sh -c 'test "$(find film -type f ! -name "*.png" | wc -l)" -eq 0'
render film.fl --frame 2 -o wanted.png
check "the pictures equal those of petri render" cmp -s film/2.png wanted.png

# Frames in which particles are not at their positions yet are neither shown nor recorded, even after a reset and while
# paused.
cat >early.fl <<'END'
%pragma fps 1
!physics state=:w dimensions=2
    !particle id=1 position=20;20 velocity=1;0
!window size=300;200 title='early'
    !record filename=concat('early/';frame;'.png')
        !canvas
            !rect size=300;200 fill=true color=(0;1;0) if $(:w;1) else (1;0;0)
END
mkdir early
view early early.fl --frames 120
check "the view is black at first" point 150 100 000000
check "the particles appear" point 150 100 00ff00
press space
soon exists early/2.png
rm -f early/*
press r
check "after a reset, the first frame with particles is recorded" soon exists early/2.png
check "earlier frames are not recorded" [ ! -e early/0.png ]
sleep 1
check "while paused, a reset records one frame" [ "$(echo early/*)" = early/2.png ]
check "while paused, a reset shows the particles" point 150 100 00ff00
press q
check "q quits" ended 0
short early.fl --lockstep --frames 5 --verbose
check "--frames counts only visible frames" [ "$(echo early/*)" = "early/2.png early/3.png early/4.png early/5.png early/6.png" ]

# Errors.
"$petri" view nothing.fl >out 2>err </dev/null
check "a missing script fails" [ $? -eq 1 ]
check "the message names the script" has err "nothing.fl"
"$petri" view still.fl more.fl >out 2>err </dev/null
check "two scripts are an error" [ $? -eq 2 ]
(
    unset DISPLAY SDL_VIDEODRIVER
    "$petri" view still.fl >out 2>err </dev/null
)
check "no display and no terminal fails" [ $? -eq 1 ]
check "the message names the display" has err "no display"
DISPLAY=:9999 "$petri" view still.fl >out 2>err </dev/null
check "a display that does not answer fails" [ $? -eq 1 ]
check "the message names the display that does not answer" has err "cannot open a window: no display server answers at DISPLAY=:9999"
# If no driver is selected, SDL opens an invisible window.
unset SDL_VIDEODRIVER
for place in DISPLAY=:9999 DISPLAY=localhost:99.0 DISPLAY=nonsense WAYLAND_DISPLAY=wayland-none; do
    env -u DISPLAY XDG_RUNTIME_DIR=. "$place" timeout 60 "$petri" view still.fl >out 2>err </dev/null
    check "$place fails" [ $? -eq 1 ]
    check "the message names $place" has err "no display server answers at $place"
done
view still still.fl
press q
check "an existing display needs no driver" ended 0
kill -STOP "$server"
timeout 60 "$petri" view still.fl >out 2>err </dev/null
check "a display that accepts connections but never answers fails" [ $? -eq 1 ]
kill -CONT "$server"
check "the message names the silent display" has err "no display server answers at DISPLAY="

# If the display is lost, a view that records continues, in this test at a higher frame rate.
cat >slow.fl <<'END'
%pragma fps 0.01
!counter state=:c rate=0 initial=7
!window size=300;200 title='slow'
    !record filename='seen.png'
        !canvas
            !rect size=300;200 color=0;1;0 fill=true
END
unset SDL_RENDER_DRIVER
view slow slow.fl --frames 10 --state gone.state
goes_on=$viewer
check "the first view shows its picture" point 150 100 00ff00
cp err slow.err
"$petri" view still.fl >out 2>still.err </dev/null &
viewer=$!
title=still
check "the second view opens a window" soon find_window
kill -KILL "$server"
wait "$server" 2>/dev/null
server=
check "a view without a purpose ends with status 1" ended 1
check "the view reports the lost display" has still.err "display lost"
check "the report is one line" [ "$(wc -l <still.err)" -eq 1 ]
viewer=$goes_on
sed -i 's/fps 0.01/fps 60/' slow.fl
check "a run with an end continues to its end" ended 0
check "the run reports that it continues" has err "display lost; continuing without it"
check "the report of the run is one line" [ "$(wc -l <err)" -eq 1 ]
"$petri" run slow.fl --state gone.state --frames 1 --print state >out 2>err
check "the run has saved its state" has out '@10 '

finish
