// test_hilbert.c: the Hilbert curve along which patches are assigned to ranks (lib/ranks/domain_balance.c).
#include "../physics/support.h"
#include "ranks/domain.h"

// The curve visits every cell once, and each step leads to an adjacent cell. Of the 2^n equal parts of the cube, the
// curve completes one before it enters the next.
static void test_curve_visits_adjacent_cells(void **state) {
    (void)state;
    enum { LEVELS = 4, MAX_CELLS = 1 << 3 * LEVELS };
    static uint32_t visited[MAX_CELLS]; // by index: the cell, plus 1
    for (uint32_t n = 1; n <= 3; n++) {
        uint32_t side = 1 << LEVELS, count = 1u << n * LEVELS;
        memset(visited, 0, sizeof visited);
        for (uint32_t c = 0; c < count; c++) {
            uint32_t cell[3] = {c % side, c / side % side, c / side / side};
            uint64_t index = domain_hilbert_index(cell, n, LEVELS);
            assert_true(index < count);
            assert_int_equal(visited[index], 0);
            visited[index] = c + 1;
        }
        for (uint32_t i = 1; i < count; i++) {
            uint32_t from = visited[i - 1] - 1, to = visited[i] - 1;
            int steps = 0;
            for (uint32_t k = 0; k < n; k++, from /= side, to /= side)
                steps += abs((int)(from % side) - (int)(to % side));
            assert_int_equal(steps, 1);
        }
        for (uint32_t part = count >> n, i = 0; i < count; i++) {
            uint32_t first = visited[i / part * part] - 1, cell = visited[i] - 1;
            for (uint32_t k = 0; k < n; k++, first /= side, cell /= side)
                assert_int_equal(first % side / (side / 2), cell % side / (side / 2));
        }
    }
}

TEST_GROUP(hilbert) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_curve_visits_adjacent_cells)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
