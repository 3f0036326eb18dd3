#!/bin/sh
# check_layouts.sh [--update] HEADERS REFERENCE LIBRARY: checks that a shared library has the structs, enums and functions of
# the last release, which REFERENCE describes. Further functions are allowed. Fields that were added at the end of structs
# do not break compiled programs either, but abidiff reports them; in this case, --update stores the layouts of LIBRARY as
# REFERENCE. LIBRARY must have been compiled with -g. HEADERS is the folder of its public headers.
set -eu
update=
if [ "$1" = --update ]; then
    update=1
    shift
fi
headers=$1 reference=$2 library=$3
rules=${0%/*}/layouts.ini
if ! command -v abidiff >/dev/null; then
    echo "skipped: no abidiff to compare layouts of structs (Debian: abigail-tools)"
    [ "${CI:-}" != true ] || exit 1
    exit 77
fi
if ! readelf -S "$library" | grep -q ' \.debug_info '; then
    echo "$library was not compiled with -g"
    exit 1
fi
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
abidw --headers-dir "$headers" --suppressions "$rules" --drop-private-types --drop-undefined-syms --exported-interfaces-only \
    --no-architecture --no-comp-dir-path --no-corpus-path --no-elf-needed --no-show-locs --no-write-default-sizes \
    --type-id-style hash --out-file "$scratch/found" "$library"
if [ -n "$update" ]; then
    cp "$scratch/found" "$reference"
elif ! abidiff --no-added-syms "$reference" "$scratch/found"; then
    echo "$library differs from the last release"
    exit 1
fi
