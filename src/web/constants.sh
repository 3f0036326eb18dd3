#!/bin/sh
# constants.sh [--check]: prints engine/constants.mjs, which is generated from the headers. --check compares it with the
# stored file. To update: src/web/constants.sh >src/web/engine/constants.mjs
set -eu
cd "$(dirname "$0")/../.."
if [ "${1:-}" = --check ]; then
    src/web/constants.sh | diff src/web/engine/constants.mjs -
    exit
fi
echo '// constants.mjs: generated from the public headers by src/web/constants.sh.'
awk -f src/web/constants.awk lib/include/petri.h lib/include/petri-edit.h lib/include/petri-inspect.h lib/schema/composite_list.h
awk -v language=js -f lib/draw/display_list_rows.awk lib/include/petri-draw.h
