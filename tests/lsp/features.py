"""features.py: tests of the answers of `petri lsp`, request by request. usage: features.py PATH-OF-PETRI"""

import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from client import Client

scratch = tempfile.TemporaryDirectory(prefix="petri-lsp-")
petri = os.path.abspath(sys.argv[1])
os.chdir(scratch.name)
passed = failed = 0


def check(name, found, wanted=True):
    global passed, failed
    good = found == wanted
    passed += good
    failed += not good
    print("ok " + name if good else f"FAIL {name}: {found!r}, not {wanted!r}")


def labels(items):
    return [item["label"] for item in items]


def place(text):
    """Takes a text with a mark, §. Returns the text without it, and the line and character of the mark."""
    before = text[:text.index("§")]
    line = before.count("\n")
    return text.replace("§", ""), line, len(before.split("\n")[-1].encode("utf-16-le")) // 2


def answer_at(text, method, **more):
    """Returns the answer to a request at the mark."""
    plain, line, character = place(text)
    client.versions.setdefault(uri, 0)
    if client.versions[uri] == 0:
        client.open(uri, plain)
    else:
        client.change(uri, {"text": plain})
    return client.at(method, uri, line, character, **more)


def applied(text, edits):
    lines = text.split("\n")

    def offset(position):
        head = lines[position["line"]].encode("utf-16-le")[:2 * position["character"]].decode("utf-16-le")
        return sum(len(line) + 1 for line in lines[:position["line"]]) + len(head)
    for edit in sorted(edits, key=lambda e: offset(e["range"]["start"]), reverse=True):
        text = text[:offset(edit["range"]["start"])] + edit["newText"] + text[offset(edit["range"]["end"]):]
    return text


client = Client(petri)
uri = Path("script.fl").absolute().as_uri()
check("the server reports its name", client.server["serverInfo"]["name"], "petri")
check("positions are UTF-16 unless the editor supports UTF-8", client.server["capabilities"]["positionEncoding"],
      "utf-16")

# Diagnostics.
diagnostics = client.open(uri, "let a=coz(1)\n!n b=a c='😀' d=nowhere\n")
check("diagnostics of petri check are published",
      [(d["message"], d["range"]["start"], d["range"]["end"], d["severity"], d["code"]) for d in diagnostics],
      [("unbound name 'coz' is null\ndid you mean 'cos'?", {"line": 0, "character": 6}, {"line": 0, "character": 9}, 2,
        "unbound-name"),
       ("unbound name 'nowhere' is null", {"line": 1, "character": 16}, {"line": 1, "character": 23}, 2,
        "unbound-name")])
client.change(uri, {"range": {"start": {"line": 0, "character": 8}, "end": {"line": 0, "character": 9}}, "text": "s"},
              {"range": {"start": {"line": 1, "character": 16}, "end": {"line": 1, "character": 23}}, "text": "1"})
check("corrected diagnostics are withdrawn", client.wait(uri), [])
client.change(uri, {"text": "!physics state=:cells dimensions=2\n    !particle id=0\n    !drag\n"
                            "!o a=$(:cell;0) b=$:cells;0 c=$(:cells;7) d=sin(90)\n"})
check("silent mistakes are published with codes", sorted(d["code"] for d in client.wait(uri)),
      ["angle-unit", "loose-key", "no-radius", "unknown-id", "unknown-state"])
client.change(uri, {"text": "!n a=)\n"})
check("errors have severity 1", [d["severity"] for d in client.wait(uri)], [1])
Path("part.fl").write_text("!n v=nothing\n")
part = Path("part.fl").absolute().as_uri()
client.change(uri, {"text": "%include 'part.fl'\n!n\n"})
while part not in client.published:
    client.read()
check("diagnostics of an included file are published for that file", [d["range"]["start"] for d in client.published[part]["diagnostics"]],
      [{"line": 0, "character": 5}])
client.change(uri, {"text": "!n\n"})
client.wait(uri)
while client.published[part]["diagnostics"]:
    client.read()
check("diagnostics of a file that is no longer included are withdrawn", client.published[part]["diagnostics"], [])

