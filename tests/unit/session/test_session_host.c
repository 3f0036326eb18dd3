// test_session_host.c: tests guarantees that petri.h gives to hosts.
#include "petri-inspect.h"
#include "player.h"

#include <math.h>

static void test_options_without_defaults_are_rejected(void **state) {
    (void)state;
    PetriOptions options;
    memset(&options, 0, sizeof options);
    assert_null(petri_open(&options)); // the struct is not from petri_default_options
    memset(&options, 0xff, sizeof options);
    assert_null(petri_open(&options));
    assert_null(petri_open(NULL));
    assert_string_equal(petri_options_problem(NULL),
                        "the options were not initialised, or a later version of petri knows one of them");
    options = petri_default_options();
    options.fps = 0;
    assert_null(petri_open(&options));
    assert_string_equal(petri_options_problem(&options), "fps is not positive and finite");
    options.fps = 1;
    options.spec = "0.2";
    assert_null(petri_open(&options));
    assert_string_equal(petri_options_problem(&options), "spec is not a version of the specification");
    options.spec = "0.3";
    options.tuning = &(PetriTuning){.no_batches = true};
    assert_string_equal(petri_options_problem(&options), "tuning was not initialised");
    options = petri_default_options();
    assert_null(petri_options_problem(&options));
    assert_number("fps", options.fps, 60);
    assert_false(options.realtime);
    assert_true(isnan(options.run_time));
    assert_int_equal(options.stack_limit, 4 << 20);
    assert_int_equal(options.memory_limit, (size_t)2 << 30);
    PetriSession *session = petri_open(&options); // no diagnostic callback is set
    assert_non_null(session);
    assert_int_equal(petri_load_text(session, "t.fl", "!a )", PETRI_NUL_TERMINATED), PETRI_INVALID);
    assert_int_equal(petri_diagnostic_count(session, PETRI_ERROR), 1);
    petri_close(&session);
    assert_null(session);
    petri_close(&session); // NULL is ignored
}

static void test_without_a_script(void **state) {
    Player *player = *state;
    assert_int_equal(petri_step(player->session), PETRI_INVALID);
    assert_int_equal(petri_frame_number(player->session), -1);
    assert_int_equal(petri_dump(player->session, PETRI_DUMP_AST, note, &player->printed), PETRI_INVALID);
    assert_text("nothing", player_print(player, 15), "");
    assert_string_equal(player->printed.text, "@-1 time=0 beat=0\n");
}

static void test_text_lengths(void **state) {
    Player *player = *state;
    assert_int_equal(petri_load_text(player->session, "t.fl", "!a !b )", 2), PETRI_OK);
    player_step(player, 1);
    assert_text("two bytes", player_tree(player), "!a\n");
    assert_int_equal(petri_load_text(player->session, "t.fl", "", 0), PETRI_OK);
    char text[] = "!a x='s'";
    assert_int_equal(petri_load_text(player->session, "t.fl", text, PETRI_NUL_TERMINATED), PETRI_OK);
    memset(text, '!', sizeof text - 1); // the text may be overwritten after the call
    player_step(player, 2);
    assert_text("copied", player_tree(player), "!a x='s'\n");
}

#define STATE "$(:c;'k') = 1.25;2.25\n$(:c;'k';:time) = 0.25\n$\"it's\" = :a\n$(\"it's\";:time) = 0.25\n"
// Expected hash, from printf STATE | sha256sum.
#define STATE_HASH "= 1d40801a6533593b67849dffa0352f51200276585fe3c23a3c9adf4ccb34336d\n"

