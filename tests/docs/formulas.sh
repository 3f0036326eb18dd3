#!/bin/sh
# formulas.sh PETRI ROOT: are the formulas of ROOT/lib/physics/README.md what the engine does? And do the facts of
# facts.fl hold, in nodes `!fact name=… holds=1`?
#
# ```formula NAME ARGUMENTS    belongs to ROOT/tests/docs/figures/NAME.fl, which measures a force and compares it with
#                              its `func formula(ARGUMENTS)`, in a node `!compared values=N difference=PART`
# The script is run as it is, and once more with a formula that is made from the text of the block: lines `NAME = EXPR`
# are intermediate results, lines `F = EXPR if CONDITION` the cases of the result, with or without `if` in the last.
# Scripts without a block are run as they are.
set -u
LC_ALL=C.UTF-8
export LC_ALL
petri=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
reference=$2/lib/physics/README.md
figures=$2/tests/docs/figures
work=$(mktemp -d "${TMPDIR:-/tmp}/petri-formulas.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM HUP
cp -R "$figures/." "$work"
least=13       # formulas
least_facts=18

# One file NAME.formula for each block, in Flitter.
sed -e '/^```formula/,/^```$/{
        s/₀/0/g; s/₁/1/g; s/₂/2/g
        s/·/*/g; s/−/-/g; s/²/**2/g; s/\^/**/g; s/≤/<=/g; s/≥/>=/g; s/√(/sqrt(/g; s/½/0.5/g; s/μ/mu/g; s/δ/delta/g
        s/|\([^|]*\)|/abs(\1)/g
    }' "$reference" | awk -v work="$work" '
    /^```formula/ {
        name = $2
        arguments = $0
        sub(/^```formula [^ ]+ */, "", arguments)
        text = "func formula(" arguments ")\n"
        result = ""
        next
    }
    name != "" && /^```/ {
        print text "    " result > (work "/" name ".formula")
        name = ""
    }
    name != "" {
        equals = index($0, " = ")
        left = substr($0, 1, equals - 1)
        right = substr($0, equals + 3)
        gsub(/ +/, " ", right)
        if (left != "F")
            text = text "    let " left "=" right "\n"
        else
            result = result (result == "" ? "" : " else ") right
    }'

passed=0
failed=0
judge() { # NAME WHICH
    got=$("$petri" run --frames 3 --every 2 --print tree "$work/$1.fl" 2>&1 | grep -E '^!compared|warning:|error:' | tail -n 1)
    if echo "$got" | awk '{ sub(/.*values=/, ""); split($0, part, " difference=")
                            exit !(part[1] >= 5 && part[2] != "" && part[2] <= 1e-12) }'; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "$1: the formula of $2 is not what the engine does: $got"
    fi
}

formulas=0
for script in "$work"/*.fl; do
    name=$(basename "$script" .fl)
    judge "$name" "the script"
    [ -f "$work/$name.formula" ] || continue
    formulas=$((formulas + 1))
    awk -v formula="$work/$name.formula" '
        /^func formula\(/ { while ((getline line < formula) > 0) print line; skip = 1 }
        /^$/ { skip = 0 }
        !skip { print }' "$figures/$name.fl" >"$script"
    judge "$name" "the reference"
done
for formula in "$work"/*.formula; do
    [ -f "${formula%.formula}.fl" ] || {
        failed=$((failed + 1))
        echo "$(basename "$formula" .formula): no script measures this formula"
    }
done
# What `petri help` says of the forces, and the manual and editors, is that text.
"$petri" help nodes | sed -n 's/^  !\([a-z]*\): .*/@\1/p; s/^    \([^ !].*\)/\1/p' >"$work/help"
awk '/^```formula/ && $2 !~ /^(stability|ease)$/ { print "@" $2; on = 1; next } /^```/ { on = 0 } on' "$reference" |
    awk '/^@/ { name = $0; next } { print name, $0 }' | sort >"$work/wanted"
awk '/^@/ { name = $0; next } { print name, $0 }' "$work/help" | sort >"$work/said"
if cmp -s "$work/wanted" "$work/said" && [ "$(cut -d" " -f 1 "$work/said" | uniq | wc -l)" -ge 11 ]; then
    passed=$((passed + 1))
else
    failed=$((failed + 1))
    echo "petri help nodes has other formulas: $(diff "$work/wanted" "$work/said" | head -n 3)"
fi
"$petri" run --frames 3 --every 2 --print tree "$2/tests/docs/facts.fl" >"$work/facts" 2>&1
sed '1,/^@2 /d' "$work/facts" >"$work/last"
facts=$(grep -c '^!fact .* holds=1$' "$work/last")
passed=$((passed + facts))
wrong=$(grep '^!fact ' "$work/last" | grep -v ' holds=1$')
if [ -n "$wrong" ] || [ "$facts" -lt $least_facts ]; then
    failed=$((failed + 1))
    echo "facts.fl: $facts of at least $least_facts facts hold: $(head -n 1 "$work/facts")"
    echo "$wrong"
fi
if [ $formulas -lt $least ]; then
    echo "found $formulas formulas, expected at least $least: has the form of the blocks changed?"
    failed=$((failed + 1))
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
