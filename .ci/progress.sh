# progress.sh: messages and progress of dev. Sourced by dev. Sets `columns`, the width of the terminal; 0: no terminal.

columns=0
if [ -t 2 ] && [ "${TERM:-dumb}" != dumb ]; then
    columns=$(stty size <&2 2>/dev/null | cut -d ' ' -f 2)
    [ "${columns:-0}" -gt 0 ] || columns=80
fi

# erase: erases the progress line of `counted`.
erase() { [ "$columns" -eq 0 ] || printf '\r\033[K' >&2; }

say() {
    erase
    echo "dev: $*" >&2
}

die() {
    say "$*"
    exit 1
}

# counted WHAT N M [NAME]: shows that N of M are done and NAME is in progress. On a terminal, rewrites the same line.
# Elsewhere, prints a line after each quarter.
counted() {
    if [ "$columns" -gt 0 ]; then
        printf "\r\033[K%.$((columns - 1))s" "dev: $1: $2 of $3${4:+, $4}" >&2
    elif [ "$1 $((4 * $2 / ($3 > 0 ? $3 : 1)))" != "${quarter:-}" ]; then
        quarter="$1 $((4 * $2 / ($3 > 0 ? $3 : 1)))"
        echo "dev: $1: $2 of $3" >&2
    fi
}

# following LOG FOLLOWER COMMAND...: runs the command and sends its output to LOG and to FOLLOWER. Returns the status of
# the command.
following() {
    log=$1
    follower=$2
    shift 2
    { "$@" 2>&1 </dev/null && echo 0 >"$log.status" || echo $? >"$log.status"; } | tee "$log" | "$follower"
    erase
    status=$(cat "$log.status")
    rm -f "$log.status"
    return "$status"
}

# quietly LOG COMMAND...: runs the command and shows its output only if it fails.
quietly() {
    log=$1
    shift
    "$@" >"$log" 2>&1 </dev/null || {
        erase
        cat "$log" >&2
        die "failed: $*"
    }
}
