// nearest.c: suggestions for mistyped words (cli.h).
#include "base/str.h"
#include "cli/cli.h"

bool nearest_offer(StrNearest *nearest, const char *name) {
    // A word that is a prefix of the name counts as similar, such as `def` for `define`.
    bool shortened = nearest->wanted.len >= 3 && str_starts_with(str_from(name), nearest->wanted);
    if (!shortened || nearest->limit <= 1)
        return !shortened && str_try_nearest(nearest, str_from(name));
    nearest->limit = 1;
    nearest->found = str_from(name);
    return true;
}
