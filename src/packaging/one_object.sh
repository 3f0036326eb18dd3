#!/bin/sh
# one_object.sh LD OBJCOPY OUTPUT ARCHIVES...: combines archives into one archive with a single object. Hidden names
# become local, so that they cannot collide with names of the program that links the archive.
set -eu
ld=$1 objcopy=$2 output=$3
shift 3
object=${output%.a}.o
"$ld" -r -o "$object" --whole-archive "$@"
"$objcopy" --localize-hidden "$object"
rm -f "$output"
ar rcs "$output" "$object"
rm "$object"
