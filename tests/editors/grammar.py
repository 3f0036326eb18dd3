"""grammar.py: the TextMate grammar and petri's scanner classify the tokens of all scripts in the same way.

usage: grammar.py PATH-OF-PETRI GRAMMAR PATH-OF-PROJECT. Skipped without node and vscode-textmate (`npm ci` in
src/editors/vscode, or NODE_PATH). GRAMMAR_STEP=N takes every Nth script."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

petri, grammar, root = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), Path(sys.argv[3]).resolve()
sys.path.insert(0, str(root / "tests/lsp"))
from client import Client  # noqa: E402

modules = root / "src/editors/vscode/node_modules"
environment = {**os.environ, "NODE_PATH": os.environ.get("NODE_PATH", str(modules))}
node = shutil.which("node")
if node is None or subprocess.run([node, "-e", "require('vscode-textmate'); require('vscode-oniguruma')"],
                                  env=environment, stderr=subprocess.DEVNULL).returncode != 0:
    print("skipped: node with vscode-textmate and vscode-oniguruma is not installed (run npm ci in src/editors/vscode)")
    sys.exit(77)

CLASSES = [("comment", "comment"), ("string", "string"), ("constant.numeric", "number"), ("keyword.operator.word", "keyword"),
           ("keyword.operator", "operator"), ("keyword", "keyword"), ("entity.name.tag", "class"),
           ("constant.other.symbol", "enumMember"), ("entity.other.attribute-name", "decorator"),
           ("variable", "name"), ("support", "name"), ("entity.name.function", "name")]
NAMES = {"variable", "parameter", "function", "property"}


def by_petri(client, path):
    """Yields the position and class of each token."""
    for line, start, end, kind in client.tokens(path):
        yield line, start, end, "name" if kind in NAMES else kind


def class_of(scope):
    return next((name for prefix, name in CLASSES if scope.startswith(prefix)), None)


# Files that cannot be parsed are not scripts.
rejected = {path.with_suffix(".fl") for path in (root / "tests").rglob("*.err")} | {
    root / line.split()[0] for line in (root / "tests/layouts.txt").read_text().splitlines() if "cannot be read" in line}
scripts = sorted(path for folder in ("samples", "tests") for path in (root / folder).rglob("*.fl") if path not in rejected)
step = int(os.environ.get("GRAMMAR_STEP", 1))
scripts = [path for i, path in enumerate(scripts) if i % step == 0]
output = subprocess.run([node, str(root / "tests/editors/tokenise.js"), grammar, *map(str, scripts)], env=environment,
                        capture_output=True, text=True, check=True).stdout.splitlines()
client = Client(petri, options=("--work", "10k"))  # tokens are checked without running frames
tokens, differ, classes = 0, 0, set()
for path, line in zip(scripts, output, strict=True):
    found = {}  # class by line and character
    for number, start, end, scope in json.loads(line):
        found.update({(number, at): class_of(scope) for at in range(start, end)})
    wrong = []
    for number, start, end, kind in by_petri(client, path):
        tokens += 1
        classes.add(kind)
        if any(found.get((number, at)) != kind for at in range(start, end)):
            wrong.append((number + 1, start + 1, kind, found.get((number, start))))
    if wrong:
        differ += 1
        print(path, *wrong, sep="\n    ")
client.end()
print(f"{len(scripts)} scripts, {tokens} tokens, {differ} scripts in which classes differ")
assert len(classes) == 9 and tokens > 20000 // step, classes
sys.exit(differ > 0)
