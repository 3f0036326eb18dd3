// fuzz_prompt.c: fuzzes the functions that a host calls. The input is a sequence of actions, separated by a byte 30.
// The first byte of an action selects its kind, and the rest is its text. If the first byte is not a control character,
// the whole action is typed at the prompt.
#include "fuzz.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "petri-live.h"

#include <string.h>

static const char SCRIPT[] = "%pragma tempo 60\n"
                             "let A=A or 3 -- 1..9 how many\n"
                             "let B=A;4\n"
                             "func f(x)\n"
                             "    x*2\n"
                             "!physics state=:c dimensions=2 time=beat\n"
                             "    for i in ..A\n"
                             "        !particle id=i position=i;0 radius=1\n"
                             "    !random strength=1\n"
                             "!counter state=:n rate=B\n"
                             "!window\n"
                             "    !key state=:k name='space'\n"
                             "!s a=A\n";
enum { SNAPSHOTS = 4, MAX_ACTIONS = 40 };

typedef struct Host {
    PetriSession *session;
    PetriConfig *config;
    PetriSnapshot *snapshots[SNAPSHOTS];
} Host;

static void print_frame(PetriSession *session) {
    petri_print(session, PETRI_PRINT_TREE | PETRI_PRINT_STATE | PETRI_PRINT_LOG, fuzz_sink, NULL);
    fuzz_check_frame(session);
    fuzz_check_state(session);
}

static void list_names(PetriSession *session) {
    for (size_t i = 0; petri_visible_name(session, i); i++)
        fuzz_sink(NULL, petri_visible_name(session, i), 1);
    for (size_t i = 0; petri_prompt_statement(session, i); i++)
        fuzz_sink(NULL, petri_prompt_statement(session, i), 1);
    for (size_t i = 0; petri_source_file(session, i); i++)
        fuzz_sink(NULL, petri_source_file(session, i), 1);
}

static void report_input(PetriSession *session, const char *text, size_t length) {
    PetriPointer pointer = {sizeof pointer, length > 0, length > 0 ? text[0] / 100.0 : 0,
                            length > 1 ? text[1] / 100.0 : 0, length > 2 ? (unsigned char)text[2] : 0};
    petri_report_pointer(session, length % 7 == 6 ? NULL : &pointer);
    petri_report_key(session, "space", length % 2);
    fuzz_sink(NULL, "", petri_key_is_bound(session, "space"));
}

static void set_parameter(PetriSession *session, const char *text, size_t length) {
    char value[64];
    length = length < sizeof value ? length : sizeof value - 1;
    memcpy(value, text, length);
    value[length] = 0;
    petri_set_parameter(session, "A", length ? value : NULL);
}

static void perform_action(Host *host, const char *text, size_t length) {
    PetriSession *session = host->session;
    PetriSnapshot **snapshot = &host->snapshots[length % SNAPSHOTS];
    PetriEvaluation result;
    PetriPromptResult done;
    switch (length ? text[0] : 0) {
    case 1:
        petri_step(session);
        print_frame(session);
        break;
    case 2:
        petri_snapshot_free(*snapshot);
        *snapshot = petri_snapshot(session);
        break;
    case 3:
        if (*snapshot)
            petri_rewind(session, *snapshot);
        break;
    case 4:
        petri_prompt_clear(session, length > 1);
        break;
    case 5:
        petri_config_apply(session, host->config);
        break;
    case 6:
        petri_evaluate(session, text + 1, length - 1, &result, sizeof result, fuzz_sink, NULL);
        break;
    case 7:
        petri_reload(session, NULL);
        break;
    case 8:
        petri_preview(session);
        print_frame(session);
        break;
    case 11:
        petri_reset(session);
        break;
    case 12:
        petri_set_tempo(session, length > 1 ? text[1] : 1);
        petri_set_resolution(session, length > 2 ? text[2] : 0);
        break;
    case 14:
        petri_load_text(session, "fuzz.fl", text + 1, length - 1);
        break;
    case 15:
        list_names(session);
        break;
    case 16:
        report_input(session, text + 1, length - 1);
        break;
    case 17:
        set_parameter(session, text + 1, length - 1);
        break;
    default:
        petri_prompt_check(session, text, length);
        petri_prompt(session, text, length, fuzz_sink, NULL, &done, sizeof done);
    }
}

FUZZ_HARNESS(prompt) {
    Host host = {.session = fuzz_open(NULL)};
    const char *at = (const char *)data, *end = at + size, *part;
    size_t length;
    fuzz_load(host.session, SCRIPT);
    host.config = petri_config_get(host.session);
    for (int i = 0; i < MAX_ACTIONS && fuzz_next_part(&at, end, &part, &length); i++)
        perform_action(&host, part, length);
    for (int i = 0; i < SNAPSHOTS; i++)
        petri_snapshot_free(host.snapshots[i]);
    petri_config_free(host.config);
    fuzz_close(&host.session);
    return 0;
}
