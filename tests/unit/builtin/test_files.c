// test_files.c: the file functions, with temporary files (spec builtins.md B13).
#include "expression.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct Place {
    World *world;
    char directory[64];
} Place;

static void write_bytes(const Place *place, const char *name, const char *bytes, size_t len) {
    char path[200];
    snprintf(path, sizeof path, "%s/%s", place->directory, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, len, file), len);
    assert_int_equal(fclose(file), 0);
}

static void write_file(const Place *place, const char *name, const char *text) {
    write_bytes(place, name, text, strlen(text));
}

static void make_directory(const Place *place, const char *name) {
    char path[200];
    snprintf(path, sizeof path, "%s/%s", place->directory, name);
    assert_int_equal(mkdir(path, 0700), 0);
}

static int place_setup(void **state) {
    static Place place;
    // /tmp may be a symbolic link, and glob resolves links.
    strcpy(place.directory, "/tmp/petri-test-XXXXXX");
    assert_non_null(mkdtemp(place.directory));
    char resolved[4096];
    assert_non_null(realpath(place.directory, resolved));
    assert_true(strlen(resolved) < sizeof place.directory);
    strcpy(place.directory, resolved);
    place.world = world_new();
    place.world->context.directory = str_from(place.directory);
    *state = &place;
    return 0;
}

static int place_teardown(void **state) {
    Place *place = *state;
    char command[100];
    snprintf(command, sizeof command, "rm -r '%s'", place->directory);
    world_free(place->world);
    return system(command);
}

// Returns how many errors an expression reports.
static uint32_t errors_of(World *world, const char *text) {
    world->errors = 0;
    evaluate(world, text);
    arena_reset(&world->frame);
    return world->errors;
}

static void test_read_returns_contents(void **state) {
    Place *place = *state;
    write_file(place, "plain.txt", "h\xc3\xa9llo\nthere\n");
    write_file(place, "lines.txt", "a\r\nb\rc\r\r\n\n");
    write_file(place, "empty.txt", "");
    write_bytes(place, "binary", "\x00\xff\r\n\x80", 5);
    write_bytes(place, "zero.txt", "a\x00z", 3);
    static const char *const lines[] = {
        "ord(read('plain.txt')) => 104;233;108;108;111;10;116;104;101;114;101;10",
        "ord(read('lines.txt')) => 97;10;98;10;99;10;10;10",
        "read('empty.txt') => ''",
        "ord(read('zero.txt')) => 97;0;122",
        "read('pl';'ain';'.txt')==read(filename='plain.txt') => 1",
        "read_bytes('binary') => 0;255;13;10;128",
        "read_bytes('empty.txt') => null",
        "read_bytes('lines.txt')[..4] => 97;13;10;98",
        "read('') => null",
        "read(null) => null",
        "read('missing') => null",
        "read('binary') => null",
        "read_bytes('missing') => null",
    };
    CHECK_ALL(place->world, lines);
}

// A failure to read a file is reported once, and again only after the file has changed.
static void test_failures_are_reported_once(void **state) {
    Place *place = *state;
    World *world = place->world;
    make_directory(place, "folder");
    write_bytes(place, "binary", "\xff", 1);
    assert_int_equal(errors_of(world, "read('')"), 0);
    assert_int_equal(errors_of(world, "read('missing')"), 1);
    assert_string_equal(world->text, "read: cannot read 'missing': no such file");
    assert_int_equal(errors_of(world, "read('missing')"), 0);
    assert_int_equal(errors_of(world, "csv('missing', 0)"), 1);
    assert_int_equal(errors_of(world, "read('folder')"), 1);
    assert_string_equal(world->text, "read: cannot read 'folder': it is a directory");
    assert_int_equal(errors_of(world, "read('folder')"), 0);
    assert_int_equal(errors_of(world, "read_bytes('folder')"), 1);
    assert_int_equal(errors_of(world, "read('binary')"), 1);
    assert_string_equal(world->text, "read: cannot read 'binary': it is not UTF-8 text");
    assert_int_equal(errors_of(world, "read('binary')"), 0);
    assert_int_equal(errors_of(world, "read_bytes('binary')"), 0);
    assert_int_equal(errors_of(world, "read(chr(97;0))"), 1);
    write_bytes(place, "binary", "\xff\xff", 2);
    assert_int_equal(errors_of(world, "read('binary')"), 1);
    write_file(place, "missing", "here");
    assert_int_equal(errors_of(world, "read('missing')"), 0);
    assert_true(check(world, "read('missing') => 'here'"));
    world->context.files = (file_cache_free(world->context.files), NULL);
    assert_int_equal(errors_of(world, "read('missing')"), 1);
    assert_int_equal(errors_of(world, "glob('*')"), 0);
}

