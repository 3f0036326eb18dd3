#!/bin/sh
# check_libraries.sh SOURCE_ROOT BUILD_ROOT SANITIZERS|none: petri and libpetri take the C library, libm and threads, no
# more; what draws is libpetri-draw's alone, and petri-pictures has it.
set -eu
sanitizers=$3
cd "$2"
faults=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# needed FILE: what the loader loads with it, besides what compilers add by themselves.
needed() {
    LC_ALL=C readelf -d "$1" | sed -n 's/.*(NEEDED).*\[\(.*\)\]$/\1/p' | grep -v -e '^lib[a-z]*san\.so' -e '^libgcc_s\.so'
}

# check NAME FILE
check() {
    if ! needed "$2" | grep -q '^libc\.'; then
        echo "$1: cannot read what it needs"
        faults=1
    fi
    more=$(needed "$2" | grep -v -e '^libc\.' -e '^libm\.' -e '^libpthread\.' -e '^libdl\.' -e '^librt\.' -e '^ld-') || true
    if [ -n "$more" ]; then
        echo "$1 needs" $more
        faults=1
    fi
}

check petri src/petri
# All of the library, not only what the command takes of it.
echo 'int main(void) { return 0; }' >"$scratch/main.c"
options=
[ "$sanitizers" = none ] || options=-fsanitize=$sanitizers
# shellcheck disable=SC2086 # no option is no word
if ${CC:-cc} $options "$scratch/main.c" -o "$scratch/all" -Wl,--whole-archive lib/session/libpetri.a \
    -Wl,--no-whole-archive -lm -lpthread; then
    check libpetri "$scratch/all"
else
    echo "libpetri does not link by itself"
    faults=1
fi
# A shared library made of it, as of a host that is one, shows what is public and nothing else.
# shellcheck disable=SC2086
${CC:-cc} $options -shared -o "$scratch/all.so" -Wl,--whole-archive lib/session/libpetri.a -Wl,--no-whole-archive -lm -lpthread
shown=$(nm -D --defined-only "$scratch/all.so" | awk '{ print $NF }' | grep -v '^__')
for name in $(echo "$shown" | grep -v '^petri_'); do
    echo "libpetri.so exports $name"
    faults=1
done
[ "$(echo "$shown" | wc -l)" -gt 50 ] || {
    echo "libpetri.so exports hardly anything"
    faults=1
}
# Were cairo_create nowhere to be found, the above would say nothing.
if nm lib/draw/libpetri-draw.a 2>/dev/null | grep -q ' U cairo_create$'; then
    if ! needed src/petri-pictures | grep -q '^libcairo\.'; then
        echo "petri-pictures does not draw"
        faults=1
    fi
fi
# Nor would it if JSON were nowhere.
if [ -e src/petri-lsp ] && ! needed src/petri-lsp | grep -q '^libjson-c\.'; then
    echo "petri-lsp has no JSON"
    faults=1
fi
exit $faults
