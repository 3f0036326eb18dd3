// test_session_parameters.c: tests parameters (`let NAME=NAME or DEFAULT`), and warnings about unused definitions.
#include "folder.h"
#include "petri-live.h"
#include "player.h"
#include "session/session.h"

// Lists the parameters, one per line: `NAME value (default) number min..max|step 'comment' position`.
static const char *list(Player *player) {
    PetriParameter row;
    player->printed.len = 0;
    note(&player->printed, "", 0);
    for (size_t i = 0; petri_parameter(player->session, i, &row, sizeof row); i++) {
        char line[1000];
        int len = snprintf(line, sizeof line, "%s %s (%s) %g/%g %g..%g|%g '%s' %u:%u%s%s\n", row.name, row.value,
                           row.default_value, row.number, row.default_number, row.min, row.max, row.step, row.comment,
                           row.line, row.column, row.defined ? " defined" : "", row.settable ? "" : " fixed");
        note(&player->printed, line, (size_t)len);
    }
    return player->printed.text;
}

static const char *list_of(Player *player, const char *script) {
    player_forget(player);
    assert_int_equal(player_load(player, script), PETRI_OK);
    return list(player);
}

static void test_parameters_are_recognised(void **state) {
    static const struct {
        const char *script, *wanted;
        bool quiet;
    } rows[] = {
        {"let N=N or 2\n!a v=N\n", "N 2 (2) 2/2 -inf..inf|0 '' 1:5\n", true},
        {"let stable N=N or 2\n", "N 2 (2) 2/2 -inf..inf|0 '' 1:12\n", true},
        {"let A=A or 1 B=B or 2 -- both\n    C=C or 3\n",
         "A 1 (1) 1/1 -inf..inf|0 '' 1:5\nB 2 (2) 2/2 -inf..inf|0 'both' 1:14\nC 3 (3) 3/3 -inf..inf|0 '' 2:5\n", true},
        {"let N=N or (1;2)\n", "N 1;2 ((1;2)) nan/nan -inf..inf|0 '' 1:5\n", true},
        {"let N=(N or 4) -- in brackets\n", "N 4 (4) 4/4 -inf..inf|0 'in brackets' 1:5\n", true},
        {"let N=N or 'a -- b'-- c\n", "N 'a -- b' ('a -- b') nan/nan -inf..inf|0 'c' 1:5\n", true},
        {"let N=N or :ring\n", "N :ring (:ring) nan/nan -inf..inf|0 '' 1:5\n", true},
        {"let k=3\nlet N=N or k*2\n", "N 6 (k*2) 6/6 -inf..inf|0 '' 2:5\n", true},
        {"let N=N or beat\n", "N beat (beat) nan/nan -inf..inf|0 '' 1:5\n", true},
        {"let N=N or 0 or 5\n", "N 0 or 5 (0 or 5) nan/nan -inf..inf|0 '' 1:5\n", true},
        {"let N=N or (1;\n  2)\n", "N 1;2 ((1; 2)) nan/nan -inf..inf|0 '' 1:5\n", true},
        {"let N=N or beat -- a\033[31m\tb\302\233c\n", "N beat (beat) nan/nan -inf..inf|0 'a [31m b c' 1:5\n", true},
        {"let N=N or beat -- a\302\237b\302\240c\n", "N beat (beat) nan/nan -inf..inf|0 'a b\302\240c' 1:5\n",
         true}, // a no-break space is kept
        {"let N=N or false -- 0..1\n", "N 0 (false) 0/0 0..1|0 '' 1:5\n", true},
        // The second `let` is not a parameter, because the name is already bound.
        {"let N=N or 1\nlet N=N or 2\n", "N 1 (1) 1/1 -inf..inf|0 '' 1:5\n", true},
        // None of these are parameters. Two are reported, because the value of the name is used.
        {"let k=3\nlet k=k or 2\n", "", true},
        {"let beat=beat or 2\n", "", true},
        {"let sin=sin or 2\n", "", true},
        {"let N=M or 2\n", "M 2 (2) 2/2 -inf..inf|0 '' 1:5\n", true},
        {"let N=M or 2\nlet K=M\n", "", false},
        {"let N=N or 1;2\n", "", true},
        {"let N;M=N or 1\n", "", true},
        {"!a v=(N or 1)\n", "", true},
        {"let N=N\n", "", false},
        {"if 1\n    let N=N or 1\n    !a v=N\n", "", true},
        {"func f(x)\n    let N=N or x\n    N\n!a v=f(1)\n", "", true},
        {"!a v=N where N=N or 1\n", "", true},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        assert_text(rows[i].script, list_of(*state, rows[i].script), rows[i].wanted);
        const char *reported = player_diagnostics(*state);
        assert_claim(rows[i].script, rows[i].quiet == (reported[0] == 0));
        assert_claim(rows[i].script, rows[i].quiet || strstr(reported, "[unbound-name]") != NULL);
    }
}

