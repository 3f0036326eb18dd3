#!/bin/sh
# check_headers.sh SOURCE_ROOT BUILD_ROOT: each header compiles alone as C17. Those in lib/include also compile as C++, if
# there is a C++ compiler. Lists of rows (X-macros, *_list.h) are not checked.
set -eu
build=$2
cd "$1"
faults=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

for header in lib/*/*.h src/*/*.h tests/support/*.h; do
    case $header in *_list.h | */engine_names.h) continue ;; esac
    # Headers that need a library are checked only if it is installed.
    isa=
    case $header in
    lib/cairo/*)
        pkg-config --exists pangocairo 2>/dev/null || continue
        isa=$(pkg-config --cflags pangocairo)
        ;;
    lib/physics/pair_tiles.h) isa=-DLANES=2 ;; # tiles need several lanes
    src/web/*) continue ;; # for WebAssembly only
    src/hdf5/*)
        pkg-config --exists hdf5 2>/dev/null || continue
        isa=$(pkg-config --cflags hdf5)
        ;;
    lib/recording/archive.h) pkg-config --exists sqlite3 2>/dev/null || continue ;;
    lib/gl/context.h | lib/scene3d/gpu_cache.h | lib/scene3d/scene_program.h) pkg-config --exists epoxy 2>/dev/null || continue ;;
    esac
    # The header is included in another file, because compilers report unused definitions in the main file.
    printf '#include "%s"\n' "$PWD/$header" >"$scratch/alone.c"
    # shellcheck disable=SC2086 # $isa may be empty
    if ! ${CC:-cc} $isa -std=c17 -D_XOPEN_SOURCE=700 -D_DEFAULT_SOURCE -fsyntax-only -Wall -Wextra -Wno-unused-variable \
        -Wno-unused-const-variable -Wno-unused-function -Werror -Ilib -Ilib/include -Isrc -Itests/support \
        -I"$build/grammar" -I"$build/lib" "$scratch/alone.c"; then
        echo "$header does not compile alone"
        faults=1
    fi
done

if command -v "${CXX:-c++}" >/dev/null 2>&1; then
    printf '#include "petri-archive.h"\n#include "petri-draw.h"\n#include "petri-edit.h"\n#include "petri-inspect.h"\n#include "petri-live.h"\n#include "petri-ranks.h"\nint main() { return petri_version() == nullptr || petri_picture_can_save(""); }\n' >"$scratch/alone.cc"
    if ! "${CXX:-c++}" -std=c++17 -fsyntax-only -Wall -Wextra -Werror -Ilib/include "$scratch/alone.cc"; then
        echo "a public header does not compile as C++"
        faults=1
    fi
fi
exit $faults
