#!/bin/sh
# pictures.sh: checks that all builds draw the same pixels at each processor level of this machine, also with OpenGL.
# usage: tests/hashes/pictures.sh PATH-OF-PETRI... (builds by different compilers, each with its petri-pictures)
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
[ $# -gt 0 ] || {
    echo "usage: $0 PATH-OF-PETRI..." >&2
    exit 2
}
for path; do
    petri=$(program "$path") || exit 2
    shift
    set -- "$@" "$petri"
done

scratch
number=0
for petri; do
    for cpu in scalar avx2 avx512; do
        number=$((number + 1))
        PETRI_CPU=$cpu "$petri" render "$here/picture.fl" --frames 9 -o "$number.png" >out 2>err
        status=$?
        check "$petri draws at $cpu" status_is 0
        [ "$number" -eq 1 ] || check "$petri draws the same bytes at $cpu" cmp 1.png "$number.png"
    done
done
# Reports nodes that were omitted because they need OpenGL, and checks that the picture is not empty.
lacks err needs-gpu || echo "without OpenGL"
check "the picture is not empty" eval '[ "$(wc -c <1.png)" -gt 8000 ]'
finish
