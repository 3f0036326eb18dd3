# state.sh: tests of `petri run --state`, which resumes an earlier run. Part of run.sh.

cat >world.fl <<'END'
%pragma tempo 90
!counter state=:turns rate=0.7;-0.3
!physics state=:w dimensions=2 time=beat resolution=1/200
    !anchor id=:hub position=polar($:turns[0] or 0)
    for i in ..(6 if frame < 40 else 4)
        !particle id=i;"cell" radius=1 charge=normal(:q)[i] position=5*polar(i/6) velocity=0.1;-0.2
        !distance from=i;"cell" to=:hub max=6 strength=20
    !electrostatic strength=3 ease=2
    !collision strength=40
    !random strength=2
    !drag strength=0.01
END
petri run world.fl --frames 200 --every 199 --print state
cp out unbroken
petri run world.fl --frames 100 --state half.state
check "a run with --state succeeds" status_is 0
check "a run with --state writes the state" has half.state "petri-state 2"
petri run world.fl --frames 100 --every 199 --print state --state half.state
sed -n '/^@199/,$p' unbroken >expected
check "two runs of 100 frames equal one of 200 bit for bit, time included" cmp -s out expected
cp half.state real.state
petri run world.fl --frames 2 --realtime --print tree --state real.state
check "a restored run with --realtime continues at the frame's time" has out "@200 time=3.3333333333333335 beat=5"
rm -f half.state
petri run world.fl --frames 40 --state half.state
petri run world.fl --frames 1 --print state --state half.state
check "particles that disappear between two runs are removed" lacks out "(:w;5;'cell')"
petri run world.fl --frames 3 --print state --state absent/half.state
check "a state that cannot be written makes the run fail" status_is 1
check "the message names the state file" has err "absent/half.state"

petri run world.fl --frames 10 --state good.state
for damage in cut edited version other empty; do
    case $damage in
    cut) head -c 200 good.state >bad.state ;;
    edited) sed 's/= 0\./= 1./' good.state >bad.state ;;
    version) sed 's/^petri-state 2/petri-state 99/' good.state >bad.state ;;
    other) echo "something else" >bad.state ;;
    empty) : >bad.state ;;
    esac
    cp bad.state before.state
    petri run world.fl --frames 2 --print state --state bad.state
    check "a bad state file ($damage) makes the run fail" status_is 1
    check "a bad state file ($damage) is reported once" count_is err "error: cannot load the state from 'bad.state'" 1
    check "a bad state file ($damage) is not modified" cmp -s bad.state before.state
    check "a run with a bad state file ($damage) starts at frame 0" has out "@0 time=0"
done
check "states leave no temporary files" [ -z "$(find . -name '*.tmp')" ]
petri run world.fl --frames 2 --state .
check "a folder is not accepted as a state file" status_is 1

# --save-every saves the state of a run that is killed
"$petri" run world.fl --frames 100000000 --state killed.state --save-every 2 --trace >out 2>err </dev/null &
job=$!
while kill -0 $job && [ "$(grep -c 'petri: frame' err)" -lt 6 ]; do :; done
kill -9 $job
wait $job 2>/dev/null
petri run world.fl --frames 1 --print state --state killed.state
next=$(sed -n 's/^@\([0-9]*\) .*/\1/p' out)
check "--save-every has saved every second frame" [ "${next:-0}" -ge 4 ]
petri run world.fl --frames 1 --save-every 2
check "--save-every without --state is a usage error" status_is 2
check "--save-every without --state says what is missing" has err 'needs --state FILE'

# ids that are new in each frame must not accumulate in the state
cat >new_ids.fl <<'END'
!physics state=:s dimensions=1
    for i in ..100
        !particle id=frame;i velocity=1
    !particle id=:stays velocity=1
!physics state=:t dimensions=2
    !particle id=:x velocity=1
END
petri run new_ids.fl --frames 300 --every 299 --print state
check "the state contains only particles of the last frame" [ "$(grep -c '^\$(:s;299;' out)" -eq 200 ]
check "the state contains no removed particles" lacks out '(:s;298'
check "the state contains particles that exist in every frame" has out '$(:s;:stays) = '
check "the state contains each system's iteration" has out '$(:t;:iteration) = 299'

# a state with many particles, whose list of particles grows while it is loaded
cat >many.fl <<'END'
!physics state=:s dimensions=1
    for i in ..20000
        !particle id=i velocity=i
END
petri run many.fl --frames 6 --every 5 --print state
sed -n '/^@5/,$p' out >expected
petri run many.fl --frames 3 --state many.state
petri run many.fl --frames 3 --every 5 --print state --state many.state
check "a state of many particles is restored completely" cmp -s out expected

# Particles of frame 0 have keys, but no positions yet.
printf '!physics state=:p dimensions=2\n    for i in ..20000\n        !particle id=i position=i;0\n' >many.fl
petri run many.fl --frames 1 --state unplaced.state
petri run many.fl --frames 1 --state unplaced.state --memory 64M
check "particles without positions are restored in little memory" eval 'status_is 0 && [ ! -s err ]'

# a module that changes while petri runs
printf 'let size=3\n' >part.fl
printf "import size from 'part.fl'\n!out size=size\n" >main.fl
# change_module OPTION...: starts a run, writes a syntax error into the module, and ends the run after further frames.
change_module() {
    printf 'let size=3\n' >part.fl
    rm -f changed err # output of the previous run, which the loops below must not read
    "$petri" run main.fl --frames 1000000000 --print tree "$@" >changed 2>err </dev/null &
    job=$!
    until [ -s changed ] && [ "$(grep -c 'size=3' changed)" -gt 2 ] || ! kill -0 $job; do sleep 0.1; done
    printf 'let size=(4\n' >part.fl
    before=$(grep -c '^@' changed)
    until [ "$(grep -c '^@' changed)" -gt $((before + 2)) ] || ! kill -0 $job; do sleep 0.1; done
    sleep 0.5
    kill -TERM $job
    wait $job 2>/dev/null
}
change_module --realtime --fps 50
check "a module with a syntax error is reported once" count_is err "error: " 1
check "a run in real time keeps the last good module" [ "$(grep -v '^@' changed | sort -u)" = '!out size=3' ]
change_module --every 100
check "a run in lockstep does not read a module again" lacks err "part.fl"
check "a run in lockstep keeps its modules" [ "$(grep -v '^@' changed | sort -u)" = '!out size=3' ]
