"""edits.py: random edits of the samples, with requests in between. `petri lsp` must not crash, and must report the same
diagnostics as `petri check`. usage: edits.py PATH-OF-PETRI PATH-OF-SAMPLES; LSP_EDITS=N sets the number of edits"""

import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from client import Client

EDITS = int(os.environ.get("LSP_EDITS", 120))
COMPARED = 12  # every 12th text is also checked with petri check
POSITIONED = ["completion", "hover", "signatureHelp", "definition", "documentHighlight", "references", "prepareRename",
              "rename"]
WHOLE = ["documentSymbol", "documentLink", "foldingRange", "semanticTokens/full", "inlayHint", "documentColor",
         "codeAction", "formatting"]
SNIPPETS = ["(", ")", "\n", "\n    ", "!", "$", ":", "'", '"', "😀", "é", "let ", "func f(x)\n    x\n", "=", ";", "--",
            " if ", "for i in ..3\n", "\t", "\\\n", "import a from 'lib/shapes.fl'\n", "%include 'hello.fl'\n", "[", "]",
            "!physics state=:a dimensions=2\n", "sin(", "0.5", "\r\n", "#t", "@f", "'''", "-", "¬", "\u0301"]

scratch = tempfile.TemporaryDirectory(prefix="petri-lsp-")
petri = os.path.abspath(sys.argv[1])
folder = Path(scratch.name) / "samples"
shutil.copytree(sys.argv[2], folder, ignore=shutil.ignore_patterns("pictures", "*.png", "*.gif", "embed"))
os.chdir(folder)
chance = random.Random(20)
texts = {path.name: path.read_text() for path in sorted(folder.glob("*.fl"))}
whole = "".join(texts.values())


def position(text, offset):
    """Returns the protocol's position of an offset. CR LF is one line end."""
    lines = text[:offset].replace("\r\n", "\n").replace("\r", "\n").split("\n")
    return {"line": len(lines) - 1, "character": len(lines[-1].encode("utf-16-le")) // 2}


def edit(text):
    """Returns a random change: start, end, new text."""
    start = chance.randrange(len(text) + 1)
    kind = chance.random()
    end = start if kind < 0.6 else min(len(text), start + chance.randrange(1, 40 if kind < 0.95 else 2000))
    new = chance.choice(SNIPPETS) if chance.random() < 0.6 else ""
    if kind < 0.2:
        begin = chance.randrange(len(whole))
        new = whole[begin:begin + chance.randrange(1, 80)]
    return start, end, new


def checked(name, text):
    Path(name).write_bytes(text.encode())
    out = subprocess.run([petri, "check", "--format=json", str(folder / name)], capture_output=True).stdout
    return sorted((d["line"], d["column"], d["level"], d["text"], d["hint"]) for d in json.loads(out)
                  if d["file"] == str(folder / name))


def published(text, diagnostics):
    lines = text.replace("\r\n", "\n").replace("\r", "\n").split("\n")

    def one(diagnostic):
        place = diagnostic["range"]["start"]
        head = lines[place["line"]].encode("utf-16-le")[:2 * place["character"]].decode("utf-16-le")
        text, _, hint = diagnostic["message"].partition("\n")
        return (place["line"] + 1, len(head) + 1, ["error", "warning", "note"][diagnostic["severity"] - 1], text,
                hint or None)
    return sorted(map(one, diagnostics))


client = Client(petri)
compared = answered = 0
slowest = []
for number in range(EDITS):
    name = chance.choice(list(texts)) if number % 40 == 0 else name
    if number % 40 == 0:
        uri, text = (folder / name).as_uri(), texts[name]
        client.published.pop(uri, None)
        client.open(uri, text)
    changes = []
    for _ in range(chance.choice([1, 1, 1, 3])):
        start, end, new = edit(text)
        # Changes must not split a CR LF.
        start -= start > 0 and text[start - 1:start + 1] == "\r\n"
        end += end > 0 and text[end - 1:end + 1] == "\r\n"
        changes.append({"range": {"start": position(text, start), "end": position(text, end)}, "text": new})
        text = text[:start] + new + text[end:]
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    client.change(uri, *changes)
    if chance.random() < 0.5:
        place = position(text, chance.randrange(len(text) + 1))
        for method in chance.sample(POSITIONED, 3):
            reply = client.reply("textDocument/" + method, {
                "textDocument": {"uri": uri}, "position": place, "newName": "other_name",
                "context": {"includeDeclaration": True}})
            assert "result" in reply or "ename" in method, reply
            answered += 1
        for method in chance.sample(WHOLE, 2):
            client.of(method, uri, options={}, context={"diagnostics": []}, range={
                "start": {"line": 0, "character": 0}, "end": place})
            answered += 1
        client.reply("textDocument/rangeFormatting", {"textDocument": {"uri": uri}, "options": {}, "range": {
            "start": {"line": place["line"] // 2, "character": 0}, "end": place}})
    begun = time.monotonic()
    diagnostics = client.wait(uri)
    slowest.append(time.monotonic() - begun)
    if number % COMPARED == COMPARED - 1:
        wanted = checked(name, text)
        assert published(text, diagnostics) == wanted, (number, published(text, diagnostics), wanted)
        compared += 1
    if number % 40 == 39:
        client.close(uri)
assert client.end() == 0
assert compared >= EDITS // COMPARED and answered > EDITS
print(f"{EDITS} edits, {answered} requests, {compared} compared with petri check: 0 failed; diagnostics in "
      f"{1000 * sorted(slowest)[len(slowest) // 2]:.1f} ms, the slowest in {1000 * max(slowest):.0f} ms")