static void test_print_writes_the_sections_asked_for(void **state) {
    Player *player = *state;
    player_run(
        player,
        "%pragma fps 4\n%pragma tempo 60\n!counter state=:c;'k' initial=1;2 rate=1\n!counter state='it\\'s' rate=0 "
        "initial=:a\n"
        "debug(frame)\ndebug('x')\ndebug('x')\n!a v='s'(1)\n'b'\n    !lost\n",
        2);
    static const struct {
        unsigned sections;
        const char *wanted;
    } rows[] = {
        {0, "@1 time=0.25 beat=0.25\n"},
        {PETRI_PRINT_TREE, "@1 time=0.25 beat=0.25\n"
                           "!counter state=:c;'k' initial=1;2 rate=1\n!counter state=\"it's\" rate=0 initial=:a\n!a\n"},
        {PETRI_PRINT_STATE, "@1 time=0.25 beat=0.25\n" STATE},
        {PETRI_PRINT_LOG, "@1 time=0.25 beat=0.25\n> 1\n> 'x'\n"},
        {PETRI_PRINT_ERROR, "@1 time=0.25 beat=0.25\n? a string cannot be called (t.fl:8)\n"},
        {PETRI_PRINT_LOG | PETRI_PRINT_ERROR,
         "@1 time=0.25 beat=0.25\n> 1\n> 'x'\n? a string cannot be called (t.fl:8)\n"},
        {PETRI_PRINT_HASH, "@1 time=0.25 beat=0.25\n" STATE_HASH},
        {PETRI_PRINT_HASH | PETRI_PRINT_STATE | PETRI_PRINT_ERROR,
         "@1 time=0.25 beat=0.25\n" STATE "? a string cannot be called (t.fl:8)\n" STATE_HASH},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        player_print(player, rows[i].sections);
        assert_text("sections", player->printed.text, rows[i].wanted);
    }
    player->printed.len = 0;
    assert_int_equal(petri_print_log(player->session, note, &player->printed), PETRI_OK);
    assert_text("log", player->printed.text, "> 1\n> 'x'\n");
}

static bool stop_writing(void *host, const char *text, size_t len) {
    (void)text;
    (void)len;
    return ++*(int *)host < 1;
}

static void test_writer_can_stop(void **state) {
    Player *player = *state;
    player_run(player, "for i in ..30000\n    !a v=i\n", 1);
    int calls = 0;
    assert_int_equal(petri_print(player->session, PETRI_PRINT_TREE, stop_writing, &calls), PETRI_INVALID);
    assert_int_equal(calls, 1);
    assert_true(strlen(player_tree(player)) > 200000); // if the callback never stops, the output is complete
}

static void test_dump_writes_tree_or_code(void **state) {
    Player *player = *state;
    player_run(player, "let x=frame\n!a v=x\n", 1);
    player->printed.len = 0;
    assert_int_equal(petri_dump(player->session, PETRI_DUMP_AST, note, &player->printed), PETRI_OK);
    assert_non_null(strstr(player->printed.text, "attr v  @2:4"));
    player->printed.len = 0;
    assert_int_equal(petri_dump(player->session, PETRI_DUMP_CODE, note, &player->printed), PETRI_OK);
    assert_non_null(strstr(player->printed.text, "frame"));
}

static void note_token(void *host, const PetriToken *token) {
    char line[40];
    int len = snprintf(line, sizeof line, "%c%zu-%zu ", "nk1s:!#o-?;><"[token->kind], token -> start, token -> end);
    note(host, line, (size_t)len);
}

// Each token is written as a letter for its kind, followed by its range. Words are keywords only where the grammar
// expects one.
static void test_tokens_have_kinds_and_ranges(void **state) {
    static const struct {
        const char *text;
        const char *tokens;
    } rows[] = {
        {"", ";0-0 "},
        {"let in=1:30", "k0-3 n4-6 o6-7 17-11 ;11-11 "},
        {"let a=1:30 -- x", "k0-3 n4-5 o5-6 16-10 ;11-11 -11-15 "},
        {"!a #t x='s'\n  !b\n", "!0-2 #3-5 n6-7 o7-8 s8-11 ;11-11 >14-14 !14-16 ;16-16 <17-17 "},
        {"-- c\n(1\n-- d\n;:a)\n", ";0-0 -0-4 o5-6 16-7 -8-12 o13-14 :14-16 o16-17 ;17-17 "},
        {"#! x\n!a\n", "-0-4 !5-7 ;7-7 "},
        {"!a x=)\nfor i in 3\n !b\n",
         "!0-2 n3-4 o4-5 o5-6 ;6-6 k7-10 n11-12 k13-15 116-17 ;17-17 >19-19 !19-21 ;21-21 <22-22 "},
        {"!a ?\n!b\n", "!0-2 ?3-4 ;4-4 !5-7 ;7-7 "},
        {"%pragma fps 20\n", "k0-7 n8-11 112-14 ;14-14 "},
        {") 2 's'\n!b\n", "o0-1 12-3 s4-7 ;7-7 !8-10 ;10-10 "}, // the rest of the line after an error in line 1
    };
    Player *player = *state;
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        player->printed.len = 0;
        note(&player->printed, "", 0);
        assert_int_equal(
            petri_tokenise(player->session, rows[i].text, PETRI_NUL_TERMINATED, note_token, &player->printed),
            PETRI_OK);
        assert_string_equal(player->printed.text, rows[i].tokens);
    }
}

