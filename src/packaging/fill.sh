#!/bin/sh
# fill.sh TEMPLATE [NAME=VALUE...]: prints the file with @NAME@ replaced: by a value of identity.ini, such as @EMAIL@, by
# the version in meson.build (@VERSION@, and @SERIES@ without the last number), or by a value of the command line. Fails
# if it contains another such name.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
template=$1
shift
exec awk -v given="$(printf '%s\n' "$@")" '
    function set_value(line, name) {
        name = line
        sub(/ *=.*/, "", name)
        sub(/^[^=]*= */, "", line)
        value[toupper(name)] = line
    }
    BEGIN { count = split(given, line, "\n"); for (i = 1; i <= count; i++) if (line[i] != "") set_value(line[i]) }
    FNR == 1 { file++ }
    file == 1 && /^[a-z_]+ *=/ { set_value($0) }
    file == 2 && /^ *version: / && !("VERSION" in value) {
        split($0, part, "\047")
        value["VERSION"] = part[2]
        split(part[2], number, ".")
        value["SERIES"] = number[1] "." number[2]
    }
    file == 3 {
        rest = $0
        filled = ""
        while (match(rest, /@[A-Z][A-Z0-9_]+@/)) {
            name = substr(rest, RSTART + 1, RLENGTH - 2)
            if (!(name in value)) {
                print FILENAME ":" FNR ": unknown name: @" name "@" >"/dev/stderr"
                bad = 1
            }
            filled = filled substr(rest, 1, RSTART - 1) value[name]
            rest = substr(rest, RSTART + RLENGTH)
        }
        print filled rest
    }
    END { exit bad }' "$here/identity.ini" "$here/../../meson.build" "$template"
