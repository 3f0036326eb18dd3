#!/bin/sh
# wheel.sh SOURCE OUTPUT SCRATCH PYTHON: builds a wheel of the module in the new folder OUTPUT. The environment has the
# variables for build_petri.py and setup.py. Nothing is downloaded.
set -eu
rm -rf "$2" "$3"
mkdir -p "$3"
cp -r "$1/petri" "$1"/*.py "$1"/*.h "$1"/*.c "$3"
"$1/../packaging/fill.sh" "$1/pyproject.toml" >"$3/pyproject.toml"
# The wheel contains libpetri, and in it xxHash, whose licence is the first comment of its header.
cp "$1/../../LICENSE" "$3"
awk '/\*\// { exit } { sub(/^(\/\*| \*)/, ""); print }' "$(pkg-config --variable=includedir libxxhash)/xxhash.h" >"$3/LICENSE-xxHash"
"$4" -I -m build --wheel --no-isolation --outdir "$2" "$3" >"$3/wheel.log" 2>&1 || {
    cat "$3/wheel.log" >&2
    exit 1
}
