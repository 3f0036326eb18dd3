// session.h: internal declarations of the session; petri.h is its public interface.
//
// Each part of a session is modified by only one file: config.c, load.c, clock.c, frame.c, prompt.c, diagnostics.c,
// checkpoint.c; memory.c frees them. Every public function that allocates does so within session_protect. A file calls
// only files of lower levels:
//
//     1   protect, memory, clock, convert, library, drawing_lint, image
//     2   config, checkpoint, diagnostics, image_text
//     3   run, state_lint, text_sink
//     4   recorder, tree_lint; values, functions, systems, drawn_files
//     5   load, frame, host_state, save
//     6   moves, definitions, prompt, session, print
//     7   history, script
//     8   replay
#pragma once

#include "builtin/noise.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "physics/explain.h"
#include "ranks/ranks.h"
#include "session/checkpoint.h"
#include "session/diagnostics.h"
#include "session/draw_access.h"
#include "session/frame.h"
#include "session/prompt.h"
#include "session/recorder.h"
#include "state/digest.h"
#include "vm/vm.h"

// The current configuration. After each change, call session_change_config.
typedef struct Config {
    Unit *program;         // the loaded script, or NULL
    PromptList *prompts;   // never NULL
    const Define *defines; // array that is never modified in place, because configurations share it
    uint32_t define_count;
    ClockRates pragma_rates;
    double resolution; // maximum time step of all systems (petri_set_resolution); 0: each system uses its own
} Config;

// A name that the host sets (petri_set_global). A new value is copied to the arena that does not hold the current
// value. If it cannot be copied, the current value is kept.
typedef struct HostGlobal {
    const Symbol *name;
    Value value;
    Value next;      // the new value, while it is being copied
    Arena arenas[2]; // `value` is in arenas[turn]
    bool turn;
} HostGlobal;

// Names that the host sets, in the order in which they were first set. The parameters of a script are the names that
// existed when it was compiled, in this order.
typedef struct HostGlobals {
    const Symbol *const *names;
    HostGlobal *const *items;
    uint32_t count;
} HostGlobals;

// Functions of the host (petri_add_function), which live as long as the session. Adding a function replaces the array;
// an existing array is never modified.
typedef struct HostFunctions {
    const Builtin *const *rows;
    uint32_t count;
} HostFunctions;

// A force that the host computes in each step.
typedef struct StepForces {
    PetriForceCallback *callback; // NULL: none
    void *user_data;
} StepForces;

struct PetriConfig {
    uint32_t references;
    uint64_t revision;
    Config config;
    ClockRates rates;
};

struct PetriSnapshot {
    PetriConfig *config; // counted reference
    Checkpoint at;
};

struct PetriSession {
    PetriOptions options;
    Arena arena;      // data that lives as long as the session: symbols, definitions
    Arena text_arena; // strings returned to the host; reset by most functions that return a string
    Arena view_arena; // results of queries about systems; reset by the next query (run_request in systems.c)
    Arena key_arena;  // values received from the host, kept only during a call
    SymbolTable symbols;
    State *state;
    Scene *scene;
    FileCache *files;
    FileAccess reach; // access rights of the script that is loaded or being loaded
    NoiseCache *noise;
    Ranks ranks; // must outlive `scene`
    Schema schema;
    void *draw_memory; // data of lib/picture (session_draw_memory); NULL: none yet
    size_t draw_memory_size;
    Vm vm;
    Vm static_vm;                  // folds constant expressions at load time
    atomic_bool interrupt;         // set by petri_interrupt
    atomic_bool *interrupt_source; // `interrupt` of this session; in a check, that of the session that checks
    // Work units that the next outermost protected call starts with. Before the systems are updated, it is the work of
    // the evaluation, because both share one limit. Otherwise it is 0.
    uint64_t spent;
    unsigned old_rules;        // rules of an earlier specification (base/spec.h)
    bool no_simplify;          // PetriTuning.no_simplify
    bool spec_chosen;          // true: by the host, so that a replay does not change them
    uint64_t total_work;       // work units since the session was opened
    Budget budget;             // work and memory of the script
    uint32_t call_depth;       // nesting depth of protected calls
    bool uninterruptible;      // true while an operation must not be interrupted
    ArenaOutcome last_outcome; // reason of the most recent abort of a protected call

