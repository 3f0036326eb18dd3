// test_base_replace.c: atomic replacement of files.
#include "base/file.h"
#include "base/os.h"
#include "base/replace.h"
#include "files.h"

#include <errno.h>
#include <fcntl.h>

static void check_content(const char *name, const char *text) {
    Str bytes;
    const char *problem;
    assert_true(file_read(&arena, NULL, folder_file(&folder, name), true, 1000, &bytes, NULL, &problem));
    assert_string_equal(bytes.bytes, text);
}

static int count_files(void) {
    int files = 0;
    DIR *entries = opendir(folder.path);
    for (struct dirent *entry; (entry = readdir(entries));)
        files += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(entries);
    return files;
}

static mode_t mode_of(const char *name) {
    struct stat info;
    assert_int_equal(lstat(folder_file(&folder, name), &info), 0);
    return info.st_mode;
}

// Both ways of creating the new file must behave alike.
static const unsigned ways[] = {0, REPLACE_NAMED};

static void test_file_is_replaced(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        assert_null(file_replace(folder_file(&folder, "new"), STR("one"), ways[i]));
        check_content("new", "one");
        assert_null(file_replace(folder_file(&folder, "new"), STR(""), ways[i]));
        check_content("new", "");
        assert_null(file_replace(folder_file(&folder, "new"), STR("a longer text"), ways[i]));
        check_content("new", "a longer text");
        assert_int_equal(count_files(), 1);
        assert_int_equal(unlink(folder_file(&folder, "new")), 0);
    }
    assert_string_equal(file_replace(folder_file(&folder, "no/folder"), STR("x"), 0), strerror(ENOENT));
    assert_string_equal(file_replace("", STR("x"), 0), strerror(ENOENT));
    errno = EINVAL; // errno of an unrelated earlier error
    assert_string_equal(file_replace(folder.path, STR("x"), 0), strerror(EISDIR));
}

static void test_permissions_are_kept(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        folder_write(&folder, "secret", "old");
        assert_int_equal(chmod(folder_file(&folder, "secret"), 0640), 0);
        assert_null(file_replace(folder_file(&folder, "secret"), STR("new"), ways[i]));
        assert_int_equal(mode_of("secret") & 07777, 0640);
    }
    mode_t mask = umask(027);
    assert_null(file_replace(folder_file(&folder, "fresh"), STR("new"), 0));
    umask(mask);
    assert_int_equal(mode_of("fresh") & 07777, 0640);
}

static void test_links_are_kept(void **state) {
    (void)state;
    folder_write(&folder, "target", "old");
    assert_int_equal(symlink("target", folder_file(&folder, "link")), 0);
    assert_null(file_replace(folder_file(&folder, "link"), STR("new"), 0));
    assert_true(S_ISLNK(mode_of("link")));
    check_content("target", "new");
    assert_int_equal(symlink("later", folder_file(&folder, "first")), 0);
    assert_int_equal(symlink("first", folder_file(&folder, "second")), 0);
    assert_null(file_replace(folder_file(&folder, "second"), STR("made"), 0));
    assert_true(S_ISLNK(mode_of("second")) && S_ISLNK(mode_of("first")));
    check_content("later", "made");
    assert_int_equal(symlink("round", folder_file(&folder, "round")), 0);
    assert_string_equal(file_replace(folder_file(&folder, "round"), STR("x"), 0), strerror(ELOOP));
    Replacement replacement; // unlike replace_begin, replace_begin_in does not follow links
    int open_folder = open(folder.path, O_RDONLY | O_DIRECTORY);
    assert_false(replace_begin_in(&replacement, open_folder, "link", 0));
    assert_int_equal(errno, ELOOP);
}

