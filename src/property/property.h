// property.h: internal declarations of the tests of properties (NAME.properties): statements about all runs of a
// script.
//
// A case is a choice of parameters. Cases are sampled from the ranges of parameters and tried until a property is
// violated; the violated case is then made as simple as possible. Files, from those that call to those that are called:
//
//   command.c     the command `petri --check-properties`, which petri test executes for NAME.properties
//   search.c      tries all cases, in several processes
//   shrink.c      simplifies a violated case
//   smaller.c     removes parts of the script that a violation does not need
//   refresh.c     runs a found case again
//   attempt.c     runs one case
//   expression.c  properties that are written as expressions
//   motion.c      properties with a name, about particles
//   compare.c     properties with a name, about two runs
//   kept.c        violated cases of earlier tests
//   cases.c       sampling, and cases as text
//   read.c        reads NAME.properties
#pragma once

#include "cli/memory.h"
#include "cli/options.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "petri-live.h"

typedef enum PropertyKind {
    PROPERTY_ALWAYS,
    PROPERTY_NEVER,
    PROPERTY_FINALLY,
    PROPERTY_FINITE,
    PROPERTY_INSIDE,
    PROPERTY_MOMENTUM,
    PROPERTY_ENERGY,
    PROPERTY_SETTLES,
    PROPERTY_ORDER,
    PROPERTY_HALF_STEPS,
} PropertyKind;

// A line of the file.
typedef struct Property {
    PropertyKind kind;
    char *text;       // the line
    char *expression; // of always, never and finally; NULL: none
    uint32_t line;    // from 1
    double amount;    // allowed relative change
} Property;

// A parameter that cases set.
typedef struct Range {
    char *name;
    double min;
    double max;
    double usual; // default of the script; NaN: not a number
    bool whole;   // true if only integers are used
    bool zero;    // true if 0 can be set
} Range;

typedef struct Properties {
    const CommandContext *host;
    char *file;   // NAME.properties
    char *script; // NAME.fl
    Property *items;
    size_t count;
    Range *ranges;
    size_t range_count;
    int64_t frames;       // of each case
    int64_t cases;        // maximum number of cases
    double seconds;       // maximum duration of the search
    const char *override; // text that is used instead of the script; NULL: the script
    TextList kept;        // violated cases of earlier tests, as text
} Properties;

// read.c: reads the file, and the ranges in the comments of the script. Returns false after a message with the
// position.
bool properties_read(Properties *properties, const CommandContext *host, const char *file);
void properties_free(Properties *properties);

// cases.c: a case has a value for each range.

// Sets the values of case number `number`; the same numbers always give the same values. Case 0 has the defaults.
void case_sample(const Properties *properties, int64_t number, double *values);
// Adds a case as `NAME=VALUE NAME=VALUE`. If `changed` is true, only values that are not the default.
void case_add_text(const Properties *properties, const double *values, bool changed, Text *text);
// Reads such a text. Parameters that it lacks have their default. Returns false if it cannot be read.
bool case_read_text(const Properties *properties, const char *text, double *values);
// Sets a value to the nearest one that the range allows.
double range_clamp(const Range *range, double value);

// kept.c: NAME.cases beside NAME.properties.
void kept_read(Properties *properties);
// Adds a case to the file unless it is there. Returns false after a message.
bool kept_add(Properties *properties, const char *text);

// A violated property.
typedef struct Violation {
    bool found;
    int64_t frame;
    size_t particles; // number of particles in that frame
    Text what;        // what is wrong, in one line
    Text particle;    // key of the particle concerned, such as `:cells;1`; empty: none
} Violation;

void violation_free(Violation *violation);

// attempt.c: one run.
typedef struct Attempt {
    const Properties *properties;
    const double *values;
    int64_t only;          // index of the only property that is checked; -1: all
    double deadline;       // time of the monotonic clock at which the attempt ends
    Violation *violations; // one for each property
    // While it runs:
    PetriSession *session;
    uint64_t problems;       // number of errors and warnings
    Text first_problem;      // empty: none
    double *start;           // quantities at frame 1, of motion.c
    double largest;          // largest kinetic energy
    double momentum[3];      // at frame 1
    double largest_momentum; // largest sum of the momenta's absolute values
    bool expired;            // true if the deadline was reached
} Attempt;

// Opens a session with the parameters of a case and loads the script, or `text` instead of it. Returns NULL if that
// fails; attempt->first_problem then has the reason.
PetriSession *attempt_open(Attempt *attempt, const char *text);
// Runs a case and sets the violations. Returns false if the script cannot be run.
bool attempt_run(Attempt *attempt);
void attempt_free(Attempt *attempt);

// expression.c: checks the property after a frame. Returns false if it is violated. `last` is true for the last frame.
bool expression_holds(Attempt *attempt, const Property *property, bool last, Violation *violation);
// motion.c: the same.
bool motion_holds(Attempt *attempt, const Property *property, size_t index, bool last, Violation *violation);
// Adds the key of a particle.
void motion_add_key(PetriSession *session, size_t system, uint32_t particle, Text *key);
// compare.c: runs the case twice. Returns false if the property is violated.
bool compare_holds(Attempt *attempt, const Property *property, Violation *violation);

// A case that violates a property.
typedef struct Found {
    double *values; // NULL: no case violates the property
    int64_t number; // of the case
    Violation violation;
    size_t tries; // number of runs that simplified the case
    Text lines;   // lines of the script that the violation needs, such as `1-3, 7`; empty: all
} Found;

// refresh.c: runs the case again with one property. If it is violated, replaces the violation and returns true.
bool violation_refresh(const Properties *properties, size_t property, double deadline, Found *found);
// Like violation_refresh, but also sets *problems to the number of errors and warnings.
bool violation_refresh_counted(const Properties *properties, size_t property, double deadline, Found *found,
                               uint64_t *problems);

// search.c: tries all cases in `jobs` processes. Sets the first violated case of each property, and the number of cases
// that were tried. Returns false after a message.
bool search_all(const Properties *properties, int64_t jobs, Found *found, int64_t *tried);
// Tries every `jobs`-th case, beginning with `part`, and writes the result to standard output for search_all.
int search_part(const Properties *properties, int64_t jobs, int64_t part);

// shrink.c: simplifies a case for at most `seconds`.
void shrink_case(const Properties *properties, size_t property, double seconds, Found *found);
// smaller.c: finds the lines of the script without which the case no longer violates the property.
void smaller_script(Properties *properties, size_t property, double seconds, Found *found);
