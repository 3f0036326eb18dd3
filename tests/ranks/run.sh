#!/bin/sh
# run.sh: tests `mpirun petri run` and `mpirun petri sweep`, which give the results of one process.
# usage: tests/ranks/run.sh PATH-OF-PETRI. Skipped without mpirun.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
command -v mpirun >/dev/null || exit 77
scratch
# Allows Open MPI to run in a container: as root, with more ranks than processors, and on this machine only.
OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_plm=isolated
OMPI_MCA_btl_vader_single_copy_mechanism=none OMPI_MCA_mpi_yield_when_idle=1 TMPDIR=/tmp
ASAN_OPTIONS=${ASAN_OPTIONS:-}:detect_leaks=0 # MPI leaks memory
export ASAN_OPTIONS OMPI_ALLOW_RUN_AS_ROOT OMPI_ALLOW_RUN_AS_ROOT_CONFIRM OMPI_MCA_rmaps_base_oversubscribe OMPI_MCA_plm \
    OMPI_MCA_btl_vader_single_copy_mechanism OMPI_MCA_mpi_yield_when_idle TMPDIR
mpirun -n 1 true 2>err || { echo "mpirun does not start a process here: $(head -n 3 err)" && exit 77; }
same() { cmp "$1" "$2"; }
# ranks COUNT ARGS...: runs petri with COUNT ranks. Sets $status; the output is in the files out and err.
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
# The positions of discs are collected through shared memory or, if that is unavailable, by messages.
for count in 2 3 4 7; do
    no_shared_memory=$((count % 2))
    [ -w /dev/shm ] || no_shared_memory=1
    export PETRI_NO_SHARED_MEMORY=${no_shared_memory#0}
    ranks $count run stars.fl --frames 5 --print hash,log --every 4 --stats --threads $((count % 2 + 1))
    check "$count ranks print the hashes of one process, once" same one out
    check "$count ranks print one table of momentum" [ "$(grep momentum err)" = "$(grep momentum stats)" ]
    check "$count ranks: stars by pairs, discs by region" [ "$(grep -c "on $count ranks  *by \(pairs\|region\)" err)" -eq 2 ]
    check "$count ranks: messages only without shared memory" [ "$(grep -c ", 0 bytes per frame" err)" -eq $((2 - no_shared_memory)) ]
done
unset PETRI_NO_SHARED_MEMORY
ranks 2 stars.fl --frames 5 --print hash,log --every 4 --trajectory two.csv
check "a script without a command also runs on ranks" same one out
check "one rank writes the trajectory" same one.csv two.csv

ranks 3 run stars.fl --frames 3 --state world.state
check "one rank saves the state" exists world.state
ranks 2 run stars.fl --frames 2 --print hash --state world.state
check "another number of ranks continues from the state" [ "$(tail -n 1 out)" = "$(tail -n 2 one | grep '=')" ]

echo 'let X=(' >wrong.fl
ranks 2 run wrong.fl
check "an invalid script ends all ranks" status_is 1
check "an invalid script is reported once" count_is err 'error:' 1
ranks 2 run stars.fl --frames 5 --work 20K
check "a work limit ends all ranks" status_is 1
check "a work limit is reported once" count_is err 'stopped in frame' 1
if command -v pgrep >/dev/null; then
    # end SIGNAL WHICH: starts three ranks and sends the signal to the first (`head`) or the last (`tail`).
    end() {
        rm -f dead.state
        mpirun -n 3 "$petri" run stars.fl --frames 100000 --trace --state dead.state --save-every 2 >out 2>err </dev/null &
        job=$!
        while kill -0 $job && [ "$(grep -c "petri: frame" err)" -lt 6 ]; do :; done
        kill "$1" "$(pgrep -P $job | "$2" -n 1)"
        wait $job
        ended=$?
        frames=$(grep -c "petri: frame" err)
        report=$(grep "signal 15" err)
        ranks 2 run stars.fl --frames 1 --print hash --state dead.state
        next=$(sed -n 's/^@\([0-9]*\).*/\1/p' out)
    }
    end -KILL tail
    check "a rank that dies ends all ranks" [ $ended -ne 0 ]
    check "a rank that dies leaves a saved state" [ "${next:-0}" -ge 4 ]
    end -TERM head
    check "a terminated rank ends all ranks" [ $ended -ne 0 ]
    check "a terminated rank reports where the state was saved" [ "${report#*a rank has died*in dead.state}" != "$report" ]
    check "the saved state has all frames" [ "${next:-0}" -eq "$frames" ]
    "$petri" run stars.fl --frames $((next + 1)) --print hash --every "$next" >one 2>err
    check "other ranks continue from it with the same hashes" [ "$(tail -n 1 out)" = "$(tail -n 1 one)" ]
fi
ranks 2 run - --frames 1
check "a script on standard input is rejected" has err 'cannot use a script on standard input under mpirun'
ranks 2 run stars.fl --realtime --frames 1
check "--realtime is rejected" has err 'cannot use --realtime under mpirun'

# --- sweeps: rank 0 assigns the runs

cat >dish.fl <<'END'
let DROPS=DROPS or 20 SEED=SEED or 1
!physics state=:drops dimensions=2
    for i in ..DROPS
        !particle id=i position=9*normal(:start;SEED)[2*i;2*i+1]
    !gravity strength=50
END
# cells COMMAND...: runs COMMAND with the options of a sweep.
# shellcheck disable=SC2016 # the dollar signs are for petri
cells() { "$@" -D 'DROPS=2..20|3' --seeds 10 --frames 300 --every 150 --metric 'far=sum(hypot($(:drops;i)) for i in ..DROPS)'; }
cells "$petri" sweep dish.fl --quiet -o one.csv
cells ranks 3 sweep dish.fl -o three.csv
check "a sweep on ranks succeeds" status_is 0
check "a sweep on ranks writes the table of one process" same one.csv three.csv
check "a sweep on ranks writes the commands of one process" same one.csv.runs three.csv.runs
check "a sweep on ranks is reported once" count_is err '70 runs in three.csv, 70 of them' 1
check "a sweep on ranks leaves no other files" [ "$(echo three.csv*)" = "three.csv three.csv.runs" ]
cells mpirun -n 3 "$petri" sweep dish.fl -o cut.csv 2>err </dev/null &
job=$!
while kill -0 $job 2>/dev/null && [ "$(cat cut.csv.part 2>/dev/null | grep -c '^run ')" -lt 20 ]; do :; done
kill -9 "$(pgrep -P $job | head -n 1)" 2>/dev/null
wait $job 2>/dev/null
cells ranks 2 sweep dish.fl -o cut.csv
check "an interrupted sweep resumes on another number of ranks" same one.csv cut.csv
cat >limit.fl <<'END'
let A=A or 1
    LONG=sum(i*i for i in ..A*10000) + frame
END
ranks 3 sweep limit.fl -D 'A=1;2;1000;4' --work 5M --frames 2 --metric a=A -o limit.csv
check "a failed run is a row on any rank" [ "$(cut -d, -f1-4 limit.csv | tail -n 3 | tr '\n' ' ')" = "2,2,1,2 3,1000,0, 4,4,1,4 " ]

# A build or an installation without petri-ranks.
mkdir -p built/src installed/bin
cp "$petri" built/src
cp "$petri" installed/bin
touch built/build.ninja
timeout 100 mpirun -n 2 built/src/petri run stars.fl --frames 1 >out 2>err </dev/null
check "without petri-ranks, a build folder names the command that builds it" count_is err \
    "cannot start petri-ranks: No such file or directory; run './dev build', which builds it" 1
timeout 100 mpirun -n 2 installed/bin/petri run stars.fl --frames 1 >out 2>err </dev/null
check "without petri-ranks, an installation names the package" count_is err "; on Debian, install petri-mpi" 1

# Archives: the ranks share the segments.
if "$petri" run dish.fl --frames 60 --keyframe-every 10 --archive run.petri 2>err; then
    for count in 1 3 8; do
        ranks $count archive verify run.petri --quiet
        check "$count ranks verify an archive together" eval 'status_is 0 && has out "verified: 60 of 60 frames, 6 of 6 segments"'
        check "$count ranks print the result once" count_is out "digest " 1
    done
    ranks 2 archive verify run.petri --sample 3
    check "ranks verify the same sample" eval 'status_is 0 && has out "3 of 6 segments"'
    # Digests that no run has, as in an archive of another build, in the fifth segment, which rank 1 of 3 verifies.
    python3 - <<'END'
import sqlite3
database = sqlite3.connect("run.petri")
database.execute("UPDATE digest SET digest = zeroblob(16) WHERE frame IN (44, 57)")
database.commit()
END
    python3 "$root/tests/support/reseal.py" run.petri
    "$petri" archive verify run.petri >one 2>err
    ranks 3 archive verify run.petri
    check "ranks find the first frame that differs" eval 'status_is 1 && has out "frame 44 differs"'
    check "ranks print the report of one process" same one out
    head -c 3000 run.petri >cut.petri
    ranks 2 archive verify cut.petri
    check "ranks report a damaged archive once" eval 'status_is 2 && count_is err "archive is damaged" 1'
else
    check "a build without SQLite says what is missing" has err "built without SQLite"
fi

finish
