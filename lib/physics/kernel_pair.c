// kernel_pair.c: chooses the kernels that compute all pairs of a pass, and lists all kernels of an instruction set.
#include "physics/kernel_pair.h"

static bool needs_contact(const PairTerm *term) {
    return phys_force_row(term->kind).reach == REACH_CONTACT;
}

// Returns the table of the kernels with fused_roots, or NULL. In one dimension there are none.
static const PairKernelTable *fused_table(size_t dimensions) {
#if LANES > 2
    return dimensions == 2 ? &PER_FUSED_ISA(pair_kernels_2d) : dimensions == 3 ? &PER_FUSED_ISA(pair_kernels_3d) : NULL;
#else
    (void)dimensions;
    return NULL;
#endif
}

static PairKernel *pair_kernel(const PairPass *pass, bool fused) {
    static const PairKernelTable *const tables[PHYS_VECTOR_DIMENSIONS] = {
        &PER_ISA(pair_kernels_1d), &PER_ISA(pair_kernels_2d), &PER_ISA(pair_kernels_3d)};
    const PairKernelTable *table = tables[pass->dimensions - 1];
    const PairTerm *first = pass->terms;
    int lead = needs_contact(first) || first->bound < INFINITY ? (int)LEAD_NONE : (int)first->kind;
    size_t others = lead != LEAD_NONE;
    PairRest rest = pass->term_count == others ? REST_NONE : REST_CONTACT;
    for (size_t t = others; t < pass->term_count; t++)
        if (!needs_contact(&pass->terms[t]))
            return (*table)[LEAD_NONE][REST_ANY];
    const PairKernelTable *with_fused = fused && lead != LEAD_NONE ? fused_table(pass->dimensions) : NULL;
    if (with_fused)
        return (*with_fused)[lead][rest];
    return (*table)[lead][rest];
}

const Kernels PER_ISA(phys_kernels) = {
    .lanes = LANES,
    .pair = pair_kernel,
    .list_refresh = PER_ISA(list_refresh),
    .list_search = PER_ISA(list_search),
    .write_rows = PER_ISA(write_rows),
    .list_forces = PER_ISA(list_forces),
    .range_forces = PER_ISA(range_forces),
    .integrate = PER_ISA(integrate_all),
    .far = &PER_ISA(far_kernels),
};
