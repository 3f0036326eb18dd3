// test_base_file.c: reading of whole files, file versions and paths.
#include "base/file.h"
#include "base/os.h"
#include "files.h"

#include <errno.h>

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

static void remove_files(const char *const *names, size_t count) {
    for (size_t i = 0; i < count; i++)
        assert_int_equal(remove(folder_file(&folder, names[i])), 0);
}

static int open_folder(const char *name) {
    return file_open_at(AT_FDCWD, folder_file(&folder, name), O_RDONLY | O_DIRECTORY, 0);
}

// Both ways to open a path below a folder, of which a system may have only the second.
static void test_open_below_follows_no_links(void **state) {
    (void)state;
    static const char *const good[] = {"file", "sub/file", "sub/deep/file"};
    static const char *const bad[] = {
        "link",          "out/secret", "sub/link", "sub/out/secret", "sub/deep/up/sub/file",
        "out/home/file", "dangling",   "loop",     "file/file"};
    static const char *const folders[] = {"home", "home/sub", "home/sub/deep", "away"};
    static const char *const links[][2] = {{"../away", "home/out"},           {"../away/secret", "home/link"},
                                           {"../../away", "home/sub/out"},    {"../file", "home/sub/link"},
                                           {"../..", "home/sub/deep/up"},     {"../home", "away/home"},
                                           {"../away/none", "home/dangling"}, {"loop", "home/loop"}};
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++)
        assert_int_equal(mkdir(folder_file(&folder, folders[i]), 0777), 0);
    for (size_t i = 0; i < sizeof links / sizeof links[0]; i++)
        assert_int_equal(symlink(links[i][0], folder_file(&folder, links[i][1])), 0);
    folder_write(&folder, "away/secret", "secret");
    folder_write(&folder, "home/file", "1");
    folder_write(&folder, "home/sub/file", "2");
    folder_write(&folder, "home/sub/deep/file", "3");
    for (size_t i = 0; i < sizeof good / sizeof good[0] + sizeof bad / sizeof bad[0]; i++) {
        bool wanted = i < sizeof good / sizeof good[0];
        const char *path = wanted ? good[i] : bad[i - sizeof good / sizeof good[0]];
        for (int flags = O_RDONLY; flags <= O_RDWR; flags += O_RDWR - O_RDONLY) {
            char rest[100];
            snprintf(rest, sizeof rest, "%s", path);
            int file = file_open_below(open_folder("home"), rest, flags | O_CREAT, 0666, flags == O_RDWR);
            assert_int_equal(file >= 0, wanted);
            if (file >= 0)
                close(file);
            int start = open_folder("home");
            file = os_open_below(start, path, flags);
            close(start);
            if (file >= 0)
                close(file);
            assert_int_equal(file >= 0, wanted && errno != ENOSYS);
            errno = 0;
        }
    }
    assert_false(file_exists(folder_file(&folder, "away/none")));
    for (size_t i = 0; i < sizeof links / sizeof links[0]; i++)
        remove_files(&links[i][1], 1);
    static const char *const left[] = {"home/sub/deep/file", "home/sub/deep", "home/sub/file", "home/sub",
                                       "home/file",          "home",          "away/secret",   "away"};
    remove_files(left, sizeof left / sizeof left[0]);
}

static void test_links_made_after_the_check_are_not_followed(void **state) {
    (void)state;
    assert_int_equal(mkdir(folder_file(&folder, "home"), 0777), 0);
    assert_int_equal(mkdir(folder_file(&folder, "home/sub"), 0777), 0);
    assert_int_equal(mkdir(folder_file(&folder, "away"), 0777), 0);
    folder_write(&folder, "away/file", "secret");
    folder_write(&folder, "home/sub/file", "mine");
    char resolved[PATH_MAX];
    FileAccess file_access = {.script_folder = file_access_folder(&arena, str_from(folder_file(&folder, "home")))};
    assert_true(file_access_resolve(&file_access, FILE_ACCESS_READ, folder_file(&folder, "home/sub/file"), resolved));
    int file = file_access_open(&file_access, resolved, O_RDONLY);
    assert_true(file >= 0);
    close(file);
    // What an attacker does between the check and the opening.
    char moved[600];
    snprintf(moved, sizeof moved, "%s", folder_file(&folder, "home/moved"));
    assert_int_equal(rename(folder_file(&folder, "home/sub"), moved), 0);
    assert_int_equal(symlink("../away", folder_file(&folder, "home/sub")), 0);
    char rest[] = "sub/file";
    assert_int_equal(file_open_below(open_folder("home"), rest, O_RDONLY, 0, false), -1);
    assert_int_equal(file_access_open(&file_access, folder_file(&folder, "home/sub/file"), O_RDONLY), -1);
    assert_int_equal(errno, EXDEV);
    static const char *const left[] = {"home/sub", "home/moved/file", "home/moved", "home", "away/file", "away"};
    remove_files(left, sizeof left / sizeof left[0]);
}

TEST_GROUP(base_file) {
    const struct CMUnitTest tests[] = {
        FILE_TEST(test_read_respects_limit),         FILE_TEST(test_version_changes_with_file),
        FILE_TEST(test_canonical_path_has_no_links), FILE_TEST(test_normalise_removes_dots),
        FILE_TEST(test_open_below_follows_no_links), FILE_TEST(test_links_made_after_the_check_are_not_followed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
