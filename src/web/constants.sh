#!/bin/sh
# constants.sh [--check]: generates engine/constants.mjs and engine/constants.d.mts from the headers. --check compares
# them with the stored files.
set -eu
cd "$(dirname "$0")/../.."
headers="lib/include/petri.h lib/include/petri-edit.h lib/include/petri-inspect.h lib/schema/composite_list.h"
folder=src/web/engine
if [ "${1:-}" = --check ]; then
    folder=$(mktemp -d)
    trap 'rm -rf "$folder"' EXIT
fi
{
    echo '// constants.mjs: generated from the public headers by src/web/constants.sh.'
    # shellcheck disable=SC2086 # a list of files
    awk -f src/web/constants.awk $headers
    awk -f src/web/display_list.awk lib/include/petri-display-list.inc
} >"$folder/constants.mjs"
{
    echo '// constants.d.mts: types of the names in constants.mjs, generated from the public headers by src/web/constants.sh.'
    # shellcheck disable=SC2086
    awk -v language=ts -f src/web/constants.awk $headers
} >"$folder/constants.d.mts"
if [ "${1:-}" = --check ]; then
    diff src/web/engine/constants.mjs "$folder/constants.mjs"
    diff src/web/engine/constants.d.mts "$folder/constants.d.mts"
fi
