#!/bin/sh
# one_object.sh LD OBJCOPY OUTPUT ARCHIVE [COPIED]: makes an archive with a single object, which has all of ARCHIVE and
# what that needs of the archive COPIED. Hidden names become local, so that they cannot collide with names of the program
# that links the archive.
set -eu
ld=$1 objcopy=$2 output=$3
archive=$4 copied=${5:-}
object=${output%.a}.o
"$ld" -r -o "$object" --whole-archive "$archive" --no-whole-archive ${copied:+"$copied"}
"$objcopy" --localize-hidden "$object"
rm -f "$output"
ar rcs "$output" "$object"
rm "$object"
