#!/bin/sh
# nodes.sh PETRI ROOT: checks that the references list exactly the nodes, attributes and defaults of `petri help nodes`.
#
# A node has a heading "## `!kind`" of any level, which two nodes may share. Below it are
#   | `attribute` | default | …     a row for each attribute, or for several with the same default; "–" means no default
#   Also: [text](#heading), …       adds the attributes of the tables under those headings, and of their "Also:" lines
# Rows under other headings count only for nodes that refer to them.
set -u
LC_ALL=C.UTF-8
COLUMNS=1000
export LC_ALL COLUMNS
if [ $# -ne 2 ]; then
    echo "usage: nodes.sh PETRI ROOT" >&2
    exit 2
fi
work=$(mktemp -d "${TMPDIR:-/tmp}/petri-nodes.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM HUP

# Writes lines `kind` and `kind attribute default` to AREA.help.
"$1" help nodes | awk -v work="$work" '
    /^[a-z]/ { area = $1 }
    /^  !/ { kind = $1; sub(/:$/, "", kind); print kind > (work "/" area ".help") }
    /^      / {
        name = $1
        line = $0
        sub(/^ +[^ ]+ +/, "", line)
        # The type contains no parentheses. The default is in parentheses and precedes the explanation.
        fallback = "–"
        if (match(line, /^[^(:]*(:[a-z]+[^(:]*)*\(/)) {
            rest = substr(line, RLENGTH + 1)
            depth = 1
            for (i = 1; i <= length(rest) && depth > 0; i++)
                depth += (substr(rest, i, 1) == "(") - (substr(rest, i, 1) == ")")
            fallback = substr(rest, 1, i - 2)
        }
        print kind, name, fallback > (work "/" area ".help")
    }'

# An awk function that returns the anchor of a heading.
slug='
    function slug(text) {
        text = tolower(text)
        gsub(/[^a-z0-9 _-]/, "", text)
        gsub(/ /, "-", text)
        return text
    }'

# Prints lines of the same form from a document.
read_document() { # FILE...: treated as one document
    awk "$slug"'
        /^```/ { code = !code }
        code { next }
        /^#+ / {
            sub(/^#+ /, "")
            heading = slug($0)
            headings++
            order[headings] = heading
            kinds[headings] = ""
            text = $0
            while (match(text, /`![a-z_0-9]+`/)) {
                kinds[headings] = kinds[headings] " " substr(text, RSTART + 1, RLENGTH - 2)
                text = substr(text, RSTART + RLENGTH)
            }
            next
        }
        /^\| `[a-z_0-9]+`(, `[a-z_0-9]+`)* \|/ {
            split($0, cell, / *\| */)
            fallback = cell[3]
            gsub(/`/, "", fallback)
            text = cell[2]
            while (match(text, /`[a-z_0-9]+`/)) {
                rows[heading] = rows[heading] substr(text, RSTART + 1, RLENGTH - 2) " " fallback "\n"
                text = substr(text, RSTART + RLENGTH)
            }
        }
        /^Also: / {
            text = $0
            while (match(text, /#[^)]+\)/)) {
                also[heading] = also[heading] " " substr(text, RSTART + 1, RLENGTH - 2)
                text = substr(text, RSTART + RLENGTH)
            }
        }
        END {
            for (h = 1; h <= headings; h++) {
                count = split(kinds[h], kind, " ")
                for (k = 1; k <= count; k++) {
                    print kind[k]
                    all = rows[order[h]]
                    others = split(also[order[h]], other, " ")
                    for (o = 1; o <= others; o++) {
                        all = all rows[other[o]]
                        further = split(also[other[o]], next_one, " ")
                        for (k2 = 1; k2 <= further; k2++)
                            all = all rows[next_one[k2]]
                    }
                    lines = split(all, line, "\n")
                    for (l = 1; l < lines; l++)
                        print kind[k], line[l]
                }
            }
        }' "$@"
}

failed=0
checked=0
compare() { # AREA ROOT DOCUMENT [ANOTHER]
    sort "$work/$1.help" >"$work/help"
    read_document "$2/$3" ${4:+"$2/$4"} | sort >"$work/documented"
    checked=$((checked + $(wc -l <"$work/help")))
    comm -23 "$work/help" "$work/documented" >"$work/missing"
    comm -13 "$work/help" "$work/documented" >"$work/surplus"
    sed "s|^|$3: missing in the reference: |" "$work/missing"
    sed "s|^|$3: missing in petri help: |" "$work/surplus"
    failed=$((failed + $(cat "$work/missing" "$work/surplus" | wc -l)))
}
compare physics "$2" lib/physics/README.md
compare canvas "$2" lib/canvas/README.md lib/gl/README.md
compare canvas3d "$2" lib/scene3d/SCENE.md

# Excerpts "```flitter NAME.png" must be consecutive lines of tests/pictures/NAME.fl.
awk -v work="$work" '
    /^```flitter [a-z_]+\.png$/ { name = $2; sub(/\.png$/, "", name); file = work "/" ++count "." name ".excerpt"; next }
    /^```$/ { file = "" }
    file != "" { sub(/^ +/, ""); print > file }' "$2/lib/canvas/README.md" "$2/lib/gl/README.md"
for excerpt in "$work"/*.excerpt; do
    name=$(basename "$excerpt" .excerpt)
    name=${name#*.}
    checked=$((checked + 1))
    sed 's/^ *//' "$2/tests/pictures/$name.fl" | awk '
        FILENAME == ARGV[1] { wanted[++n] = $0; next }
        { line[++m] = $0 }
        END {
            for (from = 0; from <= m - n; from++) {
                for (i = 1; i <= n && line[from + i] == wanted[i]; i++)
                    ;
                if (i > n)
                    exit 0
            }
            exit 1
        }' "$excerpt" - || {
        echo "the excerpt of $name.fl is not in that script"
        failed=$((failed + 1))
    }
done

# Files that the references link to must exist.
for document in lib/physics/README.md lib/canvas/README.md lib/gl/README.md lib/scene3d/SCENE.md; do
    folder=$2/$(dirname "$document")
    for target in $(grep -o '](\([^)#]*\)' "$2/$document" | sed 's/^](//' | sort -u); do
        checked=$((checked + 1))
        [ -e "$folder/$target" ] || {
            echo "$document: no such file: $target"
            failed=$((failed + 1))
        }
    done
done
# Headings that the references link to must exist.
for document in lib/physics/README.md lib/canvas/README.md lib/gl/README.md lib/scene3d/SCENE.md; do
    awk -v document="$document" "$slug"'
        /^```/ { code = !code }
        !code && /^#+ / { sub(/^#+ /, ""); there[slug($0)] = 1 }
        !code {
            text = $0
            while (match(text, /\]\(#[^)]+\)/)) {
                wanted[substr(text, RSTART + 3, RLENGTH - 4)] = 1
                text = substr(text, RSTART + RLENGTH)
            }
        }
        END {
            for (name in wanted)
                if (!(name in there))
                    print document ": no such heading: #" name
        }' "$2/$document"
done >"$work/anchors"
cat "$work/anchors"
failed=$((failed + $(wc -l <"$work/anchors")))
if [ $checked -lt 250 ]; then
    echo "found $checked nodes, attributes and links, expected at least 250; has the form changed?"
    failed=$((failed + 1))
fi
echo "$((checked - failed)) passed, $failed failed"
[ "$failed" -eq 0 ]
