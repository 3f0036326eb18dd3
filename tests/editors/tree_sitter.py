"""tree_sitter.py: the tree-sitter grammar accepts the scripts that petri accepts, builds the same trees and classifies the
tokens in the same way. The corpus for `tree-sitter test` has the trees of the grammar.

usage: tree_sitter.py PATH-OF-PETRI PATH-OF-PRINTER PATH-OF-PROJECT HIGHLIGHTS [QUERY...]. PRINTER is tree_sitter.c.
HIGHLIGHTS is the generated query for colours. All queries must fit the grammar."""

import json
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

petri, printer, root, highlights = str(Path(sys.argv[1]).resolve()), sys.argv[2], Path(sys.argv[3]).resolve(), sys.argv[4]
sys.path.insert(0, str(root / "tests/lsp"))
from client import Client  # noqa: E402

LEAF = re.compile(r"\s*(name|node|tag|literal)\b")
PLACE = re.compile(r"  @(\d+):(\d+)$")
CLASSES = {"tag": "class", "string.special.symbol": "enumMember", "label": "decorator"}  # by capture
NAMES = {"variable", "parameter", "function", "property", "attribute", "constant"}
IGNORED = {"operator", "punctuation"}
TOKEN_STEP = 10  # classes are compared in every tenth script


def print_all(*arguments):
    """Returns the printed lines of each script."""
    done = subprocess.run([printer, *arguments, *map(str, scripts)], capture_output=True, text=True, errors="replace")
    assert done.returncode == 0, f"{printer} failed: {done.stdout[-1000:]} {done.stderr[-1000:]}"
    names, found, lines = set(map(str, scripts)), {}, None
    for line in done.stdout.splitlines():
        if line in names:
            lines = found[line] = []
        else:
            lines.append(line)
    return [found[str(path)] for path in scripts]


def by_petri(path):
    """Returns the lines of the syntax tree, or None if petri rejects the script. Literals have no values, and only leaves
    have places."""
    done = subprocess.run([petri, "run", "--dump=ast", path], capture_output=True, text=True, errors="replace")
    if done.returncode != 0:
        return None
    lines = []
    for line in done.stdout.splitlines():
        place, leaf = PLACE.search(line), LEAF.match(line)
        text = leaf[0] if leaf and leaf[1] == "literal" else line[:place.start()] if place else line
        lines.append(text + (place[0] if leaf else ""))
    return lines


def class_of(kind):
    first = kind.split(".")[0]
    return CLASSES.get(kind) or ("name" if first in NAMES else first)


def tokens_of_petri(client, path):
    """Returns the classes of the tokens, by line and column."""
    lines, found, string_line = path.read_text().split("\n"), {}, None
    for line, start, end, kind in client.tokens(path):
        continues = kind == "string" and start == 0 and string_line == line - 1  # a string of several lines is several tokens
        string_line = line if kind == "string" else None
        if class_of(kind) not in IGNORED and not continues:
            column = len(lines[line].encode("utf-16-le")[:2 * start].decode("utf-16-le"))
            found[line + 1, column + 1] = class_of(kind)
    return found


def compare(path, tree, got):
    """Returns what differs, or None."""
    error = got[0] if got and got[0].startswith("error") else None
    if error and tree is not None:
        return f"the grammar finds an {error}; petri accepts the script"
    if not error and tree is None:
        return "the grammar accepts a script that petri rejects"
    if not error and got != tree:
        at = next((i for i, pair in enumerate(zip(got, tree)) if pair[0] != pair[1]), min(len(got), len(tree)))
        return f"line {at + 1} of the trees differs: {got[at:at + 1]}, petri {tree[at:at + 1]}"
    return None


scripts = sorted(path for folder in ("samples", "tests") for path in (root / folder).rglob("*.fl"))
with ThreadPoolExecutor(2) as pool:
    trees = list(pool.map(by_petri, scripts))
queries = [word for path in sys.argv[5:] for word in ("--query", path)]
faults = [(path, fault) for path, tree, got in zip(scripts, trees, print_all(*queries)) if (fault := compare(path, tree, got))]
rejected = sum(tree is None for tree in trees)

client, tokens = Client(petri, options=("--work", "10k")), 0  # tokens are checked without running frames
for path, tree, captures in list(zip(scripts, trees, print_all("--captures", highlights)))[::TOKEN_STEP]:
    if tree is None or b"\r" in path.read_bytes():
        continue
    found = {}
    for capture in captures:
        place = PLACE.search(capture)
        if class_of(capture[:place.start()]) not in IGNORED:
            found[int(place[1]), int(place[2])] = class_of(capture[:place.start()])
    expected = tokens_of_petri(client, path)
    tokens += len(expected)
    if found != expected:
        faults.append((path, f"classes: {sorted(found.items() ^ expected.items())[:4]}"))
client.end()

# The corpus for `tree-sitter test`: titles between lines of =, the script, a line of -, the tree.
folder = root / "src/editors/tree-sitter-flitter"
examples = re.findall(r"(?ms)^=+\n(.*?)\n=+\n(.*?)\n---\n(.*?)(?=^=+\n|\Z)", (folder / "test/corpus/flitter.txt").read_text())
for title, script, tree in examples:
    with tempfile.NamedTemporaryFile("w", suffix=".fl") as file:
        file.write(script)
        file.flush()
        done = subprocess.run([printer, "--own", file.name], capture_output=True, text=True)
        if done.stdout.split("\n", 1)[1].split() != re.sub(r"\s+\)", ")", tree).split() or "ERROR" in tree:
            faults.append((title, f"another tree: {done.stdout}"))
assert len(examples) >= 8, "too few examples in the corpus"
about = json.loads((folder / "tree-sitter.json").read_text())
for grammar in about["grammars"]:
    for query in (grammar[kind] for kind in ("highlights", "locals")):
        if not (folder / query).exists() and not (folder / (query + ".in")).exists():
            faults.append(("tree-sitter.json", f"no such query: {query}"))
assert about["grammars"][0]["name"] == re.search(r'name: "(\w+)"', (folder / "grammar.js").read_text())[1]

for path, fault in faults:
    print(f"{path}: {fault}")
print(f"{len(scripts)} scripts, {rejected} of them rejected by petri; {tokens} tokens; {len(faults)} differences")
assert len(scripts) > 1000 and rejected > 50 and tokens > 2000, "too few scripts"
sys.exit(len(faults) > 0)
