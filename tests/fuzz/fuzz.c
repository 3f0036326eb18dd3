// fuzz.c: see fuzz.h.
#include "fuzz.h"

#include "base/hash_index.h"
#include "petri-inspect.h"

#include <ftw.h>
#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <unistd.h>

static PetriSession *volatile watched;
static volatile sig_atomic_t alarms;
static volatile size_t seen; // written only so that the compiler cannot remove reads

void fuzz_fail(const char *format, ...) {
    va_list list;
    va_start(list, format);
    fputs("fuzz_fail: ", stderr);
    vfprintf(stderr, format, list);
    va_end(list);
    fputc('\n', stderr);
    abort();
}

int fuzz_interrupt_limit = 80;

static void on_alarm(int number) {
    (void)number;
    if (++alarms > fuzz_interrupt_limit) {
        static const char text[] = "fuzz_fail: petri_interrupt has no effect: the session does not react\n";
        (void)!write(STDERR_FILENO, text, sizeof text - 1);
        abort();
    }
    if (watched)
        petri_interrupt(watched);
    else
        raise(SIGINT);
}

void fuzz_watch(PetriSession *session) {
    static const struct itimerval wait = {{0, 50000}, {2, 0}};
    struct sigaction action = {.sa_handler = on_alarm, .sa_flags = SA_RESTART | SA_ONSTACK};
    sigaction(SIGVTALRM, &action, NULL);
    alarms = 0;
    watched = session;
    setitimer(ITIMER_VIRTUAL, &wait, NULL);
}

bool fuzz_end_watch(void) {
    static const struct itimerval never;
    setitimer(ITIMER_VIRTUAL, &never, NULL);
    watched = NULL;
    return alarms > 0;
}

static void on_diagnostic(void *host, const PetriDiagnostic *reported) {
    (void)host;
    seen += strlen(reported->rendered) + strlen(reported->text) + (reported->code ? strlen(reported->code) : 0);
    if (reported->level != PETRI_NOTE && reported->file && (reported->line == 0 || reported->column == 0))
        fuzz_fail("a diagnostic without a position: %s", reported->rendered);
}

PetriOptions fuzz_options(void) {
    PetriOptions options = petri_default_options();
    options.memory_limit = (size_t)128 << 20;
    options.stack_limit = (size_t)2 << 20;
    options.threads = 1;
    options.on_diagnostic = on_diagnostic;
    options.rollback_frames = true;
    options.keep_forces = true;
    return options;
}

PetriSession *fuzz_open(const PetriOptions *options) {
    PetriOptions usual = fuzz_options();
    PetriSession *session = petri_open(options ? options : &usual);
    if (!session)
        fuzz_fail("cannot open a session");
    fuzz_watch(session);
    return session;
}

void fuzz_close(PetriSession **session) {
    fuzz_end_watch();
    petri_close(session);
}

void fuzz_load(PetriSession *session, const char *script) {
    if (petri_load_text(session, fuzz_file("fuzz.fl"), script, PETRI_NUL_TERMINATED) != PETRI_OK)
        fuzz_fail("the harness's script does not load");
}

// The contributions to the force on a particle must add up to the force.
static void check_explanation(PetriSession *session, size_t number, const PetriSystem *system, uint32_t particle) {
    PetriExplanation found;
    if (!system->force.data ||
        petri_explain_force(session, number, particle, system->steps - 1, &found, sizeof found) != PETRI_OK)
        return; // a limit was exceeded
    for (uint32_t k = 0; k < system->dimensions; k++) {
        double sum = 0, force = system->force.data[particle * system->force.stride + k];
        for (uint32_t c = 0; c < found.count; c++) {
            double f = found.vector[(size_t)c * system->dimensions + k];
            sum = found.force[c] == PETRI_OWN_FORCE ? f : sum + f;
        }
        bool same = memcmp(&sum, &force, sizeof sum) == 0 && memcmp(&sum, &found.sum[k], sizeof sum) == 0;
        if (!same && !(isnan(sum) && isnan(force) && isnan(found.sum[k])))
            fuzz_fail("the contributions to a force add up to %a and %a, not %a", sum, found.sum[k], force);
    }
}

void fuzz_check_frame(PetriSession *session) {
    enum { MAX_COUNT = 50 };
    PetriSystem system;
    PetriForce force;
    PetriParameter parameter;
    for (size_t i = 0; i < 4 && petri_system(session, i, &system, sizeof system); i++) {
        for (uint32_t j = 0; j < MAX_COUNT && j < system.particle_count; j++) {
            PetriValue id = petri_particle_id(session, i, j);
            const char *text = petri_format_value(session, id);
            uint32_t found = 0;
            seen += text ? strlen(text) : 0;
            seen += petri_find_particle(session, i, id, &found) ? found : 0;
            seen += (size_t)(system.position.data[j * system.position.stride + system.dimensions - 1] > 0);
        }
        if (system.particle_count)
            check_explanation(session, i, &system, system.particle_count / 2);
        for (uint32_t j = 0; j < MAX_COUNT && petri_system_force(session, i, j, &force, sizeof force); j++)
            seen += strlen(force.kind) + force.line + (force.file ? strlen(force.file) : 0);
    }
    for (size_t i = 0; i < MAX_COUNT && petri_parameter(session, i, &parameter, sizeof parameter); i++)
        seen += strlen(parameter.name) + strlen(parameter.value) + strlen(parameter.comment);
}

