#!/bin/sh
# check_tables.sh SOURCE_ROOT: checks that maths_tables.h equals the output of its generator.
set -eu
folder=$1/lib/maths
command -v python3 >/dev/null || {
    echo "no python3: not checked"
    exit 77
}
scratch=$(mktemp)
trap 'rm -f "$scratch"' EXIT
python3 "$folder/generate_tables.py" >"$scratch"
cmp "$scratch" "$folder/maths_tables.h"
