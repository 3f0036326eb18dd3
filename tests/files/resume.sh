# resume.sh: tests of repeated runs of `petri run --state FILE --trajectory FILE`. Part of ../cli/run.sh.
#
# However a run ends, the same command resumes it, and the resulting trajectory equals that of an uninterrupted run. For
# each format, PETRI_KILLS / 5 runs are killed (PETRI_KILLS: default 20).

kills=$(((${PETRI_KILLS:-20} + 4) / 5))
# The files are in shared memory. Writing states to disk takes long, and is not tested here.
if shared=$(mktemp -d /dev/shm/petri.XXXXXX 2>/dev/null); then
    trap 'rm -rf "$work" "$shared"' EXIT
    cd "$shared" || exit 1
fi
formats="csv xyz"
h5md=$(dirname "$petri")/petri-hdf5
if [ -x "$h5md" ] && /usr/bin/python3 -I -c 'import h5py' 2>err; then
    formats="$formats h5"
fi
# The numbers of systems, particles and ids with strings change over time.
cat >w.fl <<'END2'
!physics state=:c dimensions=2
    for i in ..(20 if frame < 30 else 300 if frame < 70 else 5)
        !particle id=i velocity=1;i
    !particle id='t';frame//9 position=1/3;frame
if frame % 4 != 1
    !physics state=:late dimensions=3
        !particle id=:p position=0.1
if frame > 60
    !physics state=:last dimensions=1
        !particle id='u' position=frame
END2
# equals_whole FILE: succeeds if FILE equals the trajectory of an uninterrupted run.
equals_whole() {
    case $1 in
    *.h5) /usr/bin/python3 -I "$here/../files/h5md.py" --same whole.h5 "$1" >out 2>&1 || { cat out; false; } ;;
    *) cmp whole."${1##*.}" "$1" ;;
    esac
}
saved_frames() { echo $(($(sed -n 's/^frame //p' s 2>/dev/null || echo -1) + 1)); }
run_rest() { petri run w.fl --frames $((100 - $(saved_frames))) --state s --energies --trajectory "$@"; }

for format in $formats; do
    way=way.$format
    petri run w.fl --frames 100 --energies --trajectory whole.$format
    rm -f s
    for frames in 1 10 25 40; do
        petri run w.fl --frames $frames --state s --energies --trajectory $way
    done
    run_rest $way
    check "$format: five consecutive runs make one trajectory" eval 'status_is 0 && empty err && equals_whole $way'
    petri run w.fl --frames 0 --state s --energies --trajectory $way
    check "$format: a run of 0 frames changes nothing" eval 'status_is 0 && equals_whole $way'
    cp $way longer.$format

    # The state is older than the end of the trajectory, so later frames are computed again.
    rm -f s
    petri run w.fl --frames 33 --state s --energies --trajectory short.$format
    run_rest longer.$format
    check "$format: frames later than the state are computed again" eval 'status_is 0 && equals_whole longer.$format'
    rm -f s
    run_rest short.$format
    check "$format: a run without a state starts a new trajectory" eval 'status_is 0 && equals_whole short.$format'

    # The trajectory ends before the state, so the missing frames are reported.
    rm -f s
    petri run w.fl --frames 3 --state s --energies --trajectory $way
    petri run w.fl --frames 4 --state s
    petri run w.fl --frames 4 --state s --energies --trajectory $way
    check "$format: missing frames are reported" has err "frames 3 to 6 are missing in $way, which continues with frame 7"
    petri run w.fl --frames 5 --every 5 --state s --energies --trajectory $way
    check "$format: frames that --every omits are not reported as missing" empty err

    echo something else >other.$format
    petri run w.fl --frames 2 --state s --energies --trajectory other.$format
    check "$format: a file of another kind is rejected" status_is 1
    check "$format: a file of another kind is reported" has err "cannot continue other.$format: it was not written by '--trajectory'"
    check "$format: a file of another kind is not modified" [ "$(cat other.$format)" = "something else" ]
    echo bad >bad.state
    petri run w.fl --frames 2 --state bad.state --energies --trajectory $way.copy.$format
    cp $way before
    petri run w.fl --frames 2 --state bad.state --energies --trajectory $way
    check "$format: an unreadable state leaves the trajectory unchanged" eval 'status_is 1 && cmp before $way'

    # petri is killed at any moment, with or without petri-hdf5.
    rm -f s $way
    i=0
    while [ $i -lt $kills ]; do
        [ "$(saved_frames)" -lt 90 ] || rm -f s $way
        setsid "$petri" run w.fl --frames $((100 - $(saved_frames))) --state s --save-every 3 --energies --trajectory $way --trace 2>err </dev/null &
        job=$!
        min_frames=$((i * 7 % 20))
        while kill -0 $job && [ "$(grep -c 'petri: frame' err)" -lt $min_frames ]; do :; done
        kill -9 -- $([ $((i % 2)) -eq 0 ] || echo -)$job 2>/dev/null
        wait $job 2>/dev/null
        i=$((i + 1))
    done 2>/dev/null
    run_rest $way
    check "$format: a run that is killed and resumed gives the same trajectory" eval 'status_is 0 && empty err && equals_whole $way'
    check "$format: killed runs leave no temporary files" [ -z "$(find . -name '*.tmp' -o -name '*.part')" ]
done
if [ -x "$h5md" ] && [ -e /proc/$$/task/$$/children ]; then
    rm -f s run.h5
    "$petri" run w.fl --frames 100000000 --state s --energies --trajectory run.h5 --trace 2>err </dev/null &
    job=$!
    while kill -0 $job && [ "$(grep -c 'petri: frame' err)" -lt 5 ]; do :; done
    kill -9 $(cat /proc/$job/task/*/children)
    wait $job
    status=$?
    check "the run ends if petri-hdf5 is killed" status_is 1
    check "the end of petri-hdf5 is reported" has err "petri-hdf5, which writes the file, was terminated by signal 9"
    petri run w.fl --frames 1 --state s --energies --trajectory run.h5
    check "the next run resumes after petri-hdf5 was killed" eval 'status_is 0 && empty err'
fi
rm -f s
(
    trap '' XFSZ # the disk is full
    ulimit -f 200
    exec timeout 100 "$petri" run w.fl --frames 100 --state s --save-every 3 --energies --trajectory full.csv >out 2>err </dev/null
)
status=$?
check "a full disk ends a run with a trajectory" status_is 1
check "no saved state is later than the trajectory" eval '[ "$(saved_frames)" -gt 3 ] && [ "$(saved_frames)" -lt 100 ]'
run_rest full.csv
check "the same command resumes after a full disk" eval 'status_is 0 && equals_whole full.csv'
cd "$work" || exit 1