typedef struct NamesRow {
    const char *text;
    const char *names;
} NamesRow;

// Checks what `note_binding` writes for all names of each text.
static void check_names(Player *player, const NamesRow *rows, size_t count,
                        void (*note_binding)(void *host, const PetriBinding *name)) {
    for (size_t i = 0; i < count; i++) {
        player->printed.len = 0;
        note(&player->printed, "", 0);
        assert_int_equal(
            petri_bindings(player->session, rows[i].text, PETRI_NUL_TERMINATED, note_binding, &player->printed),
            PETRI_OK);
        assert_string_equal(player->printed.text, rows[i].names);
    }
}

static void note_name(void *host, const PetriBinding *name) {
    char line[60];
    int len = name->kind != PETRI_NAME_USE ? snprintf(line, sizeof line, "%c%zu[%zu-%zu] ", "?lfpxi"[name->kind],
                                                      name -> start, name -> scope_start, name -> scope_end)
              : name->binding_start == PETRI_NUL_TERMINATED
                  ? snprintf(line, sizeof line, "%zu? ", name->start)
                  : snprintf(line, sizeof line, "%zu=%zu ", name->start, name->binding_start);
    note(host, line, (size_t)len);
}

// Each name is written with its binding or its scope (language.md L8.2). After a syntax error, only the names of the
// erroneous statement are missing.
static void test_names_have_bindings_and_scopes(void **state) {
    static const NamesRow rows[] = {
        {"let a=a\n!n x=a\n", "6? l4[7-15] 13=4 "},
        {"let a=1 b=a\n", "l4[7-12] 10=4 l8[11-12] "},
        {"func f(x, y=x)\n    f(x)\nf(1, y=2)\n", "12? f5[19-34] p7[19-24] p10[19-24] 19=5 21=7 24=5 29=10 "},
        {"for i in i\n    i\ni\n", "9? x4[15-17] 15=4 17? "},
        {"!n x=a;b where a=b b=1\n", "5? 17? l15[7-8] l19[7-8] 7=19 "},
        {"if 1\n    let a=1\n    a\na\n", "l13[16-23] 21=13 23? "},
        {"import a;b from 'f'\nb\n", "i7[20-22] i9[20-22] 20=9 "},
        {"let a=1\n!n x=)\n!m x=a\n", "l4[7-22] 20=4 "},
        {"let a=1\nfunc f()\n    let b=\na\n", "l4[7-30] f13[21-30] 28=4 "},
        {"let a=1\nlet b=\n!m x=a\nlet c=", "l4[7-29] 20=4 "},
        {"let a=1\n!n x=a )\n!m x=a\n", "l4[7-24] 22=4 "},
        {"let a=1\n!n x=(a\n", "l4[7-16] "},
        {"if x\n!m y=a\n", "10? "},
        {") a\n!m x=b\n", "9? "},
        {"let f='x'\nimport a from f\n", "l4[9-26] 24=4 i17[26-26] "},
        // Names of arguments are uses only if the called function is known.
        {"let f=func(x) x\nf(x=1)\n", "p11[14-15] 14=11 l4[15-23] 16=4 18=11 "},
        {"let f=(x;y)[0]\nf(x=1)\n", "7? 9? l4[14-22] 15=4 "},
    };
    check_names(*state, rows, COUNT_OF(rows), note_name);
}

static void note_value(void *host, const PetriBinding *name) {
    char line[60];
    int len = snprintf(line, sizeof line, "%zu-%zu[%zu-%zu]%u%s ", name->start, name->end, name->value_start,
                       name->value_end, name->depth, name->is_sole ? "!" : "");
    if (name->kind != PETRI_NAME_USE)
        note(host, line, (size_t)len);
}

// Each binding is written with its value and depth. `!` follows if the value is bound to this name only.
static void test_bindings_have_values(void **state) {
    static const NamesRow rows[] = {
        {"let ab=1 c;d=2;3\n", "4-6[7-8]0! 9-10[13-16]0 11-12[13-16]0 "},
        {"func f(x, y=2)\n    let z=x\n    z\n", "5-6[0-33]0! 7-8[7-8]1! 10-11[10-13]1! 23-24[25-26]2! "},
        {"for i;j in ..4\n    i\n", "4-5[11-14]0 6-7[11-14]0 "},
        {"import a from 'f'\n", "7-8[14-17]0! "},
        {"!n x=a where a=2\n", "13-14[15-16]0! "},
    };
    check_names(*state, rows, COUNT_OF(rows), note_value);
}

