// division.h: hooks through which lib/ranks divides the work of a system among processes. lib/physics calls them if
// PhysOptions.division is set, and knows nothing else about processes.
#pragma once

#include "physics/pair_wavefront.h"

// This process among all processes of a division.
typedef struct PhysProcesses {
    int self; // from 0
    int count;
} PhysProcesses;

struct PhysDivision {
    // Begins a frame. The columns and forces of the system are up to date, except as lib/ranks left them after the last
    // frame. Sets system->failed if out of memory.
    void (*begin_frame)(PhysSystem *system, const PhysTime *time);
    // Takes one step, as phys_step does for one process.
    bool (*step)(PhysSystem *system, double clock, double delta, double speed_of_light);
    // Writes the rows, as phys_write_rows does for one process. If the frame was aborted, leaves the rows unchanged and
    // returns false.
    bool (*end_frame)(PhysSystem *system, bool keep_last_finite);
    // Computes all pairs of a region. Returns false and computes nothing if they are too few to be divided.
    bool (*compute_pairs)(PhysSystem *system, const PairRegion *region);
    PhysProcesses (*processes)(const PhysSystem *system);
    // Copies the elements starts[r] to starts[r + 1] - 1 of each process r to all processes.
    void (*gather)(PhysSystem *system, double *numbers, const size_t *starts);
    // Frees PhysSystem.division.
    void (*free)(PhysSystem *system);
};
