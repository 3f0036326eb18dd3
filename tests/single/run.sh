#!/bin/bash
# run.sh BUILD_ROOT: compiles petri.c (./dev dist --single) with each compiler as its users do, and links it instead of
# libpetri with a host, with the command and with the tests of the public interface. Checks that all pass, and that the
# results are those of all builds.
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
build=$(cd "$1" && pwd)

# relink TARGET OUT: links a program of the build with petri.o instead of libpetri.
relink() {
    command=$(ninja -C "$build" -t commands "$1" | tail -n 1 |
        sed -e "s# lib/session/libpetri\.a# $PWD/petri.o#g" -e "s# -o [^ ]*# -o $2#")
    (cd "$build" && sh -c "$command")
}

scratch
cat >host.c <<'END'
#include "petri.h"
#include "petri-ranks.h"
#include <string.h>
int heap_free, arena_new, value_number; // names of petri.c that hosts may also use

int main(void) {
    const char *dish = "!physics state=:p\n    !particle id=0 velocity=1\n";
    PetriOptions options = petri_default_options();
    PetriSession *session = petri_open(&options);
    if (!session || petri_load_text(session, "dish.fl", dish, PETRI_NUL_TERMINATED) != PETRI_OK)
        return 1;
    for (int frame = 0; frame < 3; frame++)
        if (petri_step(session) != PETRI_OK)
            return 1;
    petri_close(&session);
    options.ranks = &(const struct PetriRanks){.size = sizeof(struct PetriRanks), .rank_count = 2};
    const char *problem = petri_options_problem(&options);
    return petri_open(&options) || !problem || !strstr(problem, "has no ranks");
}
END
check "petri.c is made" python3 "$root/src/packaging/single.py" "$build" .
for compiler in gcc clang; do
    command -v $compiler >/dev/null || continue
    # With gcc, the results must be right without the option, because petri.c sets it, also for its kernels.
    option=-ffp-contract=off
    [ $compiler = clang ] || option=
    # shellcheck disable=SC2086 # the option may be missing
    $compiler -O2 $option -Wall -Wextra -Werror -c petri.c >out 2>&1
    status=$?
    check "$compiler compiles petri.c" status_is 0
    $compiler -Wall -Wextra -Werror -idirafter "$root/lib/include" petri.o host.c -o host -lm -lpthread >out 2>&1
    check "a host of $compiler runs" ./host
    nm -g --defined-only petri.o | awk '{ print $3 }' |
        grep -vE '^(petri_|heap_exhausted$|(far|pair|phys)_kernels_|maths_arrays_)' >out
    check "$compiler exports only the interface" [ ! -s out ]
    $compiler -Wall -Wextra -Werror petri.o check_report.c -o check_report -lm -lpthread >out 2>&1
    check "check_report.c compiles with $compiler" [ -x check_report ]
    relink src/petri "$PWD/petri" >out 2>&1
    check "the command links with petri.c by $compiler" [ -x petri ]
    for program in tests/physics/seed_tests tests/physics/test_determinism; do
        relink $program "$PWD/tests" >out 2>&1 && ./tests >out 2>err
        status=$?
        check "$program passes with petri.c by $compiler" status_is 0
    done
    check "hashes with petri.c by $compiler" "$root/tests/hashes/hashes.sh" --check "$PWD/petri"
    ./petri test "$root/tests/golden" "$root/tests/conformance" "$root/samples" >out 2>&1
    status=$?
    check "goldens pass with petri.c by $compiler" status_is 0
    for cpu in scalar avx2 avx2-fma; do
        PETRI_CPU=$cpu ./petri test "$root/tests/conformance/physics" >out 2>&1
        status=$?
        check "physics passes with petri.c by $compiler at $cpu" status_is 0
    done
    rm -f petri tests host
done
finish
