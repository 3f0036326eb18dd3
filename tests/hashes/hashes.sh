#!/bin/bash
# hashes.sh [--check] COMMAND...: what the scripts of both conformance corpora come to, one line each: the first 16
# digits of the SHA-256 of what `COMMAND run` prints, which is tree, log and the hash of the state in the golden's frames.
#
# COMMAND is a petri of any build, in an emulator or not: all must print the same lines. --check compares them with
# corpora.txt, which `./dev hashes --update` writes, and names the scripts that differ.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
mode=print
if [ "${1:-}" = --check ]; then
    mode=check
    shift
fi
[ $# -gt 0 ] || {
    echo "usage: $0 [--check] COMMAND..." >&2
    exit 2
}
# It is run in another folder.
command=()
for word; do
    [ "${word#/}" != "$word" ] || [ ! -f "$word" ] || word=$PWD/$word
    command+=("$word")
done
cd "$here/../conformance"
"${command[@]}" --version >/dev/null # rather than a failure for each script

# hash_of FOLDER/NAME: the line of that script.
hash_of() {
    local first hash
    read -r first <"$1.golden"
    eval "set -- $1 ${first#\# run}" # the quotes in a golden are those of a shell
    if hash=$(cd "${1%/*}" && "${command[@]}" run --threads 1 "${@:2}" --print tree,log,hash "${1##*/}.fl" 2>/dev/null |
        sha256sum); then
        echo "$1.fl ${hash:0:16}"
    else
        echo "$1.fl failed"
    fi
}

# As many scripts at a time as there are processors.
all_hashes() {
    local goldens=(*/*.golden) jobs job i
    jobs=$(nproc)
    for ((job = 0; job < jobs; job++)); do
        for ((i = job; i < ${#goldens[@]}; i += jobs)); do
            hash_of "${goldens[i]%.golden}"
        done &
    done | LC_ALL=C sort
}

if [ $mode = print ]; then
    all_hashes | awk '{ print } $2 == "failed" { bad = 1 } END { exit bad }'
    exit
fi
differing=$(all_hashes | LC_ALL=C comm -3 - "$here/corpora.txt" | awk '{ print $1 }' | uniq)
count=$(grep -c . <<<"$differing") || true
if [ "$count" -gt 0 ]; then
    echo "other than in tests/hashes/corpora.txt; if that is meant: ./dev hashes --update"
    echo "$differing"
fi
echo "hashes: $(wc -l <"$here/corpora.txt") scripts, $count differ"
[ "$count" -eq 0 ]
