"""The extension that cffi makes; pyproject.toml has the rest. The version is that of the library."""

import os
import subprocess

from setuptools import setup

version = os.environ.get("PETRI_VERSION") or subprocess.run(
    ["pkg-config", "--modversion", "petri-draw"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
# cffi's extensions are the same for all versions of Python.
setup(version=version, cffi_modules=["build_petri.py:ffi"], options={"bdist_wheel": {"py_limited_api": "cp39"}})
