#!/bin/bash
# faults.sh PETRI [--table | --update]: plants each fault of faults.txt in a script and checks that petri test finds and shrinks it.
# It compares the properties, frames and parameters with faults_found.txt. Without a fault, all properties hold. --table
# prints a table with times, for the manual, and --update records faults_found.txt.
set -u
here=$(cd "$(dirname "$0")" && pwd)
petri=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
work=$(mktemp -d "${TMPDIR:-/tmp}/petri-properties.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
cp "$here"/*.fl "$here"/*.properties "$work"
cd "$work" || exit 1
failed=0
if ! "$petri" test . >out 2>&1; then
    echo "a script without a fault violates a property:"
    cat out
    failed=1
fi
number=0
while IFS='|' read -r name script change; do
    [ "${name#\#}" = "$name" ] || continue
    number=$((number + 1))
    rm -rf fault
    mkdir fault
    sed "$change" "$script.fl" >"fault/$script.fl"
    cp "$script.properties" fault
    start=$(date +%s.%N)
    "$petri" test fault >out 2>&1
    status=$?
    end=$(date +%s.%N)
    property=$(sed -n 's/^.*\.properties:[0-9]*: error: \(.*\): violated$/\1/p' out | head -n 1)
    where=$(sed -n 's/^ *violated in frame \([0-9]*\) with \([^:]*\).*/\1|\2/p' out | head -n 1)
    if cmp -s "$script.fl" "fault/$script.fl" || [ "$status" -ne 1 ] || [ -z "$property" ] || [ -z "$where" ]; then
        echo "not found: $name"
        cat out
        failed=1
    elif [ "${2:-}" = --table ]; then
        printf '| %s | `%s` | `%s` | %s | %.1f s |\n' "$name" "$property" "${where#*|}" "${where%%|*}" \
            "$(echo "$end - $start" | bc)"
    else
        printf '%s: %s: %s\n' "$name" "$property" "$where" >>found
    fi
done <"$here/faults.txt"
[ "${2:-}" != --table ] || exit "$failed"
echo "$number faults" >>found
if [ "${2:-}" = --update ]; then
    cp found "$here/faults_found.txt"
elif ! diff -u "$here/faults_found.txt" found; then
    failed=1
fi
exit "$failed"
