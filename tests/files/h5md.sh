# h5md.sh: tests of `petri run --trajectory FILE.h5`. Part of ../cli/run.sh.

mkdir bare
cp "$petri" bare/petri
cat >pair.fl <<'END'
%pragma fps 10
!physics state=:w dimensions=2 time=time resolution=0.1
    !anchor id='a,"b' position=1;2
    !particle id=7 mass=2 radius=0.5 charge=-3 position=3;4 velocity=5;0
    for i in ..3*frame % 7
        !particle id=100+i position=i;1/3
if frame != 2
    !physics state=:line;1 dimensions=1 time=time
        !particle id=:p position=0.1
        !particle id=-0.5 position=0.2
!physics state=:many dimensions=3 time=time
    for i in ..(2000 if frame > 1 else 0)
        !particle id=i position=sin(i);cos(i);i velocity=i;i;1/(i+1)
END
"$work/bare/petri" run pair.fl --frames 2 --trajectory run.h5 >out 2>err </dev/null
status=$?
check "petri without petri-hdf5 cannot write H5MD" status_is 1
check "petri without petri-hdf5 names the missing library" has err "built without HDF5; on Debian, install libhdf5-dev"
if [ -x "$(dirname "$petri")/petri-hdf5" ]; then
    petri run pair.fl --trajectory absent/run.h5
    check "an H5MD file in a missing folder is an error" status_is 1
    check "the message names the H5MD file" has err "cannot write absent/run.h5: No such file"
    echo old >full.h5
    (
        trap '' XFSZ # the disk is full
        ulimit -f 1000
        exec timeout 100 "$petri" run pair.fl --frames 5000 --trajectory full.h5 >out 2>err </dev/null
    )
    status=$?
    check "a full disk makes an H5MD file fail" status_is 1
    check "a full disk is reported once" count_is err "cannot write full.h5: File too large" 1
    check "a full disk gives no other message" lines_are err 1
    check "a full disk does not change the old file" [ "$(cat full.h5)" = old ]
    check "a full disk leaves no partial file" [ -z "$(find . -name '*.tmp')" ]
    for threads in 1 2; do
        petri run pair.fl --frames 12 --threads $threads --trajectory run$threads.h5
    done
    check "equal runs give equal H5MD files" eval 'status_is 0 && cmp run1.h5 run2.h5'
    check "H5MD files leave no temporary files" [ -z "$(find . -name '*.tmp')" ]
fi
python=/usr/bin/python3
if [ -x "$(dirname "$petri")/petri-hdf5" ] && $python -I -c 'import h5py' 2>err; then
    read_h5md() { $python -I "$here/../files/h5md.py" "$@" >out 2>err; }
    petri run pair.fl --frames 12 --trajectory run.csv
    check "an H5MD file has the contents of CSV, read by h5py" eval 'read_h5md run1.h5 run.csv || { cat err; false; }'
    check "an H5MD file contains all systems" has out "3 systems, 20083 particles"
    petri run pair.fl --frames 5 --every 2 --trajectory run.h5md
    petri run pair.fl --frames 5 --every 2 --trajectory run.csv
    check "a .h5md file contains every K-th frame" eval 'read_h5md run.h5md run.csv || { cat err; false; }'

    printf '!physics state=:c dimensions=2\n    for i in ..300\n        !particle id=i velocity=1;i\n' >w.fl
    # A file of a stranger must not make petri write to another file.
    petri run w.fl --frames 2 --state linked.state --trajectory linked.h5
    cp linked.h5 other.h5
    cp other.h5 before.h5
    $python -I -c '
