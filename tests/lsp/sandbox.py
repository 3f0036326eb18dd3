"""sandbox.py: tests that `petri lsp` reads only files that a script may read, and that checks of heavy scripts do not block requests.
usage: sandbox.py PATH-OF-PETRI"""

import os
import resource
import subprocess
import sys
import tempfile
import time
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


for folder in ("project", "outside", "elsewhere"):
    Path(folder).mkdir()
Path("outside/secret.fl").write_text("let found=1\n")
Path("project/own.fl").write_text("let found=1\n")
Path("project/link.fl").symlink_to("../outside/secret.fl")
Path("project/zero.fl").symlink_to("/dev/zero")
os.mkfifo("project/pipe.fl")
with open("project/large.fl", "wb") as sparse:
    sparse.truncate(1 << 40)
os.chdir("elsewhere")
# An unlimited read would exceed this address space quickly, so that the server would exit. The address sanitizer reserves
# terabytes; with it, only the assertions notice such a read.
limit = (4 << 30, 4 << 30)
if not subprocess.run([petri, "--version"], capture_output=True,
                      preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, limit)).returncode:
    resource.setrlimit(resource.RLIMIT_AS, limit)
project = Path("../project").resolve()
uri = (project / "main.fl").as_uri()


def definition(client, file, statement="import found from '%s'\n!n a=found\n"):
    """Returns the name of the file in which the server finds the definition of `found`, used in line 1, or None."""
    text = statement % file
    if uri not in client.versions:
        client.open(uri, text)
    else:
        client.change(uri, {"text": text})
    found = client.at("definition", uri, 1, 6)
    client.at("hover", uri, 1, 6)
    client.at("references", uri, 1, 6, context={"includeDeclaration": True})
    return found and found["uri"].split("/")[-1]


client = Client(petri, root=project.as_uri())
check("a file beside the script is read", definition(client, "own.fl"), "own.fl")
for name, file in [("a file outside the folders", "../outside/secret.fl"), ("a link that leads outside", "link.fl"),
                   ("a device", "/dev/zero"), ("a link to a device", "zero.fl"), ("a pipe", "pipe.fl"),
                   ("a file that is too large", "large.fl")]:
    check(f"{name} is not read", definition(client, file), "main.fl")
    check(f"{name} is not included", definition(client, file, "%%include '%s'\n!n a=found\n"), None)
link = client.at("definition", uri, 0, 12)
check("the path of a file that may not be read leads nowhere", link, None)
client.end()

client = Client(petri, options=["--allow-read", "../outside"])
check("--allow-read allows a folder", definition(client, "../outside/secret.fl"), "secret.fl")
check("--allow-read allows a link into the folder", definition(client, "link.fl"), "secret.fl")
client.end()

client = Client(petri, options=["--no-files"], root=project.as_uri())
check("--no-files allows no file", definition(client, "own.fl"), "main.fl")
client.end()

# Without the interrupt, the diagnostics would come before the answer.
client = Client(petri)
heavy = (project / "heavy.fl").as_uri()
client.notify("textDocument/didOpen", {"textDocument": {
    "uri": heavy, "languageId": "flitter", "version": 1, "text": "!n a=sum(i for i in ..20000000)\n!n b=sin(1)\n"}})
time.sleep(1)  # the full check begins
check("a request is answered while a heavy script is checked", "sin(x)" in str(client.at("hover", heavy, 1, 6)))
check("the request interrupts the check", heavy in client.published, False)
while heavy not in client.published:
    client.read()
check("the check starts again after the answer", client.published[heavy]["version"], 1)
client.end()
print(f"{passed} passed, {failed} failed")
sys.exit(failed > 0)
