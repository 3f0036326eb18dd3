// test_session_versions.c: hosts that were compiled with an older or newer petri.h, whose structs are shorter or longer
// than those of the library.
#include "petri-inspect.h"
#include "petri-live.h"
#include "petri-ranks.h"
#include "player.h"

#define SCRIPT                                                                                                         \
    "let N=N or 2\n!physics state=:s dimensions=2\n    for i in ..N\n        !particle id=i position=i;0 radius=1\n"   \
    "    !constant direction=1;0 strength=1\n"

enum { TAIL = 32, MAX_STRUCT = 512, UNTOUCHED = 0xa5 };

static bool fill_frame(PetriSession *session, void *out, size_t size) {
    return petri_frame(session, out, size);
}

static bool fill_parameter(PetriSession *session, void *out, size_t size) {
    return petri_parameter(session, 0, out, size);
}

static bool fill_system(PetriSession *session, void *out, size_t size) {
    return petri_system(session, 0, out, size);
}

static bool fill_force(PetriSession *session, void *out, size_t size) {
    return petri_system_force(session, 0, 0, out, size);
}

static bool fill_explanation(PetriSession *session, void *out, size_t size) {
    return petri_explain_force(session, 0, 0, 0, out, size) == PETRI_OK;
}

static bool fill_rank_stats(PetriSession *session, void *out, size_t size) {
    return petri_rank_stats(session, 0, out, size);
}

static bool fill_prompt_result(PetriSession *session, void *out, size_t size) {
    return petri_prompt(session, "1\n2\n", PETRI_NUL_TERMINATED, NULL, NULL, out, size) == PETRI_OK;
}

static bool fill_evaluation(PetriSession *session, void *out, size_t size) {
    return petri_evaluate(session, "N+1", PETRI_NUL_TERMINATED, out, size, NULL, NULL) == PETRI_OK;
}

static bool fill_diagnostic(PetriSession *session, void *out, size_t size) {
    return petri_diagnostic(session, 0, out, size);
}

static bool fill_node_kind(PetriSession *session, void *out, size_t size) {
    (void)session;
    return petri_node_kind(0, out, size);
}

static bool fill_node_attribute(PetriSession *session, void *out, size_t size) {
    (void)session;
    return petri_node_attribute(0, 0, out, size);
}

static bool fill_builtin(PetriSession *session, void *out, size_t size) {
    (void)session;
    return petri_builtin(0, out, size);
}

static bool fill_host_function(PetriSession *session, void *out, size_t size) {
    return petri_host_function(session, 0, out, size);
}

static bool fill_options(PetriSession *session, void *out, size_t size) {
    (void)session;
    petri_options_init(out, size);
    return true;
}

static PetriValue return_null(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count) {
    (void)call, (void)user_data, (void)arguments, (void)count;
    return (PetriValue){0};
}

// Returns true if all bytes have this value.
static bool has_only(const unsigned char *bytes, size_t count, int value) {
    for (size_t i = 0; i < count; i++)
        if (bytes[i] != value)
            return false;
    return true;
}

// A shorter struct must not be overrun. The end of a longer struct must become 0.
static void test_filled_structs_have_the_size_of_the_host(void **state) {
    static const struct {
        const char *row;
        bool (*fill)(PetriSession *session, void *out, size_t size);
        size_t size;
    } rows[] = {
        {"frame", fill_frame, sizeof(PetriFrame)},
        {"parameter", fill_parameter, sizeof(PetriParameter)},
        {"system", fill_system, sizeof(PetriSystem)},
        {"force", fill_force, sizeof(PetriForce)},
        {"explanation", fill_explanation, sizeof(PetriExplanation)},
        {"rank stats", fill_rank_stats, sizeof(PetriRankStats)},
        {"prompt", fill_prompt_result, sizeof(PetriPromptResult)},
        {"evaluation", fill_evaluation, sizeof(PetriEvaluation)},
        {"diagnostic", fill_diagnostic, sizeof(PetriDiagnostic)},
        {"node kind", fill_node_kind, sizeof(PetriNodeKind)},
        {"node attribute", fill_node_attribute, sizeof(PetriNodeAttribute)},
        {"builtin", fill_builtin, sizeof(PetriBuiltin)},
        {"host function", fill_host_function, sizeof(PetriBuiltin)},
        {"options", fill_options, sizeof(PetriOptions)},
    };
    Player *player = *state;
    PetriOptions options = player_options(player);
    options.keep_forces = true;
    player_reopen(player, &options);
    PetriFunction function = {
        .size = sizeof function, .name = "f", .parameters = "x", .help = "help", .call = return_null};
    assert_int_equal(petri_add_function(player->session, &function), PETRI_OK);
    assert_int_equal(player_load(player, "!a )"), PETRI_INVALID);
    player_run(player, SCRIPT, 3);
    for (size_t i = 0; i < COUNT_OF(rows); i++) {
        _Alignas(max_align_t) unsigned char bytes[MAX_STRUCT];
        size_t size = rows[i].size, shorter = size / 2;
        assert_claim(rows[i].row, size + TAIL <= sizeof bytes);
        memset(bytes, UNTOUCHED, sizeof bytes);
        assert_claim(rows[i].row, rows[i].fill(player->session, bytes, shorter));
        assert_claim(rows[i].row, !has_only(bytes, shorter, UNTOUCHED));
        assert_claim(rows[i].row, has_only(bytes + shorter, sizeof bytes - shorter, UNTOUCHED));
        assert_claim(rows[i].row, rows[i].fill(player->session, bytes, size + TAIL));
        assert_claim(rows[i].row, !has_only(bytes + shorter, size - shorter, UNTOUCHED));
        assert_claim(rows[i].row, has_only(bytes + size, TAIL, 0));
        assert_claim(rows[i].row, has_only(bytes + size + TAIL, sizeof bytes - size - TAIL, UNTOUCHED));
    }
}

