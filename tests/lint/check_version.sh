#!/bin/sh
# check_version.sh SOURCE_ROOT BUILD_ROOT: meson.build, the last release in the change log and the program have the same
# version, and no other file contains it. Packages get it from src/packaging/fill.sh.
set -eu
cd "$1"
version=$(echo @VERSION@ | src/packaging/fill.sh /dev/stdin)
logged=$(sed -n 's/^## \([0-9]\)/\1/p' CHANGELOG.md | head -n 1)
printed=$("$2/src/petri" --version)
[ -n "$version" ] && [ "$logged" = "$version" ] && [ "$printed" = "petri $version" ] || {
    echo "meson.build: '$version', the last release in CHANGELOG.md: '$logged', petri --version: '$printed'"
    exit 1
}
others=$(git grep -lwF "$version" -- . ':!meson.build' ':!CHANGELOG.md' ':!*package-lock.json' ':!lib/include/petri.h' ':!CITATION.cff' ':!.zenodo.json' 2>/dev/null | xargs) || true
[ -z "$others" ] || {
    echo "these files repeat the version $version of meson.build; write @VERSION@: $others"
    exit 1
}
