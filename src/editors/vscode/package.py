#!/usr/bin/env python3
"""package.py GRAMMAR ENGINE OUT.vsix: packs the extension with the generated grammar and the files of ENGINE, the npm package that
./dev web makes, by vsce. `npm run bundle` must run first. The output is reproducible."""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

# The command in WebAssembly and the engine of the preview.
ENGINE = ("cli.mjs", "command.mjs", "links.mjs", "paths.mjs", "runtime.mjs", "system.mjs", "threads.mjs", "engine.wasm",
          "petri-command.wasm", "third-party-licences.txt")
here = Path(__file__).resolve().parent
root = here.parents[2]


def fill(path):
    return subprocess.run([root / "src/packaging/fill.sh", path], check=True, stdout=subprocess.PIPE, text=True).stdout


def changes():
    """Returns the changes of petri that concern editors, below the headings of their versions."""
    text = "# Changelog\n"
    for version in re.split(r"(?m)^(?=## )", (root / "CHANGELOG.md").read_text())[1:]:
        items = re.findall(r"(?m)^- (?:\w+, )*(?:editors|lsp|fmt|check)\b.*\n(?:  .*\n)*", version)
        text += "\n" + version.splitlines()[0] + "\n\n" + ("".join(items) or "- no changes for editors\n")
    return re.sub(r"\]\((?!https?:|#)", "](../../../", text)  # links from the extension's folder


about = json.loads((here / "package.json").read_text()) | json.loads(fill(here / "identity.json"))
for only_for_building in ("dependencies", "devDependencies", "scripts", "private"):
    about.pop(only_for_building)
with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    (folder / "dist").mkdir()
    (folder / "engine").mkdir()
    (folder / "package.json").write_text(json.dumps(about, indent=2))
    shutil.copy(sys.argv[1], folder / "flitter.tmLanguage.json")
    for path in ("README.md", "language-configuration.json", "snippets.json", "dist/extension.js", "dist/preview.js",
                 "dist/style.css", "dist/worker.js"):
        shutil.copy(here / path, folder / path)
    shutil.copy(here / "dist/third-party-licences.txt", folder)
    for path in ENGINE:
        shutil.copy(Path(sys.argv[2]) / path, folder / "engine" / path)
    (folder / "CHANGELOG.md").write_text(changes())
    for path in ("LICENSE", "src/packaging/icon.png", "samples/dish.fl", "samples/pictures/dish.png"):
        shutil.copy(root / path, folder)
    # The marketplace needs complete addresses: of the files as such for pictures, and of pages for links.
    address = about["repository"]["url"].removesuffix(".git") + "/{}/v" + about["version"] + "/src/editors/vscode"
    vsce = subprocess.run([here / "node_modules/.bin/vsce", "package", "--no-dependencies", "--no-update-package-json",
                           "--baseContentUrl", address.format("blob"), "--baseImagesUrl", address.format("raw"),
                           "--out", folder / "packed.vsix"],
                          cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if vsce.returncode != 0:
        sys.exit(vsce.stdout)
    # vsce writes the current time.
    with zipfile.ZipFile(folder / "packed.vsix") as packed, zipfile.ZipFile(sys.argv[3], "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(packed.namelist()):
            archive.writestr(zipfile.ZipInfo(path, (2026, 1, 1, 0, 0, 0)), packed.read(path), zipfile.ZIP_DEFLATED)
