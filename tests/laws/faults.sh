#!/bin/sh
# faults.sh ROOT [TEST...]: plants each fault of faults.txt (or those of TEST) in a copy of the sources of petri, and
# checks that the law to which it belongs fails. It takes about half a minute per fault, so it is not one of the tests.
# Run it after a change of the laws.
set -eu
root=$(cd "$1" && pwd)
shift
work=$(mktemp -d "${TMPDIR:-/tmp}/petri-faults.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP
(cd "$root" && git ls-files -z | xargs -0 cp --parents -t "$work")
meson setup "$work/build" "$work" --buildtype=release -Dcairo=disabled -Dgl=disabled >"$work/log"
tests=tests/laws/laws_tests

# Builds the tests. Prints the names of those that fail.
run() {
    nice ninja -C "$work/build" "$tests" >"$work/log" 2>&1 || {
        cat "$work/log"
        exit 1
    }
    "$work/build/$tests" 2>&1 | sed -n 's/^\[  FAILED  \] \(test_[a-z_]*\)$/\1/p' | sort -u | tr '\n' ' '
}

status=0
failed=$(run)
[ -z "$failed" ] || {
    echo "without a fault, these fail: $failed"
    exit 1
}
tab=$(printf '\t')
while IFS=$tab read -r law file fault; do
    case $law in
    '#'* | '') continue ;;
    esac
    [ $# -eq 0 ] || case " $* " in
    *" $law "*) ;;
    *) continue ;;
    esac
    path=$work/lib/physics/$file
    cp "$path" "$work/original"
    sed "$fault" "$work/original" >"$path"
    if cmp -s "$path" "$work/original"; then
        echo "not ok - $law: the fault is not in $file: $fault"
        status=1
        continue
    fi
    failed=$(run)
    case " $failed " in
    *" $law "*) echo "ok - $law: $file: $fault (fails: ${failed% })" ;;
    *)
        echo "not ok - $law: $file: $fault (fails: ${failed% })"
        status=1
        ;;
    esac
    cp "$work/original" "$path"
done <"$root/tests/laws/faults.txt"
exit $status
