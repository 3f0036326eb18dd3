#!/bin/sh
# test_layouts.sh: tests check_layouts.sh with a small library, whose header is a copy of petri.h with a change.
set -u
# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
scratch
layouts() { "$here/check_layouts.sh" "$@" >out 2>&1; }

PATH=/nowhere CI='' /bin/sh "$here/check_layouts.sh" include reference.abi library.so >out 2>&1
check "without abidiff, the check is skipped" [ $? -eq 77 ]
check "the message names the package" has out abigail-tools
PATH=/nowhere CI=true /bin/sh "$here/check_layouts.sh" include reference.abi library.so >out 2>&1
check "CI requires abidiff" [ $? -eq 1 ]
if ! command -v abidiff >/dev/null; then
    echo "skipped: no abidiff (Debian: abigail-tools)"
    finish && exit 77
    exit 1
fi

mkdir include
cat >library.c <<'EOT'
#include "petri.h"
bool petri_frame(const PetriSession *session, PetriFrame *frame, SIZE size) {
    return session && frame && size > 0;
}
int64_t petri_frame_number(const PetriSession *session) {
    return session ? 1 : 0;
}
#ifdef MORE
PETRI_API int petri_more(void);
int petri_more(void) {
    return 1;
}
#endif
EOT
# planted SED [OPTION...]: compiles the library with a change of the header, and with these options.
planted() {
    sed "$1" "$root/lib/include/petri.h" >include/petri.h
    shift
    cc -g -shared -fPIC -fvisibility=hidden -Iinclude -DSIZE=size_t "$@" library.c -o library.so || exit 1
}
# accepted and rejected SED [OPTION...]: succeed if the check accepts or rejects the library with this change.
accepted() { planted "$@" && layouts include reference.abi library.so; }
rejected() { planted "$@" && ! layouts include reference.abi library.so && has out "differs from the last release"; }

planted ''
check "a reference is stored" layouts --update include reference.abi library.so
check "an unchanged library passes" accepted ''
check "an additional function passes" accepted '' -DMORE
check "an inserted field fails" rejected 's/^    double beat;$/    double inserted; double beat;/'
check "the message names the field" has out "double inserted"
check "a field at the end of a struct fails" rejected 's/^} PetriFrame;/double more; } PetriFrame;/'
check "a removed field fails" rejected '/^    double beat;$/d'
check "a changed type of a field fails" rejected 's/^    double beat;$/    float beat;/'
check "a changed type of an argument fails" rejected 's/\(PetriFrame \*frame, \)size_t/\1int/' -USIZE -DSIZE=int
check "a removed function fails" rejected 's/^PETRI_API int64_t petri_frame_number/int64_t petri_frame_number/'
planted '' -g0
check "a library without debug information fails" sh -c '! "$0" include reference.abi library.so >out' "$here/check_layouts.sh"
check "the message names the option of the compiler" has out "not compiled with -g"
finish
