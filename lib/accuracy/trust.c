// trust.c: runs a script several times to find out how many digits of its results are true (petri_trust).
#include "accuracy/estimate.h"
#include "base/hash_index.h"
#include "base/heap.h"
#include "base/host_struct.h"
#include "maths/maths.h"
#include "petri-edit.h"
#include "petri-live.h"
#include "session/session.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ELEMENTS: of a vector; the others are not compared. PROJECTIONS: random sums of all coordinates, whose differences
// are those of the positions. ROWS: at which runs are compared. VALUE_BYTES: of a printed value that is reported.
enum { ELEMENTS = 16, PROJECTIONS = 8, ROWS = 2048, VALUE_BYTES = 400 };

typedef struct Trust {
    PetriSession *session;
    PetriTrustOptions given;
    int64_t interval; // frames from one row to the next
    size_t capacity;  // rows of a run that does not stop early
    size_t rows;
    int64_t last_frame; // of the first run
    TrustRun run;       // that is executed
    double *numbers;    // [((expression * ELEMENTS + element) * TRUST_RUNS + run) * capacity + row]; NaN: none
    double *motion;     // [(run * capacity + row) * PROJECTIONS + projection]
    uint64_t *counts;   // [run * capacity + row]: number of particles
    double *times;      // by row, in the first run
    int64_t *frames;
    char *texts;            // [(expression * capacity + row) * VALUE_BYTES]: values in the first run
    double step;            // length of the steps; 0: no system has taken one
    bool random;            // the last frame has a `!random`
    bool stopped;           // the motion of the run has become meaningless
    int64_t unstable_frame; // since which the first run is unstable; -1: it is not
    uint32_t unstable_line; // of the force; 0: not known
} Trust;

// Notes what ends a run or makes it meaningless. The host receives the diagnostics of the first run, and errors.
static bool filter_diagnostic(void *context, const PetriDiagnostic *diagnostic) {
    Trust *trust = context;
    const char *code = diagnostic->code ? diagnostic->code : "";
    bool diverged = strcmp(code, "divergence") == 0, first = trust->run == TRUST_STEP;
    trust->stopped = trust->stopped || diverged;
    if (first && trust->unstable_frame < 0 && (diverged || strcmp(code, "unstable-force") == 0)) {
        int64_t frame = petri_frame_number(trust->session);
        trust->unstable_frame = frame > 1 ? frame : 1; // forces are checked before the first step
        trust->unstable_line = diagnostic->line;
    }
    return first || diagnostic->level == PETRI_ERROR;
}

// --- the rows of a run

typedef struct TrustText {
    char text[VALUE_BYTES];
    size_t length;
} TrustText;

static bool collect_text(void *user_data, const char *text, size_t length) {
    TrustText *printed = user_data;
    size_t room = sizeof printed->text - 1 - printed->length;
    length = length < room ? length : room;
    memcpy(printed->text + printed->length, text, length);
    printed->length += length;
    printed->text[printed->length] = '\0';
    return true;
}

static double *series_of(const Trust *trust, uint32_t expression, int element) {
    return trust->numbers + ((size_t)expression * ELEMENTS + (size_t)element) * TRUST_RUNS * trust->capacity;
}

static PetriStatus measure_expression(Trust *trust, uint32_t expression, size_t row) {
    TrustText printed = {.length = 0};
    PetriEvaluation result;
    const PetriTrustOptions *given = &trust->given;
    PetriStatus status = given->measure
                             ? given->measure(given->user_data, expression, collect_text, &printed)
                             : petri_evaluate(trust->session, given->expressions[expression], PETRI_NUL_TERMINATED,
                                              &result, sizeof result, collect_text, &printed);
    if (status != PETRI_OK)
        return status;
    if (trust->run == TRUST_STEP)
        memcpy(trust->texts + ((size_t)expression * trust->capacity + row) * VALUE_BYTES, printed.text, VALUE_BYTES);
    double numbers[ELEMENTS];
    bool finite = true;
    int count = 0;
    for (char *rest = printed.text; count < ELEMENTS && rest; count++) {
        char *element = rest, *end = strchr(rest, ';');
        rest = end ? end + 1 : NULL;
        if (end)
            *end = '\0';
        finite = finite && petri_parse_number(element, &numbers[count]) && isfinite(numbers[count]);
    }
    for (int i = 0; i < count && finite; i++)
        series_of(trust, expression, i)[(size_t)trust->run * trust->capacity + row] = numbers[i];
    return PETRI_OK;
}

