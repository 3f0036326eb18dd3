# support.sh: functions for the tests of `petri view`. Sourced with the path of petri as $1.

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2

skip() {
    echo "skipped: $*"
    exit 77
}

# needs TOOL PACKAGE: skips the test if the tool is missing.
needs() {
    command -v "$1" >/dev/null 2>&1 || skip "no $1; './dev setup all' installs it (Debian: $2)"
}

# soon COMMAND...: waits until the command succeeds. Fails after `patience` seconds. After a failure, later waits are
# shorter, because they are likely to fail as well.
patience=60 # seconds
soon() {
    end=$(($(date +%s) + patience))
    until "$@"; do
        [ "$(date +%s)" -lt $end ] || { patience=20 && return 1; }
        sleep 0.1
    done
}
