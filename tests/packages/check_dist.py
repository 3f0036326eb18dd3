#!/usr/bin/python3
"""check_dist.py FOLDER: checks the files that `./dev dist` has made in FOLDER: the required fields of the bill of materials
(SPDX 2.3), of CITATION.cff (1.2.0) and of .zenodo.json, the forms for issues, the recipes of Homebrew and conda, and the
Dockerfile."""

import hashlib
import json
import re
import subprocess
import sys
import tarfile
from pathlib import Path

import yaml

folder = Path(sys.argv[1])
archive, = folder.glob("petri-*.tar.xz")
name = archive.name.removesuffix(".tar.xz")
version = name.removeprefix("petri-")
place = f"/releases/download/v{version}/{archive.name}"  # of a file of the release with the tag v1.2.3, on GitHub
checksum = hashlib.sha256(archive.read_bytes()).hexdigest()
faults = []


def check(claim, holds):
    if not holds:
        faults.append(claim)


def check_materials(document):
    check("version of SPDX", document["spdxVersion"] == "SPDX-2.3")
    check("licence of SPDX documents", document["dataLicense"] == "CC0-1.0")
    check("identifier of the document", document["SPDXID"] == "SPDXRef-DOCUMENT")
    check("namespace", re.fullmatch(r"https?://[^#]+", document["documentNamespace"]))
    created = document["creationInfo"]
    check("time", re.fullmatch(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ", created["created"]))
    check("creators", created["creators"] and all(re.match(r"(Tool|Person|Organization): .", one) for one in created["creators"]))
    identifiers = [part["SPDXID"] for part in document["packages"]]
    check("unique identifiers", len(set(identifiers)) == len(identifiers))
    for part in document["packages"]:
        check(f"identifier {part['SPDXID']}", re.fullmatch(r"SPDXRef-[A-Za-z0-9.-]+", part["SPDXID"]))
        check(f"fields of {part['SPDXID']}", part["name"] and part["downloadLocation"] and part["filesAnalyzed"] is False)
        for reference in part.get("externalRefs", []):
            check(f"reference of {part['SPDXID']}", set(reference) == {"referenceCategory", "referenceType", "referenceLocator"}
                  and reference["referenceLocator"].startswith("pkg:"))
    known = {"SPDXRef-DOCUMENT", *identifiers}
    kinds = {"DESCRIBES": 0, "CONTAINS": 0, "OPTIONAL_DEPENDENCY_OF": 0}
    for relation in document["relationships"]:
        kinds[relation["relationshipType"]] += 1
        check(f"relation {relation}", {relation["spdxElementId"], relation["relatedSpdxElement"]} <= known)
    check("one described package", kinds["DESCRIBES"] == 1)
    check("relations of all packages", kinds["CONTAINS"] + kinds["OPTIONAL_DEPENDENCY_OF"] == len(identifiers) - 1)
    described = next(part for part in document["packages"] if part["name"] == "petri")
    check("the version in the bill of materials", described["versionInfo"] == version)
    check("the place in the bill of materials", described["downloadLocation"].endswith(place))
    check("checksum of the archive", described["checksums"] == [{"algorithm": "SHA256", "checksumValue": checksum}])
    names = {part["name"] for part in document["packages"]}
    check("bundled and linked software", {"xxHash", "SQLite", "@codemirror/view", "vscode-languageclient", "cairo", "sqlite3"} <= names)
    check("no tools", not names & {"esbuild", "typescript", "playwright-core"})


def check_citation(citation):
    check("required fields of CITATION.cff", {"cff-version", "message", "title", "authors"} <= set(citation))
    check("version of CITATION.cff", citation["cff-version"] == "1.2.0" and citation["version"] == version)
    check("type of CITATION.cff", citation["type"] == "software")
    check("authors of CITATION.cff", all(author.get("name") or author.get("family-names") for author in citation["authors"]))
    permitted = {"cff-version", "message", "title", "type", "authors", "version", "license", "url", "repository-code", "keywords"}
    check("fields of CITATION.cff", set(citation) <= permitted)


def check_zenodo(record):
    check("type for Zenodo", record["upload_type"] == "software" and record["access_right"] == "open")
    check("version for Zenodo", record["version"] == version)
    check("creators for Zenodo", record["creators"] and all(creator["name"] for creator in record["creators"]))
    check("texts for Zenodo", record["title"] and record["description"] and record["license"])
    for related in record["related_identifiers"]:
        check("related work for Zenodo", set(related) == {"identifier", "relation", "scheme"})


def check_form(path, text):
    """Checks a form against GitHub's syntax; GitHub ignores a form with an error."""
    form = yaml.safe_load(text)
    check(f"keys of {path}", {"name", "description", "body"} <= set(form) <= {"name", "description", "labels", "body"})
    fields = {"markdown": {"value"}, "input": {"label", "description", "placeholder", "value"},
              "textarea": {"label", "description", "placeholder", "value", "render"}}
    for part in form["body"]:
        check(f"keys of a part of {path}", {"type", "attributes"} <= set(part) <= {"type", "id", "attributes", "validations"})
        check(f"attributes of {part['type']} in {path}", set(part["attributes"]) <= fields.get(part["type"], set()))
        check(f"text of {part['type']} in {path}",
              part["attributes"].get("value" if part["type"] == "markdown" else "label"))
        check(f"validations in {path}", set(part.get("validations", {})) <= {"required"})
    inputs = [part["id"] for part in form["body"] if part["type"] != "markdown"]
    check(f"identifiers of {path}", inputs and len(set(inputs)) == len(inputs))


def check_conda(text):
    recipe = yaml.safe_load(text)
    check("source of the recipe", recipe["source"]["url"].endswith(place) and recipe["source"]["sha256"] == checksum)
    check("outputs of the recipe", [output["name"] for output in recipe["outputs"]] ==
          ["libpetri", "petri", "petri-mpi", "petri-python"])
    owners = {}
    for output in recipe["outputs"]:
        check(f"script of {output['name']}", (folder / "conda" / output["script"]).is_file())
        check(f"test of {output['name']}", output["test"])
        for path in output.get("files", []):
            check(f"{path} is in one output", owners.setdefault(path, output["name"]) == output["name"])
    check("braces of the recipe", text.count("{{") == text.count("}}"))


def check_formula(text):
    check("source of the formula", f'{place}"' in text and f'sha256 "{checksum}"' in text)
    check("test of the formula", "  test do" in text)
    try:
        check("syntax of the formula", subprocess.run(["ruby", "-c"], input=text, text=True, capture_output=True).returncode == 0)
    except FileNotFoundError:
        print("skipped: the syntax of the formula; ruby is not installed")


def check_dockerfile(text):
    lines = [line for line in text.replace("\\\n", "").splitlines() if line and not line.startswith("#")]
    words = [line.split() for line in lines]
    check("instructions of the Dockerfile", {word[0] for word in words} <= {
        "ARG", "FROM", "RUN", "COPY", "WORKDIR", "USER", "ENTRYPOINT", "CMD"})
    stages = {word[3] for word in words if word[0] == "FROM" and len(word) == 4}
    used = set(re.findall(r"--from=(\w+)", text))
    check("stages of the Dockerfile", used and used <= stages)
    check("the image runs petri", json.loads(lines[-2].removeprefix("ENTRYPOINT ")) == ["/petri"])


with tarfile.open(archive) as files:
    def read(path):
        return files.extractfile(f"{name}/{path}").read().decode()

    check("generated sources", all(read(f"grammar/generated/{file}") for file in ("parser.c", "parser.h", "lexer.c")))
    check("one folder in the archive", all(member.name.split("/")[0] == name for member in files))
    check("owners in the archive", all(member.uid == member.gid == 0 for member in files))
    filled = {path: read(path) for path in ("CITATION.cff", ".zenodo.json", ".github/SECURITY.md", ".github/CODE_OF_CONDUCT.md",
              *(f".github/ISSUE_TEMPLATE/{form}.yml" for form in ("bug", "wish", "config")))}
    check_dockerfile(read("src/packaging/Dockerfile"))
for path in [f"{name}.spdx.json", "petri.rb", "conda/meta.yaml"]:
    filled[path] = (folder / path).read_text()
for path, text in filled.items():
    check(f"{path} is filled", not re.search(r"@[A-Z][A-Z0-9_]+@", text))
check_materials(json.loads(filled[f"{name}.spdx.json"]))
check_citation(yaml.safe_load(filled["CITATION.cff"]))
check_zenodo(json.loads(filled[".zenodo.json"]))
for path in (".github/ISSUE_TEMPLATE/bug.yml", ".github/ISSUE_TEMPLATE/wish.yml"):
    check_form(path, filled[path])
check("choices of issues", set(yaml.safe_load(filled[".github/ISSUE_TEMPLATE/config.yml"])) == {
    "blank_issues_enabled", "contact_links"})
check_conda(filled["conda/meta.yaml"])
check_formula(filled["petri.rb"])
for fault in faults:
    print(f"wrong: {fault}")
print(f"check_dist: {len(faults)} faults")
sys.exit(bool(faults))
