#!/bin/bash
# archives.sh NATIVE COMMAND...: checks that an archive that one build of petri writes is verified by another. NATIVE is a
# build for this machine; COMMAND is any build, perhaps in an emulator. Both must be petri-pictures.
#
# Each build records the same session of the prompt, with changed parameters, statements and undone frames. The digests of
# both runs must be equal: they cover all rows of an archive, so the archives differ in no value.
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
rm live.fl scale.fl
"${native[@]}" archive verify other.petri | tee verified
"${other[@]}" archive verify native.petri | cmp - verified
grep -q '^verified: 67 of 67 frames' verified
