// pair_tiles.h: computes all pairs of a pass in tiles of LANES x LANES. Only tiles on the diagonal compute pairs twice.
//
// A tile has LANES targets in the lanes (its rows) and processes LANES partners (its columns) one after the other. The
// terms are added to the rows' sums immediately, in ascending order of partners. Then the tile is transposed, and the
// terms are subtracted from the columns' sums in ascending order of rows. Tiles are processed row by row, so every
// particle sums its partners in ascending order, as in pair_rows.c.
#pragma once

#include "physics/fused_roots.h"
#include "physics/kernel_pair.h"

// The rows of a tile.
typedef struct Rows {
    PairEnd target;
    Mask live;
    Mask lead; // rows on which the leading force (pair_geometry.h) can act
    Real sum[PHYS_VECTOR_DIMENSIONS];
} Rows;

// Adds all forces between the rows and one column, which is number k in its tile. The leading force can act on the rows
// in `lead`. If `lead_applies` is set, it is known to act on the column; otherwise this is tested. `tile` receives the
// terms to subtract from the sum of the column; NULL: they are not needed.
KERNEL void add_forces(const PairPass *pass, PairShape shape, Rows *rows, const PairEnd *partner,
                       const PairGeometry *pair, Mask lead, bool lead_applies, Tile *tile, size_t k) {
    const PairEnd *target = &rows->target;
    if (shape.lead != LEAD_NONE) {
        Pairs pairs = {&pass->terms[0], pair, target, partner, pair->valid, false, false};
        Mask applies = pair->valid & lead;
        if (!lead_applies)
            applies = real_differs_where(applies, pair_source(lead_need(shape), partner), real_zero());
        Real coefficient = lead_coefficient(shape, &pairs);
        add_term(shape, pair, applies, coefficient, rows->sum, tile ? tile->lead : NULL, k);
    }
    if (shape.rest != REST_NONE)
        add_rest(pass, shape, pair, target, partner, rows->sum, tile, k);
}

// Adds all forces between the `live` rows and column j, like add_forces.
KERNEL void add_column(const PairPass *pass, PairShape shape, Rows *rows, Mask live, size_t j, bool lead_applies,
                       Tile *tile, size_t k) {
    PairEnd partner = pair_partner(pass, shape, j);
    PairGeometry pair;
    if (pair_geometry(shape, &rows->target, &partner, live, &pair))
        add_forces(pass, shape, rows, &partner, &pair, rows->lead, lead_applies, tile, k);
}

// Returns all lanes but lane k.
KERNEL Mask lanes_except(size_t k) {
    return mask_not(mask_first(k + 1) & mask_not(mask_first(k)));
}

#if FUSED
// Like add_column for columns j and j + 1, by fused_roots. The leading force must act on all rows and columns.
// `diagonal`: each column is also row k, or k + 1, which is excluded. Returns the lanes of `exact` in which the results
// are exact. All masks are constants, so this needs fewer operations than add_column.
KERNEL Mask add_fused(const PairPass *pass, PairShape shape, Rows *rows, bool diagonal, size_t j, Tile *tile, size_t k,
                      Mask exact) {
    const Mask all = mask_first(LANES);
    PairEnd partner[2];
    PairGeometry pair[2];
    Real square[2], length[2], inverse[2];
    for (size_t c = 0; c < 2; c++) {
        partner[c] = pair_partner(pass, shape, j + c);
        square[c] = pair_square(shape, &rows->target, &partner[c], &pair[c]);
        pair[c].valid = diagonal ? lanes_except(k + c) : all; // root_is_exact_where rejects all other invalid pairs
        if (diagonal)
            square[c] = real_select(pair[c].valid, square[c], real_set(2)); // any number that is not rejected
        exact = root_is_exact_where(exact, square[c]);
    }
    fused_roots(2, square, length, inverse);
    for (size_t c = 0; c < 2; c++) {
        pair[c].length = length[c];
        pair_direct(shape, inverse[c], &pair[c]);
    }
    // One branch for both columns, because most columns have no contacts, and branches separate their instructions.
    bool contact = shape.rest != REST_NONE && mask_any(pair_in_contact(&pair[0]) | pair_in_contact(&pair[1]));
    if (__builtin_expect(!contact, 1))
        shape.rest = REST_NONE;
    if (shape.rest == REST_NONE)
        for (size_t c = 0; c < 2; c++)
            add_forces(pass, shape, rows, &partner[c], &pair[c], all, true, tile, k + c);
    else
        for (size_t c = 0; c < 2; c++)
            add_forces(pass, shape, rows, &partner[c], &pair[c], all, true, tile, k + c);
    return exact;
}