// Stores random sums of the coordinates of all particles.
static void project(Trust *trust, size_t row) {
    PetriSystem system;
    size_t place = (size_t)trust->run * trust->capacity + row;
    double *sums = trust->motion + place * PROJECTIONS;
    for (size_t number = 0; petri_system(trust->session, number, &system, sizeof system); number++) {
        trust->counts[place] += system.particle_count;
        for (uint32_t i = 0; i < system.particle_count; i++) {
            const double *position = system.position.data + i * system.position.stride;
            for (uint32_t k = 0; k < system.dimensions; k++)
                for (int p = 0; p < PROJECTIONS; p++) {
                    uint64_t key = hash_mix(hash_mix((uint64_t)number << 32 | i) + k * PROJECTIONS + (uint64_t)p);
                    sums[p] += position[k] * ((double)(key >> 11) * 0x1p-52 - 1);
                }
        }
    }
}

// Finds the length of the steps of the first system that moves, and whether there are random forces.
static PetriStatus inspect_systems(Trust *trust, const uint64_t *steps) {
    PetriSystem system;
    PetriForce force;
    PetriStatus status = PETRI_OK;
    for (size_t number = 0; status == PETRI_OK && petri_system(trust->session, number, &system, sizeof system);
         number++) {
        char expression[VALUE_BYTES];
        PetriEvaluation clock = {.number = 0};
        for (uint32_t i = 0; petri_system_force(trust->session, number, i, &force, sizeof force); i++)
            trust->random = trust->random || strcmp(force.kind, "random") == 0;
        if (trust->step > 0 || number > 0 || *steps == 0)
            continue;
        int length = snprintf(expression, sizeof expression, "$((%s);:clock)", system.name);
        if (length < (int)sizeof expression)
            status = petri_evaluate(trust->session, expression, PETRI_NUL_TERMINATED, &clock, sizeof clock, NULL, NULL);
        trust->step = clock.number / (double)*steps;
    }
    return status;
}

static PetriStatus take_row(Trust *trust, size_t row) {
    PetriFrame frame;
    petri_frame(trust->session, &frame, sizeof frame);
    if (trust->run == TRUST_STEP) {
        trust->times[row] = frame.time;
        trust->frames[row] = frame.number;
    }
    project(trust, row);
    PetriStatus status = PETRI_OK;
    for (uint32_t i = 0; status == PETRI_OK && i < trust->given.count; i++)
        status = measure_expression(trust, i, row);
    return status;
}

static PetriStatus execute(Trust *trust, TrustRun run) {
    static const PetriVariation variations[TRUST_RUNS] = {
        [TRUST_HALF] = {.parts = 2},
        [TRUST_QUARTER] = {.parts = 4},
        [TRUST_ULP] = {.shift = DBL_EPSILON},
        [TRUST_MOVED] = {.shift = TRUST_SHIFT, .seed = 1},
    };
    PetriStatus status = PETRI_OK;
    uint64_t steps = 0;
    trust->run = run;
    trust->stopped = false;
    petri_reset(trust->session);
    trust->session->variation = variations[run];
    for (int64_t frame = 0; status == PETRI_OK && frame <= trust->last_frame && !trust->stopped; frame++) {
        PetriSystem system;
        status = petri_step(trust->session);
        steps += status == PETRI_OK && petri_system(trust->session, 0, &system, sizeof system) ? system.steps : 0;
        size_t row = (size_t)((frame + trust->interval - 1) / trust->interval);
        bool ends = frame == trust->last_frame || (trust->stopped && run == TRUST_STEP);
        if (status == PETRI_OK && (ends || (frame % trust->interval == 0 && !trust->stopped)))
            status = take_row(trust, row);
        if (status == PETRI_OK && ends && run == TRUST_STEP) {
            trust->last_frame = frame;
            trust->rows = trust->stopped ? row + 1 : trust->rows;
            status = inspect_systems(trust, &steps);
        }
    }
    return status;
}

// --- the report

static double norm_of(const Trust *trust, uint32_t expression, size_t row, int *elements) {
    double square = 0;
    *elements = 0;
    for (int i = 0; i < ELEMENTS; i++) {
        double x = series_of(trust, expression, i)[row];
        square += isnan(x) ? 0 : x * x;
        *elements += !isnan(x);
    }
    return sqrt(square);
}

// Returns the number of decimal digits of a value that are larger than its error.
static int digits_of(double error, double value) {
    enum { MAX_DIGITS = 15 };
    double digits = error > 0 ? floor(maths_log10(value / error)) : MAX_DIGITS;
    return digits > 0 ? (int)fmin(digits, MAX_DIGITS) : 0;
}

