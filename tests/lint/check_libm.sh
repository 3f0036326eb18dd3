#!/bin/sh
# check_libm.sh SOURCE_ROOT BUILD_ROOT: lib/ calls no function of the C library whose result may differ between C
# libraries. Functions that IEEE 754 defines exactly (sqrt, floor, fmod, frexp …) are allowed. NM: the nm to use, for
# objects of another processor.
set -eu
cd "$2"
inexact='acos asin atan atan2 cos sin tan sincos acosh asinh atanh cosh sinh tanh exp exp2 exp10 expm1 log log10 log1p log2
pow cbrt hypot erf erfc lgamma tgamma'
faults=0

# Each source must have an object file, with three exceptions. Sources of the web page have none. One os_*.c is compiled. A library with an optional
# dependency has a file no_*.c, which replaces all its other files in builds without that dependency. So each build leaves
# out either no_*.c or the other files.
for source in "$1"/lib/*/*.c; do
    name=${source#"$1"/}
    folder=${name%/*} file=${name##*/}
    case $file in *_web.c | no_*.c | os_*.c) continue ;; esac
    if ! ls "$folder"/*.p/"$file".o >/dev/null 2>&1 && ! ls "$folder"/*.p/no_*.c.o >/dev/null 2>&1; then
        echo "no object file of $name in $2"
        faults=1
    fi
done

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for bad in $inexact; do
    printf '%s\n' "$bad" "${bad}f" "${bad}l" "__${bad}_finite"
done >"$scratch/inexact"
"${NM:-nm}" -uA lib/*/*.p/*.o grammar/*.p/*.o >"$scratch/undefined"
found=$(awk '
    FNR == NR { inexact[$1]; next }
    $NF in inexact { sub(/:.*/, "", $1); print $1 ": " $NF }' "$scratch/inexact" "$scratch/undefined")
if [ "$found" ]; then
    echo "$found"
    faults=1
fi
exit $faults