static void test_special_files_are_written_directly(void **state) {
    (void)state;
    assert_int_equal(mkfifo(folder_file(&folder, "pipe"), 0600), 0);
    int reader = open(folder_file(&folder, "pipe"), O_RDONLY | O_NONBLOCK);
    assert_null(file_replace(folder_file(&folder, "pipe"), STR("text"), 0));
    char got[8] = "";
    assert_int_equal(read(reader, got, sizeof got), 4);
    assert_memory_equal(got, "text", 4);
    close(reader);
    assert_true(S_ISFIFO(mode_of("pipe")));
    assert_int_equal(symlink("/dev/full", folder_file(&folder, "full")), 0);
    assert_string_equal(file_replace(folder_file(&folder, "full"), STR("x"), 0), strerror(ENOSPC));
    assert_null(file_replace("/dev/null", STR("x"), 0));
    struct stat info;
    assert_true(stat("/dev/null", &info) == 0 && S_ISCHR(info.st_mode));
    assert_true(stat("/dev/full", &info) == 0 && S_ISCHR(info.st_mode));
}

static void test_create_only_keeps_existing_file(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        assert_null(file_replace(folder_file(&folder, "new"), STR("one"), REPLACE_CREATE_ONLY | ways[i]));
        assert_string_equal(file_replace(folder_file(&folder, "new"), STR("two"), REPLACE_CREATE_ONLY | ways[i]),
                            strerror(EEXIST));
        check_content("new", "one");
        unlink(folder_file(&folder, "new"));
        // Another process creates the file first.
        Replacement replacement;
        assert_true(replace_begin(&replacement, folder_file(&folder, "new"), REPLACE_CREATE_ONLY | ways[i]));
        folder_write(&folder, "new", "theirs");
        assert_false(replace_commit(&replacement));
        assert_int_equal(errno, EEXIST);
        check_content("new", "theirs");
        assert_int_equal(count_files(), 1);
        unlink(folder_file(&folder, "new"));
    }
}

// Systems differ: temporary files may always have a name, and open files may have no locks (base/os.h).
static bool has_unnamed_files(void) {
    int start = open(folder.path, O_RDONLY | O_DIRECTORY), file = os_open_unnamed(start);
    close(start);
    if (file >= 0)
        close(file);
    return file >= 0;
}

static void test_abort_keeps_old_file(void **state) {
    (void)state;
    folder_write(&folder, "old", "old");
    for (int i = 0; i < 2; i++) {
        Replacement replacement;
        assert_true(replace_begin(&replacement, folder_file(&folder, "old"), ways[i]));
        assert_true(file_write(replacement.file, "half", 4));
        assert_int_equal(count_files(), i == 0 && has_unnamed_files() ? 1 : 2);
        replace_abort(&replacement);
        replace_abort(&replacement);
        check_content("old", "old");
        assert_int_equal(count_files(), 1);
    }
}

// Temporary files of killed processes are removed with the next replacement; locked ones are kept.
static void test_stale_files_are_removed(void **state) {
    (void)state;
    folder_write(&folder, "old", "old");
    folder_write(&folder, ".petri-0123456789abcdef.tmp", "left");
    folder_write(&folder, ".petri-0123456789abcdef.tmp.mine", "another's");
    folder_write(&folder, ".petri-fedcba9876543210.tmp", "of a running process");
    int file = open(folder_file(&folder, ".petri-fedcba9876543210.tmp"), O_RDONLY);
    if (!os_lock(file)) {
        assert_int_equal(errno, ENOTSUP);
        assert_null(file_replace(folder_file(&folder, "old"), STR("new"), 0));
        assert_int_equal(count_files(), 4); // nothing shows which files are stale
        close(file);
        return;
    }
    assert_null(file_replace(folder_file(&folder, "old"), STR("new"), 0));
    assert_int_equal(count_files(), 3);
    check_content(".petri-fedcba9876543210.tmp", "of a running process");
    close(file);
    assert_null(file_replace(folder_file(&folder, "another"), STR("new"), REPLACE_NAMED));
    assert_int_equal(count_files(), 3);
    check_content(".petri-0123456789abcdef.tmp.mine", "another's");
}

TEST_GROUP(base_replace) {
    const struct CMUnitTest tests[] = {
        FILE_TEST(test_file_is_replaced),
        FILE_TEST(test_permissions_are_kept),
        FILE_TEST(test_links_are_kept),
        FILE_TEST(test_special_files_are_written_directly),
        FILE_TEST(test_create_only_keeps_existing_file),
        FILE_TEST(test_abort_keeps_old_file),
        FILE_TEST(test_stale_files_are_removed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
