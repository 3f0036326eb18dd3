// workloads.h: the systems of the benchmark scripts, built directly for lib/physics.
#pragma once

#include "physics/system.h"

#include <stdint.h>

typedef enum WorkloadKind { DISH, BOX, GRAVITY, DISCS, SPHERES, CHARGES, WORKLOAD_KINDS } WorkloadKind;

// A particle. Between frames, the benchmark stores its position and velocity here, as lib/scene does.
typedef struct Body {
    double position[3];
    double velocity[3];
    double radius;
    double mass;
    double charge;
} Body;

typedef struct Workload {
    WorkloadKind kind;
    uint32_t n;          // number of bodies; excludes the hub of the dish
    uint32_t dimensions; // 2 or 3
    double delta;        // length of a step in time units
    double clock;
    double width; // edge of the box or radius of the dish
    uint64_t frame;
    Body *bodies;
    PhysSystem *system;
} Workload;

Workload workload_open(WorkloadKind kind, uint32_t n, const PhysOptions *options);
void workload_close(Workload *workload);
// Passes the whole system to lib/physics again, as a script does in each frame, and simulates `steps` steps.
void workload_frame(Workload *workload, int steps);
const char *workload_name(WorkloadKind kind);
