"""Builds the cffi extension; pyproject.toml has the metadata. The version is that of the library."""

import os
import subprocess

from setuptools import setup

version = os.environ.get("PETRI_VERSION") or subprocess.run(
    ["pkg-config", "--modversion", "petri-draw"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
# cffi extensions use the stable ABI, so one wheel works for all versions of Python.
setup(version=version, cffi_modules=["build_petri.py:ffi"], options={"bdist_wheel": {"py_limited_api": "cp39"}})
