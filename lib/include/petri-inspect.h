// petri-inspect.h: for hosts that test, compare and explain scripts: printed frames, digests, forces, files and work.
//
// The rules of petri.h apply.
#ifndef PETRI_INSPECT_H
#define PETRI_INSPECT_H

#include "petri.h"

#ifdef __cplusplus
extern "C" {
#endif

// Returns the path of a source file of the loaded script by number, or NULL past the last. Number 0 is the script
// itself. The files that it includes follow, then the modules imported so far, each followed by its included files.
// Scripts that were loaded from memory are not listed. Valid until the next load or step.
PETRI_API const char *petri_source_file(PetriSession *session, size_t number);

// Returns the units of work (PetriOptions.work_limit) of all calls since the session was opened. They include constant
// folding, and each petri_picture_render that petri_picture_report has followed. With it, a host can limit a whole run.
PETRI_API uint64_t petri_work(const PetriSession *session);

// Computes a digest of the state dictionary: 16 bytes that depend only on its keys and values (spec digest.md). So
// equal states have equal digests in all builds, on any number of threads or ranks. A digest takes little time, because
// only the numbers are hashed in frames that add and remove no keys. It detects differences, but it is not
// cryptographic: different states with equal digests can be constructed. Returns PETRI_INVALID if called within a
// callback. If not PETRI_OK, `digest` is unspecified.
PETRI_API PetriStatus petri_digest(PetriSession *session, uint8_t digest[16]);

// A force applier or barrier of a system.
typedef struct PetriForce {
    const char *kind;       // kind of its node without the `!`, such as "distance"; static
    double strength;        // strength of the force, without the effect of `ease`
    uint32_t from;          // `!distance` only: number of the first particle that it connects
    uint32_t to;            // `!distance` only: number of the second particle
    const double *position; // `!barrier` only: a point on it; else NULL
    const double *normal;   // `!barrier` only: its unit normal; else NULL
    const char *file;       // file of its node; NULL if the position is unknown, for example after petri_reload
    uint32_t line;          // line of its node, from 1; 0 if unknown
    uint32_t column;        // in characters, from 1; 0 if unknown
} PetriForce;

// Gets a force applier or barrier by number, in the order of the script. Returns false past the last, or if out of
// memory. The vectors and `file` are valid until the next call that gets data about a system, such as petri_system, and
// at most as long as the columns.
PETRI_API bool petri_system_force(PetriSession *session, size_t system, uint32_t number, PetriForce *force,
                                  size_t size);

// Computes the potential energy of force applier or barrier `force` of a system, in its state after the last frame, as
// lib/spec/physics.md section 4.5 defines it. Sets *energy to NaN if the force has no potential, as `!drag` and
// `!random`. The unit is that of mass * (length / time)^2. For forces of unlimited range, time grows with the square of
// the number of particles. Returns PETRI_INVALID if there is no such system or force, and PETRI_LIMIT_EXCEEDED if the
// work limit was reached; *energy is then NaN.
PETRI_API PetriStatus petri_potential_energy(PetriSession *session, size_t system, uint32_t force, double *energy);

#define PETRI_OWN_FORCE UINT32_MAX   // in PetriExplanation.force: the particle's attribute `force`
#define PETRI_NO_PARTICLE UINT32_MAX // in PetriExplanation.partner: no other particle, or a force with `theta`

// The forces on one particle in one step of the last frame. Contribution c comes from force[c] and partner[c], and its
// vector starts at vector[c * dimensions]. To add the contributions yourself, start with zeros, or with the first one
// if it is PETRI_OWN_FORCE.
typedef struct PetriExplanation {
    uint32_t count;          // number of contributions; zeros that cannot change the sum are left out
    const uint32_t *force;   // by contribution: number for petri_system_force
    const uint32_t *partner; // by contribution: number of the other particle of a pair force or `!distance`
    const double *vector;    // contributions in the order of summation
    const double *sum;       // sum of the contributions; in the last step, PetriSystem.force of the particle
    double clock;            // simulation clock at the start of the step
    double delta;            // length of the step in seconds
    const double *position;  // of the particle at the start of the step
    const double *velocity;  // of the particle at the start of the step
} PetriExplanation;

// Explains the force on a particle: computes the contributions of all forces in step `step` of the last frame again.
// The last step is PetriSystem.steps - 1. Returns PETRI_INVALID if there is no such system, particle or step, or
// without PetriOptions.keep_forces. The arrays are valid until the next call of this function, and at most as long as
// the columns.
PETRI_API PetriStatus petri_explain_force(PetriSession *session, size_t system, uint32_t particle, uint64_t step,
                                          PetriExplanation *explanation, size_t size);

// Variations of a run, which show how far its results depend on the step and on rounding. Zeros mean none.
typedef struct PetriVariation {
    size_t size;    // sizeof(PetriVariation)
    uint32_t parts; // number of equal parts into which each simulation step is divided; at most 1000000
    // Distance by which particles are moved before the first step of a run, along each axis, forwards or backwards. The
    // unit is the size of their system: the longest side of the box around all particles and anchors; if they are at
    // one point, its largest coordinate, else 1.
    double shift;
    uint64_t seed; // selects the directions
} PetriVariation;

// Varies the systems from the next frame on. Nothing else depends on it: the script is evaluated once for each of its
// frames, and in all parts of a step, `!random` has the values that it has in the whole step. petri_load,
// petri_reset and petri_config_apply keep the variation; state files do not contain it. Returns PETRI_INVALID if a
// number is not valid.
PETRI_API PetriStatus petri_vary(PetriSession *session, const PetriVariation *variation);

// The result of petri_trust.
typedef enum PetriVerdict {
    PETRI_CONVERGED,
    PETRI_STEP_TOO_LARGE,
    PETRI_CHAOTIC,      // the end of the run is after PetriTrust.horizon
    PETRI_INCOMPARABLE, // particles appear or vanish at other times, so that `!random` acts on others
    PETRI_UNSTABLE,     // a force is too strong for the length of the step, or the motion has become meaningless
    PETRI_NO_NUMBER,    // the value is not a vector of finite numbers
} PetriVerdict;

// How far the value of an expression after a frame can be trusted. For a vector, the largest errors of its elements
// count. Times are in seconds since frame 0.
typedef struct PetriTrust {
    size_t size; // number of bytes of the struct that are filled
    int64_t frame;
    double time;
    uint32_t expression; // its number
    const char *value;   // in printed form, in the run with the script's own step
    double error;        // bound of the distance from the value with infinitely short steps; infinite: not known
    double order;        // observed: the error grows as step^order. NaN: it does not grow regularly
    double spread;       // change by rounding: if the particles start one unit in the last place away
    int digits;          // decimal digits of the value that are larger than error and spread, at most 15; -1: no number
    double lyapunov_time;  // in which the distance of neighbouring runs grows by a factor of e; NaN: it does not
    double lyapunov_error; // standard error of lyapunov_time
    double horizon;        // after this time, a single run means nothing; NaN: not before the end
    PetriVerdict verdict;
    const char *sentence; // the verdict for users
} PetriTrust;

typedef struct PetriTrustOptions {
    size_t size;                    // sizeof(PetriTrustOptions)
    const char *const *expressions; // `count` expressions for petri_evaluate
    uint32_t count;
    int64_t frames; // number of frames of each run; at least 1
    int64_t every;  // report every K-th frame, and the last one; 0: only the last
    // Called with each result, in the order of frames. The struct and its strings are valid during the call.
    void (*report)(void *user_data, const PetriTrust *trust);
    void *user_data; // passed to the functions
    // Writes the value of an expression instead of petri_evaluate; NULL: petri_evaluate.
    PetriStatus (*measure)(void *user_data, uint32_t expression, PetriWriteCallback *write, void *context);
} PetriTrustOptions;

// Finds out how many digits of a run are true: runs the loaded script from frame 0 with its own steps, with halves and
// quarters of them, and with starting positions moved by one unit in the last place and by 1e-9 of the size of the
// system. The session is then where it was. Diagnostics are those of the first run, and errors. Returns the status of
// the first call that fails, or PETRI_INVALID for invalid arguments. If memory runs out, the session can be at another
// frame; reset or rewind it.
PETRI_API PetriStatus petri_trust(PetriSession *session, const PetriTrustOptions *options);

// Sections that petri_print writes, in this order (spec cli.md 3.3).
enum {
    PETRI_PRINT_TREE = 1,
    PETRI_PRINT_STATE = 2,
    PETRI_PRINT_LOG = 4,     // output of debug()
    PETRI_PRINT_ERROR = 8,   // run-time errors
    PETRI_PRINT_HASH = 16,   // SHA-256 of the text of PETRI_PRINT_STATE, which need not be selected
    PETRI_PRINT_DIGEST = 32, // digest of the state (petri_digest)
};

// Writes the last frame as text: a line `@FRAME time=T beat=B`, then the given sections. Returns PETRI_INVALID if
// `write` returned false, and PETRI_LIMIT_EXCEEDED if the tree is longer than 512 MiB.
PETRI_API PetriStatus petri_print(PetriSession *session, unsigned sections, PetriWriteCallback *write, void *user_data);

// Writes only the debug() output of the last frame, each line as `> text`. Returns PETRI_INVALID if `write` returned
// false.
PETRI_API PetriStatus petri_print_log(PetriSession *session, PetriWriteCallback *write, void *user_data);

#ifdef __cplusplus
}
#endif

#endif
