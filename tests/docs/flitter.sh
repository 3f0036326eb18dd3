#!/bin/sh
# flitter.sh PETRI: runs the scripts of flitter.txt, one or more commands for each row of the tables in
# src/manual/flitter.md, and checks that each row has a script and each script a row.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
scratch
printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' >flitter.off
printf 'glTF' >flitter.glb
printf 'GIF89a' >flitter.gif

awk -F ' *[|] *' '/^[|] feature/ { inside = 1 } !/^[|]/ { inside = 0 } inside && !/^[|] feature|^[|]-/ { print $2 }' \
    "$root/src/manual/flitter.md" | sort >rows
# Writes each script to N.fl and its commands to N.commands.
awk '/^== / { name = substr($0, 4); print name; file = ++count ".fl"; next }
    !count { next }
    /^-- .* =>/ { print substr($0, 4) >(count ".commands"); next }
    { print >file }
    END { print count >"count" }' "$here/flitter.txt" | sort >sections
check "the page has tables" [ "$(wc -l <rows)" -gt 50 ]
check "each row has one script, and each script one row" diff rows sections

i=0
while [ $i -lt "$(cat count)" ]; do
    i=$((i + 1))
    mv $i.fl s.fl
    check "script $i has a command" [ -s $i.commands ]
    while read -r line; do
        arguments=${line%% =>*}
        want=${line#*=>}
        want=${want# }
        case $arguments in
        help*) ;;
        *) arguments="$arguments s.fl" ;;
        esac
        # shellcheck disable=SC2086 # several arguments
        "$petri" $arguments >out 2>&1 </dev/null
        status=$?
        if [ -n "$want" ]; then
            check "$i: petri $line" grep -qF -e "$want" out
        else
            check "$i: petri $line" [ $status-$(wc -c <out) = 0-0 ]
        fi
        status=
    done <$i.commands
done
finish
