# kill.sh: tests that kill -9 at any moment leaves either the old or the new file. Part of ../cli/run.sh.
#
# Each command is killed PETRI_KILLS / 5 times (default of PETRI_KILLS: 20; `./dev crash-test`: 500).

kills=${PETRI_KILLS:-20}
cat >w.fl <<'END'
!physics state=:c dimensions=2
    for i in ..5000
        !particle id=i velocity=1;i
!window size=200
    !canvas
        for i in ..100
            !ellipse point=2*i;$(:c;i)[1] radius=3 fill=true
END
sed 's/5000/200/' w.fl >few.fl
echo old >old
printf '# run --frames 40 --print state\nold\n' >old.golden
cp few.fl g.fl

good_state() { [ "$(tail -n 1 "$1" | cut -c1-4)" = "end " ] && [ "$(tail -c 1 "$1" | wc -l)" -eq 1 ]; }
good_csv() { [ "$(wc -l <"$1")" -eq 50001 ]; }
good_golden() { head -n 1 "$1" | grep -q '^# run' && [ "$(grep -c '^@' "$1")" -eq 40 ]; }
good_png() { tail -c 8 "$1" | grep -q IEND; }
good_film() { grep -q moov "$1"; }

# kill_often NAME FILE OLD GOOD COMMAND...: starts COMMAND, which replaces FILE, PETRI_KILLS / 5 times. Kills it at
# moments that are spread over its duration. Before each run, FILE is a copy of OLD. The command `GOOD FILE` succeeds if
# FILE is complete and new.
kill_often() {
    what=$1 file=$2 old=$3 good=$4
    shift 4
    cp "$old" "$file"
    start=$(date +%s%N)
    timeout 100 "$petri" "$@" >out 2>err </dev/null
    status=$?
    span=$((($(date +%s%N) - start) / 1000000))
    check "$what: an undisturbed run succeeds" eval 'status_is 0 && $good "$file"'
    damaged=0
    i=0
    while [ $i -lt $(((kills + 4) / 5)) ]; do
        cp "$old" "$file"
        "$petri" "$@" >out 2>err </dev/null &
        job=$!
        sleep "$(awk "BEGIN { print $span * ($i + 0.7) / (($kills + 4) / 5) / 1000 }")"
        kill -9 $job 2>/dev/null
        wait $job 2>/dev/null
        cmp -s "$old" "$file" || $good "$file" || damaged=$((damaged + 1))
        i=$((i + 1))
    done
    check "$what: a killed run leaves the old or the new file" [ $damaged -eq 0 ]
    timeout 100 "$petri" "$@" >out 2>err </dev/null
    status=$?
    check "$what: the run after the killed ones succeeds" eval 'status_is 0 && $good "$file"'
}

petri run w.fl --frames 3 --state old.state
kill_often state a.state old.state good_state run w.fl --frames 5 --state a.state
kill_often trajectory a.csv old good_csv run w.fl --frames 10 --trajectory a.csv
if [ -x "$(dirname "$petri")/petri-hdf5" ] && /usr/bin/python3 -I -c 'import h5py' 2>/dev/null; then
    # petri-hdf5 keeps running and stores the complete frames.
    good_h5md() { /usr/bin/python3 -I "$here/../files/h5md.py" --frames "$1" >/dev/null; }
    kill_often h5md a.h5 old good_h5md run w.fl --frames 10 --trajectory a.h5
fi
kill_often golden g.golden old.golden good_golden test --update g.fl
petri render few.fl --frames 1 -o a.png
if [ "$status" -eq 0 ]; then
    kill_often picture a.png old good_png render few.fl --frames 20 -o a.png
    if command -v ffmpeg >/dev/null; then
        kill_often film a.mp4 old good_film render few.fl --frames 20 -o a.mp4
    fi
fi
check "killed runs leave no temporary files" [ -z "$(find . -name '*.tmp')" ]