static void test_comment_gives_range_step_and_help(void **state) {
    static const struct {
        const char *comment, *wanted;
    } rows[] = {
        {"-- 1..500 how many cells", "1..500|0 'how many cells'"},
        {"--1..500", "1..500|0 ''"},
        {"--- 1..500: cells ", "1..500|0 'cells'"},
        {"-- -1..1,charge", "-inf..inf|0 '-1..1,charge'"}, // a range must be followed by a space
        {"-- -1..1, charge", "-1..1|0 'charge'"},
        {"-- 0.5..2.5|0.25 speed", "0.5..2.5|0.25 'speed'"},
        {"-- 0.. not negative", "0..inf|0 'not negative'"},
        {"-- ..9 at most", "-inf..9|0 'at most'"},
        {"-- 1k..2k hertz", "1000..2000|0 'hertz'"},
        {"-- .. anything", "-inf..inf|0 '.. anything'"},
        {"-- 5..1 wrong way round", "-inf..inf|0 '5..1 wrong way round'"},
        {"-- 1..2|0 no step", "-inf..inf|0 '1..2|0 no step'"},
        {"-- 1..many of them", "-inf..inf|0 '1..many of them'"},
        {"-- from 1..5", "-inf..inf|0 'from 1..5'"},
        {"-- ... and so on", "-inf..inf|0 '... and so on'"},
        {"--", "-inf..inf|0 ''"},
        {"", "-inf..inf|0 ''"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        char script[200], wanted[200];
        snprintf(script, sizeof script, "let N=N or 2 %s\n!a v=N\n", rows[i].comment);
        snprintf(wanted, sizeof wanted, "N 2 (2) 2/2 %s 1:5\n", rows[i].wanted);
        assert_text(rows[i].comment, list_of(*state, script), wanted);
    }
}

// A true definition overrides the default, with and without the simplifier.
static void test_definition_overrides_the_default(void **state) {
    Player *player = *state;
    static const struct {
        const char *definition, *tree, *reported;
    } rows[] = {
        {"X=1", "!a v=3;2\n",
         "warning unused definition 'X': t.fl does not read it; "
         "the parameter of the script is N [unread-definition]\n"},
        {"N=4", "!a v=4;2\n", ""},
        {"N=5;1", "!a v=5;1;2\n", ""},
        {"N=11", "!a v=11;2\n", "warning t.fl:1:5 N=11 is outside the range 1..10 [out-of-range]\n"},
        {"N=nan", "!a v=nan;2\n", "warning t.fl:1:5 N=nan is not a number [out-of-range]\n"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        for (int simplify = 1; simplify >= 0; simplify--) {
            PetriOptions options = player_options(player);
            options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
            player_reopen(player, &options);
            assert_int_equal(petri_define(player->session, rows[i].definition), PETRI_OK);
            player_run(player, "let N=N or 3 -- 1..10\n!a v=N;2\n", 1);
            assert_text(rows[i].definition, player_tree(player), rows[i].tree);
            assert_text(rows[i].definition, player_diagnostics(player), rows[i].reported);
        }
}

static void give(PetriSession *session, int way, double x) {
    char text[40];
    if (way == 0) {
        assert_int_equal(petri_set_global(session, "N", (PetriValue){1, &x, NULL}), PETRI_OK);
    } else if (way == 1) {
        snprintf(text, sizeof text, "%g", x);
        assert_int_equal(petri_set_parameter(session, "N", text), PETRI_OK);
    } else {
        snprintf(text, sizeof text, "N=%g", x);
        assert_int_equal(petri_define(session, text), PETRI_OK);
        assert_int_equal(petri_reload(session, NULL), PETRI_OK);
    }
}

// A value, the text of a parameter and a definition are the same to a script, before its first frame and later.
static void test_values_are_passed_in_one_way(void **state) {
    static const char script[] = "let N=N or 3 -- 1..10\n!physics state=:s dimensions=1 time=frame\n"
                                 "    for i in ..N\n        !particle id=i position=i\n    !constant force=N\n";
    Player *player = *state;
    uint8_t digests[3][3][16];
    for (int way = 0; way < 3; way++) {
        PetriOptions options = player_options(player);
        player_reopen(player, &options);
        if (way == 0)
            give(player->session, way, 4);
        assert_int_equal(player_load(player, script), PETRI_OK);
        for (int frame = 0; frame < 3; frame++) {
            if (frame != 1)
                give(player->session, way, 4 + frame);
            player_step(player, 1);
            assert_int_equal(petri_digest(player->session, digests[way][frame]), PETRI_OK);
            if (memcmp(digests[way][frame], digests[0][frame], 16) != 0)
                fail_msg("way %d, frame %d: %s", way, frame, player_state(player));
        }
    }
    assert_memory_not_equal(digests[0][0], digests[0][2], 16);
}

// A definition that `or` would replace is an error that names a declaration without `or`. That declaration accepts it.
static void test_false_definitions(void **state) {
    Player *player = *state;
    static const struct {
        const char *script, *definition, *tree, *reported;
    } rows[] = {
        {"let N=N or 3 -- 1..10\n!a v=N\n", "N=0", NULL,
         "error t.fl:1:5 N=0 has no effect: 0 is false, so `or` uses the default 3 [false-definition]\n"},
        {"let N=N or (3;4)\n!a v=N\n", "N=0;0", NULL,
         "error t.fl:1:5 N=0;0 has no effect: 0;0 is false, so `or` uses the default (3;4) [false-definition]\n"},
        {"let N=N or 0\n!a v=N\n", "N=0", "!a v=0\n", ""},
        {"let T=T or 'x'\n!a v=T\n", "T=", NULL,
         "error t.fl:1:5 T='' has no effect: '' is false, so `or` uses the default 'x' [false-definition]\n"},
        {"let T=T if T != null else 'x'\n!a v=T;1\n", "T=", "!a v='';1\n", ""},
        {"let N=N if N != null else 3 -- 0..10\n!a v=N\n", "N=0", "!a v=0\n", ""},
        {"let N=N if N != null else 3 -- 0..10\n!a v=N\n", "M=1", "!a v=3\n",
         "warning unused definition 'M': t.fl does not read it; the parameter of the script is N "
         "[unread-definition]\n"},
        {"let N=N if null != N else 3 -- 1..10\n!a v=N\n", "N=0", "!a v=0\n",
         "warning t.fl:1:5 N=0 is outside the range 1..10 [out-of-range]\n"},
        {"let size=WIDTH if WIDTH != null else -3 -- -9..9\n!a v=size\n", "WIDTH=0", "!a v=0\n", ""},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        for (int simplify = 1; simplify >= 0; simplify--) {
            PetriOptions options = player_options(player);
            options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
            player_reopen(player, &options);
            assert_int_equal(petri_define(player->session, rows[i].definition), PETRI_OK);
            PetriStatus status = player_load(player, rows[i].script);
            assert_int_equal(status, rows[i].tree ? PETRI_OK : PETRI_INVALID);
            if (rows[i].tree) {
                player_step(player, 1);
                assert_text(rows[i].script, player_tree(player), rows[i].tree);
            }
            assert_text(rows[i].script, player_diagnostics(player), rows[i].reported);
        }
}

// A session whose parameter cannot be set to 0 keeps its last value. Without `or`, 0 is a value like any other.
static void test_zero_is_set(void **state) {
    Player *player = *state;
    PetriParameter parameter;
    player_run(player, "let A=A or 3\n    B=B if B != null else 3 -- 0..9|1 bees\n!a v=A;B\n", 1);
    assert_int_equal(petri_set_parameter(player->session, "A", "2"), PETRI_OK);
    assert_int_equal(petri_set_parameter(player->session, "A", "0"), PETRI_INVALID);
    assert_int_equal(petri_set_parameter(player->session, "B", "0"), PETRI_OK);
    player_step(player, 1);
    assert_text("0 is a value of B", player_tree(player), "!a v=2;0\n");
    assert_true(petri_parameter(player->session, 1, &parameter, sizeof parameter));
    assert_true(parameter.accepts_false && parameter.defined && parameter.number == 0 && parameter.max == 9);
    assert_text("comment", parameter.comment, "bees");
    assert_text("default", parameter.default_value, "3");
    assert_int_equal(petri_set_parameter(player->session, "B", NULL), PETRI_OK);
    player_step(player, 1);
    assert_text("the default again", player_tree(player), "!a v=2;3\n");
}

// An unused definition is reported. The diagnostic's position shows the cause.
static void test_unused_definitions_are_reported(void **state) {
    static const struct {
        const char *definition, *script, *reported;
    } rows[] = {
        {"CELLS=5", "!b\nlet CELLS=200\n!a v=CELLS\n",
         "warning t.fl:2:5 unused definition 'CELLS': the script binds this name itself "
         "[unused-definition]\n"},
        {"CELLS=5", "for CELLS in ..2\n    !a v=CELLS\n",
         "warning t.fl:1:5 unused definition 'CELLS': the script binds this name itself "
         "[unused-definition]\n"},
        {"CELL=5", "let CELLS=CELLS or 2\n!a v=CELLS\n",
         "warning t.fl:1:5 unused definition 'CELL': t.fl does not read it [unknown-parameter]\n"},
        {"fps=5", "!a v=fps\n", "warning unused definition 'fps': petri sets this name itself [unused-definition]\n"},
        {"FOO=5", "!a\n", "warning unused definition 'FOO': t.fl does not read it [unread-definition]\n"},
        {"FOO=5", "let A=A or 1 B=B or 2 C=C or 3\n",
         "warning unused definition 'FOO': t.fl does not read it; the parameters of the script are A, B and C "
         "[unread-definition]\n"},
        // The definition is used, even if only before the script binds the name.
        {"CELLS=5", "!a v=CELLS\nlet CELLS=200\n!a v=CELLS\n", ""},
        {"CELLS=5", "let CELLS=CELLS*2\n!a v=CELLS\n", ""},
        {"CELLS=5", "func f()\n    CELLS\n!a v=f()\n", ""},
        {"sin=5", "!a v=sin\n", ""},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        Player *player = *state;
        PetriOptions options = player_options(player);
        player_reopen(player, &options);
        assert_int_equal(petri_define(player->session, rows[i].definition), PETRI_OK);
        player_run(player, rows[i].script, 1);
        assert_text(rows[i].script, player_diagnostics(player), rows[i].reported);
    }
    // If a definition is repeated, only the last one counts: N=77, which is out of range, causes no warning.
    Player *player = *state;
    assert_int_equal(petri_define(player->session, "N=77"), PETRI_OK);
    assert_int_equal(petri_define(player->session, "N=3"), PETRI_OK);
    player_run(player, "let N=N or 2 -- 1..9\n!a v=N;sin\n", 1);
    assert_text("last", player_diagnostics(player), "");
}

// Hints are separate lines of the rendered text.
static void store_rendered(void *host, const PetriDiagnostic *diagnostic) {
    Player *player = host;
    note(&player->diagnostics, diagnostic->rendered, strlen(diagnostic->rendered));
}

static void test_hints_are_rendered(void **state) {
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.on_diagnostic = store_rendered;
    player_reopen(player, &options);
    assert_int_equal(petri_define(player->session, "CELS=5"), PETRI_OK);
    assert_int_equal(petri_define(player->session, "DISH=5"), PETRI_OK);
    assert_int_equal(petri_load_text(player->session, "t.fl", "let CELLS=CELLS or 2 DISH=3\n", PETRI_NUL_TERMINATED),
                     PETRI_OK);
    assert_text("rendered", player_diagnostics(player),
                "t.fl:1:5: warning: unused definition 'CELS': t.fl does not read it [unknown-parameter]\n"
                "    let CELLS=CELLS or 2 DISH=3\n"
                "        ^~~~~\n"
                "    did you mean 'CELLS'?\n"
                "t.fl:1:22: warning: unused definition 'DISH': the script binds this name itself "
                "[unused-definition]\n"
                "    let CELLS=CELLS or 2 DISH=3\n"
                "                         ^~~~\n"
                "    write `let DISH=DISH or …` to use the definition\n");
}

// If the default consists of numbers, the definition must consist of numbers as well.
static void test_invalid_definitions_are_rejected(void **state) {
    Player *player = *state;
    static const struct {
        const char *definition, *default_value, *reported;
    } rows[] = {
        {"N=12x", "3",
         "error t.fl:1:5 '12x' is not a number; 'N' takes numbers, such as its default 3 [bad-definition]\n"},
        {"N=", "3", "error t.fl:1:5 '' is not a number; 'N' takes numbers, such as its default 3 [bad-definition]\n"},
        {"N=1;b", "(1;2)",
         "error t.fl:1:5 'b' is not a number; 'N' takes numbers, such as its default (1;2) [bad-definition]\n"},
        {"N=:a", "3", "error t.fl:1:5 :a is not a number; 'N' takes numbers, such as its default 3 [bad-definition]\n"},
        {"N=12x", "'text'", ""},
        {"N=12x", ":ring", ""},
        {"N=12x", "beat", ""},
        {"N=:a", ":ring", ""},
        {"N=1:30", "3", ""},
        {"N=2k", "3", ""},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        PetriOptions options = player_options(player);
        char script[100];
        snprintf(script, sizeof script, "let N=N or %s\n!a v=N\n", rows[i].default_value);
        player_reopen(player, &options);
        assert_int_equal(petri_define(player->session, rows[i].definition), PETRI_OK);
        bool wrong = rows[i].reported[0] != 0;
        assert_int_equal(player_load(player, script), wrong ? PETRI_INVALID : PETRI_OK);
        assert_text(rows[i].definition, player_diagnostics(player), rows[i].reported);
    }
    static const char *const bad[] = {"5=3", "a b=3", " a=3", "a-b=3", "'=3", "a'b=3"};
    for (size_t i = 0; i < COUNT_OF(bad); i++)
        assert_claim(bad[i], petri_define(player->session, bad[i]) == PETRI_INVALID);
    static const char *const good[] = {"a=3", "_=3", "é2=3", "a'=3", "if=3"};
    for (size_t i = 0; i < COUNT_OF(good); i++)
        assert_claim(good[i], petri_define(player->session, good[i]) == PETRI_OK);
}

static const char DISH[] = "let N=N or 3 -- 1..5|2 rounds\n"
                           "let S=S or 'a'\n"
                           "!unbound v=nowhere\n"
                           "!a v=N;S f=frame\n"
                           "!counter state=:c rate=60\n";

// Sets a parameter while the simulation continues.
static void test_set_parameter(void **state) {
    Player *player = *state;
    assert_int_equal(petri_set_parameter(player->session, "N", "4"), PETRI_INVALID); // no script is loaded
    player_run(player, DISH, 3);
    player_forget(player);
    assert_int_equal(petri_set_parameter(player->session, "N", "5"), PETRI_OK);
    assert_text("diagnostics are not repeated", player_diagnostics(player), "");
    assert_text("set", list(player),
                "N 5 (3) 5/3 1..5|2 'rounds' 1:5 defined\nS 'a' ('a') nan/nan -inf..inf|0 '' 2:5\n");
    player_step(player, 1);
    assert_text("it is there in the next frame", player_tree(player),
                "!unbound\n!a v=5;'a' f=3\n!counter state=:c rate=60\n");
    assert_text("the state continues", player_state(player), "$:c = 3\n$(:c;:time) = 0.05\n");
    assert_int_equal(petri_set_parameter(player->session, "S", "b c"), PETRI_OK);
    assert_int_equal(petri_set_parameter(player->session, "N", NULL), PETRI_OK);
    player_step(player, 1);
    assert_text("the default again", player_tree(player), "!unbound\n!a v=3;'b c' f=4\n!counter state=:c rate=60\n");
    uint64_t number = petri_config_revision(player->session);
    assert_int_equal(petri_set_parameter(player->session, "N", "x"), PETRI_INVALID);
    assert_text("wrong", player_diagnostics(player),
                "error t.fl:1:5 'x' is not a number; 'N' takes numbers, such as its default "
                "3 [bad-definition]\n");
    assert_int_equal(petri_set_parameter(player->session, "M", "1"), PETRI_INVALID);
    assert_int_equal(petri_set_parameter(player->session, "", "1"), PETRI_INVALID);
    assert_true(number <= petri_config_revision(player->session));
    player_step(player, 1);
    assert_text("a failure changes nothing", player_tree(player),
                "!unbound\n!a v=3;'b c' f=5\n!counter state=:c rate=60\n");
    // A reload keeps the value.
    assert_int_equal(petri_set_parameter(player->session, "N", "4"), PETRI_OK);
    player_run(player, DISH, 1);
    assert_text("reloaded", player_tree(player), "!unbound\n!a v=4;'b c' f=0\n!counter state=:c rate=60\n");
}

// Rewinding also restores the value.
static void test_rewind_restores_parameter(void **state) {
    Player *player = *state;
    player_run(player, DISH, 2);
    PetriSnapshot *before = petri_snapshot(player->session);
    assert_int_equal(petri_set_parameter(player->session, "N", "5"), PETRI_OK);
    player_step(player, 1);
    assert_int_equal(petri_rewind(player->session, before), PETRI_OK);
    player_step(player, 1);
    assert_text("as it was", player_tree(player), "!unbound\n!a v=3;'a' f=2\n!counter state=:c rate=60\n");
    petri_snapshot_free(before);
}

// A slider that moves for hours defines one name many times.
static void test_definitions_replace_earlier_ones(void **state) {
    Player *player = *state;
    char definition[20], wanted[40];
    enum { MANY = 20000 };
    assert_int_equal(petri_define(player->session, "B=5"), PETRI_OK);
    for (int i = 1; i <= MANY; i++) {
        snprintf(definition, sizeof definition, "A=%d", i);
        assert_int_equal(petri_define(player->session, definition), PETRI_OK);
    }
    player_run(player, "!a v=A;B\n", 1);
    snprintf(wanted, sizeof wanted, "!a v=%d;5\n", MANY);
    assert_text("last", player_tree(player), wanted);
}

// Modules do not see definitions (L13.2); included files do.
static void test_modules_do_not_see_definitions(void **state) {
    Player *player = *state;
    Folder folder;
    folder_open(&folder);
    folder_write(&folder, "inner.fl", "let DEEP=DEEP or 1\n");
    folder_write(&folder, "m.fl",
                 "import DEEP from 'inner.fl'\nlet SIZE=SIZE or 3 -- 1..9 large\n"
                 "func f(x)\n    x*SIZE*DEEP\n");
    folder_write(&folder, "part.fl", "let PART=PART or 7 -- in a part\n!part v=PART\n");
    folder_write(&folder, "main.fl",
                 "%include 'part.fl'\nimport f from 'm.fl'\nimport f from 'none.fl'\n"
                 "let N=N or 2\nimport f from 'm.fl'\n!a v=f(N)\n");
    assert_int_equal(petri_define(player->session, "PART=8"), PETRI_OK);
    assert_int_equal(petri_define(player->session, "SIZE=4"), PETRI_OK);
    assert_int_equal(petri_load(player->session, folder_file(&folder, "main.fl")), PETRI_OK);
    const char *reported = player_diagnostics(player);
    assert_non_null(strstr(
        reported,
        "m.fl:2:5 unused definition 'SIZE': it is a parameter of a module, and definitions do not apply to modules"));
    assert_null(strstr(reported, "PART"));
    assert_text("files", list(player),
                "PART 8 (7) 8/7 -inf..inf|0 'in a part' 1:5 defined\n"
                "N 2 (2) 2/2 -inf..inf|0 '' 4:5\n"
                "SIZE 3 (3) 3/3 1..9|0 'large' 2:5 fixed\n"
                "DEEP 1 (1) 1/1 -inf..inf|0 '' 1:5 fixed\n");
    assert_int_equal(petri_set_parameter(player->session, "SIZE", "4"), PETRI_INVALID);
    player_forget(player);
    player_step(player, 2);
    assert_text("values", player_tree(player), "!part v=8\n!a v=6\n");
    assert_null(strstr(player_diagnostics(player), "unbound")); // SIZE on the right may be unbound
    folder_close(&folder);
}

// After a change of definitions, the script is recompiled, but neither it nor unchanged included files are parsed
// again. This also holds after petri_config_apply, which petri sweep calls before each run.
static void test_recompiling_does_not_parse(void **state) {
    Player *player = *state;
    PetriSession *session = player->session;
    Folder folder;
    const Source *script = NULL, *part = NULL;
    folder_open(&folder);
    folder_write(&folder, "part.fl", "let A=A or 1\n!part v=A\n");
    folder_write(&folder, "main.fl", "%include 'part.fl'\nlet B=B or 2\n!a v=B\n");
    assert_int_equal(petri_load(session, folder_file(&folder, "main.fl")), PETRI_OK);
    PetriConfig *base = petri_config_get(session);
    for (int i = 0; i < 4; i++) {
        char definition[20], wanted[60];
        petri_config_apply(session, base);
        snprintf(definition, sizeof definition, i < 2 ? "A=%d" : "B=%d", i + 5);
        assert_int_equal(petri_define(session, definition), PETRI_OK);
        assert_int_equal(petri_reload(session, NULL), PETRI_OK);
        assert_int_equal(petri_set_parameter(session, i < 2 ? "B" : "A", "9"), PETRI_OK);
        player_step(player, 1);
        snprintf(wanted, sizeof wanted, "!%s v=%d\n!a v=%d\n", i < 3 ? "part" : "changed", i < 2 ? i + 5 : 9,
                 i < 2 ? 9 : i + 5);
        assert_text("values", player_tree(player), wanted);
        const Unit *unit = session->config.program;
        assert_true(i == 0 || unit->source == script);
        assert_true(i == 0 || (unit->parse_cache->parsed->source == part) == (i < 3));
        script = unit->source;
        part = unit->parse_cache->parsed->source;
        if (i == 2)
            folder_write(&folder, "part.fl", "let A=A or 1\n!changed v=A\n");
    }
    petri_config_free(base);
    folder_close(&folder);
}

TEST_GROUP(session_parameters) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_parameters_are_recognised),
        PLAYER_TEST(test_comment_gives_range_step_and_help),
        PLAYER_TEST(test_definition_overrides_the_default),
        PLAYER_TEST(test_values_are_passed_in_one_way),
        PLAYER_TEST(test_false_definitions),
        PLAYER_TEST(test_zero_is_set),
        PLAYER_TEST(test_unused_definitions_are_reported),
        PLAYER_TEST(test_hints_are_rendered),
        PLAYER_TEST(test_invalid_definitions_are_rejected),
        PLAYER_TEST(test_set_parameter),
        PLAYER_TEST(test_rewind_restores_parameter),
        PLAYER_TEST(test_definitions_replace_earlier_ones),
        PLAYER_TEST(test_modules_do_not_see_definitions),
        PLAYER_TEST(test_recompiling_does_not_parse),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
