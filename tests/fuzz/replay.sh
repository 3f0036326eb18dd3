#!/bin/sh
# replay.sh BUILD SOURCE: runs each harness on its seeds (with those of corpus/NAME) and on earlier findings
# (crashes/NAME), without fuzzing. Skips harnesses whose optional libraries are missing.
set -eu
build=$1 source=$2
folder=$(mktemp -d "${TMPDIR:-/tmp}/petri-fuzz-XXXXXX")
trap 'rm -rf "$folder"' EXIT
"$build/tests/fuzz/fuzz_seeds" "$folder/seeds"
cp "$folder"/seeds/script/* "$folder/seeds/simplify/"
cp "$folder"/seeds/script/* "$folder/seeds/fmt/"
cp -r "$source"/tests/fuzz/corpus/. "$folder/seeds/"
cp "$source"/tests/pictures/images/small.jpg "$folder/seeds/image/"
failed=0
for seeds in "$folder"/seeds/*/; do
    name=$(basename "$seeds")
    set -- "$seeds"*
    for found in "$source/tests/fuzz/crashes/$name"/*; do
        [ ! -f "$found" ] || set -- "$@" "$found"
    done
    [ -f "$1" ] || {
        echo "not ok - $name: no seeds"
        failed=1
        continue
    }
    # Without libFuzzer, most harnesses are in one program, which exits with 77 for others (replay.c).
    count=$# status=77
    if [ -x "$build/tests/fuzz/fuzz_replay" ]; then
        set -- "$name" "$@"
        status=0
        "$build/tests/fuzz/fuzz_replay" "$@" >"$folder/log" 2>&1 || status=$?
    fi
    if [ $status -eq 77 ] && [ -x "$build/tests/fuzz/fuzz_$name" ]; then
        status=0
        "$build/tests/fuzz/fuzz_$name" "$@" >"$folder/log" 2>&1 || status=$?
    fi
    case $status in
    0) echo "ok - $name: $count inputs" ;;
    77) ;;
    *)
        tail -n 40 "$folder/log"
        echo "not ok - $name"
        failed=1
        ;;
    esac
done
exit $failed
