#!/bin/sh
# check_allocators.sh SOURCE_ROOT BUILD_ROOT: lib/ takes memory from lib/base/heap.c alone, which asks the host where it has
# functions for that (petri_set_allocator), and gives it back there. NM reads objects for another processor. What the C
# library takes for itself and gives back (opendir, qsort, regcomp) is not meant.
set -eu
cd "$2"
allocators='malloc calloc realloc reallocarray free strdup strndup wcsdup asprintf vasprintf __asprintf_chk __vasprintf_chk
aligned_alloc posix_memalign memalign valloc mmap mmap64 getline getdelim __getdelim open_memstream scandir
getcwd get_current_dir_name canonicalize_file_name'
looked=0
faults=0

for object in lib/*/*.p/*.o grammar/*.p/*.o; do
    looked=$((looked + 1))
    case $object in */heap.c.o) continue ;; esac
    found=$(${NM:-nm} -u "$object")
    for name in $allocators; do
        case "
$found
" in *" $name
"* | *" $name@"*)
            echo "$object: $name; heap_take and its kin do that (lib/base/heap.h)"
            faults=1
            ;;
        esac
    done
done
[ "$looked" -gt 100 ] || { echo "only $looked objects in $2"; faults=1; }
exit $faults
