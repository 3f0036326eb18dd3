#!/bin/sh
# check_style.sh SOURCE_ROOT: sources have no trailing blanks, no tabs in C, at most 700 lines (except generated tables), a
# line feed at the end, no reminders of unfinished work, and no tests whose name is one word. The root has only the files
# and folders of CONTRIBUTING.md.
set -eu
cd "$1"
sources=$(mktemp)
trap 'rm -f "$sources"' EXIT
status=0

# Recorded outputs and scripts of tests, and generated sources of the tree-sitter grammar are not checked.
find lib grammar src tests samples \( -name node_modules -o -name tree_sitter -o -path '*/tree-sitter-flitter/src/parser.c' \) \
    -prune -o -type f -size +0 \( -name '*.[ch]' -o -name '*.re' -o -name '*.y' \
    -o -name '*.sh' -o -name meson.build -o -name '*.md' \) -print0 >"$sources"
# The pattern of the reminders is written in two parts, so that it does not match this line.
xargs -0 awk -v max_lines=700 -v reminder='TO''DO|FIX''ME' '
    function report_line(text) {
        print FILENAME ":" FNR ": " text
        faults++
    }
    function check_length() {
        if (is_limited && lines > max_lines) {
            print name ": " lines " lines, at most " max_lines
            faults++
        }
    }
    FNR == 1 {
        check_length()
        name = FILENAME
        is_c = name ~ /\.(c|h|re|y)$/
        is_ours = is_c && name ~ /^(lib|src)\//
        is_limited = is_c && name !~ /_tables\.h$/
    }
    { lines = FNR }
    /[ \t]$/ { report_line("blanks at the end of the line") }
    $0 ~ reminder { report_line("a reminder of unfinished work") }
    is_c && /\t/ { report_line("tabs") }
    is_c && name ~ /^tests\// && /^static void test_[a-z0-9]+\(void \*\*/ { report_line("one word does not state the expected behaviour") }
    is_ours && /== NULL/ { report_line("write !p instead of p == NULL") }
    END {
        check_length()
        exit faults > 0
    }' <"$sources" || status=1
unfinished=$(xargs -0 grep -LPz '\n\z' <"$sources") || true
if [ "$unfinished" ]; then
    printf 'no line feed at the end of:\n%s\n' "$unfinished"
    status=1
fi
# Tests that ran in the root may have left files, which a commit then added.
strays=$(git ls-files 2>/dev/null | sed 's|/.*||' | sort -u | grep -vxE '\..*|grammar|lib|samples|src|tests|dev|meson.*|pyproject\.toml|LICENSE|CITATION\.cff|[A-Z]+\.md') ||
    true
if [ "$strays" ]; then
    printf 'unknown in the root:\n%s\n' "$strays"
    status=1
fi
exit $status
