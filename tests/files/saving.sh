# saving.sh: tests that failures to save are reported and retried. Part of ../cli/run.sh.

cat >w.fl <<'END'
!counter state=:n rate=1
!physics state=:c dimensions=2
    for i in ..300
        !particle id=i velocity=1;i
END
good_state() { head -n 1 "$1" | grep -qx 'petri-state 2' && tail -n 1 "$1" | grep -q '^end [0-9a-f]*$'; }

"$petri" run w.fl --realtime --runtime 8 --state later/w.state >out 2>err </dev/null &
job=$!
sleep 1
check "a state that cannot be written is reported with its file" has err "cannot write the state to 'later/w.state': No such file"
check "the message says that saving is retried" has err "cannot save the state; retrying every few seconds"
mkdir later
wait $job
status=$?
check "the first success after a failure is reported once" count_is err "saving the state works again" 1
check "the run succeeds if the last state was saved" eval 'status_is 0 && good_state later/w.state'
"$petri" run w.fl --realtime --runtime 100 --state never/w.state >out 2>err </dev/null &
job=$!
sleep 6.5
kill -TERM $job
wait $job
status=$?
check "a run whose last state is not saved fails, even after a signal" status_is 1
check "a state that cannot be saved is reported once" count_is err "cannot save the state" 1
if [ "$(id -u)" -eq 0 ] && mkdir small && mount -t tmpfs -o size=256k tmpfs small 2>/dev/null; then
    petri run w.fl --frames 3 --state small/w.state
    check "a state fits a small disk" status_is 0
    cp small/w.state before.state
    "$petri" run w.fl --realtime --runtime 13 --state small/w.state >out 2>err </dev/null &
    job=$!
    sleep 1
    head -c 1000000 /dev/zero >small/full 2>/dev/null
    sleep 5.5
    check "a full disk is reported" has err "cannot write the state to 'small/w.state': No space left on device"
    check "a full disk does not change the old state" good_state small/w.state
    rm small/full
    wait $job
    status=$?
    check "the state is saved when there is space again" eval 'status_is 0 && has err "saving the state works again" && good_state small/w.state'
    petri run w.fl --frames 1 --print state --state small/w.state
    check "the saved state is the last one" [ "$(sed -n 's/^@\([0-9]*\).*/\1/p' out)" -gt 700 ]
    head -c 1000000 /dev/zero >small/full 2>/dev/null
    petri run w.fl --frames 100 --trajectory small/w.csv
    check "a full disk is reported once for a trajectory" eval 'status_is 1 && count_is err "cannot write small/w.csv: No space left on device" 1'
    check "a full disk leaves no partial trajectory" [ "$(ls -A small | tr '\n' ' ')" = "full w.state " ]
    umount small
fi

# whole_frames: succeeds if the trajectory w.csv consists of complete frames. However a run ends, this must be the case.
whole_frames() { [ $(($(wc -l <w.csv) % 300)) -eq 1 ] && [ "$(tail -n 1 w.csv | tr -cd , | wc -c)" -eq 11 ]; }
number=129
for signal in HUP INT TERM; do
    # The parent of this test may ignore SIGHUP, as nohup does.
    env --default-signal=HUP,INT,TERM "$petri" run w.fl --frames 100000000 --trajectory w.csv >out 2>err </dev/null &
    job=$!
    sleep 1
    kill -$signal $job
    wait $job
    status=$?
    check "SIG$signal ends a run" status_is $number
    check "SIG$signal keeps the complete frames of a trajectory" whole_frames
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
check "a second Ctrl-C keeps the complete frames of a trajectory" eval 'whole_frames && [ "$(wc -l <w.csv)" -eq 1501 ]'
(
    trap '' HUP
    exec "$petri" run w.fl --frames 100000000 --trajectory w.csv >out 2>err </dev/null
) &
job=$!
sleep 0.7
kill -HUP $job
sleep 0.5
check "SIGHUP does not end a run under nohup" kill -0 $job
kill -TERM $job
wait $job
"$petri" run w.fl --frames 100000000 --trajectory w.csv >out 2>err </dev/null &
job=$!
sleep 0.7
cp w.csv before.csv
kill -9 $job
wait $job 2>/dev/null
status=$?
check "kill -9 does not change the old trajectory" cmp -s w.csv before.csv
check "kill -9 leaves no temporary files" [ -z "$(find . -name '*.tmp')" ]
