// files.h: fixture with an arena and a temporary folder for each test declared with FILE_TEST(function).
#pragma once

#include "base/arena.h"
#include "folder.h"

static Arena arena;
static Folder folder;

static int setup(void **state) {
    (void)state;
    arena_init(&arena, "test", SIZE_MAX);
    folder_open(&folder);
    return 0;
}

static int teardown(void **state) {
    (void)state;
    folder_close(&folder);
    arena_free(&arena);
    return 0;
}

#define FILE_TEST(function) cmocka_unit_test_setup_teardown(function, setup, teardown)
