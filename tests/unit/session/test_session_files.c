// test_session_files.c: tests scripts, modules and includes in files (language.md L13, L14).
#include "folder.h"
#include "petri-inspect.h"
#include "player.h"
#include "session/session.h"

typedef struct Desk {
    Player player;
    Folder folder;
} Desk;

static int setup(void **state) {
    Desk *desk = malloc(sizeof *desk);
    player_open(&desk->player);
    folder_open(&desk->folder);
    *state = desk;
    return 0;
}

static int teardown(void **state) {
    Desk *desk = *state;
    player_close(&desk->player);
    folder_close(&desk->folder);
    free(desk);
    return 0;
}

#define DESK_TEST(function) cmocka_unit_test_setup_teardown(function, setup, teardown)

static void load(Desk *desk, const char *script) {
    folder_write(&desk->folder, "main.fl", script);
    player_forget(&desk->player);
    PetriStatus status = petri_load(desk->player.session, folder_file(&desk->folder, "main.fl"));
    if (status != PETRI_OK)
        print_error("%s", player_diagnostics(&desk->player));
    assert_int_equal(status, PETRI_OK);
}

static void check_run(Desk *desk, const char *script, const char *tree) {
    load(desk, script);
    player_step(&desk->player, 1);
    assert_text(script, player_tree(&desk->player), tree);
}

static void check_reported(Desk *desk, const char *part) {
    const char *reported = player_diagnostics(&desk->player);
    if (!strstr(reported, part))
        assert_text("diagnostics", reported, part);
}

static void test_import_binds_the_modules_last_values(void **state) {
    Desk *desk = *state;
    folder_write(&desk->folder, "m.fl", "%pragma fps 3\nlet a=1 b=2\nfunc twice(x)\n    x*k\nlet k=2 a=10\n!ignored\n");
    check_run(desk, "import a;b from 'm.fl'\n!x v=a;b f=fps\n",
              "!x v=10;2 f=60\n"); // the last binding is exported, and pragmas of modules are ignored
    // In the module, k is bound after the definition of the function `twice`, which therefore does not see k.
    check_run(desk, "let k=5\nimport twice from 'm.fl'\n!x v=twice(2)\n", "!x\n");
    check_run(desk, "for n in 'm';'none'\n    import a from n;'.fl'\n    !x v=a\n", "!x v=10\n!x\n");
    check_reported(desk, "cannot import");
    check_run(desk, "import a;c from 'm.fl'\n!x v=a;c\n", "!x v=10\n");
    check_reported(desk, "[unknown-import]");
    folder_write(&desk->folder, "n.fl", "import a from 'm.fl'\nlet z=a+1\n"); // imported names are not exported
    check_run(desk, "import a;z from 'n.fl'\n!x v=a;z\n", "!x v=10;11\n");
}

// A script may read files in its folder, the current directory and the allowed folders. Files that were read by a
// previous script are not accessible.
static void test_only_allowed_folders_are_read(void **state) {
    Desk *desk = *state;
    char script[900];
    folder_write(&desk->folder, "m.fl", "let a=1\n");
    folder_write(&desk->folder, "t.txt", "text");
    snprintf(script, sizeof script, "import a from '%s/m.fl'\n!x v=a t=read('%s/t.txt')\n", desk->folder.path,
             desk->folder.path);
    check_run(desk, script, "!x v=1 t='text'\n");
    PetriConfig *before = petri_config_get(desk->player.session);
    assert_int_equal(player_load(&desk->player, script), PETRI_OK);
    player_step(&desk->player, 1);
    assert_text("outside", player_tree(&desk->player), "!x\n");
    check_reported(desk, "cannot import");
    check_reported(desk, "scripts are not allowed to read there; to allow it, use '--allow-read ");
    petri_config_apply(desk->player.session, before);
    player_step(&desk->player, 1);
    assert_text("inside again", player_tree(&desk->player), "!x v=1 t='text'\n");
    petri_config_free(before);

    PetriOptions options = player_options(&desk->player);
    options.read_folders = (const char *const[]){"/no/such/folder", desk->folder.path, NULL};
    player_reopen(&desk->player, &options);
    assert_int_equal(player_load(&desk->player, script), PETRI_OK);
    player_step(&desk->player, 1);
    assert_text("allowed", player_tree(&desk->player), "!x v=1 t='text'\n");
    options.no_files = true;
    player_reopen(&desk->player, &options);
    check_run(desk, script, "!x\n");
    check_reported(desk, "file access is disabled (--no-files)");
}

