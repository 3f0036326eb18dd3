#!/bin/sh
# run.sh: `mpirun petri run` and `sweep`: the bits of one process, once. usage: tests/ranks/run.sh PATH-OF-PETRI. Skipped without mpirun.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
command -v mpirun >/dev/null || exit 77
scratch
# As in a container: as root, with more ranks than processors, on this machine alone.
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_plm=isolated
OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_mpi_yield_when_idle=1 TMPDIR=/tmp
ASAN_OPTIONS=${ASAN_OPTIONS:-}:detect_leaks=0 # of MPI
export ASAN_OPTIONS OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_rmaps_base_oversubscribe OMPI_MCA_plm \
    OMPI_MCA_btl_vader_single_copy_mechanism OMPI_MCA_mpi_yield_when_idle TMPDIR
mpirun -n 1 true 2>err || { echo "mpirun does not start a process here: $(head -n 3 err)" && exit 77; }
same() { cmp "$1" "$2"; }
# ranks COUNT ARGS...
ranks() {
    count=$1
    shift
    timeout 100 mpirun -n "$count" "$petri" "$@" >out 2>err </dev/null
    status=$?
}

cat >stars.fl <<'END'
!physics state=:stars dimensions=3 resolution=1/30
    for i in ..700
        !particle id=i position=100*normal(:p)[3*i..3*i+3] radius=1 mass=1+uniform(:m)[i]
    !gravity strength=20
    !group
        for i in 1000..1400
            !particle id=i position=50*normal(:p)[3*i..3*i+3] radius=2
    !random strength=3
    !drag strength=0.01
debug('frame';frame)
!physics state=:discs dimensions=2 resolution=1/240
    for i in ..9000
        !particle id=i radius=0.5 position=(i%100)*0.97;(i//100)*0.97 velocity=9*normal(:v)[2*i..2*i+2]
    for i in ..80
        !distance from=100*i to=100*i+99 max=90 strength=0.1
    !collision strength=1000
    !random strength=0.5
    !barrier position=0;0 normal=0;1
END
"$petri" run stars.fl --frames 5 --print hash,log --every 4 --trajectory one.csv --stats >one 2>stats
# Numbers of discs go through memory that ranks have in common, or else by messages.
for count in 2 3 4 7; do
    no_shared_memory=$((count % 2))
    [ -w /dev/shm ] || no_shared_memory=1
    export PETRI_NO_SHARED_MEMORY=${no_shared_memory#0}
    ranks $count run stars.fl --frames 5 --print hash,log --every 4 --stats --threads $((count % 2 + 1))
    check "$count ranks come to the bits of one, and say it once" same one out
    check "in one table, too" [ "$(grep momentum err)" = "$(grep momentum stats)" ]
    check "with stars shared by pairs, discs by region" [ "$(grep -c "on $count ranks  *by \(pairs\|region\)" err)" -eq 2 ]
    check "as messages between machines only" [ "$(grep -c ", 0 bytes a frame" err)" -eq $((2 - no_shared_memory)) ]
done
unset PETRI_NO_SHARED_MEMORY
ranks 2 stars.fl --frames 5 --print hash,log --every 4 --trajectory two.csv
check "as does a script without command" same one out
check "one of them writes the trajectory" same one.csv two.csv

ranks 3 run stars.fl --frames 3 --state world.state
check "the state is kept" exists world.state
ranks 2 run stars.fl --frames 2 --print hash --state world.state
check "another number of ranks goes on from it" [ "$(tail -n 1 out)" = "$(tail -n 2 one | grep '=')" ]

echo 'let X=(' >wrong.fl
ranks 2 run wrong.fl
check "a script that is wrong ends all" status_is 1
check "and is told once" count_is err 'error:' 1
ranks 2 run stars.fl --frames 5 --work 20K
check "a limit ends all" status_is 1
check "and is told once, too" count_is err 'stopped in frame' 1
if command -v pgrep >/dev/null; then
    # end SIGNAL WHICH: once all are at work, ends one rank: the `head` or the `tail` of them.
    end() {
        rm -f dead.state
        mpirun -n 3 "$petri" run stars.fl --frames 100000 --trace --state dead.state --save-every 2 >out 2>err </dev/null &
        job=$!
        while kill -0 $job && [ "$(grep -c "petri: frame" err)" -lt 6 ]; do :; done
        kill "$1" "$(pgrep -P $job | "$2" -n 1)"
        wait $job
        ended=$?
        frames=$(grep -c "petri: frame" err)
        told=$(grep "signal 15" err)
        ranks 2 run stars.fl --frames 1 --print hash --state dead.state
        next=$(sed -n 's/^@\([0-9]*\).*/\1/p' out)
    }
    end -KILL tail
    check "a rank that dies ends all" [ $ended -ne 0 ]
    check "and some frames are kept" [ "${next:-0}" -ge 4 ]
    end -TERM head
    check "a rank that is to end ends all" [ $ended -ne 0 ]
    check "with a message that says where whole frames are" [ "${told#*a rank has died*in dead.state}" != "$told" ]
    check "all of them" [ "${next:-0}" -eq "$frames" ]
    "$petri" run stars.fl --frames $((next + 1)) --print hash --every "$next" >one 2>err
    check "from which other ranks come to the same bits" [ "$(tail -n 1 out)" = "$(tail -n 1 one)" ]
fi
ranks 2 run - --frames 1
check "no script on standard input" has err 'cannot use a script on standard input under mpirun'
ranks 2 run stars.fl --realtime --frames 1
check "no --realtime" has err 'cannot use --realtime under mpirun'

# --- sweeps: rank 0 deals the runs out

cat >dish.fl <<'END'
let DROPS=DROPS or 20 SEED=SEED or 1
!physics state=:drops dimensions=2
    for i in ..DROPS
        !particle id=i position=9*normal(:start;SEED)[2*i;2*i+1]
    !gravity strength=50
END
# cells COMMAND...: the words of a sweep behind these.
# shellcheck disable=SC2016 # dollars are for petri
cells() { "$@" -D 'DROPS=2..20|3' --seeds 10 --frames 300 --every 150 --metric 'far=sum(hypot($(:drops;i)) for i in ..DROPS)'; }
cells "$petri" sweep dish.fl --quiet -o one.csv
cells ranks 3 sweep dish.fl -o three.csv
check "a sweep ends well" status_is 0
check "… with the table of one process" same one.csv three.csv
check "… and its commands" same one.csv.runs three.csv.runs
check "… which one of them tells" count_is err '70 runs in three.csv, 70 of them' 1
check "… and nothing else stays" [ "$(echo three.csv*)" = "three.csv three.csv.runs" ]
cells mpirun -n 3 "$petri" sweep dish.fl -o cut.csv 2>err </dev/null &
job=$!
while kill -0 $job 2>/dev/null && [ "$(cat cut.csv.part 2>/dev/null | grep -c '^run ')" -lt 20 ]; do :; done
kill -9 "$(pgrep -P $job | head -n 1)" 2>/dev/null
wait $job 2>/dev/null
cells ranks 2 sweep dish.fl -o cut.csv
check "cut short, it goes on, on another number of ranks" same one.csv cut.csv
cat >limit.fl <<'END'
let A=A or 1
    LONG=sum(i*i for i in ..A*10000) + frame
END
ranks 3 sweep limit.fl -D 'A=1;2;1000;4' --work 5M --frames 2 --metric a=A -o limit.csv
check "a run that fails is a row, wherever it was made" [ "$(cut -d, -f1-4 limit.csv | tail -n 3 | tr '\n' ' ')" = "2,2,1,2 3,1000,0, 4,4,1,4 " ]

finish