# Completion.
script = """let SIZE=300
func area(width, height=2)
    width*height
!physics state=:dish dimensions=2
    !particle id=1
%s
"""
check("names in scope are completed", {"SIZE", "area", "sin", "beat", "pi"} <= set(labels(answer_at(script % "let x=§", "completion"))))
check("names out of scope are not completed", "width" in labels(answer_at(script % "let x=§", "completion")), False)
check("parameters are completed within their function",
      {"width", "height"} <= set(labels(answer_at(script.replace("width*height", "w§") % "", "completion"))))
check("nodes are completed after !", {"!window", "!particle", "!ellipse"} <= set(labels(answer_at(script % "!§", "completion"))))
items = answer_at(script % "!physics state=:b §", "completion")
check("attributes are completed", {"dimensions=", "resolution="} <= set(labels(items)))
check("attributes are completed with types", [i["detail"] for i in items if i["label"] == "dimensions="], ["whole number, 1 or more"])
check("attributes are completed with defaults", "default" in str([i for i in answer_at("!particle §\n", "completion") if i["label"] == "mass="]))
check("state keys are completed after $", labels(answer_at(script % "let x=$§", "completion"))[:1], [":dish"])
check("a partial state key is completed", ":dish" in labels(answer_at(script % "let x=$:d§", "completion")))
check("symbols that an attribute accepts are completed", {":butt", ":round", ":square"} <=
      set(labels(answer_at("!path\n    !stroke stroke_cap=:§\n", "completion"))))
check("named arguments are completed", {"width=", "height="} <= set(labels(answer_at(script % "let x=area(§", "completion"))))
check("file names are completed in strings", "part.fl" in labels(answer_at("%include 'p§'\n", "completion")))
check("nothing is completed in comments", labels(answer_at("-- s§\n", "completion")), [])
items = answer_at("let x=si§\n", "completion")
sin = [i for i in items if i["label"] == "sin"][0]
check("functions are completed with their parameters", sin["detail"], "sin(x)")
check("a completion replaces the partial word", applied("let x=si\n", [sin["textEdit"]]), "let x=sin\n")

# Hover.
hover = answer_at("let x=s§in(1)\n", "hover")
check("hover shows a function", "sin(x)" in hover["contents"]["value"])
check("hover returns the range of the word", hover["range"]["end"], {"line": 0, "character": 9})
check("hover shows a node", "a particle" in answer_at("!parti§cle id=1\n", "hover")["contents"]["value"])
check("hover shows the formula of a force", "\nF = strength · (r₁ + r₂ − l)^power if l < r₁ + r₂\n" in answer_at(
    "!coll§ision strength=2\n", "hover")["contents"]["value"])
check("hover shows an attribute", "of `!particle`" in answer_at("!particle ra§dius=1\n", "hover")["contents"]["value"])
check("hover shows a built-in value", "tempo" in answer_at("!n a=be§at\n", "hover")["contents"]["value"])
check("hover shows a keyword", "repeats" in answer_at("fo§r i in 3\n    !n\n", "hover")["contents"]["value"])
hover = answer_at("-- How large\nlet SIZE=2*150   -- it is\n!n a=SI§ZE\n", "hover")["contents"]["value"]
check("hover shows the value of a constant", "= `300`" in hover)
check("hover shows the comments at a binding", "How large" in hover and "it is" in hover)
for binding in ("A=(1;2)", "A=((1;2)*(3))", "A=1;(2;3)", "A=(1;\n    2)", "A=(')')", "A=sin(0.5)", "A=(1 -- one)\n    )", "A=(1)[(0)]"):
    text = answer_at(f"let {binding}  -- note\n    B=(3)\n!n a=§A b=B\n", "hover")["contents"]["value"]
    check(f"hover shows all of {binding}", f"let {binding}\n```" in text and "note" in text)
check("hover of a parameter has no foreign parenthesis", "x=2\n```" in answer_at(
    "func f(x=2)\n    §x\n!n a=f()\n", "hover")["contents"]["value"])
check("hover shows no value of a variable name", "= `" in answer_at("let a=frame\n!n a=§a\n", "hover")["contents"]["value"], False)
check("hover shows the value of a number with a suffix", answer_at("!n a=9§0deg\n", "hover")["contents"]["value"], "= `0.25`")
check("hover shows nothing on blanks", answer_at("!n  §  a=1\n", "hover"), None)
for topic in ("builtins", "nodes"):
    listed = subprocess.run([petri, "help", topic], capture_output=True, text=True, env={**os.environ, "COLUMNS": "1000"}).stdout.split("\n")
    words = {line.split("(")[0] for line in listed if line} if topic == "builtins" else {
        line.strip().split(":")[0] for line in listed if line.startswith("  !")}
    check(f"petri help lists {topic}", len(words) > 60)
    text = "".join(f"!n a={word}\n" if topic == "builtins" else word + "\n" for word in sorted(words))
    client.change(uri, {"text": text})
    silent = [word for i, word in enumerate(sorted(words))
              if not client.at("hover", uri, i, 6 if topic == "builtins" else 1)["contents"]["value"]]
    check(f"hover explains all {topic}", silent, [])

