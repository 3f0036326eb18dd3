#!/bin/sh
# check_libm.sh SOURCE_ROOT BUILD_ROOT: lib/ calls no function of the C library whose bits are the library's choice. What
# IEEE 754 defines exactly (sqrt, floor, fmod, frexp …) may be called.
set -eu
cd "$2"
inexact='acos asin atan atan2 cos sin tan sincos acosh asinh atanh cosh sinh tanh exp exp2 exp10 expm1 log log10 log1p log2
pow cbrt hypot erf erfc lgamma tgamma'
faults=0
seen=0

for object in lib/*/*.p/*.o libast.a.p/*.o grammar/*.p/*.o; do
    [ -f "$object" ] || continue
    seen=$((seen + 1))
    for name in $(nm -u "$object" | awk '{ print $2 }'); do
        for bad in $inexact; do
            case $name in
            "$bad" | "${bad}f" | "${bad}l" | "__${bad}_finite")
                echo "$object: $name"
                faults=1
                ;;
            esac
        done
    done
done
[ "$seen" -gt 50 ] || {
    echo "only $seen object files in $2"
    faults=1
}
exit $faults
