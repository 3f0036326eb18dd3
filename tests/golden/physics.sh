#!/bin/sh
# physics.sh PETRI FOLDER OPTION...: `petri test` on the scripts of a folder that have physics in them; how it is
# computed is nothing to the others.
set -eu
least=60 # a search that finds nothing would pass
petri=$1
folder=$2
shift 2
search() { grep -r --include='*.fl' -F '!physics' "$@" "$folder"; }
count=$(search -l | grep -c .)
if [ "$count" -lt $least ]; then
    echo "found $count scripts with physics, expected at least $least"
    exit 1
fi
search -lZ | xargs -0 "$petri" test "$@"
