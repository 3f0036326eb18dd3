#!/bin/bash
# check_steps.sh ROOT: checks that tests/README.md describes the steps of .ci/run and .ci/deep in their order, that each is a
# function, and that run_steps reports steps that pass, fail, are skipped or do not exist.
set -eu
cd "$1"
failed=0
for tier in run deep; do
    steps=$(sed -n "/^run_steps '/,/'/{s/^run_steps//;s/\"\$@\"//;s/'//g;p}" ".ci/$tier" | xargs -n 1)
    [ -n "$steps" ]
    rows=$(awk -v tier="$tier" '/^\| step of `/ { wanted = index($0, "`.ci/" tier "`") > 0 }
        /^$/ { wanted = 0 }
        wanted && /^\| `/ { sub(/^\| `/, ""); sub(/`.*/, ""); print }' tests/README.md)
    [ "$steps" = "$rows" ] || {
        echo ".ci/$tier (<) and its table in tests/README.md (>) differ:"
        diff <(echo "$steps") <(echo "$rows") || true
        failed=1
    }
    for step in $steps; do
        grep -q "^step_$step() " ".ci/$tier" || {
            echo ".ci/$tier has no function step_$step"
            failed=1
        }
    done
done

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cat >"$work/checks" <<END
set -euo pipefail
. "$PWD/.ci/steps.sh"
step_good() { echo good; }
step_bad() {
    false
    echo "not reached"
}
step_none() { skip "no tool"; }
run_steps 'good bad
    none' "\$@"
END
# expect STATUS PATTERN [STEP...]: runs the steps, and compares the status and the output.
expect() {
    local status=0
    bash "$work/checks" "${@:3}" >"$work/out" 2>&1 || status=$?
    [ "$status" -eq "$1" ] && tr '\n' ' ' <"$work/out" | grep -qE "$2" || {
        echo "run_steps ${*:3}: expected status $1 and '$2'; status $status:"
        cat "$work/out"
        failed=1
    }
}
expect 1 'good: passed .* bad: FAILED .* skipped: no tool .* none: skipped .* slowest .*repeat: .ci/checks bad $'
! grep -q 'not reached' "$work/out" || failed=1
expect 0 'good: passed after [0-9]* s .* [0-9]* s  passed   good $' good
expect 0 'skipped  none $' none
expect 2 "^checks: no such step: 'nosuch'; steps: good bad none $" good nosuch
exit "$failed"