# Signatures.
help = answer_at(script % "let x=area(1, §", "signatureHelp")
check("signature help shows the parameters of a function", help["signatures"][0]["label"], "area(width, height=2)")
check("signature help marks the current parameter", help["activeParameter"], 1)
check("signature help shows a built-in", answer_at("let x=map(0.5, (1;§2), 3)\n", "signatureHelp")["signatures"][0]["label"][:4], "map(")

# Definition, references and rename.
names = "let a=1\nfunc f(a, b)\n    a + b\n!n x=a y=f(a, b=3) z=a\n"
check("the definition of an argument is found", answer_at(names.replace("    a + b", "    §a + b"), "definition")["range"]["start"],
      {"line": 1, "character": 7})
check("the definition of a let is found", answer_at(names.replace("x=a", "x=§a"), "definition")["range"]["start"],
      {"line": 0, "character": 4})
check("references include the declaration on request", len(answer_at(names.replace("x=a", "x=§a"), "references", context={"includeDeclaration": True})), 4)
check("references exclude the declaration by default", len(answer_at(names.replace("x=a", "x=§a"), "references",
                                                                     context={"includeDeclaration": False})), 3)
check("all uses are highlighted", len(answer_at(names.replace("x=a", "x=§a"), "documentHighlight")), 4)
edits = answer_at(names.replace("(a, b)", "(a, §b)"), "rename", newName="c")["changes"][uri]
check("renaming a parameter renames named arguments", applied(names, edits),
      "let a=1\nfunc f(a, c)\n    a + c\n!n x=a y=f(a, c=3) z=a\n")
edits = answer_at("let N=N or 5\n!n a=§N\n", "rename", newName="COUNT")["changes"][uri]
check("renaming a script parameter renames both names", applied("let N=N or 5\n!n a=N\n", edits), "let COUNT=COUNT or 5\n!n a=COUNT\n")


def rename_error(text, name):
    plain, line, character = place(text)
    client.change(uri, {"text": plain})
    reply = client.reply("textDocument/rename", {"textDocument": {"uri": uri}, "newName": name,
                                                 "position": {"line": line, "character": character}})
    return reply.get("error", {}).get("message")


check("renaming to a name in use is rejected", rename_error(names.replace("(a, b)", "(a, §b)"), "a"),
      "the name is in use: renaming would change the script's meaning")
check("renaming to a built-in in use is rejected", rename_error("let §a=1\n!n b=a c=sin(1)\n", "sin"),
      "the name is in use: renaming would change the script's meaning")
check("renaming to an invalid name is rejected", rename_error("let §a=1\n", "1x"), "not a valid name")
check("built-ins cannot be renamed", rename_error("let a=§sin(1)\n", "x"), "cannot rename: the script does not bind this name")
Path("lib.fl").write_text("-- Twice as much.\nfunc twice(x)\n    2*x\n")
imports = "import twice from 'lib.fl'\n!n a=§twice(2)\n"
check("the definition of an imported name is in its file", answer_at(imports, "definition"),
      {"uri": Path("lib.fl").absolute().as_uri(),
       "range": {"start": {"line": 1, "character": 5}, "end": {"line": 1, "character": 10}}})
check("hover shows the comment of an imported name", "Twice as much" in answer_at(imports, "hover")["contents"]["value"])
check("signature help shows the parameters of an imported function",
      answer_at("import twice from 'lib.fl'\n!n a=twice(§2)\n", "signatureHelp")["signatures"][0]["label"], "twice(x)")
check("the definition of a file name is the file", answer_at("import twice from 'l§ib.fl'\n", "definition")["uri"],
      Path("lib.fl").absolute().as_uri())