bool fuzz_sink(void *host, const char *text, size_t length) {
    (void)host;
    for (size_t i = 0; i < length; i++)
        seen += (unsigned char)text[i];
    return true;
}

bool fuzz_append(void *host, const char *bytes, size_t length) {
    enum { MAX_COUNT = 1 << 22 };
    FuzzText *text = host;
    if (text->length + length + 1 > text->capacity) {
        text->capacity = 2 * (text->length + length) + 64;
        text->bytes = realloc(text->bytes, text->capacity);
    }
    memcpy(text->bytes + text->length, bytes, length);
    text->length += length;
    text->bytes[text->length] = 0;
    return text->length < MAX_COUNT;
}

bool fuzz_texts_equal(const FuzzText *a, const FuzzText *b) {
    return a->length == b->length && (a->length == 0 || memcmp(a->bytes, b->bytes, a->length) == 0);
}

bool fuzz_next_part(const char **at, const char *end, const char **part, size_t *length) {
    if (*at == end)
        return false;
    const char *stop = memchr(*at, 30, (size_t)(end - *at));
    *part = *at;
    *length = (size_t)((stop ? stop : end) - *at);
    *at = stop ? stop + 1 : end;
    return true;
}

static bool is_finite(const char *element, size_t length) {
    static const char *const others[] = {"nan", "-nan", "inf", "-inf"};
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++)
        if (strlen(others[i]) == length && memcmp(element, others[i], length) == 0)
            return false;
    return true;
}

// Checks the numbers in a line of the printed state. Lines with strings are not checked.
static bool is_good_line(const char *line, size_t length) {
    const char *end = line + length, *value = line;
    if (line[0] != '$' || memchr(line, '\'', length) || memchr(line, '"', length))
        return true;
    for (const char *at = line; at + 3 < end; at++)
        value = memcmp(at, " = ", 3) == 0 ? at + 3 : value;
    for (const char *at = value; at < end; at++) {
        const char *stop = memchr(at, ';', (size_t)(end - at));
        stop = stop ? stop : end;
        if (!is_finite(at, (size_t)(stop - at)))
            return false;
        at = stop;
    }
    return true;
}

void fuzz_check_state(PetriSession *session) {
    FuzzText text = {0};
    petri_print(session, PETRI_PRINT_STATE, fuzz_append, &text);
    for (const char *line = text.bytes; line && *line; line += strspn(line, "\n")) {
        size_t length = strcspn(line, "\n");
        if (!is_good_line(line, length))
            fuzz_fail("a value in the state is not finite: %.*s", (int)length, line);
        line += length;
    }
    free(text.bytes);
}

static char folder[64];

static int remove_one(const char *path, const struct stat *status, int type, struct FTW *where) {
    (void)status, (void)type, (void)where;
    return remove(path);
}

static void remove_folder(void) {
    nftw(folder, remove_one, 8, FTW_DEPTH | FTW_PHYS);
}

const char *fuzz_file(const char *name) {
    static char path[4][128];
    static unsigned turn;
    if (!folder[0]) {
        const char *place = getenv("TMPDIR");
        snprintf(folder, sizeof folder, "%s/petri-fuzz.XXXXXX", place && strlen(place) < 40 ? place : "/tmp");
        if (!mkdtemp(folder))
            fuzz_fail("cannot make a temporary folder");
        atexit(remove_folder);
    }
    char *out = path[turn++ % 4];
    snprintf(out, sizeof path[0], "%s/%s", folder, name);
    return out;
}

void fuzz_put(const char *name, const void *bytes, size_t length) {
    FILE *file = fopen(fuzz_file(name), "wb");
    if (!file || fwrite(bytes, 1, length, file) != length || fclose(file) != 0)
        fuzz_fail("cannot write %s", fuzz_file(name));
}

void fuzz_put_parts(const char *name, FuzzText *head, const uint8_t *data, size_t size, FuzzAddPart *add) {
    const char *at = (const char *)data, *end = at + size, *part;
    size_t length;
    if (size > 0 && at[0] == '#') {
        fuzz_put(name, at + 1, size - 1);
    } else {
        while (fuzz_next_part(&at, end, &part, &length))
            add(head, part, length);
        fuzz_put(name, head->bytes, head->length);
    }
    free(head->bytes);
}

void fuzz_put_state(const char *name, const void *text, size_t length) {
    FuzzText all = {0};
    char end[40];
    fuzz_append(&all, text, length);
    int count = snprintf(end, sizeof end, "end %016" PRIx64 "\n", hash_bytes(0, all.bytes, length));
    fuzz_append(&all, end, (size_t)count);
    fuzz_put(name, all.bytes, all.length);
    free(all.bytes);
}
