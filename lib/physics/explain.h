// explain.h: the contributions of all forces to the force on one particle in a step of the last frame.
//
// A frame stores only the rows from which it started (PhysOptions.keep_forces). phys_explain copies the system,
// computes the steps before the requested one again, and then evaluates the forces on one particle, in the order of
// summation (spec physics.md section 4). A pass with kernels, threads or processes adds the same terms in the same
// order, so the sum is equal to the last bit. A force with `theta` is one contribution for each group that exerts it.
#pragma once

#include "physics/system.h"

#define PHYS_OWN_FORCE UINT32_MAX  // in PhysExplanation.forces: the particle's `force` attribute
#define PHYS_NO_PARTNER UINT32_MAX // in PhysExplanation.partners: the force has no other particle, or has `theta`

// Results of phys_explain, valid until phys_explanation_free.
typedef struct PhysExplanation {
    double clock;                     // simulation clock at the start of the step
    double delta;                     // length of the step
    const double *position;           // at the start of the step; n doubles
    const double *velocity;           // n doubles
    const double *sum;                // the force on the particle in the step; n doubles; zeros for an anchor
    uint32_t count;                   // number of contributions; zeros that cannot change the sum are left out
    const uint32_t *forces;           // by contribution, in the order of summation: number that phys_add_force returned
    const uint32_t *partners;         // by contribution: handle of the other particle of a pair force or link
    const double *vectors;            // by contribution: n doubles
    struct ExplanationMemory *memory; // holds the arrays
    PhysSystem *copy;                 // the system in which the step was computed
} PhysExplanation;

// Returns the number of steps of the last frame that phys_explain can explain. It is 0 without PhysOptions.keep_forces,
// or if the last frame had no steps.
uint64_t phys_explained_steps(const PhysSystem *system);
// Explains the force on a particle in step `step` of the last frame, counted from 0. `particle` and `step` must be in
// range. Fills `result` even on failure; the caller frees it with phys_explanation_free. Memory and work are charged to
// the budget of the system.
PhysStatus phys_explain(const PhysSystem *system, uint32_t particle, uint64_t step, PhysExplanation *result);
// Explains the force on a particle in a step of `delta` from the current rows, at `clock` of the simulation clock. Does
// not need PhysOptions.keep_forces. In other respects like phys_explain.
PhysStatus phys_explain_rows(const PhysSystem *system, uint32_t particle, double clock, double delta,
                             PhysExplanation *result);
void phys_explanation_free(PhysExplanation *explanation);