static const char profiled_script[] = "let a=frame\n\n!b x=a\n!counter state=:c rate=1\n";

// The profile has one row for each line that was evaluated in a frame. Folded lines have none.
static void test_profile_has_row_per_line(void **state) {
    Player *player = *state;
    player_run(player, profiled_script, 3);
    assert_int_equal(petri_profile(player->session, 0, note, &player->printed), PETRI_INVALID);
    PetriOptions options = player_options(player);
    options.profile = true;
    player_reopen(player, &options);
    for (int load = 0; load < 2; load++) { // loading clears the measurements
        player_run(player, profiled_script, 3);
        player->printed.len = 0;
        assert_int_equal(petri_profile(player->session, 0.5, note, &player->printed), PETRI_OK);
        const char *text = player->printed.text;
        assert_non_null(strstr(text, " ms per frame, 3 frames\n"));
        assert_non_null(strstr(text, "166.6667               output\n"));
        assert_non_null(strstr(text, " 1  t.fl:1: let a=frame\n"));
        assert_non_null(strstr(text, " 1  t.fl:3: !b x=a\n"));
        assert_non_null(strstr(text, "physics\n"));
        // The rows have shares of the total time. The output, which has the largest share, comes first.
        double total = 0, share = 0;
        assert_int_equal(sscanf(strstr(text, "total: "), "total: %lf", &total), 1);
        assert_int_equal(sscanf(strchr(text, '\n'), "%lf %%", &share), 1);
        assert_claim("share", total > 166 && fabs(share - 100 * 166.6667 / total) < 0.1);
        assert_null(strstr(text, "t.fl:2"));
        assert_null(strstr(text, "t.fl:4"));
        assert_text("the same frames", player_tree(player), "!b x=2\n!counter state=:c rate=1\n");
    }
    int calls = 0;
    assert_int_equal(petri_profile(player->session, 0, stop_writing, &calls), PETRI_INVALID);
}

static void test_failed_load_keeps_the_script(void **state) {
    Player *player = *state;
    player_run(player, "!a v=frame\n!counter state=:c rate=1\n", 3);
    static const char *const bad[] = {"!b )", "let", "\xff", "'x", "!a\n  !b\n !c\n"};
    for (size_t i = 0; i < COUNT_OF(bad); i++) {
        player_forget(player);
        assert_claim(bad[i], player_load(player, bad[i]) == PETRI_INVALID);
        assert_claim(bad[i], strstr(player_diagnostics(player), "error t.fl:") != NULL);
        assert_text("the frame is still there", player_tree(player)[1] == 'a' ? "!a" : "?", "!a");
        player_step(player, 1);
        assert_int_equal(petri_frame_number(player->session), 3 + i);
    }
    assert_text("continues", player_tree(player), "!a v=7\n!counter state=:c rate=1\n");
}

// Each diagnostic is reported once per position, until the next load.
static void test_diagnostics_are_reported_once_per_load(void **state) {
    Player *player = *state;
    static const char script[] = "!a v='s'(1);nothing\n!physics state=:s dimensions=1 colour=1\n";
    static const char wanted[] = "warning t.fl:1:13 unbound name 'nothing' is null [unbound-name]\n"
                                 "warning t.fl:1:6 a string cannot be called [not-callable]\n"
                                 "warning !physics state=:s: unknown attribute 'colour' [unknown-attribute]\n";
    player_run(player, script, 5);
    assert_text("first load", player_diagnostics(player), wanted);
    player_forget(player);
    player_step(player, 5);
    assert_text("not repeated", player_diagnostics(player), "");
    player_run(player, script, 5);
    assert_text("second load", player_diagnostics(player), wanted);
    for (int i = 0; i < 2; i++) {
        player_forget(player);
        assert_int_equal(player_load(player, "!a )\n"), PETRI_INVALID);
        assert_text("an error is reported at every attempt", player_diagnostics(player),
                    "error t.fl:1:4 unexpected ')', expected end of line or '<<' [syntax]\n");
    }
}

