#!/bin/sh
# formulas.sh PETRI ROOT: compares the formulas in ROOT/lib/physics/README.md with the engine. Also checks that each
# node `!fact` of facts.fl has holds=1.
#
# ```formula NAME ARGUMENTS    belongs to ROOT/tests/docs/figures/NAME.fl, which measures a force and compares it with
#                              its `func formula(ARGUMENTS)`, in a line `> N;DIFFERENCE` of the log
# The script is run unchanged, and again with a formula made from the block: lines `NAME = EXPR` are intermediate
# results, lines `F = EXPR if CONDITION` the cases of the result. The last case may have no `if`. Scripts without a block
# are only run unchanged.
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
min_formulas=13
min_facts=38

# Writes each block as Flitter code to NAME.formula.
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
# judge NAME WHICH: runs a script and checks the difference in its log.
judge() {
    got=$("$petri" run --frames 3 --every 2 --print log "$work/$1.fl" 2>&1 | grep -E '^> |warning:|error:' | tail -n 1)
    if echo "$got" | awk '{ sub(/^> /, ""); split($0, part, ";")
                            exit !(part[1] >= 5 && part[2] != "" && part[2] <= 1e-12) }'; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "$1: the engine differs from the formula of $2: $got"
    fi
}

formulas=0
for script in "$work"/*.fl; do
    name=$(basename "$script" .fl)
    case $name in
    far_*) continue ;; # shows measured times or errors
    esac
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
        echo "$(basename "$formula" .formula): no script checks this formula"
    }
done
# `petri help`, the manual and editors must show the same formulas.
"$petri" help nodes | sed -n 's/^  !\([a-z]*\): .*/@\1/p; s/^    \([^ !].*\)/\1/p' >"$work/help"
awk '/^```formula/ && $2 !~ /^(stability|ease)$/ { print "@" $2; on = 1; next } /^```/ { on = 0 } on' "$reference" |
    awk '/^@/ { name = $0; next } { print name, $0 }' | sort >"$work/wanted"
awk '/^@/ { name = $0; next } { print name, $0 }' "$work/help" | sort >"$work/printed"
if cmp -s "$work/wanted" "$work/printed" && [ "$(cut -d" " -f 1 "$work/printed" | uniq | wc -l)" -ge 11 ]; then
    passed=$((passed + 1))
else
    failed=$((failed + 1))
    echo "petri help nodes has other formulas: $(diff "$work/wanted" "$work/printed" | head -n 3)"
fi
"$petri" run --frames 3 --every 2 --print tree "$2/tests/docs/facts.fl" >"$work/facts" 2>&1
sed '1,/^@2 /d' "$work/facts" >"$work/last"
facts=$(grep -c '^!fact .* holds=1$' "$work/last")
passed=$((passed + facts))
wrong=$(grep '^!fact ' "$work/last" | grep -v ' holds=1$')
if [ -n "$wrong" ] || [ "$facts" -lt $min_facts ]; then
    failed=$((failed + 1))
    echo "facts.fl: $facts facts hold, expected at least $min_facts: $(head -n 1 "$work/facts")"
    echo "$wrong"
fi
if [ $formulas -lt $min_formulas ]; then
    echo "found $formulas formulas, expected at least $min_formulas; has the form of the blocks changed?"
    failed=$((failed + 1))
fi
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
