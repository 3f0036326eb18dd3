#!/bin/sh
# run.sh: what a user sees of the `petri` command: exit codes, what goes where, bad input, the golden runner.
# usage: tests/cli/run.sh PATH-OF-PETRI [PART...]. Each check says what it shows; the last line counts them.

here=$(cd "$(dirname "$0")" && pwd)
case $1 in
/*) petri=$1 ;;
*) petri=$PWD/$1 ;;
esac
if [ ! -x "$petri" ]; then
    echo "usage: $0 PATH-OF-PETRI" >&2
    exit 2
fi

work=$(mktemp -d) || exit 1
trap 'chmod -R u+rwx "$work"; rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
cd "$work" || exit 1
unset NO_COLOR
TMPDIR=$work
TERM=xterm
SHELL=/bin/sh # that of `script`; others warn of locales that are not installed
export TMPDIR TERM SHELL

passed=0
failed=0

# Runs petri; leaves its exit code in $status and what it wrote in the files out and err.
petri() {
    timeout 100 "$petri" "$@" >out 2>err </dev/null
    status=$?
}

# check NAME COMMAND...: the command must succeed.
check() {
    name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
        echo "ok $name"
    else
        failed=$((failed + 1))
        echo "FAIL $name: $* (exit status $status)"
        echo "  stdout: $(head -c 300 out)"
        echo "  stderr: $(head -c 600 err)"
    fi
}

status_is() { [ "$status" -eq "$1" ]; }
out_is() { [ "$(cat out)" = "$1" ]; }
has() { grep -Fq -e "$2" "$1"; }
lacks() { ! has "$1" "$2"; }
empty() { [ ! -s "$1" ]; }
lines_are() { [ "$(wc -l <"$1")" -eq "$2" ]; }
count_is() { [ "$(grep -Fc -e "$2" "$1")" -eq "$3" ]; }
# One clear message: rejected without a crash, with exactly one error on standard error.
one_error() { status_is 1 && count_is err "error: " 1 && empty out; }
last_line_is() { [ "$(tail -n 1 "$1")" = "$2" ]; }

shift
for part in ${*:-command suggest streams parameters check habits bad_input state record render golden new}; do
    # shellcheck source=/dev/null
    . "$here/$part.sh"
done

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
