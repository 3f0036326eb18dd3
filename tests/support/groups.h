// groups.h: the test program of a library. Each of its files defines one group of tests, and groups.c runs them:
//
//   TEST_GROUP(state_views) {
//       const struct CMUnitTest tests[] = {...};
//       return cmocka_run_group_tests(tests, NULL, NULL);
//   }
#pragma once

// The exit status of tests that cannot run here.
enum { GROUP_SKIPPED = 77 };

// Defines the function that runs a group. It returns the exit status: 0, the number of failures or GROUP_SKIPPED.
// argv[0] is the name of the group, and the arguments of the test follow.
#define TEST_GROUP(name)                                                                                               \
    int group_##name(int argc, char **argv);                                                                           \
    int group_##name(__attribute__((unused)) int argc, __attribute__((unused)) char **argv)
