#!/bin/sh
# package.sh FOLDER BUILD [--source]: builds Debian packages (source and binary; with --source only source) in FOLDER from the
# archive that dist.sh makes with the build folder BUILD, and checks them with lintian. The debian/ folder is created there
# from src/packaging/debian.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
mkdir -p "$1"
folder=$(cd "$1" && pwd)
version=$(echo @VERSION@ | "$root/src/packaging/fill.sh" /dev/stdin)
source=$folder/petri-$version
rm -rf "$source" "$folder"/*petri*_"$version"* "$folder"/petri_"$version"*
cd "$root"
# All time stamps are the time of the last commit, so that builds of the same tree are identical.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
src/packaging/dist.sh "$2" "$folder"
mv "$folder/petri-$version.tar.xz" "$folder/petri_$version.orig.tar.xz"
rm -r "$folder/petri-$version.spdx.json" "$folder/SHA256SUMS" "$folder/petri.rb" "$folder/conda"
tar -xf "$folder/petri_$version.orig.tar.xz" -C "$folder"
cp -r src/packaging/debian "$source"
cd "$source/debian"
# Symbols files: the public functions, the names of versions, and all private functions, which only the libraries of the
# same version use.
for header in petri petri-draw petri-archive; do
    package=lib$header${version%.*}
    mv "lib$header.install" "$package.install"
    echo "lib$header.so.${version%.*} $package #MINVER#" >"$package.symbols"
    echo "* Build-Depends-Package: libpetri-dev" >>"$package.symbols"
    awk -v header=$header -v series="${version%.*}" '
        !/^#/ { of = $1 ~ /-(draw|archive)$/ ? $1 : "petri" }
        !/^#/ && of == header { print " " $2 "@PETRI_" series " " series }' "$root/tests/lint/abi.txt" >>"$package.symbols"
    printf ' (symver|optional)%s %s\n' "PETRI_${version%.*}" "${version%.*}" "PETRI_PRIVATE_$version" "$version" >>"$package.symbols"
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
if [ "${3:-}" = --source ]; then
    dpkg-buildpackage --no-sign --build=source --no-pre-clean --no-check-builddeps
else
    dpkg-buildpackage --no-sign
fi
lintian --fail-on error,warning "$folder/petri_$version-1"_*.changes
