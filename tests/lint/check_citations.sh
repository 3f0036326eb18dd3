#!/bin/sh
# check_citations.sh SOURCE_ROOT: pages that comments cite as `spec PAGE.md` exist in lib/spec, and so do the cited
# sections of language.md (L…) and builtins.md (B…).
set -eu
cd "$1"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

find grammar lib src tests -name node_modules -prune -o -type f \( -name '*.[chy]' -o -name '*.re' -o -name '*.sh' -o -name '*.txt' -o -name 'meson.build' \) -print |
    grep -v -e '^lib/spec/' -e check_citations | sort >"$scratch/files"
xargs grep -noE 'spec/?[ /](\(?[a-z0-9_]+\.(md|txt))' <"$scratch/files" >"$scratch/pages" || true
xargs grep -noE '\b(spec|language\.md|builtins\.md)\b.*\b[LB][0-9]+(\.[0-9]+)?' <"$scratch/files" >"$scratch/lines" || true

[ -s "$scratch/pages" ] || {
    echo "no citations found: the pattern of this check is wrong"
    exit 1
}

# Lists the pages, and the sections: headings and bold numbers.
(cd lib/spec && ls) >"$scratch/known"
cat lib/spec/language.md lib/spec/builtins.md | grep -oE '^(#+ |\*\*|- \*\*)[LB][0-9]+(\.[0-9]+)?' | grep -oE '[LB][0-9.]+' \
    >>"$scratch/known"
awk -v page_list="$scratch/pages" '
    function check_name(name) {
        if (!(name in known)) {
            match($0, /^[^:]*:[0-9]+/)
            print substr($0, 1, RLENGTH) ": cites " name ", which lib/spec does not have"
            faults++
        }
    }
    FILENAME == ARGV[1] { known[$0]; next }
    FILENAME == page_list {
        name = $0
        sub(/^.*:spec\/?[ \/]\(?/, "", name)
        check_name(name)
        next
    }
    {
        rest = $0
        sub(/^[^:]*:[0-9]+:/, "", rest)
        count = split(rest, words, /[^A-Za-z0-9_.]+/)
        for (i = 1; i <= count; i++) {
            sub(/\.+$/, "", words[i])
            if (words[i] ~ /^[LB][0-9]+(\.[0-9]+)?$/)
                check_name(words[i])
        }
    }
    END { exit faults > 0 }' "$scratch/known" "$scratch/pages" "$scratch/lines"