static void test_fields_of_older_hosts_keep_their_values(void **state) {
    Player *player = *state;
    player_run(player, SCRIPT, 3);
    PetriFrame frame = {.beat = -7}, whole = last_frame(player->session);
    assert_true(petri_frame(player->session, &frame, offsetof(PetriFrame, beat)));
    assert_int_equal(frame.number, 2);
    assert_number("time", frame.time, whole.time);
    assert_number("beat", frame.beat, -7);
    PetriDiagnostic diagnostic;
    petri_clear_diagnostics(player->session);
    assert_int_equal(player_load(player, "!a )"), PETRI_INVALID);
    assert_true(petri_diagnostic(player->session, 0, &diagnostic, offsetof(PetriDiagnostic, hint)));
    assert_int_equal(diagnostic.size, offsetof(PetriDiagnostic, hint));
    assert_int_equal(diagnostic.line, 1);
}

// A struct of a newer petri.h.
typedef struct NewerOptions {
    PetriOptions known;
    uint64_t unknown;
} NewerOptions;
typedef struct NewerPointer {
    PetriPointer known;
    uint64_t unknown;
} NewerPointer;
typedef struct NewerFunction {
    PetriFunction known;
    uint64_t unknown;
} NewerFunction;

static bool opens(const PetriOptions *options) {
    PetriSession *session = petri_open(options);
    bool opened = session;
    petri_close(&session);
    return opened;
}

static void test_options_of_other_versions(void **state) {
    (void)state;
    PetriOptions options = petri_default_options();
    options.size = offsetof(PetriOptions, ranks); // the fields behind must not be read
    options.ranks = (const PetriRanks *)1;
    assert_true(opens(&options));
    NewerOptions newer;
    petri_options_init(&newer.known, sizeof newer);
    assert_int_equal(newer.known.size, sizeof newer);
    assert_int_equal(newer.unknown, 0);
    assert_true(opens(&newer.known));
    newer.unknown = 1; // asks for something that this library cannot do
    assert_false(opens(&newer.known));
    options = petri_default_options();
    options.ranks = &(PetriRanks){.size = 0};
    assert_false(opens(&options));
}

static void test_input_of_other_versions(void **state) {
    Player *player = *state;
    PetriPointer pointer = {.size = offsetof(PetriPointer, buttons), .inside = true, .x = 0.5, .y = 0.5, .buttons = 1};
    player_run(player, "!window size=9;9\n    !pointer state=:p\n", 2);
    assert_int_equal(petri_report_pointer(player->session, &pointer), PETRI_OK);
    player_step(player, 1);
    assert_null(strstr(player_state(player), "$(:p;:left) = 1")); // the host's struct ends before the buttons
    pointer.size = sizeof pointer;
    assert_int_equal(petri_report_pointer(player->session, &pointer), PETRI_OK);
    player_step(player, 1);
    assert_non_null(strstr(player_state(player), "$(:p;:left) = 1"));
    NewerPointer newer = {.known = {.size = sizeof newer, .inside = true, .x = 0.5, .y = 0.5}};
    assert_int_equal(petri_report_pointer(player->session, &newer.known), PETRI_OK);
    newer.unknown = 1;
    assert_int_equal(petri_report_pointer(player->session, &newer.known), PETRI_INVALID);
    pointer.size = 0;
    assert_int_equal(petri_report_pointer(player->session, &pointer), PETRI_INVALID);
}

static void test_functions_of_other_versions(void **state) {
    Player *player = *state;
    NewerFunction newer = {
        .known = {.size = sizeof newer, .name = "f", .parameters = "x", .call = return_null},
    };
    newer.unknown = 1;
    assert_int_equal(petri_add_function(player->session, &newer.known), PETRI_INVALID);
    newer.unknown = 0;
    assert_int_equal(petri_add_function(player->session, &newer.known), PETRI_OK);
    newer.known.size = offsetof(PetriFunction, call); // the function is missing
    newer.known.name = "g";
    assert_int_equal(petri_add_function(player->session, &newer.known), PETRI_INVALID);
    newer.known.size = offsetof(PetriFunction, user_data);
    assert_int_equal(petri_add_function(player->session, &newer.known), PETRI_OK);
}

TEST_GROUP(session_versions) {
    const struct CMUnitTest tests[] = {
        PLAYER_TEST(test_filled_structs_have_the_size_of_the_host),
        PLAYER_TEST(test_fields_of_older_hosts_keep_their_values),
        cmocka_unit_test(test_options_of_other_versions),
        PLAYER_TEST(test_input_of_other_versions),
        PLAYER_TEST(test_functions_of_other_versions),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
