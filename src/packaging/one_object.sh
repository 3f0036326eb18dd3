#!/bin/sh
# one_object.sh LD OBJCOPY OUTPUT ARCHIVES...: one archive with one object of all of them, whose hidden names are nobody's
# outside: a host may have functions of the same names.
set -eu
ld=$1 objcopy=$2 output=$3
shift 3
object=${output%.a}.o
"$ld" -r -o "$object" --whole-archive "$@"
"$objcopy" --localize-hidden "$object"
rm -f "$output"
ar rcs "$output" "$object"
rm "$object"
