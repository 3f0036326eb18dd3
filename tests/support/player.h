// player.h: a session for tests, which loads scripts, steps frames, and records diagnostics and printed text.
#pragma once

#include "check.h"
#include "last_frame.h"
#include "petri-edit.h"
#include "petri-inspect.h"

#include <stdlib.h>

typedef struct Notebook {
    char *text;
    size_t len;
} Notebook;

static inline bool note(void *user_data, const char *text, size_t len) {
    Notebook *book = user_data;
    book->text = realloc(book->text, book->len + len + 1);
    assert_non_null(book->text);
    memcpy(book->text + book->len, text, len);
    book->len += len;
    book->text[book->len] = 0;
    return true;
}

typedef struct Player {
    PetriSession *session;
    // Diagnostics as lines `level file:line:column text [code]`. The position is omitted if there is none, or if the
    // text begins with a node's name; test_session_host tests the positions of nodes.
    Notebook diagnostics;
    Notebook printed; // output of the last print function
} Player;

static inline void player_report(void *user_data, const PetriDiagnostic *diagnostic) {
    static const char *const levels[] = {"error", "warning", "note"};
    Player *player = user_data;
    char line[4000], place[1000] = "";
    if (diagnostic->file && diagnostic->text[0] != '!')
        snprintf(place, sizeof place, "%s:%u:%u ", diagnostic->file, diagnostic->line, diagnostic->column);
    assert_true(diagnostic->rendered[strlen(diagnostic->rendered) - 1] == '\n');
    int len = snprintf(line, sizeof line, "%s %s%s [%s]\n", levels[diagnostic->level], place, diagnostic->text,
                       diagnostic->code ? diagnostic->code : "");
    note(&player->diagnostics, line, (size_t)len < sizeof line ? (size_t)len : sizeof line - 1);
}

static inline void player_ignore_token(void *user_data, const PetriToken *token) {
    (void)user_data;
    (void)token;
}

static inline void player_ignore_name(void *user_data, const PetriBinding *name) {
    (void)user_data;
    (void)name;
}

static inline PetriOptions player_options(Player *player) {
    PetriOptions options = petri_default_options();
    options.on_diagnostic = player_report;
    options.user_data = player;
    return options;
}

static inline void player_open_with(Player *player, const PetriOptions *options) {
    *player = (Player){0};
    note(&player->diagnostics, "", 0);
    note(&player->printed, "", 0);
    player->session = petri_open(options);
    assert_non_null(player->session);
}

static inline void player_open(Player *player) {
    PetriOptions options = player_options(player);
    player_open_with(player, &options);
}

static inline void player_close(Player *player) {
    petri_close(&player->session);
    assert_null(player->session);
    free(player->diagnostics.text);
    free(player->printed.text);
}

static inline PetriStatus player_load(Player *player, const char *script) {
    return petri_load_text(player->session, "t.fl", script, PETRI_NUL_TERMINATED);
}

// Replaces the session by a new one with other options.
static inline void player_reopen(Player *player, const PetriOptions *options) {
    player_close(player);
    player_open_with(player, options);
}

// Replaces the session by a new one that runs in real time.
static inline void player_realtime(Player *player, double fps) {
    PetriOptions options = player_options(player);
    options.realtime = true;
    options.fps = fps;
    player_reopen(player, &options);
}

// Returns the diagnostics since the last call. Valid until the next diagnostic.
static inline const char *player_diagnostics(Player *player) {
    player->diagnostics.len = 0;
    return player->diagnostics.text;
}

static inline void player_forget(Player *player) {
    player->diagnostics.len = 0;
    player->diagnostics.text[0] = 0;
}

// Returns printed sections of the frame without the `@` line. Valid until the next call.
static inline const char *player_print(Player *player, unsigned sections) {
    player->printed.len = 0;
    assert_int_equal(petri_print(player->session, sections, note, &player->printed), PETRI_OK);
    return strchr(player->printed.text, '\n') + 1;
}

static inline const char *player_tree(Player *player) {
    return player_print(player, PETRI_PRINT_TREE);
}

static inline const char *player_state(Player *player) {
    return player_print(player, PETRI_PRINT_STATE);
}

static inline void player_step(Player *player, int frames) {
    for (int i = 0; i < frames; i++)
        assert_int_equal(petri_step(player->session), PETRI_OK);
}

// Loads a script, which must succeed, and steps some frames.
static inline void player_run(Player *player, const char *script, int frames) {
    if (player_load(player, script) != PETRI_OK) {
        print_error("%s\n%s", script, player_diagnostics(player));
        fail();
    }
    player_step(player, frames);
}

static inline int player_setup(void **state) {
    Player *player = malloc(sizeof *player);
    player_open(player);
    *state = player;
    return 0;
}

static inline int player_teardown(void **state) {
    player_close(*state);
    free(*state);
    return 0;
}

#define PLAYER_TEST(function) cmocka_unit_test_setup_teardown(function, player_setup, player_teardown)

typedef struct ScriptRow {
    const char *script;
    const char *wanted;
} ScriptRow;

// Runs each script for `frames` frames, once with and once without the simplifier. Both times, the tree of the last
// frame must equal the `wanted` tree of the row.
static inline void check_trees(Player *player, const ScriptRow *rows, size_t count, int frames) {
    for (int simplify = 1; simplify >= 0; simplify--) {
        PetriOptions options = player_options(player);
        options.tuning = &(PetriTuning){.size = sizeof(PetriTuning), .no_simplify = !simplify};
        player_reopen(player, &options);
        for (size_t i = 0; i < count; i++) {
            player_run(player, rows[i].script, frames);
            assert_text(rows[i].script, player_tree(player), rows[i].wanted);
        }
    }
}
