#!/bin/sh
# run.sh PETRI [--update] [FILE...]: repeats recorded sessions of `petri repl` with `petri test`, each in a copy of
# this folder, because sessions write files. `petri test` must also reproduce the goldens that a session records.
# Without FILE, also tests the transcripts themselves.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1")
shift
update=
if [ "${1:-}" = --update ]; then
    update=--update
    shift
fi
all=
[ $# -gt 0 ] || { all=yes && set -- "$here"/*.session; }
start=$PWD
scratch
print_details() { cat "$work/out"; } # of the last `petri test`
run() { "$petri" test "$@" >"$work/out" 2>&1; }
said() { has "$work/out" "$1"; }

for session in "$@"; do
    [ "${session#/}" != "$session" ] || session=$start/$session
    name=$(basename "$session" .session)
    folder=$work/$name
    mkdir "$folder"
    cp -R "$here"/*.fl "$here"/lib "$session" "$folder"/
    check "$name" run $update "$folder/$name.session"
    [ -z "$update" ] || cmp -s "$folder/$name.session" "$session" || {
        cp "$folder/$name.session" "$session"
        echo "updated $name"
    }
    set -- "$folder"/*.golden
    [ ! -f "$1" ] || check "$name: petri test reproduces its goldens" run "$@"
done

if [ -n "$all" ]; then
    mkdir own
    cd own || exit 1
    printf '!counter state=:n rate=60\n' >count.fl
    printf '.step 3\n$:n\n.step 1+\n.time 1\n' >inputs
    "$petri" repl count.fl <inputs >count.session 2>/dev/null
    check "what petri repl prints is a transcript, but for its messages" [ "$(head -n 1 count.session)" = "petri> .step 3" ]
    run count.session
    check "a missing message is a difference" said "the answers differ"
    check "the difference is shown" said "+prompt:1:3: error: "
    check "the name of the test is that of the file" said "FAIL count.session"
    run --update count.session
    check "--update records the messages" grep -q '^prompt:1:3: error: ' count.session
    check "--update records the exit status" grep -qx '# exit status 1' count.session
    check "the recorded session passes" run .
    check "the folder has one test" said "1 passed, 0 failed"
    sed 's/ *$//; s/^-- [0-9.e-]* [munk]*s,/-- 77 s,/' count.session >edited && mv edited count.session
    check "blanks after prompts and times are not compared" grep -q '^@2>$' count.session
    check "such a session passes" run count.session
    printf 'petri> 1+1\n3\n' >count.session
    run count.session
    check "a wrong answer fails" said "-3"
    check "the answer is shown" said "+2"
    printf '# repl -D N=5 other.fl\npetri> N\n5\npetri>\n' >count.session
    printf 'let N=N or 2\n' >other.fl
    check "a transcript names its options and script" run count.session
    printf '# repl nowhere.fl\npetri> 1\n1\n' >alone.session
    run alone.session
    check "a missing script is reported where it was" said "+error: cannot read 'nowhere.fl'"
    : >count.session
    check "an empty transcript has no inputs" run count.session

    # A session with changes, blocks and going back is recorded; its inputs give the same state again.
    cp -R "$here"/*.fl "$here"/lib .
    last='$(:cells;1); $(:cells;1;:velocity); $:ticks; $:typed; doubled'
    printf '%s\n' '.step 30' 'let doubled=2*$:ticks' 'func f(x)' '    x*2' '' 'f(_1 or 3)' '.back 7' '!counter state=:typed rate=3' '' \
        '.step 20' '.tempo 90' '.step 5' '.record cells' '.record kept.session' "$last" >inputs
    "$petri" repl -D GAP=2 --fps 50 cells.fl <inputs >live 2>&1
    check "the session is recorded" grep -q '^-- 10 inputs and their answers written to kept.session$' live
    check "the recorded session passes" run kept.session
    check "it begins with the options" [ "$(head -n 1 kept.session)" = "# repl --fps 50 -D GAP=2 cells.fl" ]
    grep -v -e '^# exit' -e '^@52> $' kept.session >longer.session
    printf 'petri> %s\n' "$last" >>longer.session
    "$petri" repl longer.session >"$work/out"
    check "its inputs lead to the same state" [ "$(tail -n 3 "$work/out" | head -n 1)" = "$(tail -n 2 live | head -n 1)" ]
    printf '.step 3\n.archive kept.petri\n.step 2\n.arch more.petri\n.rec more.session\n' | "$petri" repl cells.fl >"$work/out" 2>&1
    check "a session that was also archived is recorded" said "-- 2 inputs and their answers written to more.session"
    check "it passes, too" run more.session
    check "it writes no archive" [ "$(grep -c -e archive -e petri$ more.session)" -eq 0 ]
    printf '.record kept.session\n.record --replace kept.session\n' | "$petri" repl >"$work/out" 2>&1
    check ".record replaces no file by itself" said "'kept.session' already exists; to replace it, run"
    check ".record --replace replaces it" said "-- 0 inputs and their answers written to kept.session"
fi
finish
