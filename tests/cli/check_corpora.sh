#!/bin/sh
# check_corpora.sh: test of `petri check` with every script of the project.
# usage: tests/cli/check_corpora.sh PATH-OF-PETRI [--update]
#
# Samples and benchmarks must give no warnings. The scripts of tests/golden and tests/conformance test limits of the
# language, and many contain mistakes on purpose. check_corpora.txt lists their expected diagnostics, one `FILE CODE`
# per line; there must be no others. A script with a NAME.err must be rejected and is not listed.
set -u
LC_ALL=C
export LC_ALL
case $1 in
/*) petri=$1 ;;
*) petri=$PWD/$1 ;;
esac
cd "$(dirname "$0")/../.." || exit 1
recorded=tests/cli/check_corpora.txt
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
failed=0

for corpus in samples tests/bench/workloads; do
    "$petri" check --werror "$corpus" 2>"$work/err"
    if [ $? -ne 0 ] || [ "$(wc -l <"$work/err")" -ne 1 ]; then
        echo "FAIL there are diagnostics for $corpus:"
        cat "$work/err"
        failed=1
    fi
done

find tests/golden tests/conformance -name '*.err' | sed 's/err$/fl/' >"$work/rejected"
"$petri" check tests/golden tests/conformance 2>&1 |
    sed -n 's/^\([^ :]*\.fl\):[0-9]*:[0-9]*: .* \[\([a-z-]*\)\]$/\1 \2/p' | sort -u >"$work/all"
if ! grep -q . "$work/all"; then
    echo "FAIL nothing was checked"
    exit 1
fi
while read -r script; do
    if ! grep -Fq "$script " "$work/all"; then
        echo "FAIL $script is not rejected"
        failed=1
    fi
done <"$work/rejected"
sed 's/$/ /' "$work/rejected" >"$work/patterns"
grep -Fv -f "$work/patterns" "$work/all" >"$work/diagnostics"
if [ "${2-}" = --update ]; then
    cp "$work/diagnostics" "$recorded"
elif ! diff "$recorded" "$work/diagnostics" >"$work/diff"; then
    echo "FAIL diagnostics differ from $recorded (<: missing, >: new):"
    cat "$work/diff"
    failed=1
fi
[ "$failed" -eq 0 ] && echo "ok: $(wc -l <"$work/diagnostics") diagnostics, as recorded"
exit "$failed"
