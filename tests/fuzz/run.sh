#!/bin/sh
# run.sh BUILD SOURCE SECONDS [NAME ...]: runs the harnesses (default: all) for SECONDS each, as many in parallel as there
# are processors. Inputs are collected in BUILD/fuzz/NAME from run to run. Findings are minimised and stored in
# tests/fuzz/crashes/NAME, where replay.sh uses them. Exits with 1 if anything was found. The variable PETRI_FUZZ_SEED
# is the seed of the random numbers (0, the default: another one in each run).
set -eu
build=$(cd "$1" && pwd) source=$(cd "$2" && pwd) seconds=$3
shift 3
work=$build/fuzz

# minimise NAME FILE: minimises a finding and stores it.
minimise() {
    stored=$source/tests/fuzz/crashes/$1/$(sha1sum <"$2" | cut -c -12)
    mkdir -p "${stored%/*}"
    cp "$2" "$stored"
    case $2 in
    *-crash-* | *-leak-*)
        "$build/tests/fuzz/fuzz_$1" -minimize_crash=1 -max_total_time=60 -exact_artifact_path="$work/small" "$2" \
            >/dev/null 2>&1 || true
        [ ! -s "$work/small" ] || mv "$work/small" "$stored"
        ;;
    esac
    echo "$1: stored a finding in ${stored#"$source"/}; to repeat, run: build-sanitizers/tests/fuzz/fuzz_$1 ${stored#"$source"/}"
    # The log of a CI run is all that is left of its machine.
    echo "$1: the finding in base64: $(base64 -w 0 "$stored" | head -c 8000)"
}

# explain LOG: prints the reason of a failure and the functions that were being executed.
explain() {
    grep -a -m 3 -e 'runtime error' -e 'ERROR: ' -e 'Assertion' -e 'fuzz_fail: ' "$1" || tail -n 3 "$1"
    sed -n 's|^ *#[0-9]* 0x[0-9a-f]* in \([^ ]*\) .*/\([a-z_]*/[^/]*:[0-9]*\):.*|    \1 (\2)|p' "$1" | head -n 15
}

fuzz_one() {
    name=$1 quiet=0 longest=4096
    [ "$name" != repl ] || longest=300 # commands take long
    # `quiet` hides the output of harnesses that run commands.
    case $name in
    archive | arguments | database | golden | journal | link | listen | lsp | plan | repl | resume) quiet=3 ;;
    esac
    rm -f "$work/found-$name"-*
    cd "$work"
    if "$build/tests/fuzz/fuzz_$name" -dict="$work/dictionary" -max_len=$longest -timeout=60 -rss_limit_mb=3000 \
        -max_total_time="$seconds" -seed="${PETRI_FUZZ_SEED:-0}" -close_fd_mask=$quiet -print_final_stats=1 \
        -artifact_prefix="$work/found-$name-" "$work/$name" >"$work/$name.log" 2>&1; then
        echo "$name: $(sed -n 's/^stat::number_of_executed_units: *//p' "$work/$name.log") inputs, nothing found"
        return
    fi
    explain "$work/$name.log"
    for found in "$work/found-$name"-*; do
        [ ! -f "$found" ] || minimise "$name" "$found"
    done
    return 1
}

export ASAN_OPTIONS="${ASAN_OPTIONS:-detect_stack_use_after_return=0:allocator_may_return_null=1}"
export UBSAN_OPTIONS="${UBSAN_OPTIONS:-print_stacktrace=1}"
export LSAN_OPTIONS="${LSAN_OPTIONS:-suppressions=$source/tests/leaks.txt:print_suppressions=0}"
if [ "${PETRI_FUZZ_ONE:-}" ]; then
    fuzz_one "$1"
    exit
fi
# libFuzzer exits without removing temporary files.
TMPDIR=$(mktemp -d "$([ -w /dev/shm ] && echo /dev/shm || echo /tmp)/fuzz-XXXXXX")
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT
"$source/tests/fuzz/seeds.sh" "$build" "$source" "$work"
cp -r "$source"/tests/fuzz/corpus/. "$work/"
[ $# -gt 0 ] || set -- $(find "$source/tests/fuzz" -name 'fuzz_*.c' | sed 's|.*/fuzz_||; s|\.c$||' | sort)
export PETRI_FUZZ_ONE=1
printf '%s\n' "$@" | xargs -P "$(nproc)" -I NAME sh "$0" "$build" "$source" "$seconds" NAME || exit 1
