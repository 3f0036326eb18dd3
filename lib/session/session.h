// session.h: what the session's files share; the public face is petri.h.
//
// Each part of a session has a file of its own that writes it: config.c, load.c, clock.c, frame.c, prompt.c,
// diagnostics.c, checkpoint.c. Every public function that allocates does so within session_protect.
#ifndef PETRI_SESSION_SESSION_H
#define PETRI_SESSION_SESSION_H

#include "petri.h"

#include "builtin/files.h"
#include "builtin/noise.h"
#include "scene/scene.h"
#include "session/checkpoint.h"
#include "session/clock.h"
#include "session/diagnostics.h"
#include "session/frame.h"
#include "session/prompt.h"
#include "session/shown.h"
#include "session/unit.h"
#include "session/writing.h"
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
typedef struct GivenName {
    const Symbol *name;
    Value value;
    Value next;      // while it is copied
    Arena arenas[2]; // `value` is in arenas[turn]
    bool turn;
} GivenName;

// In the order in which they were given first, which is that of the parameters of scripts loaded since then.
typedef struct GivenNames {
    const Symbol *const *names;
    GivenName *const *items;
    uint32_t count;
} GivenNames;

// The host's own built-ins, which live as long as the session. The array is replaced, never changed.
typedef struct HostFunctions {
    const Builtin *const *rows;
    uint32_t count;
} HostFunctions;

struct PetriConfig {
    uint32_t references;
    uint64_t number;
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
    Arena view_arena; // … about systems: until the next petri_id, petri_force
    Arena key_arena;  // … that is looked up or stored, which may be one that was given: during the call
    SymbolTable symbols;
    State *state;
    Scene *scene;
    FileCache *files;
    Reach reach; // of the loaded script, or the one that is being loaded
    NoiseCache *noise;
    Schema schema;
    void *drawing; // what the room that draws keeps (shown.h)
    size_t drawing_size;
    Vm vm;
    Vm static_vm; // evaluates ahead while a program is compiled
    atomic_bool interrupt;
    uint64_t spent; // of the work that the next protected call may do
    Meter meter;    // of all that is done and held for the script
    uint32_t calls; // protected ones under way, one within the other
    bool steadfast; // what is being done must not be interrupted
    ArenaEnd end;   // how the last one ended that was given up

    GivenNames given;
    HostFunctions functions;
    Config config;
    PetriConfig *shared;    // the same, once somebody has asked for it
    uint64_t config_number; // of the present configuration
    uint64_t last_number;   // given so far
    uint32_t told_defines;  // of these it was told what the script does with them
    bool again;             // the same text is being compiled once more, for other definitions
    Loader loader;
    Clock clock;
    SessionFrame frame;
    Prompt prompt;
    Diagnostics diagnostics;
    Checkpoint undo; // before the frame that is being made
    bool torn;       // that frame was given up, but there was no memory yet for going back
};

// An arena that is charged to the session.
void session_arena(PetriSession *session, Arena *arena, const char *name, size_t budget);

// Goes back to before a frame that was given up, if that has not been possible so far; false if it still is not.
bool session_heal(PetriSession *session);

// Is a text a name of the language (L2.4)?
bool session_is_name(Str text);
// A value as a host sees it: valid as long as what `v` points to and `v` itself.
PetriValue session_show(const Value *v);
// A host's value, with elements in the arena and the texts and numbers of the host; false if it is none.
bool session_take(Arena *arena, PetriValue given, Value *taken);

// Gives another session the names that this one has, and frees them.
void session_copy_given(const PetriSession *session, PetriSession *to);
void session_free_given(PetriSession *session);

// Defines a name; the text is that of its value. Within a protected call.
PetriStatus session_define(PetriSession *session, Str name, Str value);
// Tells of definitions that a script does not take; false if one cannot be, and the script must not run.
bool session_check_definitions(PetriSession *session, Unit *unit);

// Says that the configuration has changed; `frame_stays`: what the last frame computed is still right.
void session_change_config(PetriSession *session, bool frame_stays);
// Puts a list, whose reference is given, in the place of the present one.
void session_set_prompts(PetriSession *session, PromptList *list);

// Takes rates from a program's pragmas and goes to before frame 0.
void session_start(PetriSession *session, const ClockRates *rates);
// Takes rates from the pragmas, where they differ from those of the script before.
void session_take_rates(PetriSession *session, const ClockRates *rates);
// What a program's pragmas say. Within a protected call.
ClockRates session_pragma_rates(PetriSession *session, const Program *program);
// The values of the engine's names in the present frame; before the first, those that never change.
void session_set_globals(const PetriSession *session, Vm *vm);
// Warns of nodes at the top of the frame that are nearly spelled like those that drive or show something. Within a
// protected call.
void session_look_at_top(PetriSession *session);

#endif
