// roots_isa.c: see roots_isa.h.
#include "roots_isa.h"

#include "physics/fused_roots.h"

static bool same_bits(double a, double b) {
    return memcmp(&a, &b, sizeof a) == 0;
}

size_t PER_ISA(check_roots)(const double *squares, size_t count, uint64_t *excluded) {
    for (size_t i = 0; i < count; i += LANES) {
        Real square[2] = {real_load(squares + i), real_load(squares + (i + LANES) % count)}, root[2], inverse[2];
        Lanes exact = mask_bits(root_is_exact_where(mask_first(LANES), square[0]));
        fused_roots(2, square, root, inverse);
        double roots[LANES], inverses[LANES];
        real_store(roots, root[0]);
        real_store(inverses, inverse[0]);
        for (size_t lane = 0; lane < LANES; lane++) {
            double right = sqrt(squares[i + lane]);
            if (!(exact >> lane & 1))
                ++*excluded;
            else if (!same_bits(roots[lane], right) || !same_bits(inverses[lane], 1 / right))
                return i + lane;
        }
    }
    return count;
}