static void test_changed_files_are_read_again(void **state) {
    Place *place = *state;
    World *world = place->world;
    write_file(place, "a.txt", "one");
    assert_true(check(world, "read('a.txt') => 'one'"));
    write_file(place, "a.txt", "three");
    assert_true(check(world, "read('a.txt') => 'three'"));
    // The new content has the same size, so only the modification time differs.
    char path[200];
    snprintf(path, sizeof path, "%s/a.txt", place->directory);
    write_file(place, "a.txt", "seven");
    const struct timespec times[2] = {{1000, 0}, {1000, 5}};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
    assert_true(check(world, "read('a.txt') => 'seven'"));
    assert_int_equal(unlink(path), 0);
    assert_int_equal(errors_of(world, "read('a.txt')"), 1);
    write_file(place, "a.txt", "again");
    assert_true(check(world, "read('a.txt') => 'again'"));
    // A value that was read before the change stays as it was.
    Value before = evaluate(world, "read('a.txt')");
    write_file(place, "a.txt", "another text");
    evaluate(world, "read('a.txt')");
    assert_true(str_equal(before.as.items[0].as.string->text, STR("again")));
}

static void test_names_are_relative_to_script(void **state) {
    Place *place = *state;
    World *world = place->world;
    make_directory(place, "sub");
    write_file(place, "a.txt", "outer");
    write_file(place, "sub/a.txt", "inner");
    assert_true(check(world, "read('sub/a.txt');read('sub/../a.txt') => 'inner';'outer'"));
    char path[200], line[400];
    snprintf(path, sizeof path, "%s/sub/", place->directory);
    world->context.directory = str_from(path);
    assert_true(check(world, "read('a.txt');read('../a.txt') => 'inner';'outer'"));
    snprintf(line, sizeof line, "read('%s/a.txt') => 'outer'", place->directory);
    assert_true(check(world, line));
}

static void test_csv_returns_rows(void **state) {
    Place *place = *state;
    write_file(place, "t.csv", "1,2,\"three\",4.5\n\n\"a \"\"q\"\" b\", 7 ,inf,nan,1_0,,\n,,\nx");
    write_file(place, "ragged.csv", "a\r\nb,c,d\re,,f\n\"x\ny\",\"1\"\n,\n1\n");
    write_file(place, "quotes.csv", "a\"b\",\"c\"d\"e\",\"\"\"\"\n\"\",\"\",z\n \"s\"\n\"open, to the\nend");
    write_file(place, "numbers.csv",
               "1,-2.5,+3,.5,5.,1e3,1E-2,1_000.0_1,-inf,INFINITY,NaN\n"
               "1_,_1,1__0,.,1e,e5,0x10,1.2.3,--1,+,1 2,\xc2\xa0"
               "1\n");
    write_file(place, "empty.csv", "");
    write_bytes(place, "bad.csv", "a,\xc3\n", 4);
    write_file(place, "mark.csv",
               "\xef\xbb\xbf"
               "1,2\n3\n");
    static const char *const lines[] = {
        "csv('t.csv',0) => 1;2;'three';4.5",
        "csv('mark.csv',0);csv('mark.csv',1) => 1;2;3", // the byte-order mark is skipped
        "csv('t.csv',1) => null",
        "csv('t.csv',2) => 'a \"q\" b';7;inf;nan;10",
        "csv('t.csv',3) => null",
        "csv('t.csv',4) => 'x'",
        "csv('t.csv',5) => null",
        "csv('t.csv',4.9);csv('t.csv','4');csv('t.csv',' +4 ') => 'x';'x';'x'",
        "csv('t.csv',-1);csv('t.csv',-0.5);csv('t.csv',nan);csv('t.csv',inf);csv('t.csv',1e300) => null",
        "csv('t.csv','x');csv('t.csv','-1');csv('t.csv','1.0');csv('t.csv','');csv('t.csv',:a) => null",
        "csv('t.csv',0;1);csv('t.csv',null);csv('t.csv','0';'1') => null",
        "csv(filename='t.csv',row_number=4) => 'x'",
        "csv('ragged.csv',0);csv('ragged.csv',1);csv('ragged.csv',2) => 'a';'b';'c';'d';'e';'';'f'",
        "csv('ragged.csv',3) => 'x\\ny';1",
        "csv('ragged.csv',4);csv('ragged.csv',5);csv('ragged.csv',6) => 1",
        "csv('quotes.csv',0) => 'a\"b\"';'cd\"e\"';'\"'",
        "csv('quotes.csv',1);csv('quotes.csv',2) => '';'';'z';' \"s\"'",
        "csv('quotes.csv',3) => 'open, to the\\nend'",
        "csv('numbers.csv',0) => 1;-2.5;3;0.5;5;1000;0.01;1000.01;-inf;inf;nan",
        "len(csv('numbers.csv',1)) => 12",
        "csv('numbers.csv',1)[..11] => '1_';'_1';'1__0';'.';'1e';'e5';'0x10';'1.2.3';'--1';'+';'1 2'",
        "csv('empty.csv',0) => null",
        "csv('bad.csv',0) => null",
        "csv('missing.csv',0) => null",
        "csv(null,0) => null",
    };
    CHECK_ALL(place->world, lines);
}

