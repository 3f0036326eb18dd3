#!/bin/sh
# dist.sh BUILD FOLDER: makes a source archive in FOLDER from the files that git tracks and from the scanner and parser that
# the folder BUILD contains. Also makes its bill of materials, the recipes of Homebrew and conda, which contain its
# checksum, and the checksums of all. Archives of the same commit are identical. Prints the archive's path.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
build=$(cd "$1" && pwd)
mkdir -p "$2"
folder=$(cd "$2" && pwd)
cd "$root"
version=$(echo @VERSION@ | src/packaging/fill.sh /dev/stdin)
name=petri-$version
# All time stamps are the time of the last commit.
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
rm -rf "${folder:?}/$name" "$folder/$name.tar.xz" "$folder/$name.spdx.json" "$folder/SHA256SUMS"
mkdir "$folder/$name"
git ls-files -z | tar -c --null --files-from=- | tar -x -C "$folder/$name"
mkdir "$folder/$name/grammar/generated"
for file in parser.c parser.h lexer.c; do
    cp "$build/grammar/$file" "$folder/$name/grammar/generated"
done
src/packaging/hosts.sh "$folder/$name"
tar -c -C "$folder" --sort=name --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX --mtime="@$SOURCE_DATE_EPOCH" "$name" |
    xz -6 -T2 >"$folder/$name.tar.xz"
rm -r "${folder:?}/$name"
python3 src/packaging/materials.py "$folder/$name.tar.xz" >"$folder/$name.spdx.json"
sum=$(sha256sum "$folder/$name.tar.xz" | cut -d ' ' -f 1)
rm -rf "$folder/conda"
cp -r src/packaging/conda "$folder"
src/packaging/fill.sh src/packaging/conda/meta.yaml "SHA256=$sum" >"$folder/conda/meta.yaml"
src/packaging/fill.sh src/packaging/homebrew/petri.rb "SHA256=$sum" >"$folder/petri.rb"
(cd "$folder" && sha256sum "$name.tar.xz" "$name.spdx.json" petri.rb conda/* >SHA256SUMS)
echo "$folder/$name.tar.xz"