// Problems that are found while compiling are reported in the order of the text.
static void test_diagnostics_follow_text(void **state) {
    Player *player = *state;
    player_run(player, "!a v=one;x where x=two\n", 1); // `two` is compiled first
    assert_text("order", player_diagnostics(player),
                "warning t.fl:1:6 unbound name 'one' is null [unbound-name]\n"
                "warning t.fl:1:20 unbound name 'two' is null [unbound-name]\n");
}

// Two messages at one position are two diagnostics (language.md L15.1).
static void test_texts_at_one_position_are_distinct(void **state) {
    Player *player = *state;
    player_run(player, "!a v=(read(f) for f in ('missing1';'missing2'))\n", 1);
    assert_text("frame", player_print(player, PETRI_PRINT_ERROR),
                "? read: cannot read 'missing1': no such file (t.fl:1)\n"
                "? read: cannot read 'missing2': no such file (t.fl:1)\n");
}

// After loading another script, no output or data of the old script remains.
static void test_load_clears_output(void **state) {
    Player *player = *state;
    player_run(player, "!a v='s'(1)\ndebug('old')\n", 1);
    assert_int_equal(player_load(player, "!b\n"), PETRI_OK);
    player_print(player, 15);
    assert_text("nothing", player->printed.text, "@-1 time=0 beat=0\n");
}

static void test_diagnostics_are_limited(void **state) {
    Player *player = *state;
    Notebook script = {0};
    for (int i = 0; i < 300; i++) {
        char line[80];
        int len = snprintf(line, sizeof line, "!physics state=:s%d dimensions=0\n    !q a=1\n", i);
        note(&script, line, (size_t)len);
    }
    player_run(player, script.text, 2);
    uint64_t count = petri_diagnostic_count(player->session, PETRI_WARNING);
    assert_int_equal(count, 300);
    script.len = 0;
    for (int i = 0; i < 1500; i++) {
        char line[80];
        int len = snprintf(line, sizeof line, "!counter state=:c%d qqqq=1\n", i);
        note(&script, line, (size_t)len);
    }
    player_run(player, script.text, 2);
    assert_non_null(strstr(player_diagnostics(player), "further ones are not shown"));
    assert_int_equal(petri_diagnostic_count(player->session, PETRI_NOTE), 1);
    count = petri_diagnostic_count(player->session, PETRI_WARNING);
    player_step(player, 1);
    assert_int_equal(petri_diagnostic_count(player->session, PETRI_WARNING), count);
    free(script.text);
}

static void test_sessions_are_independent(void **state) {
    Player *first = *state, second;
    player_open(&second);
    assert_int_equal(petri_define(first->session, "d=1"), PETRI_OK);
    player_run(first, "%pragma fps 10\n!a v=frame;fps;d\n!counter state=:c rate=1\n", 1);
    player_run(&second, "!b v=frame;fps;d;$:c\n", 1);
    for (int i = 0; i < 3; i++) {
        player_step(first, 2);
        player_step(&second, 1);
    }
    assert_text("first", player_tree(first), "!a v=6;10;1\n!counter state=:c rate=1\n");
    assert_text("second", player_tree(&second), "!b v=3;60\n");
    assert_text("diagnostics", player_diagnostics(first), "");
    assert_non_null(strstr(player_diagnostics(&second), "unbound name 'd'"));
    // A symbol that is registered in only one session is a number in the other.
    player_run(first, "!a v=:spring\n", 1);
    player_run(&second, "!a v=:sprung+0\n", 1);
    assert_text("symbol", player_tree(first), "!a v=:spring\n");
    player_close(&second);
    player_step(first, 1);
}

static void test_colour_is_only_in_rendered(void **state) {
    (void)state;
    Player player;
    PetriOptions options = player_options(&player);
    options.colour = true;
    player_open_with(&player, &options);
    assert_int_equal(player_load(&player, "!a )"), PETRI_INVALID);
    assert_text("colour is in `rendered` only", player_diagnostics(&player),
                "error t.fl:1:4 unexpected ')', expected end of line or '<<' [syntax]\n");
    player_close(&player);
}

static void store_position(void *host, const PetriDiagnostic *diagnostic) {
    snprintf(host, 100, "%s:%u:%u", diagnostic->file ? diagnostic->file : "", diagnostic->line, diagnostic->column);
}