import h5py
with h5py.File("linked.h5", "r+") as file:
    del file["particles"]
    file["particles"] = h5py.ExternalLink("other.h5", "/particles")'
    petri run w.fl --frames 2 --state linked.state --trajectory linked.h5
    check "an H5MD file that refers to another file is not continued" status_is 1
    check "the message says that --trajectory did not write the file" has err "cannot continue linked.h5: it was not written by"
    check "the other file is not changed" cmp other.h5 before.h5

    # However the run ends, the complete frames must be in the file.
    # start_run FRAMES [OPTION...]: starts a run and waits until it has computed FRAMES frames.
    start_run() {
        min_frames=$(($1 - 1))
        shift
        rm -f run.h5
        : >err # the frames of an earlier run must not be counted
        env --default-signal=HUP,INT,TERM "$petri" run w.fl --frames 100000000 --trace --trajectory run.h5 "$@" 2>err </dev/null &
        job=$!
        while kill -0 $job && [ "$(grep -c 'petri: frame' err)" -le $min_frames ]; do :; done
    }
    has_frames() { read_h5md --frames run.h5 && [ "$(cat out)" -ge $min_frames ]; }
    number=129
    for signal in HUP INT TERM; do
        start_run 20 >out
        kill -$signal $job
        wait $job
        status=$?
        check "SIG$signal ends a run" status_is $number
        check "SIG$signal keeps the frames of an H5MD file" has_frames
        number=$((number == 129 ? 130 : 143))
    done
    # stop_writer: stops the run's petri-hdf5, and waits until the run blocks.
    stop_writer() {
        writer=$(pgrep -P $job)
        kill -STOP "$writer"
        before=0
        until [ "$(wc -c <err)" -eq $before ]; do
            before=$(wc -c <err)
            sleep 0.1
        done
        min_frames=1
    }
    # ends_run SIGNAL [SECONDS]: sends a signal, and succeeds if the run has ended SECONDS later (default: 2).
    ends_run() {
        kill -"$1" $job
        timeout "${2:-2}" tail --pid=$job -s 0.05 -f /dev/null
        ended=$?
        [ $ended -eq 0 ] || kill -9 $job
        wait $job
        status=$?
        [ $ended -eq 0 ]
    }
    ends() { timeout 20 tail --pid="$1" -s 0.05 -f /dev/null; }
    if command -v pgrep >/dev/null; then
        number=130
        for signal in INT TERM; do
            start_run 3 >out
            stop_writer
            check "SIG$signal ends a run whose petri-hdf5 is stopped" ends_run $signal
            check "SIG$signal gives the usual status while petri-hdf5 is stopped" status_is $number
            check "SIG$signal leaves no petri-hdf5 that was stopped" ends "$writer"
            check "SIG$signal keeps the frames that a stopped petri-hdf5 has received" has_frames
            number=143
        done
        start_run 3 >out
        stop_writer
        kill -9 $job
        wait $job 2>/dev/null
        check "a stopped petri-hdf5 finishes the file after kill -9 of petri" eval 'ends "$writer" && has_frames'
        mkfifo hung.h5
        env --default-signal=INT,TERM "$petri" run w.fl --trajectory hung.h5 2>err </dev/null &
        job=$!
        until writer=$(pgrep -P $job -x petri-hdf5); do :; done
        check "SIGINT ends a run whose petri-hdf5 cannot open the file" eval 'ends_run INT && status_is 130'
        check "a petri-hdf5 that cannot open the file is killed" eval 'ends "$writer" && has err "did not respond"'
        printf '#!/bin/sh\nprintf ! >&0\nexec sleep 100\n' >bare/petri-hdf5
        chmod +x bare/petri-hdf5
        env --default-signal=INT,TERM bare/petri run w.fl --frames 100000000 --trace --trajectory run.h5 2>err </dev/null &
        job=$!
        until writer=$(pgrep -P $job -x sleep); do :; done
        kill -INT $job
        sleep 0.3
        check "a second SIGINT ends a run whose petri-hdf5 does not respond" eval 'ends_run INT && status_is 130'
        check "a petri-hdf5 that does not respond is killed" eval 'ends "$writer" && has err "did not respond"'
    fi
    mkfifo unread
    # start_blocked_run: starts a run, and waits until it blocks because nothing reads its output.
    start_blocked_run() {
        exec 7<>unread
        start_run 3 --print state >unread
        before=0
        until [ "$(wc -c <err)" -eq $before ]; do
            before=$(wc -c <err)
            sleep 0.1
        done
        min_frames=$(grep -c 'petri: frame' err)
    }
    start_blocked_run
    kill -INT $job
    sleep 0.3
    kill -INT $job
    wait $job
    status=$?
    exec 7>&-
    check "a second Ctrl-C ends a run at once" status_is 130
    check "a second Ctrl-C keeps the complete frames of an H5MD file" has_frames
    start_blocked_run
    kill -9 $job
    wait $job 2>/dev/null
    status=$?
    exec 7>&-
    tries=0
    while [ ! -e run.h5 ] && [ $tries -lt 1000 ]; do
        tries=$((tries + 1))
        sleep 0.01
    done
    check "kill -9 keeps the complete frames of an H5MD file" eval 'status_is 137 && has_frames'
fi
