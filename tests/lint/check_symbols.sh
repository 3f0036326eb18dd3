#!/bin/sh
# check_symbols.sh SOURCE_ROOT BUILD_ROOT: checks that every global name of a library starts with one of its prefixes in
# symbols.txt.
set -eu
table=$1/tests/lint/symbols.txt
cd "$2"
faults=0

# Names of the linker and of sanitizers (`__…`, or with a dot) are not checked. PRIVATE_API adds `_petri_`.
while read -r library folder prefixes; do
    case $library in '#'* | '') continue ;; esac
    names=$(nm -g --defined-only "$folder"/*.o | awk 'NF == 3 && $3 !~ /^__|\./ { sub(/^_petri_/, "", $3); print $3 }')
    if [ -z "$names" ]; then
        echo "$library: no names in $folder"
        faults=1
    fi
    echo "$names" | awk -v library="$library" -v list="$prefixes" '
        BEGIN { count = split(list, prefixes, " ") }
        {
            for (i = 1; i <= count; i++)
                if (index($0, prefixes[i]) == 1)
                    next
            print library ": " $0 " has none of the prefixes " list
            faults++
        }
        END { exit faults > 0 }' || faults=1
done <"$table"

# Every library must be in the table.
for folder in "$1"/lib/*/; do
    library=$(basename "$folder")
    [ "$library" != include ] && [ "$library" != spec ] || continue # the library has no code
    if ! grep -q "^$library " "$table"; then
        echo "symbols.txt has no library $library"
        faults=1
    fi
done
exit $faults
