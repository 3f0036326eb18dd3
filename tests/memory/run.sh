#!/bin/sh
# run.sh: lets each allocation of a command fail in turn, alone and with all later ones. The command must then succeed
# completely, or report that it is out of memory and exit with status 1. Its files must be the old or the new ones.
# usage: tests/memory/run.sh PATH-OF-PETRI PATH-OF-PETRI-PICTURES FAIL_NTH.SO [ACT...]. Tries TRIES allocations of each
# act in each of the two ways (default: 12); TRIES=all tries all of them.

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
plain=$(program "$1") || exit 2
pictures=$(program "$2") || exit 2
library=$(cd "$(dirname "$3")" && pwd)/$(basename "$3")
shift 3
wanted=$*
tries=${TRIES:-12}
[ "$tries" != all ] || tries=1000000

scratch
cp "$library" fail_nth.so # LD_PRELOAD splits its value at spaces
unset NO_COLOR
TMPDIR=$work
TERM=xterm
SHELL=/bin/sh
export TMPDIR TERM SHELL

printf 'let STEP=STEP or 2\nfunc twice(x)\n    x*STEP\n' >module.fl
printf 'a,b\n1,2\n' >table.csv
cat >s.fl <<'END'
%pragma tempo 60
import twice from 'module.fl'
let N=N or 5 -- 1..9 how many
    x=uniform(:x)[..5]
func area(x)
    twice(x)*x
func deep(n)
    (deep(n-1);n) if n>0 else 's'
!physics state=:cells dimensions=2 time=beat
    for i in ..N
        !particle id=i position=10*x[i];i radius=2 charge=1
    !anchor id=:hub position=0;0
    !distance from=0 to=:hub fixed=2 strength=9
    !group
        !particle id=:z radius=1
        !collision
    !electrostatic
    !random strength=10
!counter state=:count rate=2;3 maximum=1;9
!shown value=area(3) deep=deep(5) text=read('module.fl') csv=csv('table.csv',1) glob=glob('*.fl') x=debug(frame)
!window size=60;40 title='t'
    !key name=:space state=:space
    !pointer state=:mouse
    !canvas
        !path
            !rect size=50;50
            !fill color=0;1;0
        !text text='hi' point=20;20
        !path
            !move_to point=0;0
            !line_to point=9;9
            !stroke stroke_width=2
        !image filename='i.jpg' point=0;0
        !group
            !blend mode=:multiply
                !gradient start=0;0 end=9;9
                    !stop offset=0 color=1
                    !stop offset=1 color=0
                !pattern filename='i.jpg'
            !shadow radius=2
                !blur radius=1
            !dash intervals=2;1
            !ellipse point=20;20 radius=9;5 fill=true stroke=true
        !layer size=60;40 alpha=0.5
            !group
                !rect size=9;9
                !clip
                !transform translate=1;1
                    !text text='bye' point=1;1
END
printf '# run --frames 2 --print tree,state\n' >golden.head
cp "$root/tests/pictures/images/small.jpg" i.jpg
mkdir g
cp s.fl module.fl table.csv g

# run N WAY PROGRAM...: runs the command with the N-th allocation failing. WAY is FAIL_AT or FAIL_FROM.
run() {
    n=$1 way=$2
    shift 2
    rm -rf new
    mkdir new
    cp -r old/. new
    # shellcheck disable=SC2086 # $terminal may be empty
    timeout 60 $terminal env LD_PRELOAD="$work/fail_nth.so" "$way=$n" COUNT_FILE=count "$@" >out 2>err <"$input"
    status=$?
}

