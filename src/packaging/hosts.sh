#!/bin/sh
# hosts.sh [FOLDER]: fills the templates in hosts/, which GitHub and Zenodo read only at these places, and writes them into
# FOLDER, by default the top folder of the checkout. Run it after a change of identity.ini or of the version.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
folder=${1:-$here/../..}
cd "$here/hosts"
find . -type f | while read -r file; do
    mkdir -p "$folder/$(dirname "$file")"
    "$here/fill.sh" "$file" >"$folder/$file"
done