# Names that occur in several files. One of the files is open and has unsaved changes.
Path("project").mkdir()
os.chdir("project")
files = {
    "lib.fl": "let SCALE=2\nfunc area(width, height=1)\n    width*height*SCALE\n",
    "shapes.fl": "import area from 'lib.fl'\nlet big=area(3, height=4)\n",
    "parts.fl": "!part n=COUNT m=sin(COUNT)\n",
    "main.fl": "import area;SCALE from 'lib.fl'\nlet COUNT=3\n%include 'parts.fl'\n!n a=area(1, height=2) b=SCALE c=COUNT\n",
    "other.fl": "let area=1\n!n a=area\n",
}
for name, text in files.items():
    Path(name).write_text(text)
of = {name: Path(name).absolute().as_uri() for name in files}
several = Client(petri, root=Path(".").absolute().as_uri())
several.open(of["main.fl"], files["main.fl"])


def at(name, mark, method, nth=0, **more):
    """Returns the answer at the nth occurrence of a word in a file, which is opened for the request."""
    opened = name in opens
    if not opened:
        several.open(of[name], files[name])
    start = -1
    for _ in range(nth + 1):
        start = files[name].index(mark, start + 1)
    before = files[name][:start]
    reply = several.reply("textDocument/" + method, {"textDocument": {"uri": of[name]}, "position": {
        "line": before.count("\n"), "character": len(before.split("\n")[-1])}, **more})
    if not opened:
        several.close(of[name])
    return reply.get("result", reply.get("error", {}).get("message"))


opens = {"main.fl"}


def where(locations):
    """Returns locations as FILE:LINE:COLUMN, from 1."""
    locations = locations if isinstance(locations, list) else [locations]
    return sorted("%s:%d:%d" % (l["uri"].split("/")[-1], l["range"]["start"]["line"] + 1,
                                l["range"]["start"]["character"] + 1) for l in locations)


def renamed(edit):
    """Returns the texts of all files after an edit."""
    return {name: applied(text, edit["changes"][of[name]]) if of[name] in edit["changes"] else text
            for name, text in files.items()}


check("a name of an included file is defined in the including file", where(at("parts.fl", "COUNT", "definition")), ["main.fl:2:5"])
check("hover in an included file shows the binding of the including file", "let COUNT=3" in at("parts.fl", "COUNT", "hover")["contents"]["value"])
check("completion in an included file offers names of the including file", {"COUNT", "area"} <= set(labels(at("parts.fl", "COUNT", "completion"))))
every = {"includeDeclaration": True}
check("references are found in all files", where(at("main.fl", "area", "references", context=every)),
      ["lib.fl:2:6", "main.fl:1:8", "main.fl:4:6", "shapes.fl:1:8", "shapes.fl:2:9"])
check("references are found from a file that imports nothing", where(at("lib.fl", "SCALE", "references", context=every)),
      ["lib.fl:1:5", "lib.fl:3:18", "main.fl:1:13", "main.fl:4:26"])
check("references are found through an include", where(at("parts.fl", "COUNT", "references", context=every)),
      ["main.fl:2:5", "main.fl:4:34", "parts.fl:1:21", "parts.fl:1:9"])
check("highlights are limited to the file", len(at("main.fl", "COUNT", "documentHighlight")), 2)
check("a function is renamed in all files", renamed(at("main.fl", "area", "rename", newName="face")),
      {name: text if name == "other.fl" else text.replace("area", "face") for name, text in files.items()})
check("a parameter is renamed in all files", renamed(at("lib.fl", "height", "rename", newName="tall")),
      {name: text.replace("height", "tall") for name, text in files.items()})
check("a name of an included file is renamed in all files", renamed(at("parts.fl", "COUNT", "rename", newName="MANY")),
      {name: text.replace("COUNT", "MANY") for name, text in files.items()})
check("renaming to a name of another file is rejected", at("lib.fl", "area", "rename", newName="COUNT"),
      "the name is in use: renaming would change the script's meaning")
check("renaming to a name that an included file uses is rejected", at("main.fl", "SCALE", "rename", newName="sin"),
      "the name is in use: renaming would change the script's meaning")
check("correct files have no diagnostics", several.published[of["main.fl"]]["diagnostics"], [])
opens.add("lib.fl")
several.open(of["lib.fl"], files["lib.fl"])
several.change(of["lib.fl"], {"text": files["lib.fl"].replace("SCALE", "SIZE")})
several.of("documentSymbol", of["lib.fl"])
while not several.published[of["main.fl"]]["diagnostics"]:
    several.read()
