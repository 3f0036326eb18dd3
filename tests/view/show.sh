#!/bin/sh
# show.sh: tests of `petri run --show`, which `./dev run` calls: it shows the picture on a terminal, and prints text
# otherwise.
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
# typed COMMAND: runs the command on an empty screen. Afterwards, the screen shows `status N`.
typed() {
    wipe
    type_keys "clear; $*; echo status \$?" Enter
}

typed "$(quoted "$petri") run --show dish.fl"
check "the picture is on the alternate screen" started
type_keys q
check "q ends the run" soon shows 'status 0'
started_at=$(date +%s)
sed '1s/^/%pragma fps 20\n/' dish.fl >slow.fl
typed "$(quoted "$petri") run --show slow.fl"
check "a slow script ends" soon shows 'status 0'
check "a slow script ends after ten seconds, not after 600 frames" [ $(($(date +%s) - started_at)) -lt 25 ]
typed "$(quoted "$petri") run --show --frames 30 dish.fl"
check "a fast script ends by itself" soon shows 'status 0'
check "the last picture stays on the screen" eval 'screen | grep -q "[▀▄█▌▐]"'
check "the graphics card is not mentioned" hides 'graphics card'
check "a summary is printed" soon shows 'petri: 30 frames in '
check "a hint explains how to view the script" soon shows 'petri: to watch the script: '
check "a hint explains how to save a picture" soon shows 'petri: to save a picture: '
mkdir -p build/src
cp "$petri" "$(dirname "$petri")/petri-pictures" build/src
ln -s src/petri build/petri
typed "$work/build/petri run --show --frames 2 -D X=7 dish.fl"
check "in the project folder the hint is short" soon shows 'petri: to watch the script: build/petri view dish.fl'
hint=$(screen | sed -n 's/^petri: to watch the script: //p')
typed "$hint --frames 3"
check "the command of the hint works" soon shows 'petri: 3 frames in '

typed "$(quoted "$petri") run --show --frames 2 --print state --every 1 dish.fl | head -n 1"
check "a pipe gets text" soon shows '@0 time=0'
typed "$(quoted "$petri") run --show --frames 2 --print tree text.fl"
check "--print prints text" soon shows '@1 time='
typed "$(quoted "$petri") run --show --frames 2 --print=state --every 100 dish.fl"
check "--print prints text even if there is a picture" soon shows '@0 time=0'
typed "$(quoted "$petri") run --show --frames 2 text.fl"
check "a script without a picture prints its text" soon shows "> 'only text'"
typed "$(quoted "$petri") run --show --frames 2 missing.fl"
check "an error exits with status 1" soon shows 'status 1'
check "the error is printed once" [ "$(screen | grep -c missing.fl)" -eq 1 ]
typed "TERM=dumb $(quoted "$petri") run --show --frames 2 --verbose dish.fl"
check "a dumb terminal shows no picture" soon shows 'physics step'
"$petri" run --show --frames 2 --print log text.fl >out 2>err </dev/null
check "without a terminal, --show prints the text" has out "> 'only text'"
check "without a terminal, --show prints a summary" has err 'petri: 2 frames in '

if ! "$petri" open '#' 2>&1 | grep -q 'built without'; then
    "$petri" link dish.fl --frame 9 >link
    typed "$(quoted "$petri") run \"\$(cat link)\""
    check "petri run reports that the state matches" soon shows 'frame 9: state matches the link exactly'
    check "petri run of a link shows the picture" eval 'screen | grep -q "[▀▄█▌▐]"'
    typed "$(quoted "$petri") run --quiet \"\$(cat link)\""
    check "petri run --quiet of a link prints the hash" soon shows 'status 0'
    check "petri run --quiet of a link shows no picture" eval '! screen | grep -q "[▀▄█▌▐]"'
    # A link to frame 30 of this script, with N=5 from the start and N=7 after frame 10 (tests/cli/link.sh).
    link='#JcdBCsIwEEDRq4x_PUpDKcJAr5ALpFmUkOKipBBHEcS7i7h6vDdPLCiOsVeXOEc5uoxLO5Xj0bx2ufvqdbYi_WdcGkrDKJdtRylYSuegRJSJrCkM_1zJWdmwcVBuGC8-Xw'
    typed "$(quoted "$petri") view --terminal --lockstep --frames 31 --archive seen.petri '$link'"
    check "petri view shows a link" soon shows 'status 0'
    "$petri" run "$link" >expected 2>err
    "$petri" run seen.petri --print hash >out 2>err
    check "petri view makes the changes of a link" [ "$(tail -n 1 out)" = "$(tail -n 1 expected)" ]
    check "the last frame is that of the link" has out "@30 "
fi

finish
