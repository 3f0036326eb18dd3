#!/bin/sh
# run.sh FOLDER [--current]: tests what `./dev web` has made there, in Node.js. --current: only if it is that of today's
# sources, else it is skipped, for making it takes half a minute: so `./dev test` has it.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
export PETRI_WEB="${1:?the folder that ./dev web makes}"
if [ "${2:-}" = --current ]; then
    skip() {
        echo "skipped: $1"
        exit 77
    }
    command -v node >/dev/null || skip "no node"
    [ -f "$PETRI_WEB/petri/engine.wasm" ] || skip "nothing there: ./dev web makes it"
    ninja -C "$root/build-wasm" -n src/web/engine.wasm 2>/dev/null | grep -q 'no work to do' || skip "out of date: ./dev web"
    for file in "$root"/src/web/engine/*; do
        cmp -s "$file" "$PETRI_WEB/petri/${file##*/}" || skip "out of date: ./dev web"
    done
fi
node "$here/hashes.mjs" "$PETRI_WEB/petri/engine.wasm" "$root/tests/conformance" "$root/tests/hashes/corpora.txt"
node --test "$here"/*.test.mjs >"$PETRI_WEB/tests.log" 2>&1 || {
    cat "$PETRI_WEB/tests.log"
    exit 1
}
grep -E '^# (pass|fail|skipped) ' "$PETRI_WEB/tests.log"
