#!/bin/sh
# seeds.sh BUILD SOURCE FOLDER: writes the seeds of all harnesses to FOLDER/NAME, except those of corpus/NAME.
set -eu
build=$1 source=$2 work=$3
"$build/tests/fuzz/fuzz_seeds" "$work"
# One cp per file, because different folders contain equal file names.
find "$source/tests/golden" "$source/tests/conformance" "$source/tests/pictures" "$source/samples" \
    -name '*.fl' -size -4k -exec cp {} "$work/script" \;
cp "$work"/script/*.fl "$work/simplify/"
cp "$work"/script/*.fl "$work/fmt/"
# Scripts that need OpenGL are seeds of other harnesses.
find "$source/tests/pictures" -maxdepth 1 -name '*.fl' ! -name 'effect_*' -exec cp {} "$work/draw/" \;
cp "$source"/tests/pictures/effect_*.fl "$work/effects/"
cp "$source"/tests/pictures/scenes/*.fl "$work/scene/"
cp "$source"/tests/pictures/images/small.jpg "$work/image/"
for session in "$source"/tests/repl/*.session; do
    sed -n 's/^\(petri\|@[0-9]*\|\.\.\.\)>\{0,1\} //p' "$session" >"$work/repl/$(basename "$session")"
done
