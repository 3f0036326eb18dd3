// spec.c: see spec.h.
#include "base/spec.h"

#include <string.h>

const SpecChange SPEC_CHANGES[] = {
    {"0.4", "barriers", "physics.md 4.4",
     "a particle that is pressed against a barrier moves along it, and only a faster one bounces", SPEC_OLD_BARRIERS},
    {"0.4", "theta", "far-field.md 5", "forces with theta are computed for all pairs where the tree would save nothing",
     SPEC_OLD_FAR_FIELDS},
    {"0.4", "seeds", "builtins.md B9.2", "every nan in a seed counts as the same number", 0},
    {"0.4", "counters", "counters.md", "a counter whose state has no time starts at the present time", 0},
    {"0.4", "subtitles", "builtins.md B13.6", "srt() reads the files that ffmpeg reads", 0},
};
const size_t SPEC_CHANGE_COUNT = sizeof SPEC_CHANGES / sizeof *SPEC_CHANGES;

bool spec_find(const char *text, unsigned *old_rules) {
    size_t length = strcspn(text, " ");
    const char *name = text[length] ? text + length + 1 : NULL;
    bool first = length == strlen(SPEC_FIRST) && memcmp(text, SPEC_FIRST, length) == 0, found = !name;
    *old_rules = 0;
    if (!first)
        return strcmp(text, SPEC_VERSION) == 0;
    for (size_t i = 0; i < SPEC_CHANGE_COUNT; i++) {
        if (name && strcmp(name, SPEC_CHANGES[i].name) != 0)
            continue;
        *old_rules |= SPEC_CHANGES[i].rule;
        found = found || SPEC_CHANGES[i].rule;
    }
    return found;
}

const char *spec_version(unsigned old_rules) {
    return old_rules ? SPEC_FIRST : SPEC_VERSION;
}
