#!/bin/sh
# check_allocators.sh SOURCE_ROOT BUILD_ROOT: lib/ takes memory from lib/base/heap.c alone, which asks the host where it has
# functions for that (petri_set_allocator), and gives it back there. NM reads objects for another processor. What the C
# library takes for itself and gives back (opendir, qsort, regcomp) is not meant.
set -eu
cd "$2"
allocators='malloc|calloc|realloc|reallocarray|free|strdup|strndup|wcsdup|v?asprintf|__v?asprintf_chk|aligned_alloc'
allocators="$allocators|posix_memalign|memalign|valloc|mmap|mmap64|getline|(__)?getdelim|open_memstream|scandir"
allocators="$allocators|getcwd|get_current_dir_name|canonicalize_file_name"
calls=$(${NM:-nm} -A -u lib/*/*.p/*.o grammar/*.p/*.o)
[ "$(echo "$calls" | cut -d: -f1 | uniq | wc -l)" -gt 100 ] || { echo "nearly no objects in $2"; exit 1; }
if echo "$calls" | grep -v '/heap\.c\.o:' | grep -E " U ($allocators)(@.*)?\$"; then
    echo "memory is heap_alloc's and its kin's business (lib/base/heap.h)"
    exit 1
fi
