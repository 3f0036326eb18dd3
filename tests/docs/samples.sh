#!/bin/sh
# samples.sh PETRI ROOT: checks all samples: `petri check` prints nothing, every parameter has a comment and a range, and
# the sample runs without messages at both ends of the range. Each step of the tutorial has a task, whose answer in tasks.txt
# runs, too.
set -u
LC_ALL=C.UTF-8
export LC_ALL

petri=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
cd "$2" || exit 2
work=$(mktemp -d "${TMPDIR:-/tmp}/petri-samples.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM HUP

passed=0
failed=0
check() { # NAME COMMAND...
    name=$1
    shift
    if "$@" >"$work/out" 2>&1 </dev/null; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAIL $name: $(head -n 2 "$work/out")"
    fi
}
silent() { # COMMAND...: succeeds without output
    "$@" && [ ! -s "$work/out" ]
}

check "petri check prints nothing" "$petri" check --werror samples
for script in samples/*.fl; do
    "$petri" run --parameters "$script" </dev/null >"$work/parameters" 2>"$work/err"
    check "$script has parameters" [ -s "$work/parameters" ]
    while read -r parameter value range comment; do
        check "$script: $parameter has a comment" [ -n "$comment" ]
        case $range in
        *..*) ;;
        *) check "$script: $parameter has a range" false ;;
        esac
        for end in "${range%%..*}" "${range##*..}"; do
            check "$script runs silently with $parameter=$end" \
                silent "$petri" run --frames 5 -D "$parameter=$end" "$script" --print error
        done
        check "$script: the default of $parameter is within its range" \
            awk -v value="$value" -v range="$range" '
                BEGIN { split(range, end, /\.\./); exit !(end[1] <= value && value <= end[2]) }'
    done <"$work/parameters"
done

# Writes the script of each step to N.fl, and the numbers of the steps that end with a task.
awk -v work="$work" '/^## [0-9]+\. / { step = $2 + 0 }
    /^```flitter cells\.fl$/ { file = work "/" step ".fl"; next }
    /^```$/ { file = "" }
    file { print >file }
    /^\*\*Task:\*\* / { print step }' samples/TUTORIAL.md >"$work/tasks"
check "each step of the tutorial has one task" [ "$(tr '\n' ' ' <"$work/tasks")" = "$(seq -s ' ' 12) " ]
# The tasks about tests and the prompt do not change the script.
check "each task of the first ten has an answer" [ "$(sed '/^#/d; s/ .*//' tests/docs/tasks.txt | tr '\n' ' ')" = "$(seq -s ' ' 10) " ]
sed '/^#/d' tests/docs/tasks.txt >"$work/answers"
while read -r step answer; do
    sed "$answer" "$work/$step.fl" >"$work/answer.fl"
    check "step $step: the answer changes the script" [ "$(cat "$work/answer.fl")" != "$(cat "$work/$step.fl")" ]
    check "step $step: petri check accepts the answer" "$petri" check --werror "$work/answer.fl"
    check "step $step: the answer runs silently" silent "$petri" run --frames 61 "$work/answer.fl" --print error
done <"$work/answers"

[ $passed -ge 100 ] || check "at least 100 checks were made, not $passed" false
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
