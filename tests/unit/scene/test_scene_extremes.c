// test_scene_extremes.c: tests random scripts with extreme numbers. The state must contain only finite numbers, and the
// session must continue. Each run uses the same scripts; PETRI_EXTREMES=COUNT,SEED generates others.
#include "player.h"

#include <math.h>
#include <stdarg.h>

enum { SCRIPTS = 100, FRAMES = 4, MAX_TEXT = 6000 };

typedef struct Author {
    uint64_t state;
    char text[MAX_TEXT];
    size_t len;
} Author;

static unsigned below(Author *author, unsigned n) {
    author->state = author->state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (unsigned)(author->state >> 33) % n;
}

__attribute__((format(printf, 2, 3))) static void add(Author *author, const char *format, ...) {
    va_list list;
    va_start(list, format);
    author->len += (size_t)vsnprintf(author->text + author->len, MAX_TEXT - author->len, format, list);
    va_end(list);
    assert_true(author->len < MAX_TEXT);
}

static const char *number(Author *author) {
    static const char *const numbers[] = {
        "0",
        "-0",
        "1",
        "2",
        "0.5",
        "-1",
        "60",
        "1e308",
        "1.7e308",
        "-1.7e308",
        "1e-308",
        "5e-324",
        "1e300",
        "1e154",
        "1e155",
        "-1e155",
        "1e-300",
        "inf",
        "-inf",
        "nan",
        "1e10",
        "1e-10",
        "1e16",
        "1e20",
        "9007199254740993",
        "2147483648",
        "frame",
        "time",
        "-frame",
        "frame*1e307",
        "1e308*frame",
        "1/frame",
        "(inf if frame==2 else 1)",
        "(nan if frame==1 else 2)",
        "(-1.7e308 if frame==0 else 1.7e308)",
        ":a",
        "\"x\"",
        "null",
        "(1;2)",
        "uniform(frame)[0]",
        "normal(frame)[0]*1e308",
    };
    return numbers[below(author, COUNT_OF(numbers))];
}

// Adds about half of the attributes in a list, followed by spaces. Names in capitals are vectors.
static void add_attributes(Author *author, const char *names, unsigned n) {
    for (const char *at = names; *at;) {
        size_t len = strcspn(at, " ");
        if (below(author, 2)) {
            bool vector = at[0] >= 'A' && at[0] <= 'Z';
            unsigned size = !vector ? 1 : below(author, 5) == 3 ? 1 : below(author, 5) == 4 ? n + 1 : n;
            add(author, " %c%.*s=(", vector ? at[0] - 'A' + 'a' : at[0], (int)len - 1, at + 1);
            for (unsigned i = 0; i < size; i++)
                add(author, i ? ";%s" : "%s", number(author));
            add(author, ")");
        }
        at += len + (at[len] == ' ');
    }
}

#define BOUNDS "fixed minimum min maximum max power strength ease"
#define BODY "Position Velocity radius mass charge"

static void add_system(Author *author, unsigned k) {
    static const char *const forces[][2] = {
        {"constant", "Force Acceleration strength ease"},
        {"random", "strength ease"},
        {"field", "Direction strength ease"},
        {"collision", "power strength ease max_distance"},
        {"gravity", "strength ease max_distance theta"},
        {"electrostatic", "strength ease max_distance theta"},
        {"adhesion", "overlap strength ease max_distance"},
        {"drag", "Flow strength ease"},
        {"buoyancy", "Gravity density strength ease"},
        {"barrier", "Position Normal restitution " BOUNDS},
    };
    unsigned n = 1 + below(author, 5);
    add(author, "!physics state=:c%u dimensions=%u", k, n);
    add_attributes(author, "time resolution run speed_of_light", 1);
    add(author, "\n");
    for (unsigned i = 0, count = 1 + below(author, 6); i < count; i++) {
        add(author, "    !%s id=%u", below(author, 6) ? "particle" : "anchor", i);
        add_attributes(author, BODY " Force ease", n);
        add(author, "\n");
    }
    for (unsigned i = 0, count = 1 + below(author, 4); i < count; i++) {
        unsigned force = below(author, COUNT_OF(forces));
        add(author, "    !%s", forces[force][0]);
        add_attributes(author, forces[force][1], n);
        add(author, "\n");
    }
    if (below(author, 2)) {
        add(author, "    !distance from=%u to=%u", below(author, 7), below(author, 7));
        add_attributes(author, BOUNDS, n);
        add(author, "\n");
    }
    if (!below(author, 3)) {
        add(author, "    !group\n        !particle id=99");
        add_attributes(author, BODY, n);
        add(author, "\n        !collision");
        add_attributes(author, "strength power", n);
        add(author, "\n");
    }
}

static void write_script(Author *author) {
    static const char *const rates[] = {"1e-300", "1e300", "60", "1e10", "1e-5"};
    author->len = 0;
    if (!below(author, 3))
        add(author, "%%pragma tempo %s\n", rates[below(author, COUNT_OF(rates))]);
    if (!below(author, 3))
        add(author, "%%pragma fps %s\n", rates[below(author, COUNT_OF(rates))]);
    for (unsigned k = 0, count = 1 + below(author, 2); k < count; k++)
        add_system(author, k);
    for (unsigned k = 0, count = below(author, 3); k < count; k++) {
        add(author, "!counter state=:n%u", k);
        add_attributes(author, "Initial Rate Time minimum min maximum max reset", 2);
        add(author, "\n");
    }
}

// Returns true if all values are finite. The keys in these tests are symbols and integers.
static bool is_finite_state(const char *state) {
    for (const char *at = state; (at = strstr(at, " = ")) != NULL;) {
        at += 3;
        for (size_t len; len = strcspn(at, ";\n"), len > 0; at += len + (at[len] == ';')) {
            char text[40];
            snprintf(text, sizeof text, "%.*s", (int)len, at);
            if (text[0] != ':' && !isfinite(strtod(text, NULL)))
                return false;
        }
    }
    return true;
}

static void test_state_stays_finite(void **state) {
    Player *player = *state;
    Author author = {.state = 1};
    unsigned long count = SCRIPTS, seed = 1;
    const char *wanted = getenv("PETRI_EXTREMES");
    if (wanted)
        assert_int_equal(sscanf(wanted, "%lu,%lu", &count, &seed), 2);
    author.state = seed;
    PetriOptions options = player_options(player);
    options.threads = 1;
    for (unsigned long i = 0; i < count; i++) {
        write_script(&author);
        player_reopen(player, &options);
        player_run(player, author.text, 0);
        for (int frame = 0; frame < FRAMES; frame++) {
            player_step(player, 1);
            const char *found = player_state(player);
            if (!is_finite_state(found))
                assert_text(author.text, found, "finite numbers");
        }
        player_forget(player);
    }
}

TEST_GROUP(scene_extremes) {
    const struct CMUnitTest tests[] = {PLAYER_TEST(test_state_stays_finite)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