// Adds the forces between LANES rows and columns by add_fused. Returns false if that is not possible, or not exact in
// all lanes; then only the terms in `tile` have changed. The leading force must act on all columns.
KERNEL bool add_all_fused(const PairPass *pass, PairShape shape, Rows *rows, bool diagonal, size_t j, Tile *tile) {
    if (mask_bits(rows->lead) != ALL_LANES)
        return false;
    Real sum[PHYS_VECTOR_DIMENSIONS];
    for (size_t m = 0; m < shape.dimensions; m++)
        sum[m] = rows->sum[m];
    Mask exact = mask_first(LANES);
#pragma GCC unroll 4
    for (size_t k = 0; k < LANES; k += 2)
        exact = add_fused(pass, shape, rows, diagonal, j + k, tile, k, exact);
    if (__builtin_expect(mask_bits(exact) == ALL_LANES, 1))
        return true;
    for (size_t m = 0; m < shape.dimensions; m++)
        rows->sum[m] = sum[m];
    return false;
}
#endif

// Subtracts component m of the terms of all forces from the columns' sums in *total. The order is row by row, and
// within a row the order of the forces.
static void finish_mixed(const PairPass *pass, Tile *tile, bool lead, size_t m, Real *total) {
    Real(*terms[PHYS_MAX_TERMS])[LANES]; // of the forces that have written to `rest`
    size_t count = 0;
    for (size_t t = 0; t < pass->term_count; t++)
        if (tile->hits >> t & 1) {
            terms[count] = &tile->rest[t][m];
            real_transpose(*terms[count++]);
        }
    Real sum = *total;
    for (size_t k = 0; k < LANES; k++) {
        if (lead)
            sum -= tile->lead[m][k];
        for (size_t t = 0; t < count; t++)
            sum -= (*terms[t])[k];
    }
    *total = sum;
}

// Subtracts the terms of a tile from the columns' sums.
KERNEL void finish_tile(const PairPass *pass, PairShape shape, Tile *tile, size_t j, size_t columns) {
    bool lead = shape.lead != LEAD_NONE, mixed = shape.rest != REST_NONE && tile->hits;
    if (!lead && !mixed)
        return;
    for (size_t m = 0; m < shape.dimensions; m++) {
        double *force = pass->force + m * pass->stride + j;
        Real total = real_load(force);
        if (lead)
            real_transpose(tile->lead[m]);
        if (mixed) {
            finish_mixed(pass, tile, lead, m, &total);
        } else {
#pragma GCC unroll 8
            for (size_t k = 0; k < LANES; k++)
                total -= tile->lead[m][k];
        }
        if (columns == LANES)
            real_store(force, total);
        else
            real_store_where(mask_first(columns), force, total);
    }
}

// Returns true if the leading force acts on all LANES columns from `j`.
KERNEL bool lead_acts_on_all(const PairPass *pass, PairShape shape, size_t j) {
    ForceNeed need = lead_need(shape);
    if (need == NEED_NOTHING)
        return true;
    const double *sources = need == NEED_MASS ? pass->mass : need == NEED_CHARGE ? pass->charge : pass->radius;
    Real source = real_load(sources + j);
    return mask_bits(real_differs_where(mask_first(LANES), source, real_zero())) == (1u << LANES) - 1;
}

// Computes a tile of LANES columns on which the leading force acts. Returns false, without an effect, if fused_roots is
// not exact. Then partial_tile must be used. The tile must not have variable indices, so that it is in registers.
KERNEL bool full_tile(const PairPass *pass, PairShape shape, Rows *rows, size_t j) {
    Tile tile;
    tile.hits = 0;
#if FUSED
    if (!add_all_fused(pass, shape, rows, false, j, &tile))
        return false;
#else
#pragma GCC unroll 8
    for (size_t k = 0; k < LANES; k++)
        add_column(pass, shape, rows, rows->live, j + k, true, &tile, k);
#endif
    finish_tile(pass, shape, &tile, j, LANES);
    return true;
}

// Computes any tile: it may have fewer than LANES columns, or columns on which the leading force does not act.
KERNEL void partial_tile(const PairPass *pass, PairShape shape, Rows *rows, size_t j, size_t columns) {
    Tile tile;
    tile.hits = 0;
    if (shape.lead != LEAD_NONE)
        clear_terms(shape.dimensions, tile.lead);
    for (size_t k = 0; k < columns; k++)
        add_column(pass, shape, rows, rows->live, j + k, false, &tile, k);
    finish_tile(pass, shape, &tile, j, columns);
}

