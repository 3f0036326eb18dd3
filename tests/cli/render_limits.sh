# render_limits.sh: tests of `petri render` with limits of work, memory and disk space, and without ffmpeg. Part of run.sh.

draws || return
cp disc.png first.png
# The cost of drawing is charged in advance for all kinds of elements.
for many in '!ellipse point=50 radius=50 fill=true' '!ellipse point=50 radius=50 stroke=true stroke_width=50' \
    '!rect size=100 fill=true composite=:hue' '!text text="many" point=0;90 font_size=80 fill=true' \
    '!image filename="disc.png" size=100'; do
    printf '!window size=100\n    !canvas id=:c color=1\n        for i in ..1000\n            %s\n' "$many" >many.fl
    petri render many.fl -o many.png --work 500k --scale 5
    check "drawing is charged as work: $many" has err "drawing exceeded the work limit (--work): parts of the picture are left"
    check "the note on the limit is printed once: $many" count_is err "note: --work " 1
    petri render many.fl -o many.png --scale 5 --work "$(sufficient work)"
    check "the note names a limit that suffices: $many" [ ! -s err ]
    petri render many.fl -o many.png
    check "cheap drawing is below the limit: $many" [ ! -s err ]
done
# Small shapes that are far apart cost no more than others.
printf '!window size=1000\n    !canvas color=1\n        for i in ..20000\n            !ellipse point=i%%2*1000;i%%3*500 radius=1 fill=true\n' >many.fl
petri render many.fl -o many.png --frames 1 --work 25M
check "many small shapes that are far apart are drawn" eval 'status_is 0 && [ ! -s err ]'
printf '!physics state=:p dimensions=2\n    for i in ..1000\n        !particle id=i position=0 radius=1\n' >many.fl
petri render many.fl -o many.png --work 500k
check "drawing is charged as work: particles" has err "drawing exceeded the work limit (--work)"
petri render many.fl -o many.png --work "$(sufficient work)"
check "the note names a limit that suffices: particles" [ ! -s err ]
# Compositing pictures without shaders is also charged: 200 of 10^6 pixels take 3 s, whatever their size.
for size in 1000 999 50; do
    printf '!window size=1000\n    !canvas id=:a size=%s\n        !rect size=500 fill=true\n    for i in ..200\n        !reference id=:a\n' $size >many.fl
    petri render many.fl -o many.png --frames 1 --work 20M
    check "compositing is charged as work: size $size" count_is err "!window: drawing exceeded the work limit (--work): the picture is left out" 1
    sed 's/\.\.200/..20/' many.fl >few.fl
    petri render few.fl -o many.png --frames 1 --work 20M
    check "compositing is charged before it is done: size $size" has err "drawing exceeded the work limit"
    petri render few.fl -o many.png --frames 1 --work "$(sufficient work)"
    check "the note names a limit that suffices for compositing: size $size" eval 'status_is 0 && [ ! -s err ]'
done
printf '!window size=1000\n    for i in ..3\n        !canvas color=1\n            !ellipse point=500 radius=400 fill=true\n' >many.fl
petri render many.fl -o many.png --frames 1 --memory 10M
check "pictures above the memory limit are left out" has err "exceeds the memory limit (--memory); it is left out"
petri render many.fl -o many.png --frames 1 --memory "$(sufficient memory)"
check "the note names a memory limit that suffices" [ ! -s err ]
PATH='' "$petri" render disc.fl -o none.mp4 --frames 5 >out 2>err </dev/null
status=$?
check "a video without ffmpeg is an error" status_is 1
check "the message says how to install ffmpeg" has err "apt install ffmpeg"
(
    ulimit -f 1
    exec timeout 100 "$petri" render disc.fl -o disc.png --frames 1 --size 2000x2000 >out 2>err </dev/null
)
status=$?
check "a full disk makes a picture fail" status_is 1
check "a full disk is reported once for a picture" count_is err "cannot write 'disc.png': File too large" 1
check "a full disk does not change the old picture" cmp -s disc.png first.png
check "a full disk leaves no partial picture" nothing_beside