// The diagnostics of a node have its position, even if it was folded, or created in a loop or by a function.
static void test_diagnostics_have_node_positions(void **state) {
    (void)state;
    static const struct {
        const char *script, *wanted;
    } rows[] = {
        {"\n!physics state=:s dimensions=1\n    !particle id=1 radious=2\n", "t.fl:3:20"},
        {"!physics state=:s dimensions=1\n    for i in ..3\n        !particle id=i mess=frame\n", "t.fl:3:24"},
        {"func cell(r)\n    !particle id=1 radious=r\n!physics state=:s dimensions=1\n    cell(frame)\n", "t.fl:2:20"},
        {"!physics dimensions=1\n    !particle id=1\n", "t.fl:1:1"},
        {"!physics state=:s dimensions=1\n    !particle id=1\n    !distance from=1 to=2\n", "t.fl:3:22"},
        // An attribute that was added elsewhere has the position where it was added.
        {"let cell=!particle id=1\n!physics state=:s dimensions=1\n    cell radious=2\n", "t.fl:1:10"},
        {"!physics state=:s dimensions=1\n    !partikel id=1\n", "t.fl:2:5"},
        {"!a\n!pysics\n", "t.fl:2:1"},
    };
    for (size_t i = 0; i < COUNT_OF(rows); i++)
        for (int simplify = 0; simplify <= 1; simplify++) {
            char place[100] = "";
            PetriOptions options = petri_default_options();
            options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
            options.on_diagnostic = store_position;
            options.user_data = place;
            PetriSession *session = petri_open(&options);
            assert_int_equal(petri_load_text(session, "t.fl", rows[i].script, PETRI_NUL_TERMINATED), PETRI_OK);
            assert_int_equal(petri_step(session), PETRI_OK);
            assert_text(rows[i].script, place, rows[i].wanted);
            petri_close(&session);
        }
}

// An error in many nodes of one loop is reported once. The same error on two lines is reported twice.
static void test_loop_error_is_reported_once(void **state) {
    (void)state;
    Player player;
    player_open(&player);
    player_run(&player,
               "!physics state=:s dimensions=1\n    for i in ..50\n        !particle id=i radious=2\n"
               "    !particle id=50 radious=2\n",
               3);
    assert_int_equal(petri_diagnostic_count(player.session, PETRI_WARNING), 2);
    player_close(&player);
}

static void test_builtins_and_numbers(void **state) {
    (void)state;
    PetriBuiltin builtin;
    size_t count = 0;
    for (; petri_builtin(count, &builtin, sizeof builtin); count++) {
        assert_true(strlen(builtin.name) > 0);
        assert_non_null(builtin.parameters);
        assert_true(strlen(builtin.help) > 0);
    }
    assert_true(count > 60);
    assert_false(petri_builtin(count + 1000, &builtin, sizeof builtin));
    double x = 0;
    assert_true(petri_parse_number("1:30", &x));
    assert_number("time code", x, 90);
    assert_true(petri_parse_number("10m", &x));
    assert_number("suffix", x, 0.01);
    assert_false(petri_parse_number("soon", &x));
    assert_true(strlen(petri_version()) > 0);
}

static void test_node_kinds_and_attributes(void **state) {
    (void)state;
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    size_t kinds = 0, rects = 0, groups = 0, circles = 0;
    for (; petri_node_kind(kinds, &kind, sizeof kind); kinds++) {
        assert_true(kind.name[0] && kind.help[0]);
        circles += strncmp(kind.synonyms, "circle ", strlen("circle ")) == 0 && strcmp(kind.name, "ellipse") == 0;
        groups += strcmp(kind.name, "group") == 0;
        for (size_t i = 0; petri_node_attribute(kinds, i, &attribute, sizeof attribute); i++) {
            assert_true(attribute.name[0] && attribute.type[0] && attribute.default_value && attribute.help);
            rects += strcmp(kind.name, "rect") == 0 && strcmp(attribute.name, "radius") == 0;
        }
    }
    assert_int_equal(groups, 3); // the groups physics, canvas and canvas3d
    assert_int_equal(rects, 1);
    assert_int_equal(circles, 1);
    assert_false(petri_node_kind(kinds + 1000, &kind, sizeof kind));
    assert_false(petri_node_attribute(kinds, 0, &attribute, sizeof attribute));
}

