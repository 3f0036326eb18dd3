# clock_jumps.sh: tests that clocks that jump (jumping_clock.c) affect nothing but the times of frames in real time. Part
# of ../cli/run.sh. JUMPING_CLOCK: the library that makes them jump.

cat >w.fl <<'END2'
%pragma fps 50
let SEED=SEED or 0
!physics state=:p dimensions=2 time=time run=SEED
    for i in ..20
        !particle id=i position=i%5;i//5 radius=0.6
    !collision
    !random strength=1
!counter state=:c rate=clock
!window size=20
    !canvas
        !rect size=4+$:c fill=true
END2
# jumping ARGUMENTS...: runs petri with these clocks.
jumping() {
    LD_PRELOAD=$JUMPING_CLOCK CLOCK_JUMP=$seed timeout 100 "$petri" "$@" >out 2>err </dev/null
    status=$?
}
petri sweep w.fl --seeds 4 --frames 20 --metric 'x=$(:p;3)[0]' -o whole.csv
petri run w.fl --frames 60 --trajectory whole.xyz --state whole.state --print digest
cp out whole.out
for seed in 1 2 3; do
    rm -f s ./*.csv.part
    jumping run w.fl --frames 60 --trajectory a.xyz --state s --print digest
    check "seed $seed: frames in lockstep do not depend on clocks" eval 'status_is 0 && cmp whole.out out && cmp whole.state s && cmp whole.xyz a.xyz'
    jumping sweep w.fl --seeds 4 --frames 20 --metric 'x=$(:p;3)[0]' -o a.csv --cache cache --jobs 2
    check "seed $seed: a sweep does not depend on clocks" eval 'status_is 0 && cmp whole.csv a.csv'
    rm -f s r.petri
    jumping run w.fl --realtime --frames 60 --state s --trajectory a.csv --archive r.petri --stats
    if lacks err "built without SQLite"; then
        check "seed $seed: a run in real time ends" status_is 0
        check "seed $seed: the clock has jumped" [ "$(sed -n 's/^ *wall time *\([0-9]*\).*/\1/p' err)" -gt 100 ]
        check "seed $seed: a run in real time writes all frames" [ "$(wc -l <a.csv)" -eq 1201 ]
        petri archive verify r.petri
        check "seed $seed: an archive can be verified" has out "verified: 60 of 60 frames"
        jumping archive verify r.petri
        check "seed $seed: verifying does not depend on clocks" has out "verified: 60 of 60 frames"
    fi
done
