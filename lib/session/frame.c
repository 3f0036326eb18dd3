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

void session_clear_frame(PetriSession *session) {
    session->tree = VALUE_NULL;
    session->evaluated = false;
    session->values = NULL;
    session->value_count = session->value_capacity = 0;
    diag_sink_free(&session->log);
    diag_sink_free(&session->errors);
    arena_reset(&session->frame_arena);
    arena_reset(&session->scene_arena);
    arena_reset(&session->text_arena);
    session_free_retired(session);
}

static ClockRates rates_of(PetriSession *session, const Program *program) {
    ClockRates rates = {session->options.fps, TEMPO, QUANTUM};
    for (uint32_t i = 0; i < program->pragma_count; i++) {
        const Pragma *pragma = &program->pragmas[i];
        if (str_equal(pragma->name->name, STR("fps")))
            rates.fps = pragma_number(session, pragma, true, session->options.fps);
        else if (str_equal(pragma->name->name, STR("tempo")))
            rates.tempo = pragma_number(session, pragma, true, TEMPO);
        else if (str_equal(pragma->name->name, STR("quantum")))
            rates.quantum = pragma_number(session, pragma, false, QUANTUM);
    }
    return rates;
}

// Before frame 0 at the session's rates.
static void rewind_clock(PetriSession *session) {
    session->frame = (PetriFrame){.number = -1, .fps = session->frame.fps, .tempo = session->frame.tempo};
    session->base = (ClockBase){0};
    memset(session->auto_frames, 0, sizeof session->auto_frames);
    session->delta = 0;
    session->wall = (WallClock){.performance = session->options.realtime ? 1 : 2};
    session->profiled_physics = 0;
    session->profiled_frames = 0;
    if (session->vm.profile)
        vm_profile_clear(session->vm.profile);
}

void session_start(PetriSession *session, const Program *program) {
    session->said = rates_of(session, program);
    session->frame.fps = session->said.fps;
    session->frame.tempo = session->said.tempo;
    session->quantum = session->said.quantum;
    rewind_clock(session);
    session_change_config(session, false);
}

// What is due and what the beat is stay as they are; what comes is counted from here.
static void rebase_clock(PetriSession *session) {
    const PetriFrame *frame = &session->frame;
    if (frame->number >= 0)
        session->base = (ClockBase){frame->number, frame->time, frame->beat};
}

static void set_fps(PetriSession *session, double fps) {
    rebase_clock(session);
    session->frame.fps = fps;
}

static void set_tempo(PetriSession *session, double tempo) {
    rebase_clock(session);
    session->frame.tempo = tempo;
}

void session_set_rates(PetriSession *session, const ClockRates *rates) {
    if (rates->fps != session->frame.fps)
        set_fps(session, rates->fps);
    if (rates->tempo != session->frame.tempo)
        set_tempo(session, rates->tempo);
    session->quantum = rates->quantum;
}

void session_take_rates(PetriSession *session, const Program *program) {
    ClockRates before = session->said, rates = {session->frame.fps, session->frame.tempo, session->quantum};
    const ClockRates *said = &session->said;
    session->said = rates_of(session, program);
    rates.fps = said->fps != before.fps ? said->fps : rates.fps;
    rates.tempo = said->tempo != before.tempo ? said->tempo : rates.tempo;
    rates.quantum = said->quantum != before.quantum ? said->quantum : rates.quantum;
    session_set_rates(session, &rates);
}

static bool is_rate(double x) {
    return x > 0 && isfinite(x);
}

PetriStatus petri_set_tempo(PetriSession *session, double tempo) {
    if (!is_rate(tempo))
        return PETRI_INVALID;
    set_tempo(session, tempo);
    session_change_config(session, true);
    return PETRI_OK;
}

PetriStatus petri_set_fps(PetriSession *session, double fps) {
    if (!is_rate(fps))
        return PETRI_INVALID;
    set_fps(session, fps);
    session_change_config(session, true);
    return PETRI_OK;
}

