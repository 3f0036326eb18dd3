# shellcheck shell=bash
# sqlite.sh: compiles SQLite for systems for which Debian has no package: WebAssembly, musl and AArch64. The source is that in
# an npm package.
SQLITE_SOURCE=better-sqlite3@12.11.1
SQLITE_SHA256=60d2f39a3726cd6b9021da6f4e868608d66fbb6528a9f513dc8ffcc640493422

# sqlite FOLDER COMPILER AR: compiles SQLite in the folder, with a file for pkg-config, and a cross file with which meson finds
# only this library. Returns 1 if npm cannot fetch the source. Other problems end the program, also where `set -e` does not.
sqlite() {
    local to
    [ ! -f "$1/sqlite3.pc" ] || return 0
    rm -rf "$1"
    mkdir -p "$1"
    to=$(cd "$1" && pwd)
    command -v npm >/dev/null || return 1
    (cd "$to" && npm pack --loglevel=error "$SQLITE_SOURCE" >pack.log 2>&1 &&
        tar -xzf better-sqlite3-*.tgz --strip-components=3 package/deps/sqlite3) || return 1
    echo "$SQLITE_SHA256  $to/sqlite3.c" | sha256sum --check --quiet || die "the SQLite in $SQLITE_SOURCE is not the expected one"
    { "$2" -Os -DSQLITE_OMIT_LOAD_EXTENSION -c "$to/sqlite3.c" -o "$to/sqlite3.o" && "$3" rcs "$to/libsqlite3.a" "$to/sqlite3.o"; } ||
        die "$2 cannot compile SQLite"
    printf '%s\n' '[binaries]' "pkgconfig = 'pkg-config'" '[properties]' "pkg_config_libdir = '$to'" >"$to/cross.ini"
    printf '%s\n' 'Name: sqlite3' 'Description: SQLite' 'Version: 3.53' "Libs: -L$to -lsqlite3" "Cflags: -I$to" >"$to/sqlite3.pc"
}
