#!/bin/sh
# check_allocators.sh SOURCE_ROOT BUILD_ROOT: lib/ allocates and frees memory only through lib/base/heap.c, so that the
# host's allocator is used (petri_set_allocator). Memory that the C library allocates and frees internally (opendir,
# qsort, regcomp) is not checked. NM: the nm to use, for objects of another processor.
set -eu
cd "$2"
allocators='malloc|calloc|realloc|reallocarray|free|strdup|strndup|wcsdup|v?asprintf|__v?asprintf_chk|aligned_alloc'
allocators="$allocators|posix_memalign|memalign|valloc|mmap|mmap64|getline|(__)?getdelim|open_memstream|scandir"
allocators="$allocators|getcwd|get_current_dir_name|canonicalize_file_name"
calls=$(${NM:-nm} -A -u lib/*/*.p/*.o grammar/*.p/*.o)
[ "$(echo "$calls" | cut -d: -f1 | uniq | wc -l)" -gt 100 ] || { echo "too few object files in $2"; exit 1; }
if echo "$calls" | grep -v '/heap\.c\.o:' | grep -E " U ($allocators)(@.*)?\$"; then
    echo "use heap_alloc and the other functions of lib/base/heap.h instead"
    exit 1
fi
