#!/bin/sh
# readme.sh PETRI ROOT: replays the sessions in ROOT/src/manual/repl.md: blocks that begin with ```session and the options
# of `petri repl`, in the form that run.sh reads, without the exit status and without blanks at the ends of lines.
set -u
petri=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
cd "$2" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# Each session block becomes the files N.options, N.want and N.in.
awk -v work="$work" '
    /^```/ && !inside && $1 == "```session" {
        inside = 1
        base = work "/" ++count
        sub(/^```session */, "")
        print > (base ".options")
        next
    }
    /^```/ { inside = 0 }
    inside {
        print > (base ".want")
        if (match($0, /^(petri|@[0-9]+)> /) || match($0, /^\.\.\.( |$)/))
            print substr($0, RLENGTH + 1) > (base ".in")
    }' src/manual/repl.md

count=0
failed=0
while [ -f "$work/$((count + 1)).options" ]; do
    count=$((count + 1))
    base=$work/$count
    # shellcheck disable=SC2046 # options are words
    LC_ALL=C.UTF-8 timeout 60 "$petri" repl $(cat "$base.options") <"$base.in" 2>&1 | sed 's/[ ]*$//' >"$base.got"
    if cmp -s "$base.want" "$base.got"; then
        echo "ok session $count of src/manual/repl.md"
    else
        failed=$((failed + 1))
        echo "FAIL session $count of src/manual/repl.md"
        diff "$base.want" "$base.got"
    fi
done
[ $count -gt 0 ] || echo "FAIL src/manual/repl.md has no session"
[ $count -gt 0 ] && [ $failed -eq 0 ]
