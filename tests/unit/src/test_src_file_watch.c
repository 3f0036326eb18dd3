// test_src_file_watch.c: tests that each complete change on disk is reported once, however an editor saves the file.
#include "cli/file_watch.h"
#include "folder.h"

#include <poll.h>
#include <time.h>

enum { PATIENCE_MS = 20000, QUIET_MS = 300 };

#ifdef TEST_KQUEUE
enum { KNOWS_OPEN_FILES = false };
#else
enum { KNOWS_OPEN_FILES = true };
#endif

typedef struct Site {
    Folder folder;
    FileWatch *watch;
} Site;

static int site_open(void **state) {
    Site *site = calloc(1, sizeof *site);
    assert_non_null(site);
    folder_open(&site->folder);
    site->watch = file_watch_new();
    *state = site;
    return 0;
}

static int site_close(void **state) {
    Site *site = *state;
    file_watch_free(site->watch);
    folder_close(&site->folder);
    free(site);
    return 0;
}

static long milliseconds(void) {
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return time.tv_sec * 1000 + time.tv_nsec / 1000000;
}

// Waits for a report like a host, with poll if possible. Returns false if there is none within `limit` milliseconds.
static bool wait_changed(FileWatch *watch, long limit) {
    long end = milliseconds() + limit;
    for (long left = limit; left > 0; left = end - milliseconds()) {
        int descriptor = file_watch_descriptor(watch);
        struct pollfd wake = {.fd = descriptor, .events = POLLIN};
        poll(&wake, 1, (int)(descriptor < 0 ? 20 : left));
        if (file_watch_changed(watch))
            return true;
    }
    return false;
}

static void write_file(Folder *folder, const char *name, const char *text) {
    FILE *file = fopen(folder_file(folder, name), "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void test_unchanged_file_is_not_reported(void **state) {
    Site *site = *state;
    assert_false(file_watch_changed(site->watch));
    folder_write(&site->folder, "a.fl", "1");
    file_watch_add(site->watch, folder_file(&site->folder, "a.fl"));
    assert_false(wait_changed(site->watch, QUIET_MS));
    write_file(&site->folder, "b.fl", "a neighbour");
    assert_false(wait_changed(site->watch, QUIET_MS));
}

static void test_write_in_place_is_reported_once(void **state) {
    Site *site = *state;
    folder_write(&site->folder, "a.fl", "1");
    file_watch_add(site->watch, folder_file(&site->folder, "a.fl"));
    for (int i = 0; i < 3; i++) {
        folder_write(&site->folder, "a.fl", "2");
        assert_true(wait_changed(site->watch, PATIENCE_MS));
        assert_false(wait_changed(site->watch, QUIET_MS)); // the change is reported only once
    }
}

static void test_rename_is_reported_once(void **state) {
    Site *site = *state;
    char to[600];
    folder_write(&site->folder, "a.fl", "1");
    snprintf(to, sizeof to, "%s", folder_file(&site->folder, "a.fl"));
    file_watch_add(site->watch, to);
    for (int i = 0; i < 3; i++) {
        folder_write(&site->folder, "a.fl~", "22");
        assert_int_equal(rename(folder_file(&site->folder, "a.fl~"), to), 0);
        assert_true(wait_changed(site->watch, PATIENCE_MS));
        assert_false(wait_changed(site->watch, QUIET_MS));
    }
}

static void test_recreated_file_is_reported(void **state) {
    Site *site = *state;
    folder_write(&site->folder, "a.fl", "1");
    file_watch_add(site->watch, folder_file(&site->folder, "a.fl"));
    assert_int_equal(remove(folder_file(&site->folder, "a.fl")), 0);
    assert_false(wait_changed(site->watch, QUIET_MS));
    folder_write(&site->folder, "a.fl", "2");
    assert_true(wait_changed(site->watch, PATIENCE_MS));
}

// If a pipe replaces the file, it must not be reported, because opening it would block until a writer appears.
static void test_pipe_is_not_reported(void **state) {
    Site *site = *state;
    folder_write(&site->folder, "a.fl", "1");
    file_watch_add(site->watch, folder_file(&site->folder, "a.fl"));
    assert_int_equal(remove(folder_file(&site->folder, "a.fl")), 0);
    assert_int_equal(mkfifo(folder_file(&site->folder, "a.fl"), 0600), 0);
    assert_false(wait_changed(site->watch, QUIET_MS));
}

static void test_new_file_is_reported(void **state) {
    Site *site = *state;
    file_watch_add(site->watch, folder_file(&site->folder, "later.fl"));
    assert_false(wait_changed(site->watch, QUIET_MS));
    folder_write(&site->folder, "later.fl", "1");
    assert_true(wait_changed(site->watch, PATIENCE_MS));
}

static void test_file_in_recreated_folder_is_reported(void **state) {
    Site *site = *state;
    char folder[600], file[700];
    snprintf(folder, sizeof folder, "%s", folder_file(&site->folder, "inner"));
    snprintf(file, sizeof file, "%s/a.fl", folder);
    file_watch_add(site->watch, file);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(mkdir(folder, 0700), 0);
        folder_write(&site->folder, "inner/a.fl", "1");
        assert_true(wait_changed(site->watch, PATIENCE_MS));
        assert_int_equal(remove(file) | rmdir(folder), 0);
        assert_false(wait_changed(site->watch, QUIET_MS));
    }
}