static bool counts_differ(const Trust *trust, size_t row) {
    bool differ = false;
    for (size_t r = 0; r <= row; r++)
        for (size_t run = 1; run < TRUST_RUNS; run++)
            differ = differ || trust->counts[run * trust->capacity + r] != trust->counts[r];
    return differ;
}

// Writes a resolution that gives the wanted digits, if the error goes on to fall with the observed order.
static void advise(const Trust *trust, const PetriTrust *found, double value, char *text, size_t size) {
    enum { WANTED = 3, REGULAR_DOUBLINGS = 14, MAX_DOUBLINGS = 6 };
    double order = isnan(found->order) ? 1 : found->order;
    double doublings = ceil(maths_log2(found->error / value * 1e3) / order);
    if (!(doublings <= (isnan(found->order) ? MAX_DOUBLINGS : REGULAR_DOUBLINGS)) || !(trust->step > 0)) {
        snprintf(text, size, "step too large, or the value too close to 0: no step in reach gives %d digits", WANTED);
        return;
    }
    double parts = ldexp(1, (int)fmax(doublings, 1)), rate = parts / trust->step;
    bool whole = fabs(rate - round(rate)) < 1e-9 * rate;
    int used = snprintf(text, size, "step too large: for %d digits, use resolution=%s%.*g", WANTED, whole ? "1/" : "",
                        whole ? 9 : 4, whole ? round(rate) : 1 / rate);
    if (trust->random)
        snprintf(text + used, size - (size_t)used, ", and !random %.3g times as strong", sqrt(parts));
}

static void judge(const Trust *trust, double value, PetriTrust *found, char *text, size_t size, size_t row) {
    enum { ENOUGH = 3 };
    if (trust->unstable_frame >= 0 && trust->unstable_frame <= found->frame) {
        found->verdict = PETRI_UNSTABLE;
        int used = snprintf(text, size, "unstable since frame %" PRId64, trust->unstable_frame);
        if (trust->unstable_line > 0)
            snprintf(text + used, size - (size_t)used, " because of the force in line %" PRIu32, trust->unstable_line);
    } else if (found->digits < 0) {
        found->verdict = PETRI_NO_NUMBER;
        snprintf(text, size, "not a number");
    } else if (found->digits >= ENOUGH) {
        found->verdict = PETRI_CONVERGED;
        snprintf(text, size, "converged: %d digits", found->digits);
    } else if (trust->random && counts_differ(trust, row)) {
        found->verdict = PETRI_INCOMPARABLE;
        snprintf(text, size,
                 "!random makes single runs incomparable, because particles come and go at other times; "
                 "compare means over seeds");
    } else if (found->time >= found->horizon) {
        found->verdict = PETRI_CHAOTIC;
        snprintf(text, size, "chaotic: single runs mean nothing after %.3g s; look at means", found->horizon);
    } else {
        found->verdict = PETRI_STEP_TOO_LARGE;
        advise(trust, found, value, text, size);
    }
}

static void report_row(const Trust *trust, const TrustGrowth *growth, uint32_t expression, size_t row) {
    double time = trust->rows > 1 ? trust->times[1] - trust->times[0] : 0;
    PetriTrust found = {.size = sizeof found,
                        .frame = trust->frames[row],
                        .time = trust->times[row],
                        .expression = expression,
                        .value = trust->texts + ((size_t)expression * trust->capacity + row) * VALUE_BYTES,
                        .order = NAN,
                        .digits = -1,
                        .lyapunov_time = growth->lyapunov_time * time,
                        .lyapunov_error = growth->lyapunov_error * time,
                        .horizon = growth->horizon * time};
    char sentence[VALUE_BYTES];
    int elements;
    double norm = norm_of(trust, expression, row, &elements);
    for (int i = 0; i < elements; i++) {
        TrustEstimate one =
            trust_estimate((TrustSeries){series_of(trust, expression, i), trust->capacity, trust->rows}, row);
        found.order = one.error >= found.error ? one.order : found.order;
        found.error = fmax(found.error, one.error);
        found.spread = fmax(found.spread, one.spread);
    }
    if (elements > 0)
        found.digits = digits_of(fmax(found.error, found.spread), norm);
    judge(trust, norm, &found, sentence, sizeof sentence, row);
    found.sentence = sentence;
    trust->given.report(trust->given.user_data, &found);
}

