// frame.c: computation of one frame: evaluates the script, then advances the systems (spec language.md L16).
#include "ast/literal.h"
#include "base/clock.h"
#include "base/host_struct.h"
#include "petri-inspect.h"
#include "session/session.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEMPO = 120, QUANTUM = 4 }; // values for scripts without these pragmas

// Returns the number that a pragma gives, either directly or in a string (L12). If its value is not valid, warns and
// returns the default. With `positive`, only finite numbers above 0 are valid.
static double pragma_number(PetriSession *session, const Pragma *pragma, bool positive, double default_value) {
    Value v = pragma->value;
    double number = NAN;
    if (value_is_number(v) && !symbol_of_number(&session->symbols, v.as.number))
        number = v.as.number;
    else if (v.kind == VALUE_MIXED && v.as.items[0].type == ITEM_STRING) {
        Str text = v.as.items[0].as.string->text;
        (void)(literal_parse_number(text, &number) || literal_parse_timecode(text, &number));
    }
    bool good = positive ? number > 0 && isfinite(number) : !isnan(number);
    if (good)
        return number;
    Str text = positive ? STR("the value of this pragma must be a number above 0; the pragma is ignored")
                        : STR("the value of this pragma must be a number; the pragma is ignored");
    session_report(session, &(Diag){DIAG_WARNING, {pragma->source, pragma->span}, text, .code = "bad-pragma"});
    return default_value;
}