// A module sees only built-ins. Its functions see the caller's state.
static void test_module_sees_only_builtins(void **state) {
    Desk *desk = *state;
    folder_write(&desk->folder, "m.fl", "let v=frame;d;$:c w=sin(0.25)\nfunc look(k)\n    $k\n");
    assert_int_equal(petri_define(desk->player.session, "d=3"), PETRI_OK);
    load(desk, "import v;w;look from 'm.fl'\n!counter state=:c initial=7 rate=0\n!x v=v w=w s=look(:c) d=d\n");
    player_step(&desk->player, 2);
    assert_text("tree", strstr(player_tree(&desk->player), "!x"), "!x w=1 s=7 d=3\n");
    check_reported(desk, "m.fl:1:7 unbound name 'frame' is null [unbound-name]");
}

static void test_changed_module_is_reloaded(void **state) {
    Desk *desk = *state;
    folder_write(&desk->folder, "m.fl", "let a=1\n");
    load(desk, "import a from 'm.fl'\n!x v=a\n");
    static const char *const versions[][2] = {
        {"let a=2\n", "!x v=2\n"}, {"let b=3\n", "!x\n"}, {"let a=4\n", "!x v=4\n"}};
    player_step(&desk->player, 2);
    assert_text("first", player_tree(&desk->player), "!x v=1\n");
    for (size_t i = 0; i < COUNT_OF(versions); i++) {
        folder_write(&desk->folder, "m.fl", versions[i][0]);
        player_step(&desk->player, 1);
        assert_text(versions[i][0], player_tree(&desk->player), versions[i][1]);
        player_step(&desk->player, 1);
        assert_text(versions[i][0], player_tree(&desk->player), versions[i][1]);
    }
    remove(folder_file(&desk->folder, "m.fl"));
    player_step(&desk->player, 1);
    assert_text("gone", player_tree(&desk->player), "!x\n");
}

// While a module has errors, its last good version is used. Each error is reported once.
static void test_invalid_change_keeps_last_good_module(void **state) {
    Desk *desk = *state;
    folder_write(&desk->folder, "m.fl", "import b from 'n.fl'\nfunc f(x)\n    x;b\n");
    folder_write(&desk->folder, "n.fl", "let b=1\n");
    load(desk, "import f from 'm.fl'\n!x v=f(5)\n");
    static const char *const changes[][3] = {
        {"m.fl", "func f(x)\n", "!x v=5;1\n"},
        {"n.fl", "let b=2\n", "!x v=5;2\n"},
        {"m.fl", "func f(x)\n    x+(\n", "!x v=5;2\n"},
        {"n.fl", "let b=\xff\n", "!x v=5;2\n"},
        {"m.fl", "let f=abs\n", "!x v=5\n"},
        {"m.fl", "let f=)\n", "!x v=5\n"},
    };
    player_step(&desk->player, 2);
    for (size_t i = 0; i < COUNT_OF(changes); i++) {
        uint64_t errors = petri_diagnostic_count(desk->player.session, PETRI_ERROR);
        folder_write(&desk->folder, changes[i][0], changes[i][1]);
        for (int frame = 0; frame < 3; frame++) {
            player_step(&desk->player, 1);
            assert_text(changes[i][1], player_tree(&desk->player), changes[i][2]);
        }
        bool good = strcmp(changes[i][1], "let b=2\n") == 0 || strcmp(changes[i][1], "let f=abs\n") == 0;
        assert_int_equal(petri_diagnostic_count(desk->player.session, PETRI_ERROR) - errors, !good);
        assert_int_equal(petri_reload(desk->player.session, folder_file(&desk->folder, "main.fl")), PETRI_OK);
        player_step(&desk->player, 1);
        assert_text("reloaded", player_tree(&desk->player), changes[i][2]);
    }
    load(desk, "import f from 'm.fl'\n!x v=f(6)\n");
    player_step(&desk->player, 1);
    assert_text("loaded again", player_tree(&desk->player), "!x v=6\n");
}

