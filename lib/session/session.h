// session.h: what the session's files share; the public face is petri.h.
//
// Each part of a session has a file of its own that writes it: config.c, load.c, clock.c, frame.c, prompt.c,
// diagnostics.c, checkpoint.c. Every public function that allocates does so within session_protect.
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

// The present configuration. Whoever changes it calls session_change_config.
typedef struct Config {
    Unit *program;         // the loaded script, or NULL
    PromptList *prompts;   // never NULL
    const Define *defines; // replaced as a whole: configurations share it
    uint32_t define_count;
    ClockRates pragma_rates;
    double resolution; // 0: as systems say
} Config;

// A name that the host gives values to. One that cannot be copied leaves the one before.
typedef struct HostGlobal {
    const Symbol *name;
    Value value;
    Value next;      // while it is copied
    Arena arenas[2]; // `value` is in arenas[turn]
    bool turn;
} HostGlobal;

// In the order in which they were given first, which is that of the parameters of scripts loaded since then.
typedef struct HostGlobals {
    const Symbol *const *names;
    HostGlobal *const *items;
    uint32_t count;
} HostGlobals;

// The host's own built-ins, which live as long as the session. The array is replaced, never changed.
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
    PetriConfig *config; // a reference
    Checkpoint at;
};

struct PetriSession {
    PetriOptions options;
    Arena arena;      // session lifetime: symbols, definitions
    Arena text_arena; // texts given to the host, reset by most uses
    Arena view_arena; // … about systems: until the next petri_particle_id, petri_system_force
    Arena key_arena;  // … that is looked up or stored, which may be one that was given: during the call
    SymbolTable symbols;
    State *state;
    Scene *scene;
    FileCache *files;
    FileAccess reach; // of the loaded script, or the one that is being loaded
    NoiseCache *noise;
    Schema schema;
    void *draw_memory; // what the room that draws keeps (draw_access.h)
    size_t draw_memory_size;
    Vm vm;
    Vm static_vm; // evaluates ahead while a program is compiled
    atomic_bool interrupt;
    uint64_t spent;            // of the work that the next protected call may do
    Budget meter;              // of all that is done and held for the script
    uint32_t call_depth;       // protected ones under way, one within the other
    bool uninterruptible;      // what is being done must not be interrupted
    ArenaOutcome last_outcome; // how the last one ended that was given up

    HostGlobals host_globals;
    HostFunctions functions;
    Config config;
    PetriConfig *shared_config; // the same, once somebody has asked for it
    uint64_t config_revision;   // of the present configuration
    uint64_t last_revision;     // given so far
    uint32_t reported_defines;  // of these it was told what the script does with them
    bool recompiling;           // the same text is being compiled once more, for other definitions
    Loader loader;
    Clock clock;
    SessionFrame frame;
    Prompt prompt;
    Diagnostics diagnostics;
    Checkpoint undo;       // before the frame that is being made, or was made last
    bool undo_of_frame;    // `undo` is what the present frame was made from
    bool rollback_pending; // that frame was given up, but there was no memory yet for going back
};

// An arena that is charged to the session.
void session_arena(PetriSession *session, Arena *arena, const char *name, size_t budget);

// Goes back to before a frame that was given up, if that has not been possible so far; false if it still is not.
bool session_rollback(PetriSession *session);

// Is a text a name of the language (L2.4)?
bool session_is_name(Str text);
// A value as a host sees it: valid as long as what `v` points to and `v` itself.
PetriValue session_export_value(const Value *v);
// A host's value, with elements in the arena and the texts and numbers of the host; false if it is none.
bool session_import_value(Arena *arena, PetriValue host_value, Value *value);

// Gives another session the names that this one has, and frees them.
void session_copy_host_globals(const PetriSession *session, PetriSession *to);
void session_free_host_globals(PetriSession *session);

// Defines a name; the text is that of its value. Within a protected call.
PetriStatus session_define(PetriSession *session, Str name, Str value);
// Tells of definitions that a script does not take; false if one cannot be, and the script must not run.
bool session_check_definitions(PetriSession *session, Unit *unit);

// Says that the configuration has changed; `frame_stays`: what the last frame computed is still right.
void session_change_config(PetriSession *session, bool frame_valid);
// Puts a list, whose reference is given, in the place of the present one.
void session_set_prompts(PetriSession *session, PromptList *list);

// Takes rates from a program's pragmas and goes to before frame 0.
void session_start(PetriSession *session, const ClockRates *rates);
// Takes rates from the pragmas, where they differ from those of the script before.
void session_apply_rates(PetriSession *session, const ClockRates *rates);
// What a program's pragmas say. Within a protected call.
ClockRates session_pragma_rates(PetriSession *session, const Program *program);
// The values of the engine's names in the present frame; before the first, those that never change.
void session_set_globals(const PetriSession *session, Vm *vm);
// Warns of nodes at the top of the frame that are nearly spelled like those that drive or show something. Within a
// protected call.
void session_lint_top_nodes(PetriSession *session);

#endif
