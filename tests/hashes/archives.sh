#!/bin/bash
# archives.sh NATIVE COMMAND...: checks that archives, state files and links that one build of petri writes are read by
# another. NATIVE is a build for this machine; COMMAND is any build, perhaps in an emulator. Both must be petri-pictures.
#
# Each build records the same session of the prompt, with changed parameters, statements and undone frames. The digests of
# both runs must be equal: they cover all rows of an archive, so the archives differ in no value. State files must have the
# same bytes. Links need zlib in both builds.
set -euo pipefail
[ $# -gt 1 ] || {
    echo "usage: $0 NATIVE COMMAND..." >&2
    exit 2
}
words=()
for word; do
    [ "${word#/}" != "$word" ] || [ ! -f "$word" ] || word=$PWD/$word
    words+=("$word")
done
native=("${words[0]}")
other=("${words[@]:1}")
stored=$(cd "$(dirname "$0")/../archives" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$scratch"
cat >live.fl <<'END'
%pragma fps 25
import scale from 'scale.fl'
let N=N or 12
!physics state=:p dimensions=3 time=time
    for i in ..N
        !particle id=i position=scale*normal(:a)[3*i..3*i+3] radius=1 mass=1+i/4 charge=0.5
    !collision
    !gravity strength=2
    !electrostatic strength=0.5
    !random strength=1
    !drag strength=0.1
!counter state=:turns rate=sin(time)
END
echo 'let scale=2.5' >scale.fl

# record NAME COMMAND...: records the session in NAME.petri.
record() {
    printf '%s\n' '.archive run.petri' '.step 30' '.set N 7' 'let k=2' '!counter state=:q rate=exp(k)' '.step 20' '.tempo 90' \
        '.step 9' '.back 12' '.step 20' | "${@:2}" repl live.fl >out 2>&1 || { cat out && exit 1; }
    mv run.petri "$1.petri"
}
record native "${native[@]}"
record other "${other[@]}"

# Each build starts a state file, and continues that of the other.
"${native[@]}" run live.fl --frames 30 --state native.state
"${other[@]}" run live.fl --frames 30 --state other.state
cmp native.state other.state
"${other[@]}" run live.fl --frames 20 --state native.state
"${native[@]}" run live.fl --frames 20 --state other.state
cmp native.state other.state
grep -q '^frame 49$' native.state
echo "state files: equal at frames 29 and 49, $(wc -c <native.state) bytes"

# A link cannot contain the module.
sed "s/^import.*/let scale=2.5/" live.fl >alone.fl
if "${other[@]}" link alone.fl --frame 30 >other.link 2>out; then
    "${native[@]}" link alone.fl --frame 30 >native.link
    "${native[@]}" run "$(cat other.link)" >out
    "${other[@]}" run "$(cat native.link)" >out
else
    grep 'zlib' out || { cat out && exit 1; }
    echo "skipped: links"
fi

rm live.fl scale.fl
"${native[@]}" archive verify other.petri | tee verified
"${other[@]}" archive verify native.petri | cmp - verified
grep -q '^verified: 67 of 67 frames' verified

# Archives of releases, with all kinds of forces, inputs and drawings.
count=0
for file in "$stored"/*/*.petri; do
    release=$(basename "$(dirname "$file")")
    "${native[@]}" archive verify "$file" --spec "$release" >verified
    "${other[@]}" archive verify "$file" --spec "$release" | cmp - verified
    count=$((count + 1))
done
echo "archives of releases: $count verified"