static void test_modules_are_kept_until_reload(void **state) {
    Desk *desk = *state;
    Player *player = &desk->player;
    PetriOptions options = player_options(player);
    options.keep_modules = true;
    player_reopen(player, &options);
    folder_write(&desk->folder, "m.fl", "let a=1\n");
    load(desk, "import a from 'm.fl'\n!x v=a\n");
    player_step(player, 1);
    folder_write(&desk->folder, "m.fl", "let a=20\n");
    player_step(player, 1);
    assert_text("kept", player_tree(player), "!x v=1\n");
    remove(folder_file(&desk->folder, "m.fl"));
    player_step(player, 1);
    assert_text("kept without its file", player_tree(player), "!x v=1\n");
    folder_write(&desk->folder, "m.fl", "let a=20\n");
    assert_int_equal(petri_reload(player->session, folder_file(&desk->folder, "main.fl")), PETRI_OK);
    player_step(player, 1);
    assert_text("reloaded", player_tree(player), "!x v=20\n");
}

static void test_circular_imports_are_reported(void **state) {
    Desk *desk = *state;
    folder_write(&desk->folder, "a.fl", "import y from 'b.fl'\nlet x=1;y\n");
    folder_write(&desk->folder, "b.fl", "import x from 'a.fl'\nlet y=2;x\n");
    check_run(desk, "import x from 'a.fl'\n!x v=x\n", "!x v=1;2\n");
    check_reported(desk, "circular import");
    check_run(desk, "let q=1\nimport q from 'main.fl'\n!x v=q\n", "!x\n");
    check_reported(desk, "circular import");
    folder_write(&desk->folder, "s.fl", "let q=1\nimport q from 's.fl'\n");
    check_run(desk, "import q from 's.fl'\n!x v=q\n", "!x\n");
    check_reported(desk, "circular import");
}

static void test_invalid_modules_are_reported(void **state) {
    Desk *desk = *state;
    static const char *const files[] = {"'none.fl'", "''", "null", "'.'", "!a", "'bad.fl'", "'dir'"};
    folder_write(&desk->folder, "bad.fl", "let a=\xff\n");
    assert_int_equal(mkdir(folder_file(&desk->folder, "dir"), 0700), 0);
    for (size_t i = 0; i < COUNT_OF(files); i++) {
        char script[100];
        snprintf(script, sizeof script, "import a from %s\n!x v=a\n", files[i]);
        check_run(desk, script, "!x\n");
        check_reported(desk, "cannot import");
    }
}

