#!/bin/sh
# check_abi.sh SOURCE_ROOT BUILD_ROOT SANITIZERS: checks that the libraries export exactly the functions of abi.txt. Removing a
# function breaks compiled programs, and an added function must be kept in later versions.
set -eu
listed=$1/tests/lint/abi.txt
headers=$1/lib/include
cd "$2"
faults=0
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# compare NAME WANTED FOUND: reports differences between two lists.
compare() {
    if ! diff "$2" "$3" >"$scratch/diff"; then
        sed -n -e "s|^< |missing in $1: |p" -e "s|^> |missing in abi.txt, but in $1: |p" "$scratch/diff"
        faults=1
    fi
}

# check NAME LIBRARY nm-options...: compares exported names, except private ones, versions, and those of the linker and of
# sanitizers.
check() {
    name=$1 library=$2
    shift 2
    [ -e "$library" ] || { echo "skipped: this build has no $library"; return; }
    nm "$@" --defined-only "$library" |
        awk '{ sub(/@@PETRI_[0-9.]*$/, "") } NF == 3 && $2 != "A" && $3 !~ /^_|^\.|@/ { print $3 }' | sort -u >"$scratch/found"
    compare "$library" "$scratch/$name" "$scratch/found"
}

# is_complete: succeeds if the libraries were built with Cairo, OpenGL and SQLite.
is_complete() {
    [ "$(nm -D lib/cairo/libpetri-draw.so lib/recording/libpetri-archive.so |
        grep -c -e ' U cairo_create$' -e ' U epoxy_eglBindAPI$' -e ' U sqlite3_step$')" -eq 3 ]
}

grep -v -e '^petri-draw ' -e '^petri-archive ' -e '^#' "$listed" | sed 's/.* //' | sort >"$scratch/petri"
sed -n "s/^petri-draw //p" "$listed" | sort >"$scratch/draw"
sed -n "s/^petri-archive //p" "$listed" | sort >"$scratch/archive"
check petri lib/session/libpetri.so -D
check draw lib/cairo/libpetri-draw.so -D
check archive lib/recording/libpetri-archive.so -D
check petri src/packaging/libpetri.a -g
check draw src/packaging/libpetri-draw.a -g
check archive src/packaging/libpetri-archive.a -g

# The private names of libpetri.so are those that the other libraries need, and at most 40. The linker has reported
# missing ones. The other libraries have copies of code without state, but export no private names.
private() { kind=$1; shift; nm -D "$@" | sed -n "s/.* $kind \(_petri_[a-z0-9_]*\)@.*/\1/p" | sort -u; }
if [ -e lib/cairo/libpetri-draw.so ]; then
    private '[TDRBV]' lib/session/libpetri.so >"$scratch/exported"
    private U lib/cairo/libpetri-draw.so lib/recording/libpetri-archive.so >"$scratch/used"
    if [ ! -s "$scratch/used" ] || { is_complete && ! cmp -s "$scratch/exported" "$scratch/used"; }; then
        echo "PRIVATE_API that the other libraries do not need:" $(comm -23 "$scratch/exported" "$scratch/used")
        faults=1
    fi
    [ "$(wc -l <"$scratch/exported")" -le 40 ] || {
        echo "libpetri.so exports more than 40 private names"
        faults=1
    }
    private '[TDRBV]' lib/cairo/libpetri-draw.so lib/recording/libpetri-archive.so >"$scratch/exported"
    [ ! -s "$scratch/exported" ] || {
        echo "private names that libpetri-draw.so or libpetri-archive.so export:" $(cat "$scratch/exported")
        faults=1
    }
    # Sanitizers add variables.
    size -A lib/schema/libcopied.a >"$scratch/sections"
    if [ "$3" = none ] && ! awk '/^\.(data|bss|tdata|tbss) / { state += $2 } /^\.text/ { code += $2 }
        END { exit state > 0 || code == 0 }' "$scratch/sections"; then
        echo "libcopied.a has variables, of which each shared library would have its own"
        faults=1
    fi
fi

# Functions and values of enums of the last release (*.abi) stay, as the rules in petri.h say.
sed -n -e "s/.*<elf-symbol name='\(petri_[a-z0-9_]*\)'.*/\1/p" -e "s/.*<enumerator name='\(PETRI_[A-Z0-9_]*\)'.*/\1/p" \
    "$1"/tests/lint/*.abi | sort -u >"$scratch/released"
cat "$headers"/*.h "$headers"/*.inc | grep -o '[A-Za-z_][A-Za-z0-9_]*' | sort -u >"$scratch/words"
for name in $(comm -23 "$scratch/released" "$scratch/words"); do
    echo "$name was in the last release; keep it as an alias, with a comment that says 'deprecated: use NEW'"
    faults=1
done

for header in petri petri-archive petri-draw petri-edit petri-inspect petri-live petri-ranks; do
    awk 'match($0, /[ *]petri_[a-z_]+\(/) && /^PETRI_API/ { print substr($0, RSTART + 1, RLENGTH - 2) }' \
        "$headers/$header.h" | sort >"$scratch/declared"
    grep "^$header " "$listed" | sed 's/.* //' | sort >"$scratch/wanted"
    compare "$header.h" "$scratch/wanted" "$scratch/declared"
done
exit $faults