check("unsaved changes affect importing files", several.published[of["main.fl"]]["diagnostics"][0]["message"],
      f"'{Path('lib.fl').absolute()}' does not bind 'SCALE'")
several.close(of["lib.fl"])
while several.published[of["main.fl"]]["diagnostics"]:
    several.read()
check("closing a file discards its unsaved changes", several.published[of["main.fl"]]["diagnostics"], [])
several.end()
os.chdir("..")

# Files that other programs change.
check("an editor that cannot watch files is not asked to", client.requests, [])
watching = Client(petri, watches=True)
importing = Path("importing.fl").absolute().as_uri()
Path("changing.fl").write_text("func twice(x)\n    2*x\n")
check("a correct import has no diagnostics", watching.open(importing, "import twice from 'changing.fl'\n!n a=twice(2)\n"), [])
[asked] = watching.requests
check("the server asks for changes of scripts", (asked["method"], [(one["method"], one["registerOptions"]) for one in asked["params"][
    "registrations"]]), ("client/registerCapability", [("workspace/didChangeWatchedFiles", {"watchers": [{"globPattern": "**/*.fl"}]})]))
Path("changing.fl").write_text("func thrice(x)\n    3*x\n")
watching.notify("workspace/didChangeWatchedFiles", {"changes": [{"uri": Path("changing.fl").absolute().as_uri(), "type": 2}]})
while not watching.published[importing]["diagnostics"]:
    watching.read()
check("a script is checked again after a change of a file that it imports", watching.published[importing]["diagnostics"][0]["message"],
      f"'{Path('changing.fl').absolute()}' does not bind 'twice'")
watching.end()

# Memory for typed names is freed. Not checked with AddressSanitizer, which does not return memory to the system.
def memory():
    return next(int(line.split()[1]) for line in open(f"/proc/{several.process.pid}/status") if line.startswith("VmRSS"))


several = Client(petri)
many = Path("many.fl").absolute().as_uri()
several.open(many, "!n\n")
sizes = []
for i in range(13):
    several.change(many, {"text": "let\n" + " ".join(f"name_{i}_{k}" for k in range(32000))})
    several.at("hover", many, 0, 0)
    sizes.append(memory())
check("memory for names is bounded",
      "ASAN_OPTIONS" in os.environ or any(b < 0.7 * a for a, b in zip(sizes, sizes[1:])))
several.end()

# Symbols, folding ranges, semantic tokens.
text = "-- one\n-- two\nlet a=1\nfunc f(x)\n    x\n!window size=1;2\n    !canvas\n        !rect\n"
client.change(uri, {"text": text})
check("top-level names and nodes are symbols", [(s["name"], s["kind"]) for s in client.of("documentSymbol", uri)],
      [("a", 13), ("f", 12), ("!window", 19)])
check("comments and blocks fold", [(f["startLine"], f["endLine"], f.get("kind")) for f in client.of("foldingRange", uri)],
      [(0, 1, "comment"), (3, 4, None), (5, 7, None), (6, 7, None)])

def offset_of(text, position):
    lines = text.split("\n")
    return sum(len(line) + 1 for line in lines[:position["line"]]) + position["character"]


def selected(text, *marks):
    """Returns, for each offset, the ranges that the editor selects one after the other."""
    client.change(uri, {"text": text})
    positions = [{"line": text[:mark].count("\n"), "character": len(text[:mark].split("\n")[-1])} for mark in marks]
    found = []
    for chain in client.of("selectionRange", uri, positions=positions):
        found.append([])
        while chain:
            found[-1].append(tuple(offset_of(text, chain["range"][side]) for side in ("start", "end")))
            chain = chain.get("parent")
    return found


text = ("let a=1\n!physics state=:s dimensions=2\n    !group\n"
        "        !particle id=:p position=f(1, 2*(a+3), r=a);7 mass=2 -- c\n        !drag\n    !random\n")