static void test_include_shares_the_scope_of_its_place(void **state) {
    Desk *desk = *state;
    folder_write(&desk->folder, "i.fl", "%pragma fps 7\n!i k=k\nlet k=5\n!i k=k\n");
    check_run(desk, "let k=2\n!a\n    %include 'i.fl'\n    !b k=k\n!f v=fps\n",
              "!a\n    !i k=2\n    !i k=5\n    !b k=2\n!f v=60\n");
    check_run(desk, "for k in ..2\n    %include 'i.fl'\n", "!i k=0\n!i k=5\n!i k=1\n!i k=5\n");
    check_run(desk, "func f(k)\n    %include 'i.fl'\nf(1)\nf(2)\n", "!i k=1\n!i k=5\n!i k=2\n!i k=5\n");
    // the path may contain static names and operators
    check_run(desk, "let k=1 n='i'\n%include n;'.fl'\n", "!i k=1\n!i k=5\n");
    check_run(desk, "%include null\n!a\n", "!a\n");
    assert_string_equal(player_diagnostics(&desk->player), "");
    check_run(desk, "let k=1\n%include 'i.fl'\n%include 'i.fl'\n", "!i k=1\n!i k=5\n");
    check_reported(desk, "main.fl:3:10 cannot include");
    check_run(desk, "%include 'main.fl'\n!a\n", "!a\n");
    check_reported(desk, "already included");
    check_run(desk, "%include 'none.fl'\n!a\n", "!a\n");
    check_reported(desk, "cannot include");
    check_run(desk, "%include frame;'.fl'\n!a\n", "!a\n");
    check_reported(desk, "must be constant");
    folder_write(&desk->folder, "bad.fl", "!a )\n");
    check_run(desk, "%include 'bad.fl'\n!a\n", "!a\n");
    check_reported(desk, "bad.fl:1:4 unexpected ')'");
    check_run(desk, "import k from 'j.fl'\n!a k=k\n", "!a\n");
    folder_write(&desk->folder, "k.fl", "let k=77\n!k\n");
    folder_write(&desk->folder, "j.fl", "let k=3\n%include 'k.fl'\n"); // names bound in an included file are local
    check_run(desk, "import k from 'j.fl'\n!a k=k\n", "!a k=3\n");
}

static void test_define_names_an_include(void **state) {
    Desk *desk = *state;
    folder_write(&desk->folder, "i.fl", "!i\n");
    assert_int_equal(petri_define(desk->player.session, "which=i.fl"), PETRI_OK);
    check_run(desk, "%include which\n", "!i\n");
}

static void test_invalid_scripts_are_rejected(void **state) {
    Desk *desk = *state;
    PetriSession *session = desk->player.session;
    assert_int_equal(petri_load(session, folder_file(&desk->folder, "none.fl")), PETRI_INVALID);
    check_reported(desk, "error cannot read '");
    player_forget(&desk->player);
    assert_int_equal(petri_load(session, desk->folder.path), PETRI_INVALID);
    check_reported(desk, "directory");
    folder_write(&desk->folder, "empty.fl", "");
    assert_int_equal(petri_load(session, folder_file(&desk->folder, "empty.fl")), PETRI_OK);
    player_step(&desk->player, 1);
    assert_text("empty", player_tree(&desk->player), "");
}

static void test_check_does_not_affect_the_loaded_script(void **state) {
    Desk *desk = *state;
    PetriSession *session = desk->player.session;
    load(desk, "!a\n");
    player_step(&desk->player, 1);
    folder_write(&desk->folder, "bad.fl", "!a )\n!b\nlet\n!c (\n");
    player_forget(&desk->player);
    assert_int_equal(petri_check(session, folder_file(&desk->folder, "bad.fl")), PETRI_INVALID);
    assert_int_equal(petri_diagnostic_count(session, PETRI_ERROR), 3);
    check_reported(desk, "bad.fl:4:5 ");
    folder_write(&desk->folder, "good.fl", "!z v=unknown\n");
    assert_int_equal(petri_check(session, folder_file(&desk->folder, "good.fl")), PETRI_OK);
    assert_true(petri_diagnostic_count(session, PETRI_WARNING) >= 1);
    folder_write(&desk->folder, "frame.fl", "!physics state=:check dimensions=1\n    !particle id=1 mas=NAME\n");
    assert_int_equal(petri_define(session, "NAME=:x;1"), PETRI_OK);
    player_forget(&desk->player);
    assert_int_equal(petri_check(session, folder_file(&desk->folder, "frame.fl")), PETRI_OK);
    check_reported(desk, "unknown attribute 'mas'");
    player_step(&desk->player, 1); // the script that was loaded before continues
    assert_text("state of the other session is not used", player_state(&desk->player), "");
    assert_text("still", player_tree(&desk->player), "!a\n");
    assert_int_equal(petri_frame_number(session), 1);
}

