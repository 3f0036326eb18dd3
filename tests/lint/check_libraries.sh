#!/bin/sh
# check_libraries.sh SOURCE_ROOT BUILD_ROOT SANITIZERS|none: petri and libpetri need only the C library, libm and threads.
# Libraries for drawing are needed only by libpetri-draw and petri-pictures.
set -eu
sanitizers=$3
cd "$2"
faults=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# needed FILE: prints the shared libraries that a file needs, except those that compilers add.
needed() {
    LC_ALL=C readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]$/\1/p' | grep -v -e '^lib[a-z]*san\.so' -e '^libgcc_s\.so'
}

# check NAME FILE: checks the shared libraries of a file.
check() {
    if ! needed "$2" | grep -q '^libc\.'; then
        echo "$1: cannot read its shared libraries"
        faults=1
    fi
    more=$(needed "$2" | grep -v -e '^libc\.' -e '^libm\.' -e '^libpthread\.' -e '^libdl\.' -e '^librt\.' -e '^ld-') || true
    if [ -n "$more" ]; then
        echo "$1 needs" $more
        faults=1
    fi
}

check petri src/petri
# Links the whole library, not only the parts that the command needs.
echo 'int main(void) { return 0; }' >"$scratch/main.c"
options=
[ "$sanitizers" = none ] || options=-fsanitize=$sanitizers
# shellcheck disable=SC2086 # $options may be empty
if ${CC:-cc} $options "$scratch/main.c" -o "$scratch/all" -Wl,--whole-archive lib/session/libpetri.a \
    -Wl,--no-whole-archive -lm -lpthread; then
    check libpetri "$scratch/all"
else
    echo "libpetri does not link by itself"
    faults=1
fi
# A shared library that contains libpetri.a exports only public functions, and private ones with their prefix.
# shellcheck disable=SC2086
${CC:-cc} $options -shared -o "$scratch/all.so" -Wl,--whole-archive lib/session/libpetri.a -Wl,--no-whole-archive -lm -lpthread
shown=$(nm -D --defined-only "$scratch/all.so" | awk '{ print $NF }' | grep -v '^__')
for name in $(echo "$shown" | grep -v '^_\{0,1\}petri_'); do
    echo "libpetri.so exports $name"
    faults=1
done
[ "$(echo "$shown" | wc -l)" -gt 50 ] || {
    echo "libpetri.so exports too few functions"
    faults=1
}
# Checks that petri-pictures needs Cairo. Otherwise, the checks above would prove nothing.
if nm lib/cairo/libpetri-draw.a 2>/dev/null | grep -q ' U cairo_create$'; then
    if ! needed src/petri-pictures | grep -q '^libcairo\.'; then
        echo "petri-pictures does not need Cairo"
        faults=1
    fi
fi
exit $faults
