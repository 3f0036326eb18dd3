#!/bin/sh
# check_version.sh SOURCE_ROOT BUILD_ROOT: meson.build, the last release in the change log and the program have the same
# version.
set -eu
cd "$1"
version=$(sed -n "s/^ *version: '\([0-9.]*\)',$/\1/p" meson.build)
logged=$(sed -n 's/^## \([0-9]\)/\1/p' CHANGELOG.md | head -n 1)
printed=$("$2/src/petri" --version)
[ -n "$version" ] && [ "$logged" = "$version" ] && [ "$printed" = "petri $version" ] || {
    echo "meson.build: '$version', the last release in CHANGELOG.md: '$logged', petri --version: '$printed'"
    exit 1
}