PetriStatus petri_set_resolution(PetriSession *session, double resolution) {
    if (!(resolution >= 0) || !isfinite(resolution))
        return PETRI_INVALID;
    session->resolution = resolution;
    session_change_config(session, true);
    return PETRI_OK;
}

double petri_resolution(const PetriSession *session) {
    return session->resolution;
}

void petri_clear(PetriSession *session) {
    state_clear(session->state);
    scene_reset(session->scene, NULL);
    session_clear_frame(session);
    rewind_clock(session);
    session_change_config(session, false);
}

void session_resume(PetriSession *session, int64_t number) {
    PetriFrame *frame = &session->frame;
    session->base = (ClockBase){0};
    session->wall.running = false;
    session_change_config(session, false);
    frame->number = number;
    frame->time = (double)number / frame->fps;
    frame->beat = frame->time / (60 / frame->tempo);
}

static double wall_time(const PetriSession *session) {
    return now(CLOCK_MONOTONIC) - session->wall.origin;
}

// A session that fell behind further than this goes on from where it is; it does not hurry to make up for it.
static const double LATEST = 0.1;

static double lockstep_time(const PetriSession *session) {
    return session->base.time + (double)(session->frame.number - session->base.frame) / session->frame.fps;
}

// The first frame has the time that it has in lockstep: 0, or where a restored state goes on.
static double start_wall_clock(PetriSession *session) {
    double time = lockstep_time(session);
    session->wall.running = true;
    session->wall.origin = now(CLOCK_MONOTONIC) - time;
    session->wall.due = time + 1 / session->frame.fps;
    return time;
}

// In real time: sleeps until the frame is due and returns the time.
static double wait_for_frame(PetriSession *session) {
    WallClock *wall = &session->wall;
    if (!wall->running)
        return start_wall_clock(session);
    double at = wall_time(session), spare = wall->due - at;
    wall->slow_frame = spare < 0;
    wall->performance += spare > 0.001 ? 0.001 : -0.01;
    wall->performance = fmin(2, fmax(0.5, wall->performance));
    if (spare > 0) {
        struct timespec pause = {(time_t)spare, (long)((spare - floor(spare)) * 1e9)};
        nanosleep(&pause, NULL);
    }
    wall->due = fmax(wall->due, at - LATEST) + 1 / session->frame.fps;
    return wall_time(session);
}

double petri_due(const PetriSession *session) {
    bool waits = session->options.realtime && session->wall.running;
    return waits ? fmax(0, session->wall.due - wall_time(session)) : 0;
}

// The clock is put to where the next frame is due.
static void follow_frame(PetriSession *session) {
    session->wall.due = session->frame.time + 1 / session->frame.fps;
    session->wall.origin = now(CLOCK_MONOTONIC) - session->wall.due;
}

void petri_hold(PetriSession *session) {
    if (!session->options.realtime || !session->wall.running)
        return;
    double due = session->frame.time + 1 / session->frame.fps;
    if (wall_time(session) > due)
        follow_frame(session);
    session->wall.due = due;
}

void session_rewind_wall_clock(PetriSession *session) {
    session->wall.running = session->wall.running && session->frame.number >= 0;
    if (session->wall.running)
        follow_frame(session);
}

