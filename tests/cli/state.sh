# state.sh: `petri run --state`: going on where another run ended. Part of run.sh.

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
cp out whole
petri run world.fl --frames 100 --state half.state
check "a run with --state ends well" status_is 0
check "… and leaves the state behind" has half.state "petri-state 1"
petri run world.fl --frames 100 --every 199 --print state --state half.state
sed -n '/^@199/,$p' whole >expected
check "two runs of 100 frames are one of 200 to the last bit, time included" cmp -s out expected
cp half.state real.state
petri run world.fl --frames 2 --realtime --print tree --state real.state
check "in real time a restored run goes on from the frame's time" has out "@200 time=3.3333333333333335 beat=5"
rm -f half.state
petri run world.fl --frames 40 --state half.state
petri run world.fl --frames 1 --print state --state half.state
check "particles that vanish between two runs are forgotten" lacks out "(:w;5;'cell')"
petri run world.fl --frames 3 --print state --state absent/half.state
check "a state that cannot be written is an error" status_is 1
check "… which names the file" has err "absent/half.state"

petri run world.fl --frames 10 --state good.state
for damage in cut edited version other empty; do
    case $damage in
    cut) head -c 200 good.state >bad.state ;;
    edited) sed 's/= 0\./= 1./' good.state >bad.state ;;
    version) sed 's/^petri-state 1/petri-state 99/' good.state >bad.state ;;
    other) echo "something else" >bad.state ;;
    empty) : >bad.state ;;
    esac
    cp bad.state before.state
    petri run world.fl --frames 2 --print state --state bad.state
    check "a state file that is bad ($damage) makes the run fail" status_is 1
    check "… is told in one error ($damage)" count_is err "error: cannot load the state from 'bad.state'" 1
    check "… is left alone ($damage)" cmp -s bad.state before.state
    check "… and the run starts fresh ($damage)" has out "@0 time=0"
done
check "nothing is left beside the files" [ -z "$(find . -name '*.tmp')" ]
petri run world.fl --frames 2 --state .
check "a folder is no state file" status_is 1

# a run that is killed leaves what --save-every says
"$petri" run world.fl --frames 100000000 --state kept.state --save-every 2 --trace >out 2>err </dev/null &
job=$!
while kill -0 $job && [ "$(grep -c 'petri: frame' err)" -lt 6 ]; do :; done
kill -9 $job
wait $job 2>/dev/null
petri run world.fl --frames 1 --print state --state kept.state
next=$(sed -n 's/^@\([0-9]*\) .*/\1/p' out)
check "--save-every has kept each second frame" [ "${next:-0}" -ge 4 ]
petri run world.fl --frames 1 --save-every 2
check "--save-every alone has nothing to keep" status_is 2
check "… and says what it needs" has err 'add --state FILE'

# ids that are new in each frame must not fill the state
cat >fresh.fl <<'END'
!physics state=:s dimensions=1
    for i in ..100
        !particle id=frame;i velocity=1
    !particle id=:stays velocity=1
!physics state=:t dimensions=2
    !particle id=:x velocity=1
END
petri run fresh.fl --frames 300 --every 299 --print state
check "the state of particles with ever new ids holds the present ones only" [ "$(grep -c '^\$(:s;299;' out)" -eq 200 ]
check "… and no former one" lacks out '(:s;298'
check "… and those that stay" has out '$(:s;:stays) = '
check "… with their systems" has out '$(:t;:iteration) = 299'

# many particles: the list of a system's particles grows while other things are read between
cat >many.fl <<'END'
!physics state=:s dimensions=1
    for i in ..20000
        !particle id=i velocity=i
END
petri run many.fl --frames 6 --every 5 --print state
sed -n '/^@5/,$p' out >expected
petri run many.fl --frames 3 --state many.state
petri run many.fl --frames 3 --every 5 --print state --state many.state
check "a state of many particles is taken back whole" cmp -s out expected