// The session retains copies of the last diagnostics, in order.
static void test_retained_diagnostics(void **state) {
    Player *player = *state;
    PetriDiagnostic kept;
    assert_false(petri_diagnostic(player->session, 0, &kept, sizeof kept));
    player_load(player, "!a x=one y=two\n!b x=(three\n");
    assert_true(petri_diagnostic(player->session, 0, &kept, sizeof kept));
    assert_string_equal(kept.file, "t.fl");
    assert_int_equal(kept.level, PETRI_ERROR);
    petri_clear_diagnostics(player->session);
    assert_false(petri_diagnostic(player->session, 0, &kept, sizeof kept));
    player_run(player, "!a x=one y=two\n!b x=three\n", 1);
    static const char *const names[] = {"one", "two", "three"};
    for (size_t i = 0; i < 3; i++) {
        assert_true(petri_diagnostic(player->session, i, &kept, sizeof kept));
        assert_string_equal(kept.code, "unbound-name");
        assert_non_null(strstr(kept.text, names[i]));
        assert_non_null(strstr(kept.rendered, kept.text));
    }
    assert_false(petri_diagnostic(player->session, 3, &kept, sizeof kept));
    // If there are more than 100, the oldest are dropped.
    petri_clear_diagnostics(player->session);
    for (int load = 0; load < 3; load++) {
        char script[4000] = "!a";
        for (int i = 0; i < 45; i++)
            snprintf(script + strlen(script), sizeof script - strlen(script), " a%d=b%d", i, 100 * load + i);
        player_run(player, script, 1);
    }
    size_t count = 0;
    while (petri_diagnostic(player->session, count, &kept, sizeof kept))
        count++;
    assert_int_equal(count, 100);
    assert_true(petri_diagnostic(player->session, 0, &kept, sizeof kept));
    const char *first = strstr(player_diagnostics(player), kept.text);
    assert_non_null(first);
    assert_true(petri_diagnostic(player->session, 99, &kept, sizeof kept));
    assert_true(strstr(player_diagnostics(player), kept.text) > first);
}

static void test_version_and_status_texts(void **state) {
    (void)state;
    char version[40];
    snprintf(version, sizeof version, "%d.%d.%d", PETRI_VERSION_MAJOR, PETRI_VERSION_MINOR, PETRI_VERSION_PATCH);
    assert_string_equal(petri_version(), version);
    assert_int_equal(petri_version_number(), PETRI_VERSION_NUMBER);
    for (int i = PETRI_OK; i <= PETRI_INTERRUPTED; i++)
        for (int k = PETRI_OK; k < i; k++)
            assert_string_not_equal(petri_status_text((PetriStatus)i), petri_status_text((PetriStatus)k));
    assert_string_equal(petri_status_text((PetriStatus)-1), "unknown status");
    assert_string_equal(petri_status_text((PetriStatus)100), "unknown status");
}

TEST_GROUP(session_host) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_retained_diagnostics),
        PLAYER_TEST(test_version_and_status_texts),
        cmocka_unit_test(test_options_without_defaults_are_rejected),
        PLAYER_TEST(test_without_a_script),
        PLAYER_TEST(test_text_lengths),
        PLAYER_TEST(test_print_writes_the_sections_asked_for),
        PLAYER_TEST(test_writer_can_stop),
        PLAYER_TEST(test_dump_writes_tree_or_code),
        PLAYER_TEST(test_profile_has_row_per_line),
        PLAYER_TEST(test_failed_load_keeps_the_script),
        PLAYER_TEST(test_diagnostics_are_reported_once_per_load),
        PLAYER_TEST(test_diagnostics_follow_text),
        PLAYER_TEST(test_texts_at_one_position_are_distinct),
        PLAYER_TEST(test_diagnostics_are_limited),
        PLAYER_TEST(test_sessions_are_independent),
        PLAYER_TEST(test_node_kinds_and_attributes),
        cmocka_unit_test(test_colour_is_only_in_rendered),
        PLAYER_TEST(test_tokens_have_kinds_and_ranges),
        PLAYER_TEST(test_names_have_bindings_and_scopes),
        PLAYER_TEST(test_bindings_have_values),
        cmocka_unit_test(test_diagnostics_have_node_positions),
        cmocka_unit_test(test_loop_error_is_reported_once),
        cmocka_unit_test(test_builtins_and_numbers),
        PLAYER_TEST(test_load_clears_output), // runs last, because the tested bug was a read of freed memory
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
