// spec.h: versions of the specification (lib/spec), and the changes that make results differ.
//
// A new version of the specification is a new version of petri. An archive, a state file and a link say by which
// version they were computed. Rules of earlier versions that are kept compute old runs again.
#pragma once

#include <stdbool.h>
#include <stddef.h>

#define SPEC_VERSION "0.4"
#define SPEC_FIRST "0.3" // version of states that have none

// Rules that are not those of the present version.
enum {
    SPEC_OLD_BARRIERS = 1,
    SPEC_OLD_FAR_FIELDS = 2,
};

typedef struct SpecChange {
    const char *version; // first version with the new rule
    const char *alone;   // the version before, and the name of the change: only this rule is the old one
    const char *section; // of lib/spec
    const char *sentence;
    unsigned rule; // the old rule; 0: it is not kept
} SpecChange;

// The changes since SPEC_FIRST, in the order of versions. lib/spec/README.md lists the same ones.
extern const SpecChange SPEC_CHANGES[];
extern const size_t SPEC_CHANGE_COUNT;

// Reads a version, such as "0.3", or a version and the name of one of the changes since, such as "0.3 barriers": only
// this rule is the old one. Returns false if there is no such version or name.
bool spec_find(const char *text, unsigned *old_rules);
// Returns the text by which spec_find finds these rules.
const char *spec_version(unsigned old_rules);