// A check goes through the script several times, and then reports everything in the order of the lines. In a line, an
// unbound name comes before what follows from it.
static void test_check_reports_in_order(void **state) {
    Desk *desk = *state;
    Notebook *reported = &desk->player.diagnostics;
    static const char script[] = "!window size=40;40\n    !canvas size=40;40\n        !rect siz=1 fill=true color=1\n"
                                 "!physics state=:s dimensions=1 colour=1\n!a v=unknown\n";
    static const char *const wanted[] = {"!rect: unknown attribute 'siz'", "unknown attribute 'colour'", "t.fl:5:6 ",
                                         "'!a' does nothing"};
    assert_int_equal(petri_check_text(desk->player.session, "t.fl", script, PETRI_NUL_TERMINATED), PETRI_OK);
    const char *at = reported->text;
    for (size_t i = 0; i < COUNT_OF(wanted); i++) {
        at = strstr(at, wanted[i]);
        assert_claim(wanted[i], at != NULL);
    }
    assert_int_equal(petri_diagnostic_count(desk->player.session, PETRI_WARNING), COUNT_OF(wanted));
}

// --- files provided by the host

typedef struct Given {
    const char *name;
    const char *text;
} Given;

typedef struct Shelf {
    Given files[8];
    int asked;
} Shelf;

static const char *read_shelf_file(void *host, const char *name, size_t *length) {
    Shelf *shelf = host;
    shelf->asked++;
    for (size_t i = 0; i < COUNT_OF(shelf->files); i++)
        if (shelf->files[i].name && strcmp(shelf->files[i].name, name) == 0) {
            *length = strlen(shelf->files[i].text);
            return shelf->files[i].text;
        }
    return NULL;
}

static void test_host_provides_files(void **state) {
    Desk *desk = *state;
    Player *player = &desk->player;
    Shelf shelf = {.files = {{"dish/main.fl", "import f from 'lib/../m.fl'\n%include './part.fl'\n"
                                              "!a x=f(2) y=read('../words.txt') z=csv('t.csv', 0)\n"},
                             {"dish/m.fl", "func f(x)\n    x*10\n"},
                             {"dish/part.fl", "!part\n"},
                             {"words.txt", "ein Wort"},
                             {"dish/t.csv", "1,2\n"}}};
    PetriOptions options = player_options(player);
    options.read_file = read_shelf_file;
    options.read_user_data = &shelf;
    options.no_files = true;
    player_reopen(player, &options);
    assert_int_equal(petri_load(player->session, "dish/main.fl"), PETRI_OK);
    player_step(player, 1);
    assert_text("all of them", player_tree(player), "!part\n!a x=20 y='ein Wort' z=1;2\n");
    assert_string_equal(petri_source_file(player->session, 0), "dish/main.fl");
    assert_string_equal(petri_source_file(player->session, 1), "dish/part.fl");
    assert_string_equal(petri_source_file(player->session, 2), "dish/m.fl");
    // If the text has changed, the file is read again, even if the length is the same. Unchanged files are not read or
    // compiled again.
    shelf.files[1].text = "func f(x)\n    x*11\n";
    shelf.files[3].text = "zwei W..";
    player_step(player, 1);
    assert_text("changed", player_tree(player), "!part\n!a x=22 y='zwei W..' z=1;2\n");
    assert_string_equal(player_diagnostics(player), "");
    assert_int_equal(petri_check(player->session, "dish/main.fl"), PETRI_OK);
    assert_string_equal(player_diagnostics(player), "");
}

static uint64_t chain_of(const char *path) {
    return (hash_bytes(0, path, strlen(path)) >> 32) % MODULE_CHAINS;
}

// Modules whose paths have the same place in the hash table are distinct, so neither is loaded again in each frame.
static void test_modules_with_equal_hash_stay_loaded(void **state) {
    Desk *desk = *state;
    Player *player = &desk->player;
    char other[20], script[100];
    for (int i = 1; snprintf(other, sizeof other, "m%d.fl", i), chain_of(other) != chain_of("m.fl"); i++) {
    }
    snprintf(script, sizeof script, "import f from 'm.fl'\nimport g from '%s'\n!a v=f;g\n", other);
    Shelf shelf = {.files = {{"m.fl", "let f=1\n"}, {other, "let g=2\n"}}};
    PetriOptions options = player_options(player);
    options.read_file = read_shelf_file;
    options.read_user_data = &shelf;
    player_reopen(player, &options);
    player_run(player, script, 1);
    uint64_t revision = petri_config_revision(player->session);
    player_step(player, 2);
    assert_text("both", player_tree(player), "!a v=1;2\n");
    assert_int_equal(petri_config_revision(player->session), revision);
}