    HostGlobals host_globals;
    HostFunctions functions;
    StepForces step_forces;
    PetriVariation variation; // of petri_vary
    Config config;
    PetriConfig *shared_config; // a copy of `config` for petri_config_get; NULL until that is called
    uint64_t config_revision;   // revision of `config`
    uint64_t last_revision;     // highest revision used so far
    uint32_t reported_defines;  // number of definitions already checked for the loaded script
    bool recompiling;           // true while the loaded text is compiled again because definitions changed
    Loader loader;
    Clock clock;
    bool frame_realtime; // value of `realtime` in the last frame, or in the first one; in a replay, as it was recorded
    SessionFrame frame;
    Prompt prompt;
    Diagnostics diagnostics;
    Checkpoint undo;             // taken before the current frame was computed, if PetriOptions.rollback_frames is set
    bool undo_of_frame;          // true if `undo` is the state from which the current frame was computed
    PhysExplanation explanation; // result of petri_explain_force, until the next one or the end of the frame
    Recorder recorder;           // callbacks of an archive; all NULL: none
    bool rollback_pending;       // true if an aborted frame could not be rolled back yet, because memory ran out
};

// Initialises an arena like arena_init. Its memory is charged to the session's budget.
void session_arena(PetriSession *session, Arena *arena, const char *name, size_t limit);

// Runs a protected call as session_protect does, but without rolling back first.
PetriStatus session_attempt(PetriSession *session, Arena *extra, SessionCall *call, void *context);
// Runs a short call whose public function returns no status: an interrupt waits for the next call. Returns false if the
// call failed.
bool session_query(PetriSession *session, SessionCall *call, void *context);
// Restores the state before an aborted frame. If out of memory, sets rollback_pending, so that the next call tries
// again, and returns false.
bool session_rollback(PetriSession *session);

// Returns true if the text is a valid name (spec language.md L2.4).
bool session_is_name(Str text);
// Computes the digest of the state (spec digest.md). Called within a protected call.
void session_digest(PetriSession *session, uint8_t digest[STATE_DIGEST_SIZE]);
// Returns the public form of a value. Valid as long as `v` itself and the data that it points to.
PetriValue session_export_value(const Value *v);
// Converts a public value and stores the result in *value. The items of a mixed value are copied to the arena. Arrays
// of numbers and the bytes of strings still refer to the host's memory. Returns false if the value is not valid.
bool session_import_value(Arena *arena, PetriValue host_value, Value *value);

// Returns the public form of a system, without `steps`. Its columns have the lifetime of phys_columns.
PetriSystem session_system(const PhysSystem *engine, const char *name, uint32_t dimensions);

// Copies the names that the host set, with their values, from `session` to the session `to`.
void session_copy_host_globals(const PetriSession *session, PetriSession *to);
// Frees the values of the names that the host set.
void session_free_host_globals(PetriSession *session);

// Checks whether the definitions fit a script and reports problems, such as unused definitions. Returns false if there
// is an error that must prevent the script from running.
bool session_check_definitions(PetriSession *session, Unit *unit);

// Records that the configuration has changed. If `frame_valid` is true, the results of the last frame stay valid.
void session_change_config(PetriSession *session, bool frame_valid);
// Adds a statement to the prompt without evaluating it. Returns PETRI_INVALID if it is not valid.
PetriStatus session_restore_statement(PetriSession *session, const char *text);
// Replaces the list of prompt statements. Takes over the caller's reference to `list`.
void session_set_prompts(PetriSession *session, PromptList *list);

// Sets the rates of a new script and rewinds to before frame 0.
void session_start(PetriSession *session, const ClockRates *rates);
// Changes rates after a reload. `rates` are those that the pragmas of the new script set. A rate changes only if its
// pragma differs from that of the previous script.
void session_apply_rates(PetriSession *session, const ClockRates *rates);
// Returns the rates that a program's pragmas set; rates without a valid pragma have their defaults. Called within a
// protected call.
ClockRates session_pragma_rates(PetriSession *session, const Program *program);
// Gives the engine's names, such as `time` and `beat`, their values for the current frame in `vm`. Before the first
// frame, only constant names have valid values.
void session_set_globals(const PetriSession *session, Vm *vm);
// Warns about top-level nodes that have no effect, once for each kind. Called within a protected call.
void session_lint_top_nodes(PetriSession *session);
// Reads the windows of the frame, to report nodes and attributes that are ignored in them. Does nothing if earlier
// frames of the script had nodes of the same kinds with the same parents. A limit that this exceeds is reported only
// when the windows are drawn.
void session_lint_windows(PetriSession *session);
// Reports lookups of the first frame that can never find anything (state_lint.c). `log` is the LookupLog of the frame.
// Called within a protected call, after the systems were updated.
PetriStatus session_lint_state(PetriSession *session, void *log);
// Reports shapes and canvases in a window that stay invisible (drawing_lint.c).
void session_lint_drawings(Schema *schema, Arena *arena, const Node *window, const Source *script);