static void test_srt_returns_lines(void **state) {
    Place *place = *state;
    write_file(place, "film.srt",
               "1\r\n00:00:01,000 --> 00:00:03,500\r\nFirst line\r\nsecond line\r\n\r\n"
               "2\n00:01:00,500 --> 00:02:00,000\nLater\n");
    write_file(place, "short.srt", "1\n0 --> 2\na\n\n2\n1,5 --> 1:01:01,250\nb\n\n3\n5 --> 6");
    write_file(place, "trailing.srt", "1\n0 --> 2\na\n\n");
    // mark, numbers that are missing, repeated or in the text, points, positions, spaces, empty lines
    write_file(
        place, "forms.srt",
        "\xef\xbb\xbf\n\n7\n0:0:1 --> 00:00:02,000\nA\n\n\n\n7\n1.005 --> 1.500 X1:40 X2:600 Y1:20 Y2:50\nB\n\n2 b"
        "\n\n00:00:03.000-->00:00:04.000\n\nC\n  \n9\n 4 --> 5 \nD\n42\n\n9\n7 --> 8\n\n10\n8,000 --> 9,000\n"
        "--> F\n\n\n");
    write_file(place, "number.srt", "one\n0 --> 2\na\n");
    write_file(place, "arrow.srt", "1\n0 -> 2\na\n");
    write_file(place, "time.srt", "1\n0:0:0:0 --> 2\na\n");
    write_file(place, "empty.srt", "");
    write_file(place, "lone.srt", "1\n");
    static const char *const lines[] = {
        "srt('film.srt',0);srt('film.srt',0.999);srt('film.srt',3.5) => null",
        "srt('film.srt',1) => 'First line';'second line'",
        "srt('film.srt',61.25);srt('film.srt',60.5) => 'Later';'Later'",
        "srt('short.srt',1) => 'a'",
        "srt('short.srt',1.5) => 'a';'b'",
        "srt('short.srt',3661.249) => 'b'",
        "srt('short.srt',3661.25);srt('short.srt',nan);srt('short.srt',-1) => null",
        "srt('short.srt',5.5) => 'b'",
        "srt('film.srt',null);srt('film.srt',1;2);srt('film.srt','1');srt(null,1) => null",
        "srt('trailing.srt',2);srt('number.srt',1);srt('arrow.srt',1);srt('time.srt',1) => null",
        "srt('trailing.srt',1);srt('forms.srt',1) => 'a';'A'",
        "srt('forms.srt',1.006) => 'A';'B';'';'2 b'",
        "srt('forms.srt',3) => 'C'",
        "srt('forms.srt',4.5) => 'D';'42'",
        "srt('forms.srt',7);srt('forms.srt',8.5) => '--> F'",
        "srt('empty.srt',1);srt('lone.srt',1);srt('missing.srt',1) => null",
    };
    CHECK_ALL(place->world, lines);
    assert_int_equal(errors_of(place->world, "srt('lone.srt',1)"), 0); // this error was already reported above
    write_file(place, "lone.srt", "1\nx");
    assert_int_equal(errors_of(place->world, "srt('lone.srt',1)"), 1);
    assert_string_equal(place->world->text,
                        "srt: cannot read 'lone.srt': it is not a subtitle file: line 2 is not START --> END");
}

// Checks the paths that match a pattern, relative to the folder and joined by spaces.
static void check_glob(const Place *place, const char *pattern, const char *expected) {
    World *world = place->world;
    Value name = value_string(&world->frame, str_from(pattern));
    Value v = builtin_call(&world->context, builtin_find(STR("glob")), &name, 1, NULL, NULL, 0);
    char actual[1000] = "";
    size_t skip = strlen(place->directory) + 1;
    for (uint32_t i = 0; i < v.len; i++) {
        Str path = v.as.items[i].as.string->text;
        assert_true(str_starts_with(path, str_from(place->directory)));
        if (i)
            strcat(actual, " ");
        if (path.len > skip)
            strncat(actual, path.bytes + skip, path.len - skip);
        else
            strcat(actual, ".");
    }
    if (strcmp(actual, expected) != 0)
        fail_msg("glob %s: %s", pattern, actual);
    arena_reset(&world->frame);
}

