// noise.c: the noise functions: seeds, permutations, grids of coordinates and octaves (spec builtins.md B10.2, B10.3,
// B10.11).
#include "builtin/noise.h"

#include "builtin/family.h"
#include "maths/random.h"
#include "value/value_hash.h"

#include <math.h>
#include <string.h>

enum { MAX_NOISE_DIMS = 4 };

// --- permutations (B10.3)

enum { CACHE_SLOTS = 64 }; // the slots need 17 KiB; a permutation that was evicted is computed again

typedef struct Permutation {
    uint64_t key;
    bool known;
    uint8_t values[256];
} Permutation;

struct NoiseCache {
    Arena arena; // owns the cache itself
    Permutation slots[CACHE_SLOTS];
};

NoiseCache *noise_cache_new(void) {
    Arena arena;
    arena_init(&arena, "noise", SIZE_MAX);
    NoiseCache *cache = arena_try_alloc(&arena, sizeof *cache);
    if (!cache)
        return NULL;
    memset(cache, 0, sizeof *cache);
    cache->arena = arena;
    return cache;
}

void noise_cache_free(NoiseCache *cache) {
    if (!cache)
        return;
    Arena arena = cache->arena; // copied, because freeing the arena frees the cache
    arena_free(&arena);
}

// Sets `values` to the numbers 0 to 255, shuffled by the uniform stream of this key.
static void permutation_make(uint64_t key, uint8_t values[256]) {
    for (unsigned i = 0; i < 256; i++)
        values[i] = (uint8_t)i;
    for (unsigned i = 0; i < 255; i++) {
        unsigned j = i + (unsigned)(random_uniform(key, i) * (256 - i));
        j = j < 255 ? j : 255;
        uint8_t moved = values[i];
        values[i] = values[j];
        values[j] = moved;
    }
}

// Returns the permutation of a key: from the cache or, without a cache, computed in `local`.
static const uint8_t *permutation_get(NoiseCache *cache, uint64_t key, uint8_t local[256]) {
    if (!cache) {
        permutation_make(key, local);
        return local;
    }
    Permutation *slot = &cache->slots[random_hash_step(key, 0) % CACHE_SLOTS];
    if (!slot->known || slot->key != key) {
        permutation_make(key, slot->values);
        slot->key = key;
        slot->known = true;
    }
    return slot->values;
}

// --- the functions

// The coordinates of a call. Noise is computed at each combination of one element per axis.
typedef struct NoiseGrid {
    const double *axes[MAX_NOISE_DIMS];
    uint32_t lens[MAX_NOISE_DIMS];
    int dims;
    uint32_t len; // number of combinations
} NoiseGrid;

typedef enum GridOutcome { GRID_OK, GRID_BAD, GRID_TOO_LONG } GridOutcome;

// Reads one to four numeric vectors, which are the axes. If there is only one, the second coordinate is 0 (B10.2).
static GridOutcome grid_read(NoiseGrid *grid, const Value *args, uint32_t count) {
    static const double zero[1] = {0};
    if (count < 1 || count > MAX_NOISE_DIMS)
        return GRID_BAD;
    uint64_t len = 1;
    for (uint32_t i = 0; i < count; i++) {
        if (!value_is_numeric(args[i]))
            return GRID_BAD;
        grid->axes[i] = value_numbers(&args[i]);
        grid->lens[i] = args[i].len;
        len = len > VALUE_MAX_LEN ? len : len * args[i].len; // cannot overflow 64 bits
    }
    if (count == 1) {
        grid->axes[1] = zero;
        grid->lens[1] = 1;
    }
    grid->dims = count == 1 ? 2 : (int)count;
    grid->len = (uint32_t)len;
    return len > VALUE_MAX_LEN ? GRID_TOO_LONG : GRID_OK;
}

// For each combination j of the coordinates, sets result[j] to the noise. If `add` is true, instead adds noise*weight
// to result[j]. The last coordinate varies fastest.
static void grid_noise(Arena *arena, const NoiseGrid *grid, const uint8_t *permutation, double *result, bool add,
                       double weight) {
    enum { CHARGE_INTERVAL = 1024 };
    const unsigned work = grid->dims == 2 ? 4 : grid->dims == 3 ? 10 : 30; // work units per point
    double (*const noise)(const uint8_t *, const double *) = grid->dims == 2   ? noise_point_2
                                                             : grid->dims == 3 ? noise_point_3
                                                                               : noise_point_4;
    uint32_t at[MAX_NOISE_DIMS] = {0};
    double c[MAX_NOISE_DIMS];
    for (int i = 0; i < grid->dims; i++)
        c[i] = grid->axes[i][0];
    for (uint32_t j = 0; j < grid->len; j++) {
        if (j % CHARGE_INTERVAL == 0)
            arena_charge(arena, (grid->len - j < CHARGE_INTERVAL ? grid->len - j : CHARGE_INTERVAL) * (uint64_t)work);
        double part = noise(permutation, c);
        result[j] = add ? result[j] + part * weight : part;
        int i = grid->dims - 1;
        while (i >= 0 && ++at[i] == grid->lens[i]) {
            at[i] = 0;
            c[i] = grid->axes[i][0];
            i--;
        }
        if (i >= 0)
            c[i] = grid->axes[i][at[i]];
    }
}

