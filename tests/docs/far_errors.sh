#!/bin/sh
# far_errors.sh PROGRAM PAGE [--update]: compares the table of errors of forces with `theta` on a page with the table
# that PROGRAM (far_errors.c) prints. Results are bit-identical everywhere, so the tables are equal. --update replaces
# the table on the page.
set -eu
program=$1 page=$2
work=$(mktemp -d "${TMPDIR:-/tmp}/petri-far.XXXXXX")
trap 'rm -rf "$work"' EXIT
"$program" >"$work/table"
awk -v table="$work/table" '
    /^\| particles \| `theta` \|/ { inside = 1; found = 1; while ((getline line < table) > 0) print line }
    inside && !/^\|/ { inside = 0 }
    !inside { print }
    END { exit !found }' "$page" >"$work/page"
if [ "${3:-}" = --update ]; then
    cp "$work/page" "$page"
elif ! diff "$page" "$work/page"; then
    echo "the table in $page is outdated; run: ./dev figures"
    exit 1
fi
