// rejection.h: scripts that must be rejected (NAME.err beside NAME.fl).
#ifndef PETRI_SRC_REJECTION_H
#define PETRI_SRC_REJECTION_H

#include "cli/bytes.h"

// Whether a run of script `name` that ended with `status` (of waitpid) and these errors is what the .err file `path`
// asks for: `line N`, or `line *` for any line. If not, the reason is added to `trouble`.
bool rejection_check(const char *path, const char *name, int status, const Bytes *errors, Bytes *trouble);

#endif