static void advance_clocks(PetriSession *session) {
    PetriFrame *frame = &session->frame;
    const ClockBase *base = &session->base;
    double last_beat = frame->beat, beat_length = 60 / frame->tempo;
    frame->number++;
    frame->time = session->options.realtime ? wait_for_frame(session) : lockstep_time(session);
    frame->beat = base->beat + (frame->time - base->time) / beat_length;
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
        [ENGINE_PERFORMANCE] = session->wall.performance,
        [ENGINE_SLOW_FRAME] = session->wall.slow_frame,
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

static uint32_t export_count(const PetriSession *session) {
    uint32_t count = session->program->program->export_count;
    for (uint32_t i = 0; i < session->prompt_count; i++)
        count += session->prompts[i].program->export_count;
    return count;
}

// One program, with the values so far as its parameters; its own follow them.
static Value run_program(PetriSession *session, const Program *program) {
    Value result = vm_run(&session->vm, program, session->values, session->values + session->value_count);
    session->value_count += program->export_count;
    return result;
}

bool session_evaluate(PetriSession *session) {
    session->vm.state = session->state;
    session->vm.interrupt = &session->interrupt;
    session->value_count = 0;
    session->value_capacity = export_count(session);
    session->values = arena_alloc_array(&session->frame_arena, session->value_capacity, sizeof(Value));
    session->in_frame = true;
    session->tree = run_program(session, session->program->program);
    for (uint32_t i = 0; i < session->prompt_count && !session->vm.stopped; i++) {
        const Prompt *prompt = &session->prompts[i];
        Value more = run_program(session, prompt->program);
        if (!prompt->adds)
            continue;
        Vector tree = vector_new(&session->frame_arena);
        vector_add(&tree, session->tree);
        vector_add(&tree, more);
        session->tree = vector_finish(&tree);
    }
    session->in_frame = false;
    session->evaluated = !session->vm.stopped;
    return session->evaluated;
}

static void evaluate(PetriSession *session) {
    input_write(scene_input(session->scene), session->state, &session->frame_arena, session->frame.beat);
    session_evaluate(session);
}

static void update_systems(PetriSession *session) {
    if (session->unseen)
        session_look_at_top(session);
    session->unseen = false;
    SceneFrame frame = {.state = session->state,
                        .arena = &session->scene_arena,
                        .time = session->frame.time,
                        .fps = session->frame.fps,
                        .performance = session->wall.performance,
                        .lockstep = !session->options.realtime,
                        .generation = session->generation,
                        .resolution = session->resolution,
                        .interrupt = session->options.interruptible ? &session->interrupt : NULL};
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

void petri_interrupt(PetriSession *session) {
    atomic_store(&session->interrupt, true);
}

bool petri_interrupted(PetriSession *session) {
    return atomic_exchange(&session->interrupt, false);
}

static PetriStatus make_frame(PetriSession *session) {
    session_clear_frame(session);
    advance_clocks(session);
    session_set_globals(session, &session->vm);
    session->frame.physics_steps = 0;
    if (!guarded(session, evaluate, &session->frame.evaluation_seconds)) {
        session_clear_frame(session);
        session->loading = NULL;
        report_memory(session);
        return PETRI_LIMIT;
    }
    // A frame that was cut short would look to the systems as if everything had vanished.
    if (session->vm.stopped)
        return petri_interrupted(session) ? PETRI_INTERRUPTED : PETRI_LIMIT;
    if (!guarded(session, update_systems, &session->frame.physics_seconds))
        return PETRI_MEMORY;
    session->profiled_physics += session->frame.physics_seconds;
    session->profiled_frames++;
    if (!session->options.interruptible || !petri_interrupted(session))
        return PETRI_OK;
    return session_put_back(session, &session->undo) ? PETRI_INTERRUPTED : PETRI_MEMORY;
}

PetriStatus petri_step(PetriSession *session) {
    if (!session->program)
        return PETRI_INVALID;
    if (petri_interrupted(session))
        return PETRI_INTERRUPTED;
    if (session->options.interruptible && !session_take(session, &session->undo))
        return PETRI_MEMORY;
    PetriFrame frame = session->frame;
    double delta = session->delta;
    WallClock wall = session->wall;
    PetriStatus status = make_frame(session);
    if (status == PETRI_INTERRUPTED || (status == PETRI_LIMIT && session->options.interruptible)) {
        session_clear_frame(session);
        session->frame = frame;
        session->delta = delta;
        session->wall = wall;
    }
    return status;
}

PetriFrame petri_frame(const PetriSession *session) {
    return session->frame;
}