check("the selection grows by syntax", [text[start:end] for start, end in selected(text, text.index("a+3"))[0]], [
    "a", "a+3", "(a+3)", "2*(a+3)", "1, 2*(a+3), r=a", "(1, 2*(a+3), r=a)", "f(1, 2*(a+3), r=a);7",
    "position=f(1, 2*(a+3), r=a);7", "!particle id=:p position=f(1, 2*(a+3), r=a);7 mass=2",
    "!particle id=:p position=f(1, 2*(a+3), r=a);7 mass=2 -- c\n        !drag",
    text[text.index("!group"):text.index("\n    !random")], text[text.index("!group"):-1],
    text[text.index("!physics"):-1], text])
check("a named argument is selected with its value",
      [text[start:end] for start, end in selected(text, text.index("=a)") + 1)[0]][:3], ["a", "r=a", "1, 2*(a+3), r=a"])
for sample in (text, "", "\n\n", "f(a;(b\n!x )] y=\n  -- c\n", "func f(x)\n    x\n\n\n-- c\nlet s='''a\nb'''\n"):
    chains = selected(sample, *range(len(sample) + 1))
    check("selections contain the offset and grow: %r" % sample[:20], all(
        chain[0][0] <= offset <= chain[0][1] and chain[-1] == (0, len(sample)) and
        all(b[0] <= a[0] and a[1] <= b[1] and a != b for a, b in zip(chain, chain[1:]))
        for offset, chain in enumerate(chains)))

# Code lenses.
check("an editor without commands gets no code lenses", client.of("codeLens", uri), [])
able = Client(petri, commands=["petri.run", "petri.render", "petri.test", "petri.other"])
for name, text in ("tested.fl", "!a b=1\n"), ("module.fl", "func f(x)\n    x\n"):
    Path(name).write_text(text)
Path("tested.golden").write_text("")
for name, wanted in (("new.fl", ["run", "render"]), ("tested.fl", ["run", "render", "test"]), ("module.fl", [])):
    at = Path(name).absolute().as_uri()
    able.open(at, "!a b=1\n" if name == "new.fl" else Path(name).read_text())
    found = [lens["command"] for lens in able.of("codeLens", at)]
    check(f"{name} has the commands that it can have", [command["title"] for command in found], wanted)
    check("code lenses name the script and the command", all(
        command["arguments"] == [at] and command["command"] == "petri." + command["title"] for command in found))
able.open("untitled:one", "!a\n")
check("a script without a file has no code lenses", able.of("codeLens", "untitled:one"), [])
able.end()

client.change(uri, {"text": "let a=sin(1) -- c\n!n #t x=:y z='''😀\n2''' w=a\n"})
legend = client.server["capabilities"]["semanticTokensProvider"]["legend"]["tokenTypes"]
data = client.of("semanticTokens/full", uri)["data"]
line = character = 0
classes = []
for i in range(0, len(data), 5):
    line, character = line + data[i], data[i + 1] + (0 if data[i] else character)
    classes.append((line, character, data[i + 2], legend[data[i + 3]]))
check("tokens have semantic types", classes, [
    (0, 0, 3, "keyword"), (0, 4, 1, "variable"), (0, 5, 1, "operator"), (0, 6, 3, "function"), (0, 9, 1, "operator"),
    (0, 10, 1, "number"), (0, 11, 1, "operator"), (0, 13, 4, "comment"), (1, 0, 2, "class"), (1, 3, 2, "decorator"),
    (1, 6, 1, "property"), (1, 7, 1, "operator"), (1, 8, 2, "enumMember"), (1, 11, 1, "property"),
    (1, 12, 1, "operator"), (1, 13, 5, "string"), (2, 0, 4, "string"), (2, 5, 1, "property"), (2, 6, 1, "operator"),
    (2, 7, 1, "variable")])

# Inlay hints, colours, quick fixes, formatting.
whole = {"start": {"line": 0, "character": 0}, "end": {"line": 99, "character": 0}}
client.change(uri, {"text": "let a=2*3 b=a;1 c=frame+1 d=5 e=$:x\nlet N=N or 2*a\n"})
check("inlay hints show values of constants", [(h["label"], h["position"]["character"]) for h in client.of("inlayHint", uri, range=whole)],
      [("= 6", 9), ("= 6;1", 15), ("= 12", 14)])
client.change(uri, {"text": "!fill color=1;0.5;0\nlet c=hsv(0.5;1;1)\n!fill color=a;1;1\n"})
colours = client.of("documentColor", uri)
check("colours of a script are found", [tuple(c["color"][k] for k in ("red", "green", "blue", "alpha")) for c in colours],
      [(1, 0.5, 0, 1), (0, 1, 1, 1)])
