#!/bin/sh
# run.sh: tests of the `petri` command: exit codes, output, invalid input, goldens.
# usage: tests/cli/run.sh PATH-OF-PETRI [PART...]. A part is a file of this folder (default: all). The last line counts the
# checks. meson.build makes a test of each part, cli_PART.

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
cat >disc.fl <<'END'
!window size=40;30 title="disc"
    !canvas
        !ellipse point=5+frame;15 radius=4 fill=true color=1;0;0
END

# Functions for parts that draw.
# sufficient LIMIT: prints the value of the last note that names a limit for `work` or `memory`.
sufficient() { sed -n "s/.*note: --$1 \([0-9]*M\) suffices.*/\1/p" err | tail -n 1; }
# width FILE, height FILE: read from the header of a PNG file.
width() { od -An -j16 -N4 -tu1 "$1" | awk '{ print $1 * 16777216 + $2 * 65536 + $3 * 256 + $4 }'; }
height() { od -An -j20 -N4 -tu1 "$1" | awk '{ print $1 * 16777216 + $2 * 65536 + $3 * 256 + $4 }'; }
sized() { [ "$(width "$1")x$(height "$1")" = "$2" ]; }
nothing_beside() { [ -z "$(find . -name '*.tmp*')" ]; }
# draws: succeeds if this build has Cairo.
draws() {
    petri render disc.fl -o disc.png --frames 1
    [ "$status" -eq 0 ]
}

shift
parts=$(cd "$here" && echo *.sh | tr ' ' '\n' | sed -n '/^run\.sh$/d; /^check_/d; s/\.sh$//p')
for part in ${*:-$parts}; do
    # shellcheck source=/dev/null
    . "$here/$part.sh"
done

finish
