#!/bin/sh
# package.sh FOLDER: builds Debian packages (source and binary) in FOLDER from the files that git tracks. The debian/
# folder is created there from src/packaging/debian.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
version=$(echo @VERSION@ | "$root/src/packaging/fill.sh" /dev/stdin)
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
for library in libpetri libpetri-draw libpetri-archive; do
    mv $library.install "$library${version%.*}.install"
done
# The licence in the format of debian/copyright: a space before each line, and a dot in empty lines.
sed '1,/^Copyright/d' "$root/LICENSE" | sed '1d; s/^$/./; s/^/ /' >licence
for file in changelog control copyright; do
    "$root/src/packaging/fill.sh" "$root/src/packaging/debian/$file" \
        "YEAR=$(sed -n 's/^Copyright (c) \([0-9-]*\) .*/\1/p' "$root/LICENSE")" \
        "DATE=$(LC_ALL=C date -uRd "@$SOURCE_DATE_EPOCH")" >$file
done
sed -i -e '/^LICENCE$/{r licence' -e 'd}' copyright
rm licence
cd ..
dpkg-buildpackage --no-sign