static void test_glob_finds_matches(void **state) {
    Place *place = *state;
    make_directory(place, "d");
    make_directory(place, "d/e");
    make_directory(place, ".h");
    static const char *const files[] = {"a.txt",     "b.txt",    "B.txt", "[x].dat",     "d/a.txt",
                                        "d/e/c.txt", ".h/f.txt", ".dot",  "\xc3\xa9.txt"};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++)
        write_file(place, files[i], "");
    char link[200];
    snprintf(link, sizeof link, "%s/link", place->directory);
    assert_int_equal(symlink("d", link), 0);
    check_glob(place, "*.txt", "B.txt a.txt b.txt \xc3\xa9.txt");
    check_glob(place, "?.txt", "B.txt a.txt b.txt \xc3\xa9.txt");
    check_glob(place, "[a-b].txt", "a.txt b.txt");
    check_glob(place, "[!a-b].txt", "B.txt \xc3\xa9.txt");
    check_glob(place, "[\xc3\xa9z].txt", "\xc3\xa9.txt");
    check_glob(place, "[[]x].dat", "[x].dat");
    check_glob(place, "[", "");
    check_glob(place, "[]x]*", "");
    check_glob(place, "a.txt", "a.txt");
    check_glob(place, "A.txt", "");
    check_glob(place, ".*", ".dot .h");
    check_glob(place, "*/a.txt", "d/a.txt d/a.txt"); // the second path goes through the link
    check_glob(place, "link/*.txt", "d/a.txt");
    check_glob(place, "d/../a.txt", "a.txt");
    check_glob(place, "./d//e/./c*", "d/e/c.txt");
    check_glob(place, "**/*.txt", ".h/f.txt B.txt a.txt b.txt d/a.txt d/e/c.txt \xc3\xa9.txt");
    check_glob(place, "d/**", "d d/a.txt d/e d/e/c.txt");
    check_glob(place, "d/**/**/*", "d/a.txt d/e d/e/c.txt");
    check_glob(place, "d/**/", "d d/e");
    check_glob(place, "*/", ".h d d");
    check_glob(place, "a.txt/", "");
    check_glob(place, "d/*/", "d/e");
    check_glob(place, ".", ".");
    check_glob(place, "d/..", ".");
    check_glob(place, "nothing*", "");
    check_glob(place, "**a.t**", "a.txt");
    assert_int_equal(errors_of(place->world, "glob('')"), 1);
    assert_int_equal(errors_of(place->world, "glob(null)"), 1);
    assert_int_equal(errors_of(place->world, "glob('/tmp/*')"), 1);
    assert_int_equal(errors_of(place->world, "glob(pattern='none')"), 0);
}

// Running out of memory while a file is read leaves the cache usable.
static void test_cache_survives_out_of_memory(void **state) {
    Place *place = *state;
    World *world = place->world;
    write_file(place, "a.txt", "some text that does not fit");
    jmp_buf escape;
    size_t budget = world->frame.limit;
    if (setjmp(escape) == 0) {
        world->frame.escape = &escape;
        evaluate(world, "0");
        world->frame.limit = 260;
        for (;;)
            evaluate(world, "read('a.txt')");
    }
    world->frame.limit = budget;
    world->frame.escape = NULL;
    arena_reset(&world->frame);
    assert_true(check(world, "read('a.txt') => 'some text that does not fit'"));
}

// Reads more files than the cache can hold.
static void test_cache_is_limited(void **state) {
    Place *place = *state;
    World *world = place->world;
    write_file(place, "a.txt", "text");
    for (int i = 0; i < 40000; i++) {
        Value name = value_number(i);
        builtin_call(&world->context, builtin_find(STR("read")), &name, 1, NULL, NULL, 0);
        if (i % 1000 == 0)
            arena_reset(&world->frame);
    }
    assert_true(world->errors >= 40000);
    assert_true(check(world, "read('a.txt') => 'text'"));
}

TEST_GROUP(files) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_read_returns_contents, place_setup, place_teardown),
        cmocka_unit_test_setup_teardown(test_failures_are_reported_once, place_setup, place_teardown),
        cmocka_unit_test_setup_teardown(test_changed_files_are_read_again, place_setup, place_teardown),
        cmocka_unit_test_setup_teardown(test_names_are_relative_to_script, place_setup, place_teardown),
        cmocka_unit_test_setup_teardown(test_csv_returns_rows, place_setup, place_teardown),
        cmocka_unit_test_setup_teardown(test_srt_returns_lines, place_setup, place_teardown),
        cmocka_unit_test_setup_teardown(test_glob_finds_matches, place_setup, place_teardown),
        cmocka_unit_test_setup_teardown(test_cache_survives_out_of_memory, place_setup, place_teardown),
        cmocka_unit_test_setup_teardown(test_cache_is_limited, place_setup, place_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
