# archives.sh: tests that kill -9 at random moments leaves an archive that can be verified, and loses at most one second of
# frames. Part of ../cli/run.sh. PETRI_KILLS: number of killed runs (default: 100), half of them in real time.

kills=${PETRI_KILLS:-100} batch=10 fps=50
cat >film.fl <<END
%pragma fps $fps
!physics state=:p dimensions=2 time=time
    for i in ..20
        !particle id=i position=i%5;i//5 radius=0.6
    !collision
    !random strength=1
END
# start NUMBER: starts a run in the folder NUMBER, and kills it after a random time of up to 3 s.
start() {
    mkdir -p "$1"
    rm -f "$1"/*
    # Runs that are not in real time are often killed while they write.
    realtime=$([ $(($1 % 2)) -eq 0 ] && echo --realtime)
    delay=$(od -An -N2 -tu2 /dev/urandom | awk '{ print $1 / 65536 * 3 }')
    (
        # shellcheck disable=SC2086 # one word or none
        "$petri" run film.fl $realtime --frames 1000000 --keyframe-every 7 --print digest --archive "$1/run.petri" >"$1/out" 2>"$1/err" &
        job=$!
        sleep "$delay"
        kill -9 $job
        wait $job
    ) 2>/dev/null
    echo "$delay" >"$1/delay"
}
# survives NUMBER: succeeds if what is in the archive can be verified, and if the last second at most is missing.
survives() {
    computed=$(grep -c '^=' "$1/out")
    petri archive verify "$1/run.petri" --sample 20
    kept=$(sed -n 's/^verified: [0-9]* of \([0-9]*\) frames.*/\1/p' out)
    if [ $status -ne 0 ]; then
        # Killed before the first commit, one second after the first frame. On a busy machine, that frame is late.
        grep -q -e 'it has no frames' -e 'it is not an archive' -e 'No such file' err || return 1
        [ "$computed" -le $((fps + 1)) ] || [ "$(cut -d. -f1 "$1/delay")" -lt 2 ] || return 1
        kept=0
    fi
    [ $(($1 % 2)) -eq 1 ] || [ $((computed - kept)) -le $((fps + 1)) ]
}

if petri run film.fl --frames 1 --archive run.petri && status_is 0; then
    done=0 lost=0
    while [ $done -lt "$kills" ]; do
        for i in $(seq $batch); do
            start "$i" &
        done
        wait
        for i in $(seq $batch); do
            survives "$i" || {
                lost=$((lost + 1))
                echo "killed after $(cat "$i/delay") s: status $status, $computed frames computed, ${kept:-none} kept: $(cat err)"
            }
        done
        done=$((done + batch))
    done
    check "after kill -9, the archive is intact and lacks at most one second" [ $lost -eq 0 ]
else
    check "a build without SQLite says what is missing" has err "built without SQLite"
fi
