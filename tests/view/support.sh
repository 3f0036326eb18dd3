# support.sh: what the tests of `petri view` share. Sourced with $1 the path of petri.

here=$(cd "$(dirname "$0")" && pwd)
case $1 in
/*) petri=$1 ;;
*) petri=$PWD/$1 ;;
esac
if [ ! -x "$petri" ]; then
    echo "usage: $0 PATH-OF-PETRI ..." >&2
    exit 2
fi

skip() {
    echo "skipped: $*"
    exit 77
}

# needs TOOL PACKAGE: skips where a tool is not there.
needs() {
    command -v "$1" >/dev/null 2>&1 || skip "no $1; './dev setup all' installs it (Debian: $2)"
}

passed=0
failed=0

# check NAME COMMAND...: the command must succeed.
check() {
    name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
        echo "ok $name"
    else
        failed=$((failed + 1))
        echo "FAIL $name: $*"
        tell_more
    fi
}

# soon COMMAND...: true as soon as the command is, however slow the machine; false if it never is. Where it is waited
# in vain, what comes after is mostly in vain, too, and gets less time.
patience=600
soon() {
    tries=0
    while [ "$tries" -lt $patience ]; do
        if "$@"; then
            return 0
        fi
        tries=$((tries + 1))
        sleep 0.1
    done
    patience=200
    return 1
}

# finish: the status of the test.
finish() {
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
}

has() { grep -Fq -e "$2" "$1"; }
lacks() { ! has "$1" "$2"; }
exists() { [ -e "$1" ]; }