// Multiplies every coordinate by 2. If `own` is true, the arrays belong to the grid and are changed. Otherwise the grid
// gets new arrays.
static void grid_double(Arena *arena, NoiseGrid *grid, bool own) {
    for (int i = 0; i < grid->dims; i++) {
        double *axis = own ? (double *)grid->axes[i] : arena_alloc_array(arena, grid->lens[i], sizeof *axis);
        for (uint32_t k = 0; k < grid->lens[i]; k++)
            axis[k] = grid->axes[i][k] * 2;
        grid->axes[i] = axis;
    }
}

Value builtin_noise(BuiltinContext *context, const Value *args, uint32_t count) {
    uint8_t local[256];
    if (count == 3 && value_is_number(args[1]) && value_is_number(args[2])) { // a single point, the usual case in loops
        const double c[2] = {args[1].as.number, args[2].as.number};
        return value_number(
            noise_point_2(permutation_get(context->noise, value_seed_hash(context->arena, args[0]), local), c));
    }
    NoiseGrid grid;
    GridOutcome outcome = grid_read(&grid, args + 1, count - 1);
    if (outcome != GRID_OK)
        return outcome == GRID_TOO_LONG ? builtin_too_long(context, "noise") : VALUE_NULL;
    const uint8_t *permutation = permutation_get(context->noise, value_seed_hash(context->arena, args[0]), local);
    double single, *result = grid.len == 1 ? &single : arena_alloc_array(context->arena, grid.len, sizeof *result);
    grid_noise(context->arena, &grid, permutation, result, false, 1);
    return value_numbers_view(result, grid.len);
}

void builtin_noise_points(BuiltinContext *context, Value seed, const double *x, const double *y, uint32_t count,
                          double *to) {
    enum { MIN_POINTS = 16 };             // minimum number of points for which arrays are faster
    const double MAX_COORDINATE = 0x1p45; // arrays require smaller coordinates
    uint8_t local[256];
    const uint8_t *permutation = permutation_get(context->noise, value_seed_hash(context->arena, seed), local);
    if (count < MIN_POINTS) {
        for (uint32_t i = 0; i < count; i++)
            to[i] = noise_point_2(permutation, (double[2]){x[i], y[i]});
        return;
    }
    const PlaneNoise plane = noise_plane();
    maths_arrays(cpu_detected.level)->plane_noise(&plane, permutation, x, y, count, to);
    for (uint32_t i = 0; i < count; i++)
        if (!(fabs(x[i]) < MAX_COORDINATE && fabs(y[i]) < MAX_COORDINATE))
            to[i] = noise_point_2(permutation, (double[2]){x[i], y[i]});
}

// A coordinate overflows after about 1000 doublings, so a larger number of octaves must be a mistake.
enum { MAX_OCTAVES = 1024 };

// Sums octaves of noise (B10.11): r = noise(c), then r = r + noise(c*2^o)*k^o for o = 1, 2, ... Divides the sum by the
// total weight.
static void sum_octaves(BuiltinContext *context, NoiseGrid *grid, uint64_t seed, uint32_t octaves, double k,
                        double *result) {
    uint8_t local[256];
    double weight = 1, total = 0;
    ArenaMark scratch = arena_mark(context->arena);
    // After the weight underflows to 0, further octaves add nothing.
    for (uint32_t o = 0; o < octaves && weight != 0; o++) {
        if (o > 0)
            grid_double(context->arena, grid, o > 1);
        grid_noise(context->arena, grid, permutation_get(context->noise, seed ^ o, local), result, o > 0, weight);
        total = total + weight;
        weight = weight * k;
    }
    for (uint32_t j = 0; j < grid->len; j++)
        result[j] = result[j] / total;
    arena_rewind(context->arena, scratch);
}

Value builtin_octnoise(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_number(args[1]) || !value_is_number(args[2]))
        return VALUE_NULL;
    double octaves = trunc(args[1].as.number);
    NoiseGrid grid;
    GridOutcome outcome = grid_read(&grid, args + 3, count - 3);
    if (!(octaves > 0) || outcome == GRID_BAD)
        return VALUE_NULL;
    if (outcome == GRID_TOO_LONG)
        return builtin_too_long(context, "octnoise");
    if (octaves > MAX_OCTAVES)
        return builtin_error(context, "octnoise", "too many octaves: the limit is 1024");
    double single, *result = grid.len == 1 ? &single : arena_alloc_array(context->arena, grid.len, sizeof *result);
    sum_octaves(context, &grid, value_seed_hash(context->arena, args[0]), (uint32_t)octaves, args[2].as.number, result);
    return value_numbers_view(result, grid.len);
}