# Succeeds if the failure was reported, either by status 1 or by the row of a failed run in a sweep's table.
is_reported() {
    { status_is 1 || grep -qs -e 'out of memory' -e 'the process ended' new/t.table; } && grep -qi 'memory' out err
}
# Succeeds if status, output and files are the same as in a run without failures.
same() { [ "$status" -eq "$good" ] && same_output && same_files; }
# The output in a terminal contains times, so only the picture in it is compared.
same_output() {
    if [ "$terminal" ]; then
        grep -q '48;5;29m' out
    else
        cmp -s out good.out
    fi
}
same_files() {
    for file in good.new/*; do
        [ ! -e "$file" ] || cmp -s "$file" "new/$(basename "$file")" || return 1
    done
}
# Succeeds if each file is either the old one or complete (possibly with fewer frames), and there are no other files.
whole() {
    for file in new/* new/.[!.]*; do
        [ -e "$file" ] || continue
        base=$(basename "$file")
        cmp -s "$file" "good.new/$base" || cmp -s "$file" "old/$base" ||
            case $base in
            *.state) head -n 1 "$file" | grep -qx 'petri-state 2' && tail -n 1 "$file" | grep -q '^end [0-9a-f]*$' ;;
            *.table) awk -F, 'NR == 1 { n = NF } NF != n { bad = 1 } END { exit bad || NR > 4 }' "$file" ;;
            *.table.runs | *.table.part) ;; # the same command resumes from these files
            *.csv) awk -F, 'NR == 1 { n = NF } NF != n { bad = 1 } END { exit bad || NR % 7 != 1 }' "$file" ;;
            *) false ;;
            esac || return 1
    done
}
is_acceptable() { same || { is_reported && whole; }; }

print_details() { tail -n 3 out err | sed 's/^/  /'; }

# fail NAME COMMAND...: tests the command with failing allocations. The file `input` is its standard input.
fail() {
    act=$1
    shift
    [ -z "$wanted" ] || case " $wanted " in *" $act "*) ;; *) return ;; esac
    run 0 FAIL_AT "$@"
    total=$(cat count)
    cp out good.out
    # Each command makes at least 20 allocations; a smaller number means that the counter does not work.
    check "$act: $total allocations" eval 'same_output && status_is "$good" && [ "$total" -ge 20 ]'
    rm -rf good.new
    mv new good.new
    stride=$((1 + total / tries))
    at=1
    while [ "$at" -le "$total" ]; do
        run $at FAIL_AT "$@"
        check "$act: allocation $at fails" is_acceptable
        run $at FAIL_FROM "$@"
        check "$act: allocation $at and later ones fail" is_acceptable
        at=$((at + stride))
    done
}

mkdir old
good=0
terminal=
input=/dev/null
fail run "$plain" run s.fl --frames 3 --print tree,state,log --threads 2
fail parameters "$plain" run s.fl --parameters
fail check "$plain" check s.fl g
"$plain" run s.fl --frames 2 --quiet --state old/a.state --trajectory old/a.csv >out 2>&1
fail state "$plain" run s.fl --frames 3 --quiet --state new/a.state --trajectory new/a.csv
rm old/*
echo old >old/a.png
fail render "$pictures" render s.fl --frames 2 --threads 1 -o new/a.png
rm old/*
fail render_svg "$pictures" render s.fl --frames 1 --threads 1 -o new/a.svg
cat >runs.fl <<'DONE'
let A=A or 1
!physics state=:cells dimensions=1
    !particle id=1 position=A velocity=A
DONE
fail sweep "$plain" sweep runs.fl -D 'A=1;2;3' --frames 2 --metric 'x=$(:cells;1)' --jobs 1 -o new/t.table --summary new/u.table
# Only if requested by name, because initialising OpenGL is slow.
if [ "$wanted" = scene ]; then
    printf 'v -1 -1 0\nv 1 -1 0\nv 0 1 0\nf 1 2 3\n' >m.obj
    cat >scene.fl <<'END'
!window size=40;30
    !bloom radius=3
        !canvas id=:spots size=16;16 hidden=true
            !ellipse point=8;8 radius=5 color=1;0.5;0 fill=true
        !canvas3d viewpoint=0;0;5 near=0.1 far=20 samples=4
            !light color=0.2
            !light color=9 position=2;2;3 radius=0.2
            !camera id=:other secondary=true size=20;20
            !model filename='m.obj' position=-1;0;0 color=1 color_id=:spots
            !sphere position=1;0;0 color=1;0;0 transparency=0.3
            !group
                !light color=1 direction=0;0;-1
                !box position=0;1;0 size=0.5 color=0;1;0 translucency=0.2 texture_id=:other
        !vignette
            !reference id=:other
        !shader alpha=0.2 tint=0.2;0.1;0 fragment="""${HEADER}
out vec4 color;
uniform vec3 tint;
void main() { color = vec4(tint, 0.1); }
"""
        !shader fragment='no program'
END
    rm -f old/*
    fail scene "$pictures" render scene.fl --frames 2 --threads 1 -o new/a.png
    finish
    exit
fi
cp golden.head g/s.golden
"$plain" test --update g >out 2>&1
fail test "$plain" test g
cat >commands <<'END'
1+2
let q=5
q;x
.step 2
!physics state=:d dimensions=2
    !particle id=1

.step 2
.back 2
.goto 4
.set N=7
.particles cells
.energy
.plot q
.drop
.save new/saved.state
.restore new/saved.state
.load s.fl
.reset
.step
.help
END
input=commands
fail repl "$pictures" repl s.fl
cat >commands2 <<'END'
.watch area(3)
.watch x[0]
.watch
.until frame>=2 --limit 9
.run 0.05
.parameters
.set N
.tempo 30
.fps 20
.resolution 0.01
.state :cells 3
.tree particle 2
.step
.unwatch x[0]
.unwatch
.show
let more=area(2)
.help polar
.help !particle
.help nodes
.help tempo
if N
    !particle id=9

func f(a)
    a+more

import twice from 'module.fl'
let x=9
.drop all
.reload
.step 9
.back 4
.plot area(frame) 5
.resolution off
.load s.fl
.step 3
.record s.golden 2
.quit
END
input=commands2
fail commands "$pictures" repl s.fl
input=/dev/null
if command -v script >/dev/null; then
    terminal=./in_terminal
    printf '#!/bin/sh\nexec script -qec "$*" /dev/null\n' >in_terminal
    chmod +x in_terminal
    ln -s "$pictures" petri-pictures # in_terminal does not quote its arguments
    # Frame 0 is not shown. At most 30 other frames are shown per second.
    fail view "$work/petri-pictures" view --terminal --frames 6 s.fl
fi
finish
