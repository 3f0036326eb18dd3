// test_base_host_struct.c: structs of hosts that know fewer or more fields than the library.
#include "base/host_struct.h"
#include "check.h"

// Versions of one struct.
typedef struct Old {
    size_t size;
    int a;
    int b;
} Old;
typedef struct Current {
    size_t size;
    int a;
    int b;
    double c;
} Current;
typedef struct New {
    size_t size;
    int a;
    int b;
    double c;
    const char *d;
} New;

static const Current defaults = {.size = sizeof defaults, .a = 1, .b = 2, .c = 3};

static void assert_current(const Current *found, int a, int b, double c) {
    assert_int_equal(found->size, sizeof *found);
    assert_int_equal(found->a, a);
    assert_int_equal(found->b, b);
    assert_number("c", found->c, c);
}

static void test_reads_shorter_structs_with_defaults(void **state) {
    (void)state;
    Current found = defaults;
    assert_true(host_struct_read(&found, sizeof found, &(Current){sizeof found, 10, 20, 30}));
    assert_current(&found, 10, 20, 30);
    found = defaults;
    assert_true(host_struct_read(&found, sizeof found, &(Old){sizeof(Old), 10, 20}));
    assert_current(&found, 10, 20, 3);
    found = defaults;
    assert_true(host_struct_read(&found, sizeof found, &(Old){offsetof(Old, b), 10, 20}));
    assert_current(&found, 10, 2, 3);
    found = defaults;
    assert_true(host_struct_read(&found, sizeof found, &(size_t){sizeof(size_t)}));
    assert_current(&found, 1, 2, 3);
}

static void test_reads_longer_structs_unless_unknown_fields_are_set(void **state) {
    (void)state;
    Current found = defaults;
    assert_true(host_struct_read(&found, sizeof found, &(New){sizeof(New), 10, 20, 30, NULL}));
    assert_current(&found, 10, 20, 30);
    found = defaults;
    assert_false(host_struct_read(&found, sizeof found, &(New){sizeof(New), 10, 20, 30, "set"}));
    assert_current(&found, 1, 2, 3);
}

static void test_rejects_structs_without_a_size(void **state) {
    (void)state;
    static const size_t sizes[] = {0, sizeof(size_t) - 1, MAX_HOST_STRUCT_SIZE + 1, SIZE_MAX};
    static union {
        Current current;
        char bytes[MAX_HOST_STRUCT_SIZE];
    } given;
    Current found = defaults;
    for (size_t i = 0; i < COUNT_OF(sizes); i++) {
        given.current.size = sizes[i];
        assert_false(host_struct_read(&found, sizeof found, &given));
    }
    assert_false(host_struct_read(&found, sizeof found, NULL));
    assert_current(&found, 1, 2, 3);
}

static void test_writes_what_the_host_knows(void **state) {
    (void)state;
    Current found = {.a = 7, .b = 7, .c = 7};
    assert_true(host_struct_write(&found, offsetof(Current, b), &defaults, sizeof defaults));
    assert_current(&found, 1, 7, 7);
    assert_true(host_struct_write(&found, sizeof found, &defaults, sizeof defaults));
    assert_current(&found, 1, 2, 3);
    New newer = {.d = "set"};
    assert_true(host_struct_write(&newer, sizeof newer, &defaults, sizeof defaults));
    assert_number("c", newer.c, 3);
    assert_null(newer.d);
    assert_true(host_struct_write(&found, 0, &defaults, sizeof defaults));
    assert_false(host_struct_write(NULL, sizeof found, &defaults, sizeof defaults));
}

TEST_GROUP(base_host_struct) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reads_shorter_structs_with_defaults),
        cmocka_unit_test(test_reads_longer_structs_unless_unknown_fields_are_set),
        cmocka_unit_test(test_rejects_structs_without_a_size),
        cmocka_unit_test(test_writes_what_the_host_knows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