static void test_host_provides_folders(void **state) {
    Desk *desk = *state;
    Player *player = &desk->player;
    Shelf shelf = {.files = {{"main.fl", "!a x=glob('*.txt') y=glob('d/*') z=glob('**/n.dat') w=glob('d/../d/m.dat') "
                                         "v=glob('*/') u=glob('no/*')\n"},
                             {"./", "main.fl\nb.txt\na.txt\nd/\n"},
                             {"d/", "n.dat\nm.dat"},
                             {"d/n.dat", "1"},
                             {"d/m.dat", "2"},
                             {"a.txt", ""},
                             {"b.txt", ""}}};
    PetriOptions options = player_options(player);
    options.read_file = read_shelf_file;
    options.read_user_data = &shelf;
    player_reopen(player, &options);
    assert_int_equal(petri_load(player->session, "main.fl"), PETRI_OK);
    player_step(player, 1);
    assert_text("globs", player_tree(player),
                "!a x='a.txt';'b.txt' y='d/m.dat';'d/n.dat' z='d/n.dat' w='d/m.dat' v='d'\n");
    assert_string_equal(player_diagnostics(player), "");
}

// Files that the host does not provide do not exist for the script, even if they are on disk.
static void test_only_host_files_exist(void **state) {
    Desk *desk = *state;
    Player *player = &desk->player;
    char script[800];
    Shelf shelf = {0};
    PetriOptions options = player_options(player);
    options.read_file = read_shelf_file;
    options.read_user_data = &shelf;
    player_reopen(player, &options);
    folder_write(&desk->folder, "s.fl", "!a\n");
    assert_int_equal(petri_load(player->session, folder_file(&desk->folder, "s.fl")), PETRI_INVALID);
    check_reported(desk, "No such file");
    snprintf(script, sizeof script,
             "import f from '%s/s.fl'\n%%include '%s/s.fl'\n!a x=read('%s/s.fl') y=glob('*') z=f(1)\n",
             desk->folder.path, desk->folder.path, desk->folder.path);
    shelf.asked = 0;
    player_run(player, script, 2);
    assert_text("nothing", player_tree(player), "!a\n");
    assert_true(shelf.asked >= 3);
    check_reported(desk, "no such file");
}

static const char *read_unsaved(void *host, const char *name, size_t *length) {
    Shelf *shelf = host;
    const char *slash = strrchr(name, '/');
    assert_true(name[0] == '/' && !strstr(name, "/../"));
    return read_shelf_file(shelf, slash + 1, length);
}

// Unsaved texts of an editor replace files that scripts import or include, but only if the files exist and may be read.
static void test_unsaved_text_replaces_file(void **state) {
    Desk *desk = *state;
    Player *player = &desk->player;
    char script[800];
    Shelf shelf = {.files = {{"m.fl", "func f(x)\n    x*10\n"}, {"part.fl", "!part\n"}, {"new.fl", "!new\n"}}};
    PetriOptions options = player_options(player);
    const char *const folders[] = {desk->folder.path, NULL};
    options.read_folders = folders;
    options.read_unsaved = read_unsaved;
    options.read_user_data = &shelf;
    player_reopen(player, &options);
    folder_write(&desk->folder, "m.fl", "func f(x)\n    x\n");
    folder_write(&desk->folder, "part.fl", "!old\n");
    folder_write(&desk->folder, "kept.fl", "!kept\n");
    snprintf(script, sizeof script,
             "import f from '%s/../%s/m.fl'\n%%include '%s/part.fl'\n%%include '%s/kept.fl'\n!a x=f(2)\n",
             desk->folder.path, strrchr(desk->folder.path, '/') + 1, desk->folder.path, desk->folder.path);
    player_run(player, script, 1);
    assert_text("unsaved", player_tree(player), "!part\n!kept\n!a x=20\n");
    shelf.files[0].text = "func f(x)\n    x*11\n";
    player_step(player, 1);
    assert_text("changed", player_tree(player), "!part\n!kept\n!a x=22\n");
    assert_int_equal(petri_check_text(player->session, "s.fl", script, PETRI_NUL_TERMINATED), PETRI_OK);
    shelf.files[0].name = NULL;
    player_step(player, 1);
    assert_text("saved", player_tree(player), "!part\n!kept\n!a x=2\n");
    assert_string_equal(player_diagnostics(player), "");
    snprintf(script, sizeof script, "%%include '%s/new.fl'\n", desk->folder.path);
    petri_load_text(player->session, "s.fl", script, PETRI_NUL_TERMINATED);
    check_reported(desk, "No such file");
}

