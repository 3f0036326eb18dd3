// test_base_file.c: reading of whole files, file versions and paths.
#include "base/file.h"
#include "files.h"

static const char *content(const char *name, size_t limit) {
    Str bytes;
    const char *problem = NULL;
    if (!file_read(&arena, NULL, folder_file(&folder, name), false, limit, &bytes, NULL, &problem)) {
        assert_non_null(problem);
        return NULL;
    }
    assert_int_equal(bytes.bytes[bytes.len], 0); // the content is followed by a NUL byte
    return bytes.bytes;
}

static void test_read_respects_limit(void **state) {
    (void)state;
    folder_write(&folder, "a", "some text\n");
    assert_string_equal(content("a", 1000), "some text\n");
    assert_string_equal(content("a", 10), "some text\n");
    assert_null(content("a", 9)); // the file is larger than the limit
    folder_write(&folder, "empty", "");
    assert_string_equal(content("empty", 1000), "");
    assert_null(content("none", 1000));
    assert_null(content(".", 1000)); // a folder cannot be read
}

static void test_version_changes_with_file(void **state) {
    (void)state;
    Str first, second, third, read_version, bytes;
    const char *problem;
    folder_write(&folder, "a", "1");
    const char *path = folder_file(&folder, "a");
    assert_true(file_version(&arena, NULL, path, &first));
    assert_true(file_version(&arena, NULL, path, &second));
    assert_true(str_equal(first, second));
    assert_true(file_read(&arena, NULL, path, false, 100, &bytes, &read_version, &problem));
    assert_true(str_equal(first, read_version));
    folder_write(&folder, "a", "2");
    assert_true(file_version(&arena, NULL, folder_file(&folder, "a"), &third));
    assert_false(str_equal(first, third));
    assert_false(file_version(&arena, NULL, folder_file(&folder, "none"), &third));
}

static void test_canonical_path_has_no_links(void **state) {
    (void)state;
    folder_write(&folder, "a", "");
    char plain[600], dotted[800];
    snprintf(plain, sizeof plain, "%s", folder_file(&folder, "a"));
    snprintf(dotted, sizeof dotted, "%s/./../%s/a", folder.path, strrchr(folder.path, '/') + 1);
    Str straight = file_canonical(&arena, NULL, plain);
    assert_true(str_equal(file_canonical(&arena, NULL, dotted), straight));
    assert_int_equal(symlink(plain, folder_file(&folder, "link")), 0);
    assert_true(str_equal(file_canonical(&arena, NULL, folder_file(&folder, "link")), straight));
    assert_true(str_equal(file_canonical(&arena, NULL, "no/such/file"), STR("no/such/file")));
}

static void test_normalise_removes_dots(void **state) {
    (void)state;
    static const char *const rows[][2] = {
        {"a.fl", "a.fl"},   {"./a//b/", "a/b"}, {"a/../b", "b"},          {"a/b/../../c", "c"},  {"/a/./../b", "/b"},
        {"/../../a", "/a"}, {"../a", "../a"},   {"../../a", "../../a"},   {"a/../../b", "../b"}, {"", ""},
        {"/", "/"},         {"a/..", ""},       {"a..b/..c", "a..b/..c"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        char normal[PATH_MAX];
        assert_true(file_access_normalise(rows[i][0], normal));
        assert_string_equal(normal, rows[i][1]);
    }
    static char longest[PATH_MAX + 1];
    char normal[PATH_MAX];
    memset(longest, 'a', PATH_MAX);
    assert_false(file_access_normalise(longest, normal));
    longest[PATH_MAX - 1] = 0;
    assert_true(file_access_normalise(longest, normal));
    assert_string_equal(normal, longest);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        FILE_TEST(test_read_respects_limit),
        FILE_TEST(test_version_changes_with_file),
        FILE_TEST(test_canonical_path_has_no_links),
        FILE_TEST(test_normalise_removes_dots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
