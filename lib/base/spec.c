// spec.c: see spec.h.
#include "base/spec.h"

#include <string.h>

#define SINCE_FIRST(name) "0.4", SPEC_FIRST " " name

const SpecChange SPEC_CHANGES[] = {
    {SINCE_FIRST("barriers"), "physics.md 4.4",
     "a particle that is pressed against a barrier moves along it, and only a faster one bounces", SPEC_OLD_BARRIERS},
    {SINCE_FIRST("theta"), "far-field.md 5",
     "forces with theta are computed for all pairs where the tree would save nothing", SPEC_OLD_FAR_FIELDS},
    {SINCE_FIRST("seeds"), "builtins.md B9.2", "every nan in a seed counts as the same number", 0},
    {SINCE_FIRST("counters"), "counters.md", "a counter whose state has no time starts at the present time", 0},
    {SINCE_FIRST("subtitles"), "builtins.md B13.6", "srt() reads the files that ffmpeg reads", 0},
};
const size_t SPEC_CHANGE_COUNT = sizeof SPEC_CHANGES / sizeof *SPEC_CHANGES;

bool spec_find(const char *text, unsigned *old_rules) {
    bool all = strcmp(text, SPEC_FIRST) == 0;
    *old_rules = 0;
    for (size_t i = 0; i < SPEC_CHANGE_COUNT; i++)
        if (all || strcmp(text, SPEC_CHANGES[i].alone) == 0)
            *old_rules |= SPEC_CHANGES[i].rule;
    return *old_rules || strcmp(text, SPEC_VERSION) == 0;
}

const char *spec_version(unsigned old_rules) {
    for (size_t i = 0; i < SPEC_CHANGE_COUNT; i++)
        if (old_rules && SPEC_CHANGES[i].rule == old_rules)
            return SPEC_CHANGES[i].alone;
    return old_rules ? SPEC_FIRST : SPEC_VERSION;
}
