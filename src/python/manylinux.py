#!/usr/bin/env python3
"""manylinux.py WHEEL FOLDER: copies the wheel into FOLDER with the tag manylinux_2_N of the oldest glibc that has the
functions which it uses. Fails if the wheel needs libraries that not every Linux has. Prints the new path."""

import base64
import hashlib
import re
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

# Libraries that PEP 600 permits and that petri can need.
PERMITTED = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "ld-linux-x86-64.so.2",
             "ld-linux-aarch64.so.1"}


def inspect(module):
    """Returns the names of the libraries that a module needs, and the newest version of glibc, such as (2, 34)."""
    with tempfile.NamedTemporaryFile(suffix=".so") as file:
        file.write(module)
        file.flush()
        text = subprocess.run(["objdump", "-p", "-T", file.name], check=True, stdout=subprocess.PIPE, text=True).stdout
    versions = {tuple(map(int, version.split("."))) for version in re.findall(r"GLIBC_([0-9.]+)", text)}
    return set(re.findall(r"NEEDED +(\S+)", text)), max(versions)[:2]


wheel = Path(sys.argv[1])
with zipfile.ZipFile(wheel) as archive:
    files = {entry: archive.read(entry) for entry in archive.infolist()}
needed, newest = set(), (2, 17)
for entry, data in files.items():
    if entry.filename.endswith(".so"):
        libraries, version = inspect(data)
        needed |= libraries
        newest = max(newest, version)
if needed - PERMITTED:
    sys.exit(f"{wheel.name} needs libraries that not every Linux has: {', '.join(sorted(needed - PERMITTED))}")
name = re.sub(r"-linux_(\w+)\.whl$", rf"-manylinux_{newest[0]}_{newest[1]}_\1.whl", wheel.name)
result = Path(sys.argv[2]) / name
rows = []
with zipfile.ZipFile(result, "w", zipfile.ZIP_DEFLATED) as archive:
    for entry, data in files.items():
        if entry.filename.endswith(".dist-info/RECORD"):
            record = entry
            continue
        if entry.filename.endswith(".dist-info/WHEEL"):
            data = re.sub(rb"(?m)^(Tag: .*-)linux_", rb"\1manylinux_%d_%d_" % newest, data)
        archive.writestr(entry, data, zipfile.ZIP_DEFLATED)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        rows.append(f"{entry.filename},sha256={digest},{len(data)}\n")
    archive.writestr(record, "".join(rows) + f"{record.filename},,\n", zipfile.ZIP_DEFLATED)
print(result)
