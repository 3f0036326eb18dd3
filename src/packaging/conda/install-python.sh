#!/bin/sh
# install-python.sh: builds and installs the Python module, which uses the installed libpetri.
set -eu
src/packaging/fill.sh src/python/pyproject.toml >pyproject.filled
mv pyproject.filled src/python/pyproject.toml
PKG_CONFIG_PATH=$PREFIX/lib/pkgconfig "$PYTHON" -m pip install --no-deps --no-build-isolation src/python
