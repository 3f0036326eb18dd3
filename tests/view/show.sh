#!/bin/sh
# show.sh: `petri run --show`, which `./dev run` calls: the picture for those who sit at a terminal, what is printed for all
# others.
# usage: tests/view/show.sh PATH-OF-PETRI chafa|none
# shellcheck source=tests/view/support.sh
. "$(dirname "$0")/support.sh"
# shellcheck source=tests/view/tmux.sh
. "$(dirname "$0")/tmux.sh"

cat >dish.fl <<'END'
!physics state=:cells dimensions=2 time=beat
    for i in ..40
        !particle id=i position=100*normal(:p;i)[..2] radius=9
    !drag strength=0.01
END
printf 'debug("only text")\n' >text.fl
# typed COMMAND: on a screen that has nothing else; `status N` is on it afterwards.
typed() {
    wipe
    type_keys "clear; $*; echo status \$?" Enter
}

typed "$(quoted "$petri") run --show dish.fl"
check "the picture is there, on the other screen" started
type_keys q
check "it can be ended before its time" soon shows 'status 0'
started_at=$(date +%s)
sed '1s/^/%pragma fps 20\n/' dish.fl >slow.fl
typed "$(quoted "$petri") run --show slow.fl"
check "a slow script ends too" soon shows 'status 0'
check "after ten seconds, not after 600 frames" [ $(($(date +%s) - started_at)) -lt 25 ]
typed "$(quoted "$petri") run --show --frames 30 dish.fl"
check "it ends by itself" soon shows 'status 0'
check "the last picture stays" eval 'screen | grep -q "[▀▄█▌▐]"'
check "nothing is said of the graphics card" hides 'graphics card'
check "with a line that sums up" soon shows 'petri: 30 frames in '
check "it says how to see more of it" soon shows 'petri: to see it: '
check "and how to keep it" soon shows 'petri: to save a picture of it: '
mkdir -p build/src
cp "$petri" "$(dirname "$petri")/petri-pictures" build/src
ln -s src/petri build/petri
typed "$work/build/petri run --show --frames 2 -D X=7 dish.fl"
check "from the folder of the project the hint is short" soon shows 'petri: to see it: build/petri view dish.fl'
hint=$(screen | sed -n 's/^petri: to see it: //p')
typed "$hint --frames 3"
check "and works" soon shows 'petri: 3 frames in '

typed "$(quoted "$petri") run --show --frames 2 --print state --every 1 dish.fl | head -n 1"
check "into a pipe goes text" soon shows '@0 time=0'
typed "$(quoted "$petri") run --show --frames 2 --print tree text.fl"
check "what asks for text gets text" soon shows '@1 time='
typed "$(quoted "$petri") run --show --frames 2 --print=state --every 100 dish.fl"
check "even where there is something to see" soon shows '@0 time=0'
typed "$(quoted "$petri") run --show --frames 2 text.fl"
check "what has no picture prints what it prints" soon shows "> 'only text'"
typed "$(quoted "$petri") run --show --frames 2 missing.fl"
check "what is wrong is told" soon shows 'status 1'
check "once" [ "$(screen | grep -c missing.fl)" -eq 1 ]
typed "TERM=dumb $(quoted "$petri") run --show --frames 2 --verbose dish.fl"
check "a terminal that can nothing is shown nothing" soon shows 'physics step'
"$petri" run --show --frames 2 --print log text.fl >out 2>err </dev/null
check "without a terminal it is as without --show" has out "> 'only text'"
check "in silence" [ ! -s err ]

if ! "$petri" open '#' 2>&1 | grep -q 'built without'; then
    "$petri" link dish.fl --frame 9 >link
    typed "$(quoted "$petri") open - <link"
    check "petri open tells that the frame of a link is the same" soon shows 'frame 9: state matches the link exactly'
    check "below its picture" eval 'screen | grep -q "[▀▄█▌▐]"'
    typed "$(quoted "$petri") open --quiet - <link"
    check "quietly there is the hash alone" soon shows 'status 0'
    check "and no picture" eval '! screen | grep -q "[▀▄█▌▐]"'
fi

finish
