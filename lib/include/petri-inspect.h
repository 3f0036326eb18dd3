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