shown = client.of("colorPresentation", uri, color={"red": 1, "green": 0, "blue": 0, "alpha": 1},
                  range=colours[1]["range"])
check("a colour keeps its notation", [s["label"] for s in shown], ["hsv(0;1;1)"])
for wrong, right in [("!n a=coz(1)\n", "!n a=cos(1)\n"), ("!pysics state=:a dimensions=1\n", "!physics state=:a dimensions=1\n"),
                     ("!window\n    !canvas\n        !elipse\n", "!window\n    !canvas\n        !ellipse\n"),
                     ("!window\n    !canvas\n        !ellipse radus=1\n", "!window\n    !canvas\n        !ellipse radius=1\n"),
                     ("%pragma temp 60\n!n\n", "%pragma tempo 60\n!n\n"),
                     ("!physics state=:a dimensions=1\n    !partcle id=1\n", "!physics state=:a dimensions=1\n    !particle id=1\n")]:
    client.change(uri, {"text": wrong})
    actions = client.of("codeAction", uri, range=whole, context={"diagnostics": []})
    check("a correction is offered: " + right.split("\n")[-2].strip(),
          [applied(wrong, a["edit"]["changes"][uri]) for a in actions], [right])
text = "let a = 1\n!n   b=a\n!m\n"
client.change(uri, {"text": text})
check("a script is formatted", applied(text, client.of("formatting", uri, options={})), "let a=1\n!n b=a\n!m\n")
client.change(uri, {"text": "let a = \n"})
check("a script with errors is not formatted", client.of("formatting", uri, options={}), None)


def lines(first, last):
    return {"start": {"line": first, "character": 0}, "end": {"line": last, "character": 0}}


def formatted(text, first, last):
    """Returns the text after formatting the lines `first` to the one before `last`, counted from 0."""
    client.change(uri, {"text": text})
    return applied(text, client.of("rangeFormatting", uri, range=lines(first, last), options={}))


check("selected lines are formatted", formatted("let a = 1\n\n\n\n!n   b=a\n!m   c=a\n", 3, 5), "let a = 1\n\n\n\n!n b=a\n!m   c=a\n")
check("a selected block is formatted", formatted("!n\n  !m   a=1\n  !k\n!n   a=1\n", 1, 3), "!n\n    !m a=1\n    !k\n!n   a=1\n")
client.change(uri, {"text": "!n\n  !m\n  !k\n"})
check("lines are not formatted alone if the script would not be valid", client.reply("textDocument/rangeFormatting", {
    "textDocument": {"uri": uri}, "range": lines(1, 2), "options": {}})["error"]["message"].split(",")[0],
    "cannot format these lines alone")

# The workspace: links, symbols and folders.
for folder, name, text in [("one", "main.fl", "import area from '../two/lib.fl'\nimport x from 'missing.fl'\nlet WIDTH=1\n!n a=area(WIDTH)\n"),
                           ("two", "lib.fl", "func area(x)\n    let inner=x\n    inner\nlet aureole=2\n")]:
    Path(folder).mkdir()
    Path(folder, name).write_text(text)
folders = Client(petri, options=("--allow-read", "two"), root=Path("one").absolute().as_uri())
main = Path("one/main.fl").absolute().as_uri()
folders.open(main, Path("one/main.fl").read_text())
links = folders.of("documentLink", main)
check("the file of an import is a link", [(link["target"].split("/")[-2:], link["range"]) for link in links],
      [(["two", "lib.fl"], {"start": {"line": 0, "character": 17}, "end": {"line": 0, "character": 32}})])


def symbols(query):
    return sorted((symbol["name"], symbol["kind"], where(symbol["location"])[0]) for symbol in folders.ask("workspace/symbol", {"query": query}))


two = {"uri": Path("two").absolute().as_uri(), "name": "two"}
check("symbols are found in the folder", symbols(""), [("WIDTH", 13, "main.fl:3:5")])
folders.notify("workspace/didChangeWorkspaceFolders", {"event": {"added": [two], "removed": []}})
check("symbols are found in a folder that is added", symbols("AR"), [("area", 12, "lib.fl:1:6"), ("aureole", 13, "lib.fl:4:5")])
check("the letters of a symbol may be apart", symbols("aol"), [("aureole", 13, "lib.fl:4:5")])
folders.notify("workspace/didChangeWorkspaceFolders", {"event": {"added": [], "removed": [two]}})
check("symbols of a folder that is removed are not found", symbols("area"), [])
folders.end()