static void list_file(void *user_data, const char *name, const char *bytes, size_t length) {
    char line[200];
    snprintf(line, sizeof line, "%s=%.*s\n", name, bytes ? (int)length : 4, bytes ? bytes : "none");
    note(user_data, line, strlen(line));
}

static void test_files_are_reported_when_they_are_read(void **state) {
    Desk *desk = *state;
    Notebook files = {0};
    PetriOptions options = player_options(&desk->player);
    options.on_file_read = list_file;
    options.user_data = &files;
    options.on_diagnostic = NULL;
    player_reopen(&desk->player, &options);
    folder_write(&desk->folder, "m.fl", "let a=1");
    folder_write(&desk->folder, "i.fl", "let b=2");
    folder_write(&desk->folder, "t.txt", "text");
    load(desk,
         "%include 'i.fl'\nimport a from 'm.fl'\nimport c from 'no.fl'\n!x v=a;b t=read('t.txt') u=read('no.txt')\n");
    player_step(&desk->player, 2);
    assert_memory_equal(files.text, "main.fl=", 8);
    assert_text("files", strstr(files.text, "i.fl=let"),
                "i.fl=let b=2\nm.fl=let a=1\nno.fl=none\nt.txt=text\nno.txt=none\nno.fl=none\n");
    files.len = 0;
    folder_write(&desk->folder, "t.txt", "longer text");
    player_step(&desk->player, 1);
    assert_text("changed", files.text, "no.fl=none\nt.txt=longer text\n");
    files.len = 0;
    load(desk, "!x v=len(glob('t.txt'))\n");
    player_step(&desk->player, 1);
    assert_non_null(strstr(files.text, "/=") && strstr(files.text, "t.txt\n") ? files.text : NULL);
    free(files.text);
}

TEST_GROUP(session_files) {
    const struct CMUnitTest tests[] = {
        DESK_TEST(test_import_binds_the_modules_last_values),
        DESK_TEST(test_only_allowed_folders_are_read),
        DESK_TEST(test_module_sees_only_builtins),
        DESK_TEST(test_changed_module_is_reloaded),
        DESK_TEST(test_invalid_change_keeps_last_good_module),
        DESK_TEST(test_modules_are_kept_until_reload),
        DESK_TEST(test_circular_imports_are_reported),
        DESK_TEST(test_invalid_modules_are_reported),
        DESK_TEST(test_include_shares_the_scope_of_its_place),
        DESK_TEST(test_define_names_an_include),
        DESK_TEST(test_invalid_scripts_are_rejected),
        DESK_TEST(test_check_does_not_affect_the_loaded_script),
        DESK_TEST(test_check_reports_in_order),
        DESK_TEST(test_host_provides_files),
        DESK_TEST(test_modules_with_equal_hash_stay_loaded),
        DESK_TEST(test_files_are_reported_when_they_are_read),
        DESK_TEST(test_host_provides_folders),
        DESK_TEST(test_only_host_files_exist),
        DESK_TEST(test_unsaved_text_replaces_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
