#!/bin/sh
# release.sh: tests of src/packaging/release.sh in a small project, whose `dev` and `npm` create empty files instead of
# packages.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
command -v xz >/dev/null || {
    echo "skipped: no xz to pack the page of a release (Debian: xz-utils)"
    exit 77
}
scratch
project="$work/a project"
dist=$project/build/dist
mkdir -p "$project/src/packaging" "$project/.ci" "$work/bin" "$work/without"
cp "$root/src/packaging/release.sh" "$root/src/packaging/fill.sh" "$root/src/packaging/identity.ini" "$project/src/packaging"
cp "$root/.ci/progress.sh" "$project/.ci"
echo "  version: '1.2.3'," >"$project/meson.build"
cat >"$project/CHANGELOG.md" <<'END'
# Changelog

## 1.2.3

- new: [a page](src/manual/page.md) and [another](https://elsewhere.example/page.md#part), [below](#b); [x](a.md), [y](b.md)

### Fixed

- old: nothing

## 1.2.30

- of another version
END
cat >"$project/dev" <<'END'
#!/bin/sh
# Makes the files of each part, except those that FAILS and OMITS name.
part=${2:-$1}
mkdir -p build/package
case " $FAILS " in *" $part "*) exit 1 ;; esac
case " $OMITS " in *" $part "*) exit 0 ;; esac
cd build/package
case $part in
package) touch petri_1.2.3-1_amd64.deb petri-dbgsym_1.2.3-1_amd64.deb libpetri1.2_1.2.3-1_amd64.deb petri_1.2.3-1.dsc petri_1.2.3.orig.tar.xz petri_1.2.3-1.debian.tar.xz ;;
--sdist) touch petri-1.2.3.tar.gz ;;
--wheel) touch petri-1.2.3-cp311-cp311-linux_x86_64.whl ;;
--manylinux) touch petri-1.2.3-cp311-cp311-manylinux_2_34_x86_64.whl ;;
--static) touch petri-1.2.3-x86_64-static ;;
--vscode) touch petri.vsix ;;
web) mkdir -p ../web/petri && echo page >../web/index.html && touch ../web/petri/engine.wasm ../web/tests.log ;;
esac
END
printf '#!/bin/sh\ntouch author-petri-1.2.3.tgz\n' >"$work/bin/npm"
chmod +x "$project/dev" "$work/bin/npm"
(cd "$project" && git init -q && git -c user.name=x -c user.email=x@x.example commit -q --allow-empty -m x)
for tool in sh env awk sed cat tar xz gzip git dirname rm cp sha256sum touch mkdir cut stty; do
    ln -s "$(command -v $tool)" "$work/without/$tool"
done

# release [FAILS [OMITS]]: makes a release from a source archive. `folders` is PATH.
folders=$work/bin:$PATH
release() {
    rm -rf "$dist"
    mkdir -p "$dist/conda"
    touch "$dist/petri-1.2.3.tar.xz" "$dist/petri-1.2.3.spdx.json" "$dist/petri.rb" "$dist/conda/meta.yaml" "$dist/SHA256SUMS"
    FAILS=${1:-} OMITS=${2:-} PATH=$folders "$project/src/packaging/release.sh" "$dist" >out 2>err </dev/null
    status=$?
    (cd "$dist" && ls) >files
}
listed() { (cd "$dist" && sha256sum --check --quiet SHA256SUMS && [ "$(ls | wc -l)" -eq $(($(wc -l <SHA256SUMS) + 1)) ]); }

release
check "a complete release succeeds" status_is 0
check "it has all files" [ "$(wc -l <files)" -eq 18 ]
check "debugging symbols are not in a release" [ "$(grep -c dbgsym files)" -eq 0 ]
check "checksums are those of all files" listed
check "there are no folders" [ "$(find "$dist" -mindepth 1 -type d | wc -l)" -eq 0 ]
check "the page contains neither the npm package nor a log" \
    [ "$(tar -tf "$dist/petri-1.2.3-page.tar.xz" | grep -v '/$')" = ./index.html ]
check "the recipe of conda is packed" [ "$(tar -tf "$dist/petri-1.2.3-conda.tar.gz" | grep -v '/$')" = conda/meta.yaml ]
repository=$(sed -n 's/^repository = //p' "$root/src/packaging/identity.ini")
cat >notes <<END
- new: [a page]($repository/blob/v1.2.3/src/manual/page.md) and [another](https://elsewhere.example/page.md#part), [below](#b); [x]($repository/blob/v1.2.3/a.md), [y]($repository/blob/v1.2.3/b.md)

### Fixed

- old: nothing

END
check "the notes are the changes of this version, with complete links" cmp -s notes "$dist/petri-1.2.3.md"
cp files complete

# Whatever fails is named, is not taken from an earlier release, and does not prevent the other parts.
while IFS='|' read -r part what count; do
    for way in fails omits; do
        if [ $way = fails ]; then release "$part"; else release '' "$part"; fi
        check "$part $way: the release fails" status_is 1
        check "$part $way: the part is named" has err "  $what: "
        check "$part $way: only this part is named" [ "$(grep '^  ' err | cut -d: -f1 | sort -u | wc -l)" -eq 1 ]
        check "$part $way: the other files are there" [ $(($(wc -l <complete) - $(wc -l <files))) -eq "$count" ]
        check "$part $way: checksums are those of all files" listed
    done
done <<'END'
package|Debian packages|5
--sdist|the source distribution of the Python module|1
--wheel|the wheel for this machine|1
--manylinux|the wheel for Linux|1
--static|the static program|1
--vscode|the extension for VS Code|1
END
release web
check "the page is named" has err "  the page and the npm package: failed"
release '--wheel web --static'
check "several parts are named" [ "$(grep -c '^  ' err)" -eq 3 ]
check "the other parts are there" [ "$(wc -l <files)" -eq 14 ]

folders=$work/without
release
check "without npm, the page is named" has err "  the page and the npm package: failed"
check "the reason is named" has err "npm is not installed"
check "an older page is not in the release" [ "$(grep -c -e page -e tgz files)" -eq 0 ]
folders=$work/bin:$PATH

sed -i 's/## 1.2.3$/## 1.2.4/' "$project/CHANGELOG.md"
rm -rf "$project/build/package"
release
check "a version without changes is an error" has err "CHANGELOG.md has no changes of version 1.2.3"
check "no part is made before this error" [ ! -e "$project/build/package" ]
finish