# Failed tests of a script that is saved.
saved = Path(scratch.name, "saved.fl")
saved.write_text("let A=1\n!n a=A\n")
subprocess.run([petri, "test", "--new", saved, "--frames", "1"], check=True, stdout=subprocess.DEVNULL)


def after_save(text, again=False):
    """Saves the script with this text, or changes it `again` after that. Returns its diagnostics: line and message of each."""
    uri = saved.as_uri()
    saved.write_text(text)
    client.change(uri, {"text": text})
    client.wait(uri)
    client.published.pop(uri)
    client.notify("textDocument/didSave", {"textDocument": {"uri": uri}})
    diagnostics = client.wait(uri)
    if again:
        client.change(uri, {"text": text})
        diagnostics = client.wait(uri)
    return [(item["range"]["start"]["line"], item["message"].split("\n")[0]) for item in diagnostics]


client.open(saved.as_uri(), saved.read_text())
check("a golden that agrees gives no diagnostic", after_save("let A=1\n!n a=A\n"), [])
check("a golden that differs is an error of the script", after_save("let A=2\n!n a=A\n"),
      [(0, "saved.golden fails: frame 0: expected !n a=1, got !n a=2")])
check("after a change, failed tests are not shown", after_save("let A=3\n!n a=A\n", again=True), [])
if shutil.which("git"):
    motion = "!physics state=:s dimensions=1\n    !particle id=:a position=0\n    !constant acceleration=%d\n"
    saved.write_text(motion % 1)
    Path("saved.golden").unlink()
    subprocess.run([petri, "test", "--new", saved], check=True, stdout=subprocess.DEVNULL)
    git = ["git", "-c", "user.name=n", "-c", "user.email=e"]
    for words in (["init", "-q"], ["add", "saved.fl", "saved.golden"], ["commit", "-q", "-m", "first"]):
        subprocess.run(git + words, check=True)
    check("a failure is shown in the line of its cause", [line for line, message in after_save(motion % 2)], [2])
client.close(saved.as_uri())

# Incomplete scripts.
check("names are completed although a line has an error", {"SIZE", "area"} <=
      set(labels(answer_at(script.replace("width*height", "width*height\nlet y=(1;") % "let x=§", "completion"))))
check("definitions are found although a line has an error", answer_at("let a=1\n!n b=)\n!m c=§a\n", "definition")["range"]["start"],
      {"line": 0, "character": 4})

# Invalid messages.
check("an unknown request is an error", client.reply("petri/nonsense", {})["error"]["code"], -32601)
check("a request without a document is an error", "error" in client.reply("textDocument/hover", {}))
check("a position after the end is accepted", client.at("hover", uri, 10**6, 10**6), None)

def answer_to(body, number):
    client.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body) + body)
    client.process.stdin.flush()
    return client.answer(number)


shutdown = b'{"id":%s,"method":"shutdown"}'
nested = b"[" * 300 + b"]" * 300
for body in (b"{x}", b"{} {}", b'{"id":1,}', b'{"id":1 "method":"a"}', b'/**/{"id":1}', b"{'id':1}",
             b'{"id":01}', b'{"id":"\xff"}', shutdown % nested):
    check(f"invalid JSON is an error: {body[:30]}", answer_to(body, None)["error"]["code"], -32700)
for id in (b"1.50", b'"a\\u00e4\\n\\"\xf0\x9f\x98\x80"', b"-9007199254740993", b'[{"a":[]},null]'):
    number = json.loads(id)
    check(f"an answer has the id of its request: {id}", answer_to(shutdown.replace(b"shutdown", b"nonsense") % id, number)["id"], number)
check("the last of two members counts", answer_to(b'{"id":1,"id":2,"method":"a"}', 2)["error"]["code"], -32601)
client.close(uri)
check("the server exits with 0 after shutdown", client.end(), 0)
client = Client(petri, utf8=True)
diagnostics = client.open(uri, "!n c='😀' d=nowhere\n")
check("positions are bytes for editors that support UTF-8", diagnostics[0]["range"]["start"]["character"], 14)
client.process.stdin.close()
check("the server exits with 1 if its input ends without a shutdown", client.process.wait(), 1)
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
