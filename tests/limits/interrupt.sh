#!/bin/sh
# interrupt.sh PETRI: checks that Ctrl-C ends long operations quickly. Prints wall times. Checks processor times,
# because they do not depend on other load.
set -u
unset MALLOC_PERTURB_ # filling 800 MB in malloc takes seconds, in which petri does not run
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
scratch

# children_ms TIMES: prints the processor time of terminated children in milliseconds. TIMES is the output of `times`,
# which must run in the shell that started the children.
children_ms() { awk -F '[ms ]+' 'NR == 2 { print int(60000 * ($1 + $3) + 1000 * ($2 + $4)) }' "$1"; }

# interrupted NAME SCRIPT [ARGUMENTS...]: runs a script without limits (default: `run --frames 3`) and interrupts it. If
# SCRIPT is '', uses the previous script.
interrupted() {
    name=$1
    [ -z "$2" ] || printf '%b\n' "$2" >long.fl
    shift 2
    [ $# -gt 0 ] || set -- run --frames 3
    # By default, background processes of a script ignore SIGINT.
    env --default-signal=INT "$petri" "$@" --work 1000T --memory 3G --threads "$threads" --quiet long.fl >out 2>err </dev/null &
    job=$!
    sleep 0.4
    times >before
    used=$(awk -v hertz="$(getconf CLK_TCK)" '{ print int(1000 * ($14 + $15) / hertz) }' /proc/$job/stat)
    start=$(date +%s%N)
    kill -INT $job 2>/dev/null
    tries=0
    while kill -0 $job 2>/dev/null && [ $tries -lt 1200 ]; do
        sleep 0.05
        tries=$((tries + 1))
    done
    took=$((($(date +%s%N) - start) / 1000000))
    kill -KILL $job 2>/dev/null
    wait $job
    status=$?
    times >after
    cpu=$(($(children_ms after) - $(children_ms before) - used))
    echo "$cpu ms of processor time, $took ms: $name, $threads threads" | tee -a times
    check "$name is interrupted" status_is 130
}
shared='func f(n, v)\n    f(n-1, (!n << (v;v))) if n>0 else v\n'
groups='func g(n, v)\n    g(n-1, (!group << (v;v))) if n>0 else v\n'
window='!window size=3000\n    !canvas\n'
printf '%b\n' "$window        !rect size=1" >small.fl
mkdir d1 d2 d3 d4 d5 d6 d7 d8
many='*/../*/../*/../*/../*/../*/../*/../*/../*/../*'
for threads in 1 2; do
    interrupted "a sort" '!a x=len(sort(uniform(i+frame)[..1e7]) for i in ..100)'
    interrupted "noise" '!a x=len(noise(1, (..10000)+frame, ..10000))'
    interrupted "octaves of noise" '!a x=len(octnoise(1+frame, 1024, 0.999, ..3000, ..3000))'
    interrupted "a search" 'let a=0*(..1e6)+frame b=0*(..5e5)+frame\n!a x=((b;1) in (a;0))'
    interrupted "debug" "$shared"'!a x=len(debug(f(60+frame, !x)))'
    interrupted "loops" '!a x=sum(len(j for j in ..(1e6+frame)) for i in ..1e6)'
    interrupted "a recursion" 'func h(n)\n    h(n-1)+h(n-1) if n>0 else 1\n!a x=h(60+frame)'
    interrupted "powers" '!a x=len(((..5e6)+frame)**1.5 for i in ..100)'
    interrupted "a stream" '!a x=len(normal(frame)[..1e7] for i in ..100)'
    interrupted "texts" '!a x=len(concat((..1e6)+frame) for i in ..100)'
    interrupted "a count" '!a x=sum(count((..1e6)+frame, ..1e6)[0] for i in ..100)'
    interrupted "gravity" '!physics state=:c dimensions=2\n    for i in ..4e5\n        !particle id=i position=i;0\n    !gravity'
    interrupted "random forces" '!physics state=:c dimensions=2\n    for i in ..1e6\n        !random\n    for i in ..1000\n        !particle id=i'
    interrupted "a tree of groups" "$groups"'!physics state=:c dimensions=2\n    g(60, !group)'
    interrupted "many steps" '!physics state=:c dimensions=2 resolution=1e-9\n    for i in ..10000\n        !particle id=i position=i;0 velocity=1'
    if "$petri" run --frames 1 --quiet --archive first.petri small.fl 2>err; then
        interrupted "files for an archive" "let a=((!group id=i) for i in ..9000) b=(((!group id=i) << a) for i in ..9000)\n!a x=filename << (((!group id=i) << b) for i in ..9000)" \
            run --frames 3 --archive long.petri
    fi
    interrupted "glob" "!a x=len(glob('$many'))"
    if "$petri" render --frame 0 --quiet small.fl -o small.png 2>err; then
        interrupted "a drawing" "$window        for i in ..1e6\n            !rect size=3000 point=i;0\n            !fill color=1;0;0;0.1" \
            render --frame 0 -o picture.png
        ! command -v ffmpeg >/dev/null || interrupted "a film's frame" "" render --frames 9 -o picture.mp4
        check "an interrupted drawing leaves no files" [ -z "$(ls -A | grep picture)" ]
        interrupted "a series" "" render --frames 1000 -o picture%d.png
        interrupted "a save" '!window size=8000\n    !canvas\n        !rect size=4000\n        !fill color=1;0;0' \
            render --frame 0 -o picture.png
    fi
    yes '!a x=1;2;y;3 b="some text"' | head -n 3000000 >long.fl
    interrupted "loading" ""
    : >long.fl
done
sort -n times | awk '{ t[NR] = $1 } END { print "median " t[int((NR + 1) / 2)] " ms, worst " t[NR] " ms"; exit t[NR] > 5000 }'
status=$?
check "each interrupt takes effect within 5 s of processor time" status_is 0
finish