// If a pragma is repeated, the last one counts. If that is invalid, the default is used.
ClockRates session_pragma_rates(PetriSession *session, const Program *program) {
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

// Rewinds to before frame 0, at the current rates.
static void rewind_clock(PetriSession *session) {
    clock_rewind(&session->clock);
    session->undo_of_frame = false;
    if (session->draw_memory)
        memset(session->draw_memory, 0, session->draw_memory_size);
    session->frame.profiled_physics = 0;
    session->frame.profiled_frames = 0;
    session->frame.physics_steps = 0;
    session->frame.evaluation_seconds = session->frame.physics_seconds = 0;
    if (session->vm.profile)
        vm_profile_clear(session->vm.profile);
}

void session_start(PetriSession *session, const ClockRates *rates) {
    session->config.pragma_rates = *rates;
    clock_set_rates(&session->clock, rates);
    rewind_clock(session);
    session_change_config(session, false);
}

void session_apply_rates(PetriSession *session, const ClockRates *pragma_rates) {
    ClockRates before = session->config.pragma_rates, rates = session->clock.rates;
    session->config.pragma_rates = *pragma_rates;
    rates.fps = pragma_rates->fps != before.fps ? pragma_rates->fps : rates.fps;
    rates.tempo = pragma_rates->tempo != before.tempo ? pragma_rates->tempo : rates.tempo;
    rates.quantum = pragma_rates->quantum != before.quantum ? pragma_rates->quantum : rates.quantum;
    clock_set_rates(&session->clock, &rates);
    session_change_config(session, false);
}

static PetriStatus set_rates(PetriSession *session, ClockRates rates, double changed) {
    if (!(changed > 0) || !isfinite(changed))
        return PETRI_INVALID;
    clock_set_rates(&session->clock, &rates);
    session_change_config(session, false);
    return PETRI_OK;
}

PetriStatus petri_set_tempo(PetriSession *session, double tempo) {
    if (!session)
        return PETRI_INVALID;
    ClockRates rates = session->clock.rates;
    rates.tempo = tempo;
    return set_rates(session, rates, tempo);
}

PetriStatus petri_set_fps(PetriSession *session, double fps) {
    if (!session)
        return PETRI_INVALID;
    ClockRates rates = session->clock.rates;
    rates.fps = fps;
    return set_rates(session, rates, fps);
}

PetriStatus petri_set_resolution(PetriSession *session, double resolution) {
    if (!session || !(resolution >= 0) || !isfinite(resolution))
        return PETRI_INVALID;
    session->config.resolution = resolution;
    session_change_config(session, true);
    return PETRI_OK;
}

double petri_resolution(const PetriSession *session) {
    return session ? session->config.resolution : 0;
}

PetriStatus petri_vary(PetriSession *session, const PetriVariation *given) {
    enum { MAX_PARTS = 1000000 };
    PetriVariation variation = {.size = sizeof variation};
    if (!session || !host_struct_read(&variation, sizeof variation, given) || variation.parts > MAX_PARTS ||
        !(variation.shift >= 0) || !isfinite(variation.shift))
        return PETRI_INVALID;
    session->variation = variation;
    return PETRI_OK;
}

void petri_reset(PetriSession *session) {
    if (!session)
        return;
    session->rollback_pending = false; // no longer needed, because the state is cleared
    state_clear(session->state);
    scene_reset(session->scene);
    session_clear_frame(session);
    rewind_clock(session);
    session_change_config(session, false);
    diagnostics_begin_load(&session->diagnostics);
    recorder_jump(session);
}

double petri_seconds_until_due(const PetriSession *session) {
    return session ? clock_seconds_until_due(&session->clock) : 0;
}

void petri_resync_clock(PetriSession *session) {
    if (session)
        clock_resync(&session->clock);
}

void session_set_globals(const PetriSession *session, Vm *vm) {
    const Clock *clock = &session->clock;
    const double values[ENGINE_NAME_COUNT] = {
        [ENGINE_FRAME] = (double)clock->number,
        [ENGINE_FPS] = clock->rates.fps,
        [ENGINE_TIME] = clock->time,
        [ENGINE_BEAT] = clock->beat,
        [ENGINE_DELTA] = clock->delta,
        [ENGINE_TEMPO] = clock->rates.tempo,
        [ENGINE_QUANTUM] = clock->rates.quantum,
        [ENGINE_PERFORMANCE] = clock->wall.performance,
        [ENGINE_SLOW_FRAME] = clock->wall.slow_frame,
        [ENGINE_CLOCK] = clock->realtime ? clock_read(CLOCK_REALTIME) : 0,
        [ENGINE_REALTIME] = clock->realtime,
        [ENGINE_OFFSCREEN] = 1,
    };
    for (int i = 0; i < ENGINE_NAME_COUNT; i++)
        vm->globals[i] = value_number(values[i]);
    vm->globals[ENGINE_RUN_TIME] =
        isnan(session->options.run_time) ? VALUE_NULL : value_number(session->options.run_time);
}

// Runs a program with all values in frame->values as parameters, and appends its exports to them. Returns the program's
// value.
static Value run_program(PetriSession *session, const Program *program) {
    SessionFrame *frame = &session->frame;
    Value result = vm_run(&session->vm, program, frame->values, frame->values + frame->value_count);
    frame->value_count += program->export_count;
    return result;
}

// Evaluates the script and then the prompt's statements, with `state` as the state dictionary.
static void evaluate(PetriSession *session, const State *state) {
    SessionFrame *frame = &session->frame;
    const PromptList *list = session->config.prompts;
    session->vm.state = state;
    frame->names_current = false;
    frame->value_count = 0;
    frame->values = arena_alloc_array(&frame->arena, list->names.count, sizeof(Value));
    frame->evaluating = true;
    for (uint32_t i = 0; i < session->config.program->program->param_count; i++)
        frame->values[frame->value_count++] = value_copy(&frame->arena, session->host_globals.items[i]->value);
    Value tree = run_program(session, session->config.program->program);
    for (uint32_t i = 0; i < list->count; i++) {
        Value more = run_program(session, list->statements[i].program);
        if (!list->statements[i].adds_nodes)
            continue;
        Vector both = vector_new(&frame->arena);
        vector_add(&both, tree);
        vector_add(&both, more);
        tree = vector_finish(&both);
    }
    frame->evaluating = false;
    frame->tree = tree;
    frame->evaluated = true;
}

// Evaluates the frame again. Uses the state from which the frame was computed, if `undo` holds it, else the current
// state.
static PetriStatus preview(PetriSession *session, void *context) {
    State **before = context;
    diag_sink_free(&session->frame.log); // empty it, because the evaluation repeats the output of debug()
    if (session->undo_of_frame) {
        *before = state_new(&session->budget);
        if (!*before)
            arena_exhausted(&session->frame.arena);
        checkpoint_read_state(&session->undo, &session->frame.arena, *before);
        if (state_clear_exhausted(*before))
            arena_exhausted(&session->frame.arena);
    }
    evaluate(session, *before ? *before : session->state);
    return PETRI_OK;
}

PetriStatus petri_preview(PetriSession *session) {
    if (!session)
        return PETRI_INVALID;
    if (session->frame.evaluated)
        return PETRI_OK;
    if (!session->config.program)
        return PETRI_INVALID;
    int64_t number = session->clock.number;
    if (number < 0)
        session->clock.number = 0;
    session_set_globals(session, &session->vm);
    session->clock.number = number;
    State *before = NULL;
    PetriStatus status = session_protect(session, NULL, preview, &before);
    session->vm.state = session->state;
    state_free(before);
    return session_report_abort(session, status, "the evaluation");
}

static PetriStatus update_names(PetriSession *session, void *context) {
    (void)context;
    SessionFrame *frame = &session->frame;
    const PromptList *list = session->config.prompts;
    session->vm.state = session->state;
    frame->value_count = list->names.count;
    for (uint32_t i = 0; i < list->count; i++)
        frame->value_count -= list->statements[i].program->export_count;
    for (uint32_t i = 0; i < list->count; i++)
        if (!list->statements[i].adds_nodes)
            run_program(session, list->statements[i].program);
    frame->names_current = true;
    return PETRI_OK;
}

PetriStatus session_update_names(PetriSession *session) {
    if (session->frame.names_current)
        return PETRI_OK;
    DiagSink log = session->frame.log; // kept, because it already contains the debug() output of the bindings
    session->frame.log = diag_sink_new(&session->frame.arena, 0);
    PetriStatus status = session_protect(session, NULL, update_names, NULL);
    diag_sink_free(&session->frame.log);
    session->frame.log = log;
    return session_report_abort(session, status, "the evaluation");
}

static PetriStatus evaluate_script(PetriSession *session, void *context) {
    InputUndo *undo = context;
    SessionFrame *frame = &session->frame;
    double start = clock_seconds();
    input_write(scene_input(session->scene), session->state, &frame->arena, session->clock.beat, undo);
    if (state_clear_exhausted(session->state))
        arena_exhausted(&frame->arena);
    if (frame->no_frame_yet) {
        session->vm.missed = arena_alloc(&frame->arena, sizeof *session->vm.missed);
        *session->vm.missed = (LookupLog){0};
    }
    evaluate(session, session->state);
    frame->evaluation_seconds = clock_seconds() - start;
    return PETRI_OK;
}

static PetriStatus update_systems(PetriSession *session, void *context) {
    (void)context;
    SessionFrame *frame = &session->frame;
    double start = clock_seconds();
    session_lint_top_nodes(session);
    SceneFrame scene_frame = {.state = session->state,
                              .arena = &frame->systems_arena,
                              .number = session->clock.number,
                              .time = session->clock.time,
                              .fps = session->clock.rates.fps,
                              .performance = session->clock.wall.performance,
                              .lockstep = !session->clock.realtime,
                              .generation = session->loader.generation,
                              .resolution = session->config.resolution,
                              .parts = session->variation.parts,
                              .shift = session->variation.shift,
                              .shift_key = session->variation.seed};
    frame->physics_steps = scene_update(session->scene, frame->tree, &scene_frame);
    frame->physics_seconds = clock_seconds() - start;
    return PETRI_OK;
}

// Evaluates the script for the current frame. If the frame will be undone, removes the input that was written to the
// state.
static PetriStatus evaluate_frame(PetriSession *session, const FrameClock *recorded) {
    InputUndo undo = {.last = NULL};
    session_set_globals(session, &session->vm);
    if (recorded)
        session->vm.globals[ENGINE_CLOCK] = value_number(recorded->realtime ? recorded->unix_time : 0);
    session->frame.physics_steps = 0;
    PetriStatus status = session_protect(session, NULL, evaluate_script, &undo);
    session->frame.missed = session->vm.missed;
    session->vm.missed = NULL;
    session_report_abort(session, status, "the frame");
    bool is_kept = status == PETRI_OK || (status == PETRI_LIMIT_EXCEEDED && !session->options.rollback_frames);
    if (!is_kept)
        input_undo_write(scene_input(session->scene), session->state, &undo);
    if (status == PETRI_OK)
        return status;
    bool incomplete = state_clear_exhausted(session->state); // must not abort the next frame too
    session_drop_frame(session);
    if (incomplete && session->options.rollback_frames)
        session_rollback(session); // because memory ran out while the input was removed from the state
    return status;
}

// Updates the systems after the script was evaluated.
static PetriStatus update_frame(PetriSession *session) {
    SessionFrame *frame = &session->frame;
    uint64_t evaluation_work = session->budget.work;
    if (frame->no_frame_yet)
        frame->seen.count = 0;
    session_lint_windows(session);
    frame->no_frame_yet = false;
    session->spent = evaluation_work; // evaluation and systems share one budget
    PetriStatus status = session_protect(session, NULL, update_systems, NULL);
    bool exhausted = scene_clear_exhausted(session->scene);
    exhausted |= state_clear_exhausted(session->state);
    if (exhausted && status == PETRI_OK) {
        session->last_outcome = ARENA_MEMORY_LIMIT;
        status = session->budget.memory_refused ? PETRI_LIMIT_EXCEEDED : PETRI_OUT_OF_MEMORY;
    }
    if (status == PETRI_OK && scene_clear_stopped(session->scene, &session->last_outcome))
        status = session->last_outcome == ARENA_WORK_LIMIT ? PETRI_LIMIT_EXCEEDED : PETRI_INTERRUPTED;
    session_report_abort(session, status, "the frame");
    if (status == PETRI_OK && frame->missed)
        session_protect(session, NULL, session_lint_state, frame->missed);
    frame->missed = NULL;
    frame->profiled_physics += frame->physics_seconds;
    frame->profiled_frames++;
    if (status != PETRI_OK && session->options.rollback_frames)
        session_rollback(session);
    return status;
}

static void record_frame(PetriSession *session, bool at_given_time, bool complete) {
    const Clock *clock = &session->clock;
    if (session->recorder.after_frame)
        session->recorder.after_frame(session->recorder.user_data,
                                      &(FrameClock){.lockstep = !clock->realtime && !at_given_time,
                                                    .realtime = clock->realtime,
                                                    .slow_frame = clock->wall.slow_frame,
                                                    .is_base = at_given_time,
                                                    .time = clock->time,
                                                    .beat = clock->beat,
                                                    .performance = clock->wall.performance,
                                                    .unix_time = session->vm.globals[ENGINE_CLOCK].as.number},
                                      complete);
}

static void advance_clock(PetriSession *session, const ClockBase *at, const FrameClock *recorded) {
    if (recorded)
        clock_advance_recorded(&session->clock, recorded);
    else if (at)
        clock_advance_to(&session->clock, at->time, at->beat);
    else
        clock_advance(&session->clock);
}

// Computes the next frame at the time and beat in `at`. If `at` is NULL, the clock determines time and beat.
static PetriStatus step_session(PetriSession *session, const ClockBase *at) {
    if (!session || !session->config.program || session->call_depth > 0)
        return PETRI_INVALID;
    if (petri_clear_interrupt(session))
        return PETRI_INTERRUPTED;
    if (session->rollback_pending && !session_rollback(session))
        return PETRI_OUT_OF_MEMORY;
    FrameClock recorded;
    bool replays = false;
    PetriStatus status = session->recorder.before_frame
                             ? session->recorder.before_frame(session->recorder.user_data, &recorded, &replays)
                             : PETRI_OK;
    if (status != PETRI_OK)
        return status;
    session->undo_of_frame = false;
    if (session->options.rollback_frames && !checkpoint_save(&session->undo, session))
        return PETRI_OUT_OF_MEMORY;
    Clock clock = session->clock;
    session_clear_frame(session);
    advance_clock(session, at, replays ? &recorded : NULL);
    session->frame_realtime = session->clock.realtime;
    status = evaluate_frame(session, replays ? &recorded : NULL);
    bool is_kept = status == PETRI_OK || (status == PETRI_LIMIT_EXCEEDED && !session->options.rollback_frames);
    if (status == PETRI_OK) {
        status = update_frame(session);
        is_kept = status == PETRI_OK || !session->options.rollback_frames;
    }
    if (is_kept)
        record_frame(session, at && !replays, status == PETRI_OK);
    if (!is_kept)
        session->clock = clock;
    session->clock.realtime = clock.realtime;
    session->undo_of_frame = is_kept && session->options.rollback_frames;
    return status;
}

PetriStatus petri_step(PetriSession *session) {
    return step_session(session, NULL);
}

PetriStatus petri_step_at(PetriSession *session, double time, double beat) {
    return isfinite(time) && isfinite(beat) ? step_session(session, &(ClockBase){.time = time, .beat = beat})
                                            : PETRI_INVALID;
}

uint64_t petri_work(const PetriSession *session) {
    return session ? session->total_work : 0;
}

int64_t petri_frame_number(const PetriSession *session) {
    return session ? session->clock.number : -1;
}

bool petri_frame(const PetriSession *session, PetriFrame *frame, size_t size) {
    if (!session)
        return false;
    const Clock *clock = &session->clock;
    const SessionFrame *last = &session->frame;
    const PetriFrame data = {.number = clock->number,
                             .time = clock->time,
                             .beat = clock->beat,
                             .fps = clock->rates.fps,
                             .tempo = clock->rates.tempo,
                             .physics_steps = last->physics_steps,
                             .evaluation_seconds = last->evaluation_seconds,
                             .physics_seconds = last->physics_seconds};
    return host_struct_write(frame, size, &data, sizeof data);
}