// A change is not reported while its writer keeps the file open, even if it pauses for longer than usual.
static void test_open_file_is_reported_after_close(void **state) {
    Site *site = *state;
    if (!KNOWS_OPEN_FILES || file_watch_descriptor(site->watch) < 0)
        skip(); // kqueue and polling cannot detect that the file is still open
    folder_write(&site->folder, "a.fl", "1");
    file_watch_add(site->watch, folder_file(&site->folder, "a.fl"));
    FILE *file = fopen(folder_file(&site->folder, "a.fl"), "wb");
    assert_non_null(file);
    assert_true(fputs("!group", file) >= 0 && fflush(file) == 0);
    assert_false(wait_changed(site->watch, QUIET_MS));
    assert_true(fputs(" size=1\n", file) >= 0 && fclose(file) == 0);
    assert_true(wait_changed(site->watch, PATIENCE_MS));
    assert_false(wait_changed(site->watch, QUIET_MS));
}

static void test_target_of_link_is_watched(void **state) {
    Site *site = *state;
    Folder other;
    folder_open(&other);
    folder_write(&other, "target.fl", "1");
    assert_int_equal(symlink(folder_file(&other, "target.fl"), folder_file(&site->folder, "a.fl")), 0);
    file_watch_add(site->watch, folder_file(&site->folder, "a.fl"));
    folder_write(&other, "target.fl", "2");
    assert_true(wait_changed(site->watch, PATIENCE_MS));
    folder_close(&other);
}

static void test_several_changes_are_reported(void **state) {
    Site *site = *state;
    static const char *const names[] = {"a.fl", "b.fl", "c.fl"};
    for (int i = 0; i < 3; i++) {
        folder_write(&site->folder, names[i], "1");
        file_watch_add(site->watch, folder_file(&site->folder, names[i]));
        file_watch_add(site->watch, folder_file(&site->folder, names[i])); // adding a file again has no effect
    }
    for (int i = 0; i < 3; i++)
        folder_write(&site->folder, names[i], "2");
    assert_true(wait_changed(site->watch, PATIENCE_MS));
    while (wait_changed(site->watch, QUIET_MS)) // on a slow machine, the changes may be reported separately
        ;
    folder_write(&site->folder, names[1], "3");
    assert_true(wait_changed(site->watch, PATIENCE_MS));
}

static void test_free_ignores_null(void **state) {
    (void)state;
    file_watch_free(NULL);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_unchanged_file_is_not_reported, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_write_in_place_is_reported_once, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_rename_is_reported_once, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_recreated_file_is_reported, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_pipe_is_not_reported, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_new_file_is_reported, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_file_in_recreated_folder_is_reported, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_open_file_is_reported_after_close, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_target_of_link_is_watched, site_open, site_close),
        cmocka_unit_test_setup_teardown(test_several_changes_are_reported, site_open, site_close),
        cmocka_unit_test(test_free_ignores_null),
    };
    return cmocka_run_group_tests_name("watch", tests, NULL, NULL);
}
