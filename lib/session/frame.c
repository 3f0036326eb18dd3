// frame.c: one frame: clocks, evaluation, systems. The only place where state goes round (spec language.md L16).
#include "session/session.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum { TEMPO = 120, QUANTUM = 4 }; // without pragmas

static double now(clockid_t clock) {
    struct timespec time;
    clock_gettime(clock, &time);
    return (double)time.tv_sec + (double)time.tv_nsec * 1e-9;
}

// The value of a pragma: a number, or a string that reads as one (L12); tempo and fps must be above 0. Of several the
// last counts, even if that is bad and means the default.
static double pragma_number(PetriSession *session, const Pragma *pragma, bool positive, double fallback) {
    Value v = pragma->value;
    double number = NAN;
    if (v.kind == VALUE_NUMBERS && v.len == 1 && !symbol_of_number(&session->symbols, v.as.number))
        number = v.as.number;
    else if (v.kind == VALUE_MIXED && v.as.items[0].type == ITEM_STRING)
        petri_read_number(str_to_c(&session->text_arena, v.as.items[0].as.string->text), &number);
    bool good = positive ? number > 0 && isfinite(number) : !isnan(number);
    if (good)
        return number;
    Diag diag = {.level = DIAG_WARNING,
                 .source = pragma->source,
                 .span = pragma->span,
                 .text = positive ? STR("this pragma's value must be a number above 0; ignored")
                                  : STR("this pragma's value must be a number; ignored"),
                 .code = "bad-pragma"};
    session_tell(session, &diag);
    return fallback;
}

static void clear_frame(PetriSession *session) {
    session->tree = VALUE_NULL;
    diag_sink_free(&session->log);
    diag_sink_free(&session->errors);
    arena_reset(&session->frame_arena);
    arena_reset(&session->scene_arena);
    arena_reset(&session->text_arena);
    session_free_retired(session);
}

void session_start(PetriSession *session, const Program *program) {
    clear_frame(session);
    double fps = session->options.fps, tempo = TEMPO, quantum = QUANTUM;
    for (uint32_t i = 0; i < program->pragma_count; i++) {
        const Pragma *pragma = &program->pragmas[i];
        if (str_equal(pragma->name->name, STR("fps")))
            fps = pragma_number(session, pragma, true, session->options.fps);
        else if (str_equal(pragma->name->name, STR("tempo")))
            tempo = pragma_number(session, pragma, true, TEMPO);
        else if (str_equal(pragma->name->name, STR("quantum")))
            quantum = pragma_number(session, pragma, false, QUANTUM);
    }
    session->frame = (PetriFrame){.number = -1, .fps = fps, .tempo = tempo};
    session->quantum = quantum;
    memset(session->auto_frames, 0, sizeof session->auto_frames);
    session->delta = 0;
    session->start = 0;
    session->performance = session->options.realtime ? 1 : 2;
    session->slow_frame = false;
}

void session_resume(PetriSession *session, int64_t number) {
    PetriFrame *frame = &session->frame;
    frame->number = number;
    frame->time = (double)number / frame->fps;
    frame->beat = frame->time / (60 / frame->tempo);
}

// The clock of a session in real time: the monotonic one without the time that the host has held it.
static double session_clock(const PetriSession *session) {
    return now(CLOCK_MONOTONIC) - session->held;
}

// A session that fell behind further than this goes on from where it is; it does not hurry to make up for it.
static const double LATEST = 0.1;

// In real time: sleeps until frame `number` is due and returns the time.
static double wait_for_frame(PetriSession *session, int64_t number) {
    double at = session_clock(session);
    if (session->start == 0) { // the first frame, or the first after a restored state
        session->start = at - (double)number / session->frame.fps;
        session->due = at + 1 / session->frame.fps;
        return at;
    }
    double spare = session->due - at;
    session->slow_frame = spare < 0;
    session->performance += spare > 0.001 ? 0.001 : -0.01;
    session->performance = fmin(2, fmax(0.5, session->performance));
    if (spare > 0) {
        struct timespec pause = {(time_t)spare, (long)((spare - floor(spare)) * 1e9)};
        nanosleep(&pause, NULL);
    }
    session->due = fmax(session->due, at - LATEST) + 1 / session->frame.fps;
    return session_clock(session);
}

double petri_due(const PetriSession *session) {
    return session->options.realtime && session->start != 0 ? fmax(0, session->due - session_clock(session)) : 0;
}

