# check.sh: checks that are counted, for tests in shell. Sourced; `here` is the folder of the test, `root` the project.
unset CDPATH
here=$(cd "$(dirname "$0")" && pwd)
root=${here%/tests/*}
# A test that is started by hand gets the environment that meson gives it.
[ "${PETRI_TESTS:-}" = clean ] || exec "$root/.ci/clean-env" "$here/$(basename "$0")" "$@"
passed=0
failed=0
failures=
status=

# check NAME COMMAND...: the command must succeed. `status` is told if the test keeps exit statuses there.
check() {
    name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
        echo "ok $name"
    else
        failed=$((failed + 1))
        failure="FAIL $name: $*${status:+ (exit status $status)}"
        echo "$failure"
        failures="$failures$failure
"
        print_details
    fi
}

# print_details: what helps to see why a check has failed; tests may have one of their own.
print_details() {
    for output_file in out err; do
        [ ! -s "$output_file" ] || head -c 600 "$output_file" | sed "s/^/  $output_file: /"
    done
}

# finish: what failed once more, since of a long log only the end is kept; the last line, and the status of the test.
finish() {
    printf '%s' "$failures"
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
}

# scratch: goes into a new folder, `work`, which is gone when the test ends.
scratch() {
    work=$(mktemp -d) || exit 1
    trap 'chmod -R u+rwx "$work"; rm -rf "$work"' EXIT
    trap 'exit 130' INT TERM
    cd "$work" || exit 1
}

# program PATH: the same from the root; ends the test if there is no such program.
program() {
    if [ ! -x "$1" ]; then
        echo "usage: $0 PATH-OF-PETRI ..." >&2
        exit 2
    fi
    echo "$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"
}

# quoted TEXT: prints it quoted for a shell; the path of the checkout may contain blanks and apostrophes.
quoted() { printf "'%s'\n" "$(printf '%s\n' "$1" | sed "s/'/'\\\\''/g")"; }

status_is() { [ "$status" -eq "$1" ]; }
has() { grep -Fq -e "$2" "$1"; }
lacks() { ! has "$@"; }
empty() { [ ! -s "$1" ]; }
exists() { [ -e "$1" ]; }
count_is() { [ "$(grep -Fc -e "$2" "$1")" -eq "$3" ]; }
lines_are() { [ "$(wc -l <"$1")" -eq "$2" ]; }
# repeat COUNT TEXT
repeat() { awk -v n="$1" -v s="$2" 'BEGIN { for (i = 0; i < n; i++) printf "%s", s }'; }
