# check.sh: functions that run and count the checks of a shell test. Sourced by the test. Sets `here` to the folder of
# the test and `root` to that of the project.
unset CDPATH
here=$(cd "$(dirname "$0")" && pwd)
root=${here%/tests/*}
# A test that was started by hand restarts itself in the environment that meson provides.
[ "${PETRI_TESTS:-}" = clean ] || exec "$root/.ci/clean-env" "$here/$(basename "$0")" "$@"
passed=0
failed=0
failures=
status=

# check NAME COMMAND...: checks that the command succeeds. On failure prints `status` if the test has set it.
check() {
    name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
        echo "ok $name"
    else
        failed=$((failed + 1))
        reason=${status:+exit status $status}
        [ "$status" != 124 ] || reason="exit status 124: stopped by this test's time limit"
        failure="FAIL $name: $*${reason:+ ($reason)}"
        echo "$failure"
        failures="$failures$failure
"
        print_details
    fi
}

# print_details: prints the beginning of the files out and err after a failure. Tests may redefine it.
print_details() {
    for output_file in out err; do
        [ ! -s "$output_file" ] || head -c 600 "$output_file" | sed "s/^/  $output_file: /"
    done
}

# finish: repeats the failures, because often only the end of a long log is shown, and prints the summary. Returns the
# status.
finish() {
    printf '%s' "$failures"
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
}

# scratch: changes to a new folder, `work`, which is removed when the test ends.
scratch() {
    work=$(mktemp -d) || exit 1
    trap 'chmod -R u+rwx "$work"; rm -rf "$work"' EXIT
    trap 'exit 130' INT TERM
    cd "$work" || exit 1
}

# program PATH: prints the absolute path of a program. Exits with 2 if the file does not exist.
program() {
    if [ ! -x "$1" ]; then
        echo "usage: $0 PATH-OF-PETRI ..." >&2
        exit 2
    fi
    echo "$(cd "$(dirname "$1")" && pwd)/$(basename "$1")"
}

# quoted TEXT: prints the string quoted for a shell, because the path of the checkout may contain blanks and
# apostrophes.
quoted() { printf "'%s'\n" "$(printf '%s\n' "$1" | sed "s/'/'\\\\''/g")"; }

status_is() { [ "$status" -eq "$1" ]; }
has() { grep -Fq -e "$2" "$1"; }
lacks() { ! has "$@"; }
empty() { [ ! -s "$1" ]; }
exists() { [ -e "$1" ]; }
count_is() { [ "$(grep -Fc -e "$2" "$1")" -eq "$3" ]; }
lines_are() { [ "$(wc -l <"$1")" -eq "$2" ]; }
# repeat COUNT TEXT: prints the string COUNT times.
repeat() { awk -v n="$1" -v s="$2" 'BEGIN { for (i = 0; i < n; i++) printf "%s", s }'; }
