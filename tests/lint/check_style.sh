#!/bin/sh
# check_style.sh SOURCE_ROOT: sources have no trailing blanks, no tabs in C, at most 700 lines (except generated tables and
# petri.h, the reference of the interface), a line feed at the end, and no reminders of unfinished work.
set -eu
cd "$1"
max_lines=700
faults=0

report_fault() {
    echo "$1"
    faults=1
}

# Recorded outputs and scripts of tests are not checked.
for file in $(find lib grammar src tests samples -name node_modules -prune -o -name '*.c' -o -name '*.h' -o -name '*.re' -o -name '*.y' \
    -o -name '*.sh' -o -name meson.build -o -name '*.md'); do
    [ -f "$file" ] || continue
    [ -s "$file" ] || continue
    if grep -n '[[:blank:]]$' "$file"; then
        report_fault "$file: blanks at the end of a line"
    fi
    if [ -n "$(tail -c 1 "$file")" ]; then
        report_fault "$file: no line feed at the end"
    fi
    if grep -n 'TO''DO\|FIX''ME' "$file"; then
        report_fault "$file: a reminder of unfinished work"
    fi
    case $file in
    *.c | *.h | *.re | *.y)
        if grep -n "$(printf '\t')" "$file"; then
            report_fault "$file: tabs"
        fi
        case $file in
        lib/* | src/*)
            if grep -n '== NULL' "$file"; then
                report_fault "$file: write !p instead of p == NULL"
            fi
            ;;
        esac
        lines=$(wc -l <"$file")
        case $file in
        *_tables.h | lib/include/petri.h) ;;
        *)
            if [ "$lines" -gt $max_lines ]; then
                report_fault "$file: $lines lines, at most $max_lines"
            fi
            ;;
        esac
        ;;
    esac
done
exit $faults
