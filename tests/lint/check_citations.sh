#!/bin/sh
# check_citations.sh SOURCE_ROOT: pages that comments cite as `spec PAGE.md` exist in lib/spec, and so do the cited
# sections of language.md (L…) and builtins.md (B…).
set -eu
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

find grammar lib src tests -type f \( -name '*.[chy]' -o -name '*.re' -o -name '*.sh' -o -name '*.txt' -o -name 'meson.build' \) |
    grep -v -e '^lib/spec/' -e check_citations | sort >"$scratch/files"
xargs grep -noE 'spec/?[ /](\(?[a-z0-9_]+\.(md|txt))' <"$scratch/files" >"$scratch/pages" || true
xargs grep -noE '\b(spec|language\.md|builtins\.md)\b.*\b[LB][0-9]+(\.[0-9]+)?' <"$scratch/files" |
    sed -E 's/^([^:]*:[0-9]+:)/\1 /' >"$scratch/lines" || true

[ -s "$scratch/pages" ] || {
    echo "no citations found: the pattern of this check is wrong"
    exit 1
}
faults=0
while IFS= read -r line; do
    page=$(echo "${line##*:}" | sed -E 's|^spec/?[ /]\(?||')
    [ -f "lib/spec/$page" ] || {
        echo "${line%:*}: cites $page, which lib/spec does not have"
        faults=1
    }
done <"$scratch/pages"

# Lists the sections: headings and bold numbers.
cat lib/spec/language.md lib/spec/builtins.md | grep -oE '^(#+ |\*\*|- \*\*)[LB][0-9]+(\.[0-9]+)?' | grep -oE '[LB][0-9.]+' |
    sort -u >"$scratch/sections"
while IFS= read -r line; do
    for section in $(echo "${line#* }" | grep -oE '\b[LB][0-9]+(\.[0-9]+)?\b'); do
        grep -qx "$section" "$scratch/sections" || {
            echo "${line%% *} cites $section, which lib/spec does not have"
            faults=1
        }
    done
done <"$scratch/lines"
exit $faults