void petri_hold(PetriSession *session) {
    if (!session->options.realtime || session->start == 0)
        return;
    double late = session_clock(session) - (session->frame.time + 1 / session->frame.fps);
    if (late > 0)
        session->held += late;
    session->due = session->frame.time + 1 / session->frame.fps;
}

static void advance_clocks(PetriSession *session) {
    PetriFrame *frame = &session->frame;
    double last_beat = frame->beat, beat_length = 60 / frame->tempo;
    frame->number++;
    if (session->options.realtime) {
        frame->time = wait_for_frame(session, frame->number);
        frame->beat = (frame->time - session->start) / beat_length;
    } else {
        frame->time = (double)frame->number / frame->fps;
        frame->beat = frame->time / beat_length;
    }
    session->delta = frame->number == 0 ? 0 : frame->beat - last_beat;
}

void session_set_globals(const PetriSession *session, Vm *vm) {
    const PetriFrame *frame = &session->frame;
    bool realtime = session->options.realtime;
    const double values[ENGINE_NAME_COUNT] = {
        [ENGINE_FRAME] = (double)frame->number,
        [ENGINE_FPS] = frame->fps,
        [ENGINE_TIME] = frame->time,
        [ENGINE_BEAT] = frame->beat,
        [ENGINE_DELTA] = session->delta,
        [ENGINE_TEMPO] = frame->tempo,
        [ENGINE_QUANTUM] = session->quantum,
        [ENGINE_PERFORMANCE] = session->performance,
        [ENGINE_SLOW_FRAME] = session->slow_frame,
        [ENGINE_CLOCK] = realtime ? now(CLOCK_REALTIME) : 0,
        [ENGINE_REALTIME] = realtime,
        [ENGINE_OFFSCREEN] = 1,
    };
    for (int i = 0; i < ENGINE_NAME_COUNT; i++)
        vm->globals[i] = value_number(values[i]);
    vm->globals[ENGINE_RUN_TIME] =
        isnan(session->options.run_time) ? VALUE_NULL : value_number(session->options.run_time);
}

static void report_memory(PetriSession *session) {
    Diag diag = {.level = DIAG_ERROR,
                 .text =
                     str_format(&session->text_arena, "the frame needs more than its %zu MiB of memory; it is given up",
                                session->options.memory_bytes >> 20),
                 .code = "memory-limit"};
    session_tell(session, &diag);
}

static void evaluate(PetriSession *session) {
    session->vm.state = session->state;
    session->in_frame = true;
    input_write(scene_input(session->scene), session->state, &session->frame_arena, session->frame.beat);
    session->tree = vm_run(&session->vm, session->program->program);
    session->in_frame = false;
}

static void update_systems(PetriSession *session) {
    SceneFrame frame = {.state = session->state,
                        .arena = &session->scene_arena,
                        .time = session->frame.time,
                        .fps = session->frame.fps,
                        .performance = session->performance,
                        .lockstep = !session->options.realtime,
                        .generation = session->generation};
    session->frame.physics_steps = scene_update(session->scene, session->tree, &frame);
}

// Runs one stage; false if it used up the frame's memory.
static bool run_stage(PetriSession *session, void (*stage)(PetriSession *)) {
    jmp_buf escape;
    session->frame_arena.escape = session->scene_arena.escape = &escape;
    if (setjmp(escape) != 0)
        return false;
    stage(session);
    return true;
}

static bool guarded(PetriSession *session, void (*stage)(PetriSession *), double *seconds) {
    double start = now(CLOCK_MONOTONIC);
    bool done = run_stage(session, stage);
    session->frame_arena.escape = session->scene_arena.escape = NULL;
    session->in_frame = false;
    *seconds = now(CLOCK_MONOTONIC) - start;
    return done;
}

PetriStatus petri_step(PetriSession *session) {
    if (!session->program)
        return PETRI_INVALID;
    clear_frame(session);
    advance_clocks(session);
    session_set_globals(session, &session->vm);
    session->frame.physics_steps = 0;
    if (!guarded(session, evaluate, &session->frame.evaluation_seconds)) {
        session->tree = VALUE_NULL;
        session->loading = NULL;
        report_memory(session);
        return PETRI_LIMIT;
    }
    // A frame that was cut short would look to the systems as if everything had vanished.
    if (session->vm.stopped)
        return PETRI_LIMIT;
    return guarded(session, update_systems, &session->frame.physics_seconds) ? PETRI_OK : PETRI_MEMORY;
}

PetriFrame petri_frame(const PetriSession *session) {
    return session->frame;
}
