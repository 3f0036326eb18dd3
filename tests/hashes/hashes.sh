#!/bin/bash
# hashes.sh [--check] COMMAND...: prints a result hash for each script of both conformance corpora: the first 16 digits
# of the SHA-256 of the output of `COMMAND run`, that is, tree, log, hash and digest of the golden's frames.
#
# COMMAND is any build of petri, perhaps in an emulator; all builds must print the same lines. --check compares them with
# corpora.txt, which `./dev hashes --update` writes, and lists the scripts that differ.
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
# Paths in COMMAND are made absolute, because it is run in another folder.
command=()
for word; do
    [ "${word#/}" != "$word" ] || [ ! -f "$word" ] || word=$PWD/$word
    command+=("$word")
done
cd "$here/../conformance"
"${command[@]}" --version >/dev/null # reports a broken COMMAND once instead of once per script

# hash_of FOLDER/NAME: prints the result line of a script.
hash_of() {
    local first hash
    read -r first <"$1.golden"
    eval "set -- $1 ${first#\# run}" # the options in a golden are quoted for a shell
    # A run whose script imports a module with a syntax error ends with 1 after its last frame.
    if hash=$(cd "${1%/*}" && { "${command[@]}" run --threads 1 "${@:2}" --print tree,log,hash,digest "${1##*/}.fl" 2>/dev/null ||
        [ $? -eq 1 ]; } | sha256sum); then
        echo "$1.fl ${hash:0:16}"
    else
        echo "$1.fl failed"
    fi
}

# Runs as many scripts in parallel as there are processors.
all_hashes() {
    local goldens=(*/*.golden) jobs job i
    jobs=$(nproc)
    {
        for ((job = 0; job < jobs; job++)); do
            for ((i = job; i < ${#goldens[@]}; i += jobs)); do
                hash_of "${goldens[i]%.golden}"
            done &
        done
        wait # for their times
    } | LC_ALL=C sort
}

if [ $mode = print ]; then
    all_hashes | awk '{ print } $2 == "failed" { bad = 1 } END { exit bad }'
    exit
fi
differing=$(all_hashes | LC_ALL=C comm -3 - "$here/corpora.txt" | awk '{ print $1 }' | uniq)
count=$(grep -c . <<<"$differing") || true
if [ "$count" -gt 0 ]; then
    echo "results differ from tests/hashes/corpora.txt; if this is intended, run: ./dev hashes --update"
    echo "$differing"
fi
echo "hashes: $(wc -l <"$here/corpora.txt") scripts, $count differ"
[ "$count" -eq 0 ]