// Computes a tile on the diagonal, in which each particle is both a row and a column. So each pair is computed twice,
// and only the sums of the rows are needed.
KERNEL void diagonal_tile(const PairPass *pass, PairShape shape, Rows *rows, size_t i, size_t count) {
#if FUSED
    if (add_all_fused(pass, shape, rows, true, i, NULL)) // then all rows exist
        return;
#endif
    for (size_t k = 0; k < count; k++)
        add_column(pass, shape, rows, rows->live & lanes_except(k), i + k, false, NULL, 0);
}

// Computes up to LANES rows with all their columns. In a triangle, the diagonal tile comes first, then the columns to
// its right.
KERNEL void tile_row(const PairPass *pass, PairShape shape, size_t i, size_t count, size_t column, size_t column_end,
                     bool triangle) {
    Rows rows = {.target = pair_targets(pass, shape, i), .live = mask_first(count)};
    rows.lead = real_differs_where(rows.live, pair_source(lead_need(shape), &rows.target), real_zero());
    for (size_t m = 0; m < shape.dimensions; m++)
        rows.sum[m] = real_load(pass->force + m * pass->stride + i);
    if (triangle)
        diagonal_tile(pass, shape, &rows, i, count);
    size_t j = triangle ? i + count : column;
    for (; j < column_end; j += LANES)
        if (j + LANES > column_end || !lead_acts_on_all(pass, shape, j) || !full_tile(pass, shape, &rows, j))
            partial_tile(pass, shape, &rows, j, column_end - j < LANES ? column_end - j : LANES);
    for (size_t m = 0; m < shape.dimensions; m++)
        real_store_where(rows.live, pass->force + m * pass->stride + i, rows.sum[m]);
}

KERNEL void tile_rows(const PairPass *pass, PairShape shape, size_t row, size_t row_end, size_t column,
                      size_t column_end, bool triangle) {
    for (size_t i = row; i < row_end && !phys_pass_stopped(pass); i += LANES)
        tile_row(pass, shape, i, row_end - i < LANES ? row_end - i : LANES, column, column_end, triangle);
}

// The kernels. Lead and rest are constants in each, and the file that defines them defines DIMENSIONS.
#define PAIR_KERNEL_OF(n, name, lead, rest)                                                                            \
    static void kernel_##n##d_##name##rest(const PairPass *pass, bool triangle, size_t row, size_t row_end,            \
                                           size_t column, size_t column_end) {                                         \
        tile_rows(pass, (PairShape){n, lead, rest, false}, row, row_end, column, column_end, triangle);                \
    }
#define PAIR_ENTRY_OF(n, name, lead, rest) [lead][rest] = kernel_##n##d_##name##rest,
#define PAIR_IN(OF, n, name, lead, rest) OF(n, name, lead, rest) // n: the value of DIMENSIONS
#define PAIR_KERNEL(name, lead, rest) PAIR_IN(PAIR_KERNEL_OF, DIMENSIONS, name, lead, rest)
#define PAIR_ENTRY(name, lead, rest) PAIR_IN(PAIR_ENTRY_OF, DIMENSIONS, name, lead, rest)

// Every force whose range can be unlimited has kernels in which it is the lead.
#define LEAD_CONTACT(MAKE, KIND)
#define LEAD_FAR(MAKE, KIND)                                                                                           \
    MAKE(KIND, PHYS_##KIND, REST_NONE)                                                                                 \
    MAKE(KIND, PHYS_##KIND, REST_CONTACT)
#define LEAD_INVERSE_SQUARE(MAKE, KIND) LEAD_FAR(MAKE, KIND)
#define LEADERLESS(MAKE)                                                                                               \
    MAKE(NONE, LEAD_NONE, REST_CONTACT)                                                                                \
    MAKE(NONE, LEAD_NONE, REST_ANY)
#define LEAD_KERNELS(KIND, name, SIGN, SOURCE, REACH) LEAD_##REACH(PAIR_KERNEL, KIND)
#define LEAD_ENTRIES(KIND, name, SIGN, SOURCE, REACH) LEAD_##REACH(PAIR_ENTRY, KIND)

// Defines `table` and its kernels. Kernels with fused_roots exist only for forces without a range.
#if FUSED
#define DEFINE_PAIR_KERNELS(table)                                                                                     \
    PHYS_FORCES(LEAD_KERNELS, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)                                                   \
    const PairKernelTable PER_FUSED_ISA(table) = {PHYS_FORCES(LEAD_ENTRIES, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)};
#else
#define DEFINE_PAIR_KERNELS(table)                                                                                     \
    PHYS_FORCES(LEAD_KERNELS, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)                                                   \
    LEADERLESS(PAIR_KERNEL)                                                                                            \
    const PairKernelTable PER_ISA(table) = {PHYS_FORCES(LEAD_ENTRIES, PHYS_NO_ROW, PHYS_NO_ROW, PHYS_NO_ROW)           \
                                                LEADERLESS(PAIR_ENTRY)};
#endif
