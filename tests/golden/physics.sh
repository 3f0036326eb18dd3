#!/bin/sh
# physics.sh PETRI FOLDER OPTION...: runs `petri test` with the options on the scripts with physics in a folder. The
# options do not affect other scripts.
set -eu
min_scripts=60 # fails if no scripts are found, because then the search is broken
petri=$1
folder=$2
shift 2
search() { grep -r --include='*.fl' -F '!physics' "$@" "$folder"; }
count=$(search -l | grep -c .)
if [ "$count" -lt $min_scripts ]; then
    echo "found $count scripts with physics, expected at least $min_scripts"
    exit 1
fi
search -lZ | xargs -0 "$petri" test "$@"
