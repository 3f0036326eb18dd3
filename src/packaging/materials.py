#!/usr/bin/env python3
"""materials.py ARCHIVE: prints the bill of materials of a release as JSON in the format SPDX 2.3: petri's source archive,
what its packages contain of other projects, and the libraries to which its programs can be linked."""

import datetime
import hashlib
import json
import os
import re
import subprocess
import sys
from pathlib import Path

root = Path(__file__).resolve().parents[2]
# Development dependencies of these folders that are bundled; the others are tools and their dependencies.
BUNDLED = {
    "src/web/page": r"@codemirror/|@lezer/",
    "src/editors/vscode": r"vscode-languageclient$",
}
# Libraries of which machine code is in petri's programs or in engine.wasm.
LINKED = [
    ("xxHash", "BSD-2-Clause", "the header, in all programs"),
    ("musl", "MIT", "in engine.wasm, from Emscripten, and in the static program"),
    ("SQLite", "blessing", "in engine-archives.wasm and petri-pictures.wasm"),
]


def fill(text):
    return subprocess.run([root / "src/packaging/fill.sh", "/dev/stdin"], input=text, stdout=subprocess.PIPE, check=True,
                          text=True).stdout


def package(name, version, place, licence, comment):
    identifier = "SPDXRef-" + re.sub(r"[^A-Za-z0-9.-]+", "-", f"{name}-{version}" if version else name).strip("-")
    result = {"SPDXID": identifier, "name": name, "downloadLocation": place, "filesAnalyzed": False,
              "licenseConcluded": "NOASSERTION", "licenseDeclared": licence, "copyrightText": "NOASSERTION", "comment": comment}
    if version:
        result["versionInfo"] = version
    return result


def bundled_modules(folder, roots):
    """Yields the npm packages whose names match the pattern `roots`, and those on which they depend."""
    lock = json.loads((root / folder / "package-lock.json").read_text())["packages"]
    declared = {**lock[""].get("dependencies", {}), **lock[""].get("devDependencies", {})}
    paths = {"node_modules/" + name for name in declared if re.match(roots, name)}
    done = set()
    while paths - done:
        path = min(paths - done)
        done.add(path)
        entry = lock[path]
        name = path.split("node_modules/")[-1]
        for dependency in entry.get("dependencies", {}):
            folders = [path]  # a package is looked up in the folders of those that depend on it, the nearest first
            while "/node_modules/" in folders[-1]:
                folders.append(folders[-1].rpartition("/node_modules/")[0])
            paths.add(next(found for found in [f"{folder}/node_modules/{dependency}" for folder in folders] +
                           [f"node_modules/{dependency}"] if found in lock))
        module = package(name, entry["version"], "NOASSERTION", entry.get("license", "NOASSERTION"), f"bundled by {folder}")
        module["externalRefs"] = [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                                   "referenceLocator": f"pkg:npm/{name.replace('@', '%40')}@{entry['version']}"}]
        yield module


def optional_libraries():
    """Yields the rows of the table of libraries in meson.build."""
    table = (root / "meson.build").read_text()
    for option, name, debian in re.findall(r"^  '\w+': \['(\w+)', '([\w.-]+)', \[.*?\], .*, '([\w. -]+)'\],$", table, re.M):
        library = package(name, "", "NOASSERTION", "NOASSERTION", f"linked if the option {option} of meson is enabled")
        library["externalRefs"] = [{"referenceCategory": "PACKAGE-MANAGER", "referenceType": "purl",
                                    "referenceLocator": f"pkg:deb/debian/{debian.split()[0]}"}]
        yield library


archive = Path(sys.argv[1])
checksum = hashlib.sha256(archive.read_bytes()).hexdigest()
version, authors, homepage, place = fill(f"@VERSION@\n@AUTHORS@\n@HOMEPAGE@\n@RELEASES@/v@VERSION@/{archive.name}").splitlines()
date = datetime.datetime.fromtimestamp(int(os.environ["SOURCE_DATE_EPOCH"]), datetime.timezone.utc)
petri = package("petri", version, place, "MIT", "the source archive")
petri["copyrightText"] = re.search(r"^Copyright .*", (root / "LICENSE").read_text(), re.M)[0]
petri |= {"packageFileName": archive.name, "checksums": [{"algorithm": "SHA256", "checksumValue": checksum}],
          "supplier": f"Organization: {authors}", "homepage": homepage}
contained = {part["SPDXID"]: part for folder, roots in BUNDLED.items() for part in bundled_modules(folder, roots)}
contained |= {part["SPDXID"]: part for part in (package(name, "", "NOASSERTION", licence, comment)
                                                for name, licence, comment in LINKED)}
optional = {part["SPDXID"]: part for part in optional_libraries()}


def related(first, kind, second):
    return {"spdxElementId": first, "relationshipType": kind, "relatedSpdxElement": second}


document = {
    "spdxVersion": "SPDX-2.3",
    "dataLicense": "CC0-1.0",
    "SPDXID": "SPDXRef-DOCUMENT",
    "name": f"petri-{version}",
    "documentNamespace": f"{homepage}/spdx/petri-{version}-{checksum}",
    "creationInfo": {"created": date.strftime("%Y-%m-%dT%H:%M:%SZ"), "creators": [f"Organization: {authors}", "Tool: materials.py"]},
    "packages": [petri, *contained.values(), *optional.values()],
    "relationships": [related("SPDXRef-DOCUMENT", "DESCRIBES", petri["SPDXID"])]
    + [related(petri["SPDXID"], "CONTAINS", part) for part in contained]
    + [related(part, "OPTIONAL_DEPENDENCY_OF", petri["SPDXID"]) for part in optional],
}
json.dump(document, sys.stdout, indent=1)
print()
