#!/bin/sh
# pictures.sh: the same pixels from each build and at each level of processor on this machine, OpenGL's among them.
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
        [ "$number" -eq 1 ] || check "$petri at $cpu: the same bytes" cmp 1.png "$number.png"
    done
done
# What is drawn is none of those that are left out, and no black square.
lacks err needs-gpu || echo "without OpenGL"
check "there is something to see" eval '[ "$(wc -c <1.png)" -gt 8000 ]'
finish
