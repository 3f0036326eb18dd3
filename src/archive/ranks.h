// ranks.h: verification of an archive by the processes that mpirun has started (MpiChannel).
#pragma once

#include "archive/segments.h"

// Gives all ranks the segments that rank 0 has chosen. Each rank then verifies its part of them.
void ranks_divide(Verification *verification);
// Returns true on rank 0, and without mpirun.
bool ranks_is_first(const Verification *verification);
// Combines the results of all ranks on rank 0. The ranks above 0 then have none.
void ranks_combine(Verification *verification);
