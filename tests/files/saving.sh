# saving.sh: saving never gives up, and never silently. Part of ../cli/run.sh.

cat >w.fl <<'END'
!counter state=:n rate=1
!physics state=:c dimensions=2
    for i in ..300
        !particle id=i velocity=1;i
END
good_state() { head -n 1 "$1" | grep -qx 'petri-state 1' && tail -n 1 "$1" | grep -q '^end [0-9a-f]*$'; }

"$petri" run w.fl --realtime --runtime 8 --state later/w.state >out 2>err </dev/null &
job=$!
sleep 1
check "a state that cannot be written is told, with its file" has err "cannot write the state to 'later/w.state': No such file"
check "… and that it is tried again" has err "cannot save the state; retrying every few seconds"
mkdir later
wait $job
status=$?
check "… and when it works again" count_is err "the state is saved again" 1
check "then all is well" eval 'status_is 0 && good_state later/w.state'
"$petri" run w.fl --realtime --runtime 100 --state never/w.state >out 2>err </dev/null &
job=$!
sleep 6.5
kill -TERM $job
wait $job
status=$?
check "a run whose last state is not on disk fails, a signal or not" status_is 1
check "… and has said so once" count_is err "cannot save the state" 1
if [ "$(id -u)" -eq 0 ] && mkdir small && mount -t tmpfs -o size=256k tmpfs small 2>/dev/null; then
    petri run w.fl --frames 3 --state small/w.state
    check "a state on a small disk" status_is 0
    cp small/w.state before.state
    "$petri" run w.fl --realtime --runtime 13 --state small/w.state >out 2>err </dev/null &
    job=$!
    sleep 1
    head -c 1000000 /dev/zero >small/full 2>/dev/null
    sleep 5.5
    check "a disk that becomes full is told" has err "cannot write the state to 'small/w.state': No space left on device"
    check "… the old state is whole" good_state small/w.state
    rm small/full
    wait $job
    status=$?
    check "… and it is saved when there is room again" eval 'status_is 0 && has err "the state is saved again" && good_state small/w.state'
    petri run w.fl --frames 1 --print state --state small/w.state
    check "… the last one" [ "$(sed -n 's/^@\([0-9]*\).*/\1/p' out)" -gt 700 ]
    head -c 1000000 /dev/zero >small/full 2>/dev/null
    petri run w.fl --frames 100 --trajectory small/w.csv
    check "a trajectory that the disk cannot hold is told once" eval 'status_is 1 && count_is err "cannot write small/w.csv: No space left on device" 1'
    check "… and leaves nothing" [ "$(ls -A small | tr '\n' ' ')" = "full w.state " ]
    umount small
fi

# A trajectory keeps its whole frames, whatever ends the run.
whole_frames() { [ $(($(wc -l <w.csv) % 300)) -eq 1 ] && [ "$(tail -n 1 w.csv | tr -cd , | wc -c)" -eq 11 ]; }
number=129
for signal in HUP INT TERM; do
    # Whoever started this test may ignore SIGHUP, as nohup does.
    env --default-signal=HUP,INT,TERM "$petri" run w.fl --frames 100000000 --trajectory w.csv >out 2>err </dev/null &
    job=$!
    sleep 1
    kill -$signal $job
    wait $job
    status=$?
    check "SIG$signal ends a run" status_is $number
    check "… whose trajectory has its frames" whole_frames
    number=$((number == 129 ? 130 : 143))
    rm -f w.csv
done
cat >slow.fl <<'END'
!physics state=:c dimensions=2
    for i in ..300
        !particle id=i velocity=1;i
for a in ..(100000 if frame==5 else 0)
    for b in ..1000
        debug(a)
END
"$petri" run slow.fl --trajectory w.csv >out 2>err </dev/null &
job=$!
sleep 1
kill -INT $job
sleep 0.5
kill -INT $job
wait $job
status=$?
check "a second Ctrl-C ends a run at once" status_is 130
check "… whose trajectory has the frames that are whole" eval 'whole_frames && [ "$(wc -l <w.csv)" -eq 1501 ]'
(
    trap '' HUP
    exec "$petri" run w.fl --frames 100000000 --trajectory w.csv >out 2>err </dev/null
) &
job=$!
sleep 0.7
kill -HUP $job
sleep 0.5
check "under nohup SIGHUP ends nothing" kill -0 $job
kill -TERM $job
wait $job
"$petri" run w.fl --frames 100000000 --trajectory w.csv >out 2>err </dev/null &
job=$!
sleep 0.7
cp w.csv before.csv
kill -9 $job
wait $job 2>/dev/null
status=$?
check "kill -9 leaves the old trajectory" cmp -s w.csv before.csv
check "… and nothing beside it" [ -z "$(find . -name '*.tmp')" ]
