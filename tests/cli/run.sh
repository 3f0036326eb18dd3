#!/bin/sh
# run.sh: what a user sees of the `petri` command: exit codes, what goes where, bad input, the golden runner.
# usage: tests/cli/run.sh PATH-OF-PETRI [PART...]. Each check says what it shows; the last line counts them.

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2

scratch
unset NO_COLOR
TMPDIR=$work
TERM=xterm
SHELL=/bin/sh # that of `script`; others warn of locales that are not installed
export TMPDIR TERM SHELL

# Runs petri; leaves its exit code in $status and what it wrote in the files out and err.
petri() {
    timeout 100 "$petri" "$@" >out 2>err </dev/null
    status=$?
}

out_is() { [ "$(cat out)" = "$1" ]; }
# One clear message: rejected without a crash, with exactly one error on standard error.
one_error() { status_is 1 && count_is err "error: " 1 && empty out; }
one_message() { status_is 1 && lines_are err 1 && has err "$1" && empty out; }
last_line_is() { [ "$(tail -n 1 "$1")" = "$2" ]; }

shift
for part in ${*:-command suggest streams parameters check syntax_hints bad_input state record render golden new fmt link}; do
    # shellcheck source=/dev/null
    . "$here/$part.sh"
done

finish
