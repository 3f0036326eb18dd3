#!/bin/sh
# run.sh FOLDER [--current]: tests the output of `./dev web` in FOLDER, in Node.js, Chromium and Firefox. With --current, as in
# `./dev test`, tests only the engine, which takes two seconds. That test is skipped if the engine is not up to date,
# because building it takes half a minute.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
export PETRI_WEB="${1:?the folder that ./dev web makes}"
tests=$(cd "$here" && echo *.test.mjs)
if [ "${2:-}" = --current ]; then
    tests=engine.test.mjs
    skip() {
        echo "skipped: $1"
        exit 77
    }
    command -v node >/dev/null || skip "no node"
    [ -f "$PETRI_WEB/petri/engine.wasm" ] || skip "nothing there: ./dev web makes it"
    ninja -C "$root/build-wasm" -n src/web/engine.wasm 2>/dev/null | grep -q 'no work to do' || skip "out of date: ./dev web"
    for file in "$root"/src/web/engine/*; do
        [ "${file##*/}" = package.json ] || cmp -s "$file" "$PETRI_WEB/petri/${file##*/}" || skip "out of date: ./dev web"
    done
fi
for engine in engine engine-scalar; do
    [ "${2:-}" != --current ] || [ $engine = engine ] || continue
    node "$here/hashes.mjs" "$PETRI_WEB/petri/$engine.wasm" "$root/tests/conformance" "$root/tests/hashes/corpora.txt"
done
cd "$here"
# shellcheck disable=SC2086 # the files are separate words
node --test $tests >"$PETRI_WEB/tests.log" 2>&1 || {
    cat "$PETRI_WEB/tests.log"
    exit 1
}
grep -E '^# (pass|fail|skipped) ' "$PETRI_WEB/tests.log"
[ "${2:-}" = --current ] || exec "$here/command.sh" "$PETRI_WEB"
