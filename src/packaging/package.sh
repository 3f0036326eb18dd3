#!/bin/sh
# package.sh FOLDER: builds Debian packages (source and binary) in FOLDER from the files that git tracks. The debian/
# folder is created there from src/packaging/debian.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
version=$(sed -n "s/^ *version: '\([0-9.]*\)',$/\1/p" "$root/meson.build")
source=$folder/petri-$version
rm -rf "$source" "$folder"/*petri*_"$version"* "$folder"/petri_"$version"*
mkdir "$source"
cd "$root"
# All time stamps are the time of the last commit, so that builds of the same tree are identical.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
git ls-files -z | tar -c --null --files-from=- | tar -x -C "$source"
tar -c -C "$folder" --sort=name --owner=0 --group=0 --mtime="@$SOURCE_DATE_EPOCH" "petri-$version" |
    xz -T0 >"$folder/petri_$version.orig.tar.xz"

cp -r src/packaging/debian "$source"
cd "$source/debian"
{
    echo "petri ($version-1) unstable; urgency=medium"
    echo
    echo "  * See CHANGELOG.md."
    echo
    echo " -- The petri authors <petri@localhost>  $(LC_ALL=C date -uRd "@$SOURCE_DATE_EPOCH")"
} >changelog
# The licence in the format of debian/copyright: a space before each line, and a dot in empty lines.
sed '1,/^Copyright/d' "$root/LICENSE" | sed '1d; s/^$/./; s/^/ /' >licence
sed -i -e "s/@OWNER@/$(sed -n 's/^Copyright (c) //p' "$root/LICENSE")/" -e '/@LICENCE@/{r licence' -e 'd}' copyright
rm licence
cd ..
dpkg-buildpackage --no-sign
