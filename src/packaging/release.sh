#!/bin/sh
# release.sh FOLDER: adds to FOLDER, in which dist.sh has made the source archive, all other files of a release. A part that
# cannot be made on this machine is named at the end, with status 1. FOLDER.log has messages of the parts.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(cd "$1" && pwd)
cd "$root"
# shellcheck source=.ci/progress.sh
. .ci/progress.sh
version=$(echo @VERSION@ | src/packaging/fill.sh /dev/stdin)
repository=$(echo @REPOSITORY@ | src/packaging/fill.sh /dev/stdin)
missing=

# part NAME 'PATTERN...' COMMAND...: runs the command and moves the files that it makes into the folder.
part() {
    name=$1
    patterns=$2
    shift 2
    say "making $name"
    # Files of earlier versions must not be in the release.
    # shellcheck disable=SC2086 # patterns
    rm -f $patterns
    if "$@"; then
        # shellcheck disable=SC2086 # patterns
        for file in $patterns; do
            [ -f "$file" ] || {
                missing="$missing
  $name: the command made no $file"
                continue
            }
            cp "$file" "$folder"
        done
    else
        missing="$missing
  $name: failed: $*"
    fi
}

has_npm() {
    command -v npm >/dev/null || {
        say "npm is not installed"
        return 1
    }
}

# Makes the page and the npm package. Without npm, ./dev web would make neither, but succeed.
web() {
    has_npm && ./dev web && (cd build && npm pack --silent ./web/petri) && tar -c -C build/web --exclude=./petri --exclude=./tests.log \
        --sort=name --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX --mtime="@$(git log -1 --format=%ct)" . | xz -6 >"$1"
}

# Prints the changes of this version, with links that work outside the repository.
notes() {
    awk -v version="$version" -v base="$repository/blob/v$version/" '
        /^## / { inside = $2 == version; next }
        inside && (NF || found) {
            found = 1
            text = $0
            line = ""
            while (match(text, /\]\([^)]*\)/)) {
                target = substr(text, RSTART + 2, RLENGTH - 3)
                line = line substr(text, 1, RSTART - 1) "](" (target ~ /^(https?:|#)/ ? "" : base) target ")"
                text = substr(text, RSTART + RLENGTH)
            }
            print line text
        }
        END { exit !found }' CHANGELOG.md
}

notes >"$folder/petri-$version.md" || die "CHANGELOG.md has no changes of version $version"
part "the source distribution of the Python module" "build/package/petri-$version.tar.gz" ./dev package --sdist
part "Debian packages" "build/package/*_$version-*.deb build/package/petri_$version*.dsc build/package/petri_$version*.tar.xz" ./dev package
rm -f "$folder"/*-dbgsym_*.deb # a third of all bytes, and for debuggers only; ./dev package makes them
part "the wheel for this machine" "build/package/petri-$version-*-linux_*.whl" ./dev package --wheel
part "the wheel for Linux" "build/package/petri-$version-*manylinux*.whl" ./dev package --manylinux
part "the static program" "build/package/petri-$version-*-static" ./dev package --static
part "the extension for VS Code" build/package/petri.vsix ./dev package --vscode
part "the page and the npm package" "build/petri-$version-page.tar.xz build/*petri-$version.tgz" web "build/petri-$version-page.tar.xz"

# Hosts take files, but no folders.
tar -c -C "$folder" --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$(git log -1 --format=%ct)" conda |
    gzip -9n >"$folder/petri-$version-conda.tar.gz"
rm -r "$folder/conda"
(cd "$folder" && rm -f SHA256SUMS && sha256sum -- * >SHA256SUMS)
say "the files of release $version are in $folder"
[ -z "$missing" ] || die "the release is incomplete; these parts are missing:$missing"
