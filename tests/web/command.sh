#!/bin/sh
# command.sh FOLDER: tests the command of the npm package, which `./dev web` has built in FOLDER, with the suites of the native command:
# corpora, goldens, samples, sessions of the prompt, the language server and tests/cli. command_differences.txt lists the checks that differ.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(cd "$1" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
cat >"$work/petri" <<END
#!/bin/sh
# Pictures are tested by render.test.mjs, if there is a browser.
CHROME_PATH=none exec node "$folder/petri/cli.mjs" "\$@"
END
chmod +x "$work/petri"
cd "$root"

# The parts of tests/cli that need neither drawing nor locks of files, except those that test messages only (suggest, syntax_hints). Some need files
# of the parts before them. `state` follows `record`, because it kills a run: without locks of files, the run's temporary
# file remains, and `record` checks that there is none.
tests/cli/run.sh "$work/petri" command streams parameters check bad_input record archive state golden diff new fmt link complete \
    >"$work/cli" 2>&1 &
cli=$!
failed=0
"$work/petri" test tests/golden tests/conformance samples >"$work/corpora" 2>&1 || failed=1
grep '^FAIL' "$work/corpora" | sort -u || true
echo "petri test in Node.js: $(tail -n 1 "$work/corpora")"
tests/repl/run.sh "$work/petri" >"$work/repl" 2>&1 || {
    failed=1
    cat "$work/repl"
}
echo "petri repl in Node.js: $(tail -n 1 "$work/repl")"
python3 tests/lsp/features.py "$work/petri" >"$work/lsp" 2>&1 || true
grep -q '^[0-9]* passed, [0-9]* failed$' "$work/lsp" || failed=1
echo "petri lsp in Node.js: $(tail -n 1 "$work/lsp")"
native=build/src/petri-pictures
if [ -x "$native" ]; then
    tests/hashes/archives.sh "$native" "$work/petri" >"$work/archives" 2>&1 || failed=1
    echo "archives of the native command and of Node.js: $(tail -n 1 "$work/archives")"
fi
wait "$cli" || true
grep -q '^[0-9]* passed, [0-9]* failed$' "$work/cli" || failed=1
sed -n 's/^FAIL \([^:]*\).*/\1/p' "$work/cli" "$work/lsp" | sort -u >"$work/found"
grep -v '^#' "$(dirname "$0")/command_differences.txt" | sort -u >"$work/expected"
diff "$work/expected" "$work/found" >"$work/diff" || {
    failed=1
    echo "FAIL tests/cli differs from command_differences.txt (<: passes now, >: fails now):"
    cat "$work/diff"
    grep -A 4 '^FAIL' "$work/cli" | head -n 60
}
echo "tests/cli in Node.js: $(tail -n 1 "$work/cli"), $(wc -l <"$work/expected") names in command_differences.txt"
exit "$failed"
