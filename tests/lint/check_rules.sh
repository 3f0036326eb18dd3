#!/bin/sh
# check_rules.sh ROOT: checks that src/check/rule_list.h has each code of diagnostics in the sources and in recorded output,
# in alphabetical order, and that src/manual/diagnostics.md has the same table.
set -eu
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sed -n 's/^RULE("\([a-z0-9-]*\)", "\(.*\)")$/| `\1` | \2 |/p' src/check/rule_list.h >"$work/rules"
sed -n '/^| `/p' src/manual/diagnostics.md >"$work/page"
failed=0
diff "$work/rules" "$work/page" >"$work/diff" || {
    echo "src/check/rule_list.h (<) and src/manual/diagnostics.md (>) differ:"
    cat "$work/diff"
    failed=1
}
cut -d'`' -f2 "$work/rules" >"$work/codes"
LC_ALL=C sort -cu "$work/codes" || failed=1
[ "$(wc -l <"$work/codes")" -gt 60 ]
# Codes in calls such as report(..., "code", ...) and in recorded diagnostics.
{
    grep -rhoE '(report[a-z_]*\([^;"]*|warning[a-z_]*\([^;"]*|\.code = )"[a-z]+(-[a-z]+)+"' lib src --include=*.c |
        grep -oE '"[a-z-]+"$' | tr -d '"'
    grep -rhoE '\[[a-z]+(-[a-z]+)+\]$' tests/repl samples src/manual README.md --include=*.session --include=*.md |
        tr -d '[]'
    awk '{ print $2 }' tests/cli/check_corpora.txt | grep -E '^[a-z]+(-[a-z]+)+$'
} | sort -u >"$work/used"
[ "$(wc -l <"$work/used")" -gt 50 ]
while read -r code; do
    grep -qxF "$code" "$work/codes" || {
        echo "src/check/rule_list.h has no code '$code'"
        failed=1
    }
done <"$work/used"
exit "$failed"
