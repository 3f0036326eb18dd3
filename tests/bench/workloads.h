// workloads.h: the systems that are measured, those of the scripts that `petri` is compared with.
#ifndef TESTS_BENCH_WORKLOADS_H
#define TESTS_BENCH_WORKLOADS_H

#include "physics/system.h"

#include <stdint.h>

typedef enum WorkloadKind { DISH, BOX, GRAVITY, DISCS, SPHERES, CHARGES, WORKLOAD_KINDS } WorkloadKind;

// What a particle starts from. Between frames the bench keeps position and velocity here, as the scene does.
typedef struct Body {
    double position[3];
    double velocity[3];
    double radius;
    double mass;
    double charge;
} Body;

typedef struct Workload {
    WorkloadKind kind;
    uint32_t n;          // bodies, the dish's hub not counted
    uint32_t dimensions; // 2 or 3
    double delta;        // length of a step
    double clock;
    double width; // side of the box or radius of the dish
    uint64_t frame;
    Body *bodies;
    PhysSystem *system;
} Workload;

Workload workload_open(WorkloadKind kind, uint32_t n, const PhysOptions *options);
void workload_close(Workload *workload);
// Describes the system anew and simulates `steps` steps.
void workload_frame(Workload *workload, int steps);
const char *workload_name(WorkloadKind kind);

#endif
