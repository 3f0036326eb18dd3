# support.sh: what the tests of `petri view` share. Sourced with $1 the path of petri.

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2

skip() {
    echo "skipped: $*"
    exit 77
}

# needs TOOL PACKAGE: skips where a tool is not there.
needs() {
    command -v "$1" >/dev/null 2>&1 || skip "no $1; './dev setup all' installs it (Debian: $2)"
}

# soon COMMAND...: true as soon as the command is, however slow the machine; false if it never is. Where it is waited
# in vain, what comes after is mostly in vain, too, and gets less time.
patience=60 # seconds
soon() {
    end=$(($(date +%s) + patience))
    until "$@"; do
        [ "$(date +%s)" -lt $end ] || { patience=20 && return 1; }
        sleep 0.1
    done
}
