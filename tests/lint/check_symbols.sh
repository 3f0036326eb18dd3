#!/bin/sh
# check_symbols.sh SOURCE_ROOT BUILD_ROOT: every global name of a room starts with one of its prefixes in symbols.txt.
set -eu
table=$1/tests/lint/symbols.txt
cd "$2"
faults=0

# Names of the linker and of sanitizers (`__…`, or with a dot) are nobody's.
while read -r room folder prefixes; do
    case $room in '#'* | '') continue ;; esac
    names=$(nm -g --defined-only "$folder"/*.o | awk 'NF == 3 && $3 !~ /^__|\./ { print $3 }')
    if [ -z "$names" ]; then
        echo "$room: no names in $folder"
        faults=1
    fi
    for name in $names; do
        known=no
        for prefix in $prefixes; do
            case $name in "$prefix"*) known=yes ;; esac
        done
        if [ $known = no ]; then
            echo "$room: $name has none of the prefixes $prefixes"
            faults=1
        fi
    done
done <"$table"

# A new room must be in the table.
for folder in "$1"/lib/*/; do
    room=$(basename "$folder")
    [ "$room" != include ] && [ "$room" != spec ] || continue # no code
    if ! grep -q "^$room " "$table"; then
        echo "symbols.txt does not know the room $room"
        faults=1
    fi
done
exit $faults
