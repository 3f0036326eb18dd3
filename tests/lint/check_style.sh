#!/bin/sh
# check_style.sh SOURCE_ROOT: no trailing blanks, no tabs in C, no file over 700 lines but generated tables, each file
# ends its last line, and nothing is left marked as to be done.
set -eu
cd "$1"
longest=700
faults=0

complain() {
    echo "$1"
    faults=1
}

# Recorded outputs and scripts of tests are what they are.
for file in $(find lib grammar src tests samples -name node_modules -prune -o -name '*.c' -o -name '*.h' -o -name '*.re' -o -name '*.y' \
    -o -name '*.sh' -o -name meson.build -o -name '*.md'); do
    [ -f "$file" ] || continue
    [ -s "$file" ] || continue
    if grep -n '[[:blank:]]$' "$file"; then
        complain "$file: blanks at the end of a line"
    fi
    if [ -n "$(tail -c 1 "$file")" ]; then
        complain "$file: the last line has no end"
    fi
    if grep -n 'TO''DO\|FIX''ME' "$file"; then
        complain "$file: something is left to be done"
    fi
    case $file in
    *.c | *.h | *.re | *.y)
        if grep -n "$(printf '\t')" "$file"; then
            complain "$file: tabs"
        fi
        case $file in
        lib/* | src/*)
            if grep -n '== NULL' "$file"; then
                complain "$file: write !p in place of p == NULL"
            fi
            ;;
        esac
        lines=$(wc -l <"$file")
        case $file in
        *_tables.h) ;;
        *)
            if [ "$lines" -gt $longest ]; then
                complain "$file: $lines lines, more than $longest"
            fi
            ;;
        esac
        ;;
    esac
done
exit $faults
