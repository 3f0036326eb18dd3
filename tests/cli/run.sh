#!/bin/sh
# run.sh: tests of the `petri` command: exit codes, output, invalid input, goldens.
# usage: tests/cli/run.sh PATH-OF-PETRI [PART...]. The last line counts the checks.

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2

scratch
unset NO_COLOR
TMPDIR=$work
TERM=xterm
SHELL=/bin/sh # the shell that `script` starts; others warn about locales that are not installed
export TMPDIR TERM SHELL

# petri ARGUMENTS...: runs petri; sets $status and writes its output to the files out and err.
petri() {
    timeout 100 "$petri" "$@" >out 2>err </dev/null
    status=$?
}

out_is() { [ "$(cat out)" = "$1" ]; }
# one_error: succeeds if petri exited with 1 and printed exactly one error and no output.
one_error() { status_is 1 && count_is err "error: " 1 && empty out; }
one_message() { status_is 1 && lines_are err 1 && has err "$1" && empty out; }
last_line_is() { [ "$(tail -n 1 "$1")" = "$2" ]; }

# Scripts of several parts.
cat >count.fl <<'END'
debug(frame)
!n a=frame b=x
END
cat >plain.fl <<'END'
!n a=1
END
cat >warn.fl <<'END'
!n a=nowhere
END

shift
for part in ${*:-command suggest streams parameters check syntax_hints bad_input state record render golden diff new fmt link complete}; do
    # shellcheck source=/dev/null
    . "$here/$part.sh"
done

finish
