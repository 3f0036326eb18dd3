// session.h: internal declarations of the session; petri.h is its public interface.
//
// Each part of a session is modified by only one file: config.c, load.c, clock.c, frame.c, prompt.c, diagnostics.c,
// checkpoint.c. Every public function that allocates does so within session_protect.
#ifndef PETRI_SESSION_SESSION_H
#define PETRI_SESSION_SESSION_H

#include "builtin/files.h"
#include "builtin/noise.h"
#include "petri.h"
#include "scene/scene.h"
#include "session/checkpoint.h"
#include "session/clock.h"
#include "session/diagnostics.h"
#include "session/draw_access.h"
#include "session/frame.h"
#include "session/prompt.h"
#include "session/text_sink.h"
#include "session/unit.h"
#include "vm/vm.h"

// The current configuration. Every change is followed by a call of session_change_config.
typedef struct Config {
    Unit *program;         // the loaded script, or NULL
    PromptList *prompts;   // never NULL
    const Define *defines; // immutable, because configurations share it
    uint32_t define_count;
    ClockRates pragma_rates;
    double resolution; // seconds; 0: each system's own
} Config;

// A name that the host sets (petri_set_global). If a new value cannot be copied, the old value is kept.
typedef struct HostGlobal {
    const Symbol *name;
    Value value;
    Value next;      // new value while it is copied
    Arena arenas[2]; // `value` is in arenas[turn]
    bool turn;
} HostGlobal;

// Names that the host sets, in the order in which they were first set. A script loaded since then receives their values
// as parameters in this order.
typedef struct HostGlobals {
    const Symbol *const *names;
    HostGlobal *const *items;
    uint32_t count;
} HostGlobals;

// Functions of the host (petri_add_function), which live as long as the session. The array is replaced, never modified.
typedef struct HostFunctions {
    const Builtin *const *rows;
    uint32_t count;
} HostFunctions;

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
    Arena arena;      // session lifetime: symbols, definitions
    Arena text_arena; // strings returned to the host; reset by most functions that return a string
    Arena view_arena; // data about systems, until the next petri_particle_id or petri_system_force
    Arena key_arena;  // values received from the host, during the call
    SymbolTable symbols;
    State *state;
    Scene *scene;
    FileCache *files;
    FileAccess reach; // access rights of the script that is loaded or being loaded
    NoiseCache *noise;
    Schema schema;
    void *draw_memory; // data of lib/draw (session_draw_memory); NULL: none yet
    size_t draw_memory_size;
    Vm vm;
    Vm static_vm; // folds constant expressions at load time
    atomic_bool interrupt;
    uint64_t spent;            // work units already charged to the next protected call
    Budget budget;             // work and memory of the script
    uint32_t call_depth;       // nesting depth of protected calls
    bool uninterruptible;      // the current operation must not be interrupted
    ArenaOutcome last_outcome; // why the last protected call was aborted

    HostGlobals host_globals;
    HostFunctions functions;
    Config config;
    PetriConfig *shared_config; // `config` for petri_config_get, or NULL until it is called
    uint64_t config_revision;   // revision of `config`
    uint64_t last_revision;     // highest revision used so far
    uint32_t reported_defines;  // number of definitions that were checked and reported for the loaded script
    bool recompiling;           // the loaded text is being compiled again for changed definitions
    Loader loader;
    Clock clock;
    SessionFrame frame;
    Prompt prompt;
    Diagnostics diagnostics;
    Checkpoint undo;       // state before the frame that is being computed, or was computed last
    bool undo_of_frame;    // `undo` is the state from which the current frame was computed
    bool rollback_pending; // an aborted frame could not be rolled back yet, for lack of memory
};

// Initialises an arena that is charged to the session.
void session_arena(PetriSession *session, Arena *arena, const char *name, size_t limit);

// Rolls back an aborted frame. Returns false if out of memory; rollback_pending is then set, to try again later.
bool session_rollback(PetriSession *session);

// Returns true if the text is a valid name (spec language.md L2.4).
bool session_is_name(Str text);
// Returns the public form of a value. Valid as long as `v` itself and the data that it points to.
PetriValue session_export_value(const Value *v);
// Converts a public value. The items of a mixed value are copied to the arena. Arrays of numbers and the bytes of
// strings still refer to the host's memory. Returns false if the value is not valid.
bool session_import_value(Arena *arena, PetriValue host_value, Value *value);

// Copies the names that the host set to another session.
void session_copy_host_globals(const PetriSession *session, PetriSession *to);
// Frees the values of the names that the host set.
void session_free_host_globals(PetriSession *session);

// Defines a name; `value` is text as in petri_define. Called within a protected call.
PetriStatus session_define(PetriSession *session, Str name, Str value);
// Checks the definitions for a script and reports problems, such as unused definitions. Returns false if there is an
// error. The script must then not run.
bool session_check_definitions(PetriSession *session, Unit *unit);

// Records that the configuration has changed. `frame_valid`: the results of the last frame are still valid.
void session_change_config(PetriSession *session, bool frame_valid);
// Replaces the list of prompt statements. Takes over the caller's reference.
void session_set_prompts(PetriSession *session, PromptList *list);

// Sets the rates of a new script and rewinds to before frame 0.
void session_start(PetriSession *session, const ClockRates *rates);
// Sets the rates whose pragmas differ from those of the previous script.
void session_apply_rates(PetriSession *session, const ClockRates *rates);
// Returns the rates of a program's pragmas, or the defaults. Called within a protected call.
ClockRates session_pragma_rates(PetriSession *session, const Program *program);
// Sets the names of the engine, such as `time` and `beat`, for the current frame. Before the first frame, only constant
// names have valid values.
void session_set_globals(const PetriSession *session, Vm *vm);
// Warns about top-level nodes of the frame that have no effect, but whose kind is spelled similarly to a kind that has
// one. Called within a protected call.
void session_lint_top_nodes(PetriSession *session);

#endif
