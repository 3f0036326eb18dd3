# steps.sh: runs steps of checks and reports their times. Sourced by run and deep, which define a function step_NAME for
# each step.

# run_steps ALL [NAME...]: runs the named steps, or ALL, a list of names. A step that fails does not stop the others. Prints
# a line for each step at its end and a summary, slowest first. A step that calls `skip` is reported as skipped. Returns 1
# if a step failed.
run_steps() {
    local all=$1 name start status state summary='' failed='' seconds
    shift
    for name; do
        [[ " ${all//$'\n'/ } " == *" $name "* ]] || {
            echo "${0##*/}: no such step: '$name'; steps: $(xargs <<<"$all")" >&2
            exit 2
        }
    done
    # shellcheck disable=SC2086 # names are words
    [ $# -gt 0 ] || set -- $all
    for name; do
        printf '\n=== %s\n' "$name"
        start=$SECONDS
        # `set -e` has no effect in a function whose status is tested, so it is set in the subshell.
        set +e
        (
            set -euo pipefail
            "step_$name"
        )
        status=$?
        set -e
        seconds=$((SECONDS - start))
        case $status in
        0) state=passed ;;
        77) state=skipped ;;
        *) state=FAILED failed+=" $name" ;;
        esac
        summary+=$(printf '%5d s  %-8s %s' "$seconds" "$state" "$name")$'\n'
        printf '=== %s: %s after %d s\n' "$name" "$state" "$seconds"
    done
    printf '\n=== %d s in total, slowest steps first\n' "$SECONDS"
    sort -rn <<<"${summary%$'\n'}"
    [ -z "$failed" ] || {
        echo "failed; to repeat: .ci/${0##*/}$failed"
        return 1
    }
}

# skip REASON: ends a step that is not possible on this machine.
skip() {
    echo "skipped: $1"
    exit 77
}

# The sources must not change, and no file may appear that git does not ignore.
check_clean_tree() {
    local untracked
    git diff --exit-code
    untracked=$(git ls-files --others --exclude-standard)
    [ -z "$untracked" ] || {
        printf 'untracked files:\n%s\n' "$untracked"
        return 1
    }
}
