#!/bin/sh
# check_single.sh SOURCE_ROOT BUILD_ROOT: petri.c (./dev dist --single) compiles without warnings. It has no name at file
# level twice, so no static name, type, enumerator or macro of one source is that of another. Its headers compile as C++,
# and README states its size.
set -eu
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
python3 "$1/src/packaging/single.py" "$2" "$scratch"
cd "$scratch"
for compiler in gcc clang; do
    command -v $compiler >/dev/null || continue
    $compiler -Wall -Wextra -Werror -fsyntax-only petri.c
    for option in -ffast-math -Ofast; do
        ! $compiler $option -Wfatal-errors -fsyntax-only petri.c 2>err || {
            echo "$compiler compiles petri.c with $option"
            exit 1
        }
        grep -q 'without -ffast-math' err
    done
done
if command -v c++ >/dev/null; then
    for header in petri*.h; do echo "#include \"$header\""; done >host.cpp
    c++ -std=c++11 -Wall -Wextra -Wpedantic -Werror -fsyntax-only host.cpp
fi
wc -lc petri.c | awk -v readme="$1/README.md" '
    function differs(stated, real) { return stated < 0.97 * real || stated > 1.03 * real }
    BEGIN {
        while ((getline line < readme) > 0)
            if (match(line, /[0-9]+ 000 lines, [0-9.]+ MB/))
                split(substr(line, RSTART, RLENGTH), stated, " ")
    }
    differs(stated[1] * 1000, $1) || differs(stated[4] * 1e6, $2) {
        print "README.md states another size of petri.c than " $1 " lines, " $2 " bytes"
        exit 1
    }'