// Replaces the first projection of each row by the distance between the positions, or the motion of the first run.
static TrustGrowth measure_growth(Trust *trust) {
    const double *base = trust->motion;
    double *distances = trust->numbers + (size_t)trust->given.count * ELEMENTS * TRUST_RUNS * trust->capacity;
    for (size_t run = 0; run < TRUST_RUNS; run++)
        for (size_t row = 0; row < trust->rows; row++) {
            double square = 0;
            for (size_t p = 0; p < PROJECTIONS; p++) {
                double from = base[(run == TRUST_STEP ? 0 : row) * PROJECTIONS + p];
                double distance = trust->motion[(run * trust->capacity + row) * PROJECTIONS + p] - from;
                square += distance * distance;
            }
            distances[run * trust->capacity + row] = sqrt(square);
        }
    return trust_growth((TrustSeries){distances, trust->capacity, trust->rows});
}

static void report_all(Trust *trust) {
    TrustGrowth growth = measure_growth(trust);
    for (size_t row = 0; row < trust->rows; row++) {
        bool due = trust->given.every > 0 && trust->frames[row] % trust->given.every == 0;
        for (uint32_t i = 0; i < trust->given.count && (due || row + 1 == trust->rows); i++)
            report_row(trust, &growth, i, row);
    }
}

// Returns the largest number of frames between rows with which there are at most ROWS rows, and that divides `every`.
static int64_t choose_interval(const PetriTrustOptions *given) {
    int64_t interval = given->frames / ROWS + 1;
    interval = given->every > 0 && given->every < interval ? given->every : interval;
    while (given->every > 0 && given->every % interval != 0)
        interval--;
    return interval;
}

static bool allocate(Trust *trust) {
    size_t rows = trust->capacity, count = trust->given.count, numbers = (count * ELEMENTS + 1) * TRUST_RUNS * rows;
    trust->numbers = heap_calloc(numbers, sizeof *trust->numbers);
    trust->motion = heap_calloc(TRUST_RUNS * rows * PROJECTIONS, sizeof *trust->motion);
    trust->counts = heap_calloc(TRUST_RUNS * rows, sizeof *trust->counts);
    trust->times = heap_calloc(rows, sizeof *trust->times);
    trust->frames = heap_calloc(rows, sizeof *trust->frames);
    trust->texts = heap_calloc(count * rows + 1, VALUE_BYTES);
    for (size_t i = 0; trust->numbers && i < numbers; i++)
        trust->numbers[i] = NAN;
    return trust->numbers && trust->motion && trust->counts && trust->times && trust->frames && trust->texts;
}

// Executes and reports all runs. An archive that is written gets none of their frames, only the files that they read.
static PetriStatus execute_all(Trust *trust) {
    PetriSession *session = trust->session;
    Recorder recorder = session->recorder;
    PetriSnapshot *snapshot = petri_snapshot(session);
    PetriStatus status = snapshot && allocate(trust) ? PETRI_OK : PETRI_OUT_OF_MEMORY;
    if (recorder.after_frame)
        session->recorder = (Recorder){.user_data = recorder.user_data, .file = recorder.file};
    for (int run = 0; status == PETRI_OK && run < TRUST_RUNS; run++)
        status = execute(trust, (TrustRun)run);
    if (status == PETRI_OK)
        report_all(trust);
    PetriStatus rewound = snapshot ? petri_rewind(session, snapshot) : PETRI_OK;
    session->recorder = recorder;
    if (rewound != PETRI_OK)
        recorder_jump(session);
    petri_snapshot_free(snapshot);
    return status == PETRI_OK ? rewound : status;
}

PetriStatus petri_trust(PetriSession *session, const PetriTrustOptions *given) {
    Trust trust = {.session = session, .unstable_frame = -1};
    PetriTrustOptions *options = &trust.given;
    if (!session || !host_struct_read(options, sizeof *options, given) || !options->report || options->frames < 1 ||
        options->every < 0 || (options->count > 0 && !options->expressions && !options->measure))
        return PETRI_INVALID;
    trust.interval = choose_interval(options);
    trust.last_frame = options->frames - 1;
    trust.capacity = trust.rows = (size_t)((trust.last_frame + trust.interval - 1) / trust.interval) + 1;
    PetriVariation before = session->variation;
    session->diagnostics.filter = filter_diagnostic;
    session->diagnostics.filter_context = &trust;
    PetriStatus status = execute_all(&trust);
    session->diagnostics.filter = NULL;
    session->variation = before;
    heap_free(trust.numbers);
    heap_free(trust.motion);
    heap_free(trust.counts);
    heap_free(trust.times);
    heap_free(trust.frames);
    heap_free(trust.texts);
    return status;
}
