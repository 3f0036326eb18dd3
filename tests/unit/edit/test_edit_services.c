// test_edit_services.c: tests that an editor may ask anything between the frames of a run without changing it.
#include "player.h"

#include <stdint.h>

enum { FRAMES = 12, DIGEST_SIZE = 16 };

// The run has a system, random numbers, a lookup and a parameter.
static const char SCRIPT[] = "let N=N or 20 -- 1..50: particles\n"
                             "!physics state=:p dimensions=2\n"
                             "    for i in ..N\n"
                             "        !particle id=i position=uniform(:a;i)[..2] velocity=0;i/N\n"
                             "    !gravity strength=0.1\n"
                             "!counter state=:c rate=$(:p;1;:position)[0]\n";

// Other texts: one with another system and the same keys, one with errors, one that ends within a token.
static const char *const EDITED[] = {
    "let N=3\n!physics state=:p dimensions=3\n    !particle id=1 position=9;9;9\n",
    "let a=(1;\n!physics state=:p\n  !partcle id=b\n",
    "!physics state=:p dimensions='",
    "",
};

static bool discard(void *user_data, const char *text, size_t len) {
    (void)user_data;
    (void)text;
    (void)len;
    return true;
}

static void ask_about_text(Player *player, const char *text, int choice) {
    PetriSession *session = player->session;
    size_t len = strlen(text);
    if (choice == 0)
        petri_check_text(session, "edited.fl", text, len);
    else if (choice == 1)
        assert_int_equal(petri_tokenise(session, text, len, player_ignore_token, NULL), PETRI_OK);
    else
        assert_int_equal(petri_bindings(session, text, len, player_ignore_name, NULL), PETRI_OK);
}

static void ask_about_script(Player *player, int choice) {
    PetriSession *session = player->session;
    PetriParameter parameter;
    PetriNodeAttribute attribute;
    PetriBuiltin builtin;
    if (choice == 0) {
        assert_true(petri_parameter(session, 0, &parameter, sizeof parameter));
        assert_string_equal(parameter.name, "N");
        assert_false(petri_parameter(session, 1, &parameter, sizeof parameter));
    } else if (choice == 1) {
        assert_int_equal(petri_dump(session, PETRI_DUMP_AST, discard, NULL), PETRI_OK);
        assert_int_equal(petri_dump(session, PETRI_DUMP_CODE, discard, NULL), PETRI_OK);
    } else {
        assert_int_equal(petri_profile(session, 1, discard, NULL), PETRI_OK);
        assert_true(petri_node_attribute(0, 0, &attribute, sizeof attribute));
        assert_true(petri_builtin(0, &builtin, sizeof builtin));
        assert_false(petri_host_function(session, 0, &builtin, sizeof builtin));
    }
}

// Runs the script and computes the digest of each frame. Before each frame, asks `questions` questions, in an order
// that `seed` determines.
static void compute_digests(uint32_t seed, int questions, uint8_t digests[FRAMES][DIGEST_SIZE]) {
    Player player;
    PetriOptions options = player_options(&player);
    options.profile = true;
    player_open_with(&player, &options);
    player_run(&player, SCRIPT, 0);
    for (int frame = 0; frame < FRAMES; frame++) {
        for (int i = 0; i < questions; i++) {
            seed = seed * 1664525 + 1013904223;
            uint32_t drawn = seed >> 16;
            if (drawn % 2)
                ask_about_text(&player, EDITED[drawn / 2 % 4], (int)(drawn / 8 % 3));
            else
                ask_about_script(&player, (int)(drawn / 8 % 3));
        }
        player_step(&player, 1);
        assert_int_equal(petri_digest(player.session, digests[frame]), PETRI_OK);
    }
    player_close(&player);
}

static void test_questions_do_not_change_a_run(void **state) {
    (void)state;
    uint8_t expected[FRAMES][DIGEST_SIZE], digests[FRAMES][DIGEST_SIZE];
    compute_digests(0, 0, expected);
    assert_memory_not_equal(expected[FRAMES - 2], expected[FRAMES - 1], DIGEST_SIZE);
    for (uint32_t seed = 1; seed <= 8; seed++) {
        compute_digests(seed, 6, digests);
        assert_memory_equal(digests, expected, sizeof expected);
    }
}

// Tokens are in order and do not overlap, also if the text ends anywhere.
typedef struct Tokens {
    size_t len;
    size_t end;
    uint32_t count;
} Tokens;

static void follow_token(void *user_data, const PetriToken *token) {
    Tokens *tokens = user_data;
    assert_in_range(token->start, tokens->end, tokens->len);
    assert_in_range(token->end, token->start, tokens->len);
    tokens->end = token->end;
    tokens->count++;
}

static void test_tokens_of_each_prefix_are_in_order(void **state) {
    Player *player = *state;
    for (size_t len = 0; len < sizeof SCRIPT; len++) {
        Tokens tokens = {.len = len};
        assert_int_equal(petri_tokenise(player->session, SCRIPT, len, follow_token, &tokens), PETRI_OK);
        assert_true(tokens.count > 0 || len == 0);
    }
}

TEST_GROUP(edit_services) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_questions_do_not_change_a_run),
        PLAYER_TEST(test_tokens_of_each_prefix_are_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
