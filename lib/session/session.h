// session.h: what the session's files share; the public face is petri.h.
#ifndef PETRI_SESSION_SESSION_H
#define PETRI_SESSION_SESSION_H

#include "petri.h"

#include "builtin/files.h"
#include "builtin/noise.h"
#include "draw/automatic.h"
#include "canvas/read.h"
#include "scene/scene.h"
#include "vm/vm.h"

// A source file with what was made of it, in one arena. Modules are kept by path until the file changes.
typedef struct Unit Unit;
struct Unit {
    Unit *next;
    Arena arena;
    Arena scratch; // while it is compiled: syntax tree, expressions
    Str path;    // canonical
    Str version; // changes when the file does: modification time, size, inode
    const Source *source;
    const Ast *ast;         // of what was typed at the prompt, which is compiled again and again
    bool empty;             // there is no statement in it
    const Program *program; // NULL: could not be loaded
    Str why;                // … for this reason
    uint32_t references;    // freed with the last
    Str *included;          // canonical paths that an %include has taken
    uint32_t included_count;
    DiagSink sink; // of the parse or compilation that is under way
    bool retired;  // replaced; freed when no frame can refer to it any more
};

enum { MOST_AUTO_SYSTEMS = 64 }; // in one automatic picture

// A statement typed at the prompt that is kept. Its parameters are the exports of the script and of the statements
// before it.
typedef struct Prompt {
    Unit *unit; // a reference
    const Ast *ast;
    const Program *program;
    bool adds; // its value is nodes for the tree
} Prompt;

// From where on the clock runs at its present rates: zeros at first.
typedef struct ClockBase {
    int64_t frame;
    double time;
    double beat;
} ClockBase;

// The clock of real time. What it counts is the script's `time`: 0 in frame 0, and the time that the host has held the
// session does not count.
typedef struct WallClock {
    bool running;       // false: the next frame is the first, or the first after a restored state
    double origin;      // what the machine's monotonic clock showed at time 0
    double due;         // the time of the next frame
    double performance; // the script's `performance`, which lockstep has as well
    bool slow_frame;    // … and `slow_frame`
} WallClock;

typedef struct ClockRates {
    double fps;
    double tempo;
    double quantum;
} ClockRates;

struct PetriConfig {
    uint32_t references;
    uint64_t number;
    Unit *program;
    Prompt *prompts;
    uint32_t prompt_count;
    const Define *defines;
    uint32_t define_count;
    ClockRates said;
    ClockRates rates;
    double resolution;
};

struct PetriSnapshot {
    PetriConfig *config; // a reference
    PetriFrame frame;
    ClockBase base;
    double delta;
    unsigned char *bytes; // state and systems (snapshot.c)
    size_t size;
    size_t capacity;
};

struct PetriSession {
    PetriOptions options;
    Arena arena; // session lifetime: symbols, definitions
    SymbolTable symbols;
    State *state;
    Scene *scene;
    CanvasSchema canvas;
    AutoFrame auto_frames[MOST_AUTO_SYSTEMS]; // what the automatic picture showed last
    FileCache *files;
    NoiseCache *noise;
    const Define *defines; // replaced as a whole: configurations share it
    uint32_t define_count;
    uint32_t told_defines; // of these it was told what the script does with them
    bool again;            // the same text is being compiled once more, for other definitions
    Unit *program;         // the loaded script, or NULL
    ClockRates said;       // by its pragmas
    ClockBase base;
    double resolution; // 0: as systems say
    Prompt *prompts;
    uint32_t prompt_count;
    PetriConfig *config;    // of the present number, once somebody has asked for it
    uint64_t config_number; // of the present configuration
    uint64_t last_number;   // given so far
    Unit *modules;          // list
    uint64_t generation;    // counts the units that frames came to depend on (session_put)
    Unit *fresh;            // the script that was begun to be loaded last, for when its memory runs out
    Unit *loading;          // whose compiler calls back
    bool lint;              // petri_check is at work
    bool unseen;            // no frame of the loaded script has been made
    Vm vm;
    Vm static_vm; // evaluates ahead while a program is compiled

    // Diagnostics already given: hashes of their texts.
    uint64_t *told;
    uint32_t told_count;
    uint32_t told_capacity;
    Index told_index;
    uint64_t counts[3]; // by level

    // The present frame; values live in frame_arena until the next step.
    Arena frame_arena;
    Arena
        scene_arena;  // what the systems need in a frame: outside the script's budget, so that no update stops half-way
    Arena text_arena; // formatting, reset by each use
    Value tree;
    DiagSink log;    // texts of debug(), each once
    DiagSink errors; // texts of run-time faults, each once
    PetriFrame frame;
    double quantum;
    double delta;
    WallClock wall;
    bool in_frame;
    double profiled_physics; // seconds, since the script was loaded
    uint64_t profiled_frames;
    // What the names of the top level stand for: exports of the script, then of each prompt statement. Values live in
    // frame_arena; there are `value_count` of them, fewer if the frame was not evaluated (to the end).
    const Symbol **names;
    uint32_t name_count;
    uint32_t name_capacity;
    Value *values;
    uint32_t value_count;
    uint32_t value_capacity;
    bool evaluated;     // tree and values are those of the present frame and configuration
    Arena prompt_arena; // of one expression
    bool tell_again;    // what a person types twice is told twice
    atomic_bool interrupt;
    PetriSnapshot undo; // the state before the frame that is being made
};

// Gives a diagnostic to the host unless it was given before.
void session_tell(PetriSession *session, const Diag *diag);
// A diagnostic without a place.
void session_tell_text(PetriSession *session, DiagLevel level, const char *code, Str text);
// Hands over what a sink has collected.
void session_tell_all(PetriSession *session, const DiagSink *sink);

// Defines a name; the text is that of its value.
PetriStatus session_define(PetriSession *session, Str name, Str value);
// Tells of definitions that a script does not take; false if one cannot be, and the script must not run.
bool session_check_definitions(PetriSession *session, Unit *unit);

// Loads a unit: reads, parses and compiles. The unit is returned even if that failed (program is NULL).
Unit *unit_load_file(PetriSession *session, const char *file, bool module);
// `path` and `version` are those of the file that the text was read from; the name and nothing if there is none.
Unit *unit_load_text(PetriSession *session, Str name, Str path, Str text, Str version);
// Gives a reference back; NULL is fine.
void unit_free(Unit *unit);
// To be told of each unit that frames come to depend on: what lies in it may lie where that of a freed one did.
Unit *session_put(PetriSession *session, Unit *unit);
// A unit of a text that is parsed but not compiled; `ast` is NULL if it does not parse.
Unit *unit_parse(PetriSession *session, Str name, Str text);
// Compiles a tree of the unit as a program with the given parameters.
const Program *unit_compile(PetriSession *session, Unit *unit, const Ast *ast, bool module, uint32_t param_count);
// For the machine: the module at a path.
const Program *session_module(void *host, Str path, Str *why);
// Frees modules that were replaced.
void session_free_retired(PetriSession *session);

// Takes tempo, quantum and fps from a program's pragmas and goes to before frame 0.
void session_start(PetriSession *session, const Program *program);
// The values of the engine's names in the present frame; before the first, those that never change.
void session_set_globals(const PetriSession *session, Vm *vm);
// Goes to just after a frame.
void session_resume(PetriSession *session, int64_t frame);
// In real time, when the session has gone to another frame: time goes on from that frame's.
void session_rewind_wall_clock(PetriSession *session);
// Takes tempo, quantum and fps from the pragmas, where they differ from those of the script before.
void session_take_rates(PetriSession *session, const Program *program);
// Changes the rates from the present frame on.
void session_set_rates(PetriSession *session, const ClockRates *rates);
// Drops what was computed in the last frame: tree, log, values of names.
void session_clear_frame(PetriSession *session);
// Evaluates script and prompt statements; false if that was given up. Within escapes.
bool session_evaluate(PetriSession *session);
// Warns of nodes at the top of the frame that are nearly spelled like those that drive or show something. Within
// escapes.
void session_look_at_top(PetriSession *session);
// Tells that the configuration has changed; `frame_stays` says that what the last frame computed is still right.
void session_change_config(PetriSession *session, bool frame_stays);
// The present configuration, borrowed; NULL if memory is used up.
PetriConfig *session_config(PetriSession *session);

// Copies state and systems into a snapshot's memory, which is used again; false if memory is used up.
bool session_take(PetriSession *session, PetriSnapshot *snapshot);
// … and back; false, with nothing changed, if memory is used up.
bool session_put_back(PetriSession *session, const PetriSnapshot *snapshot);

// Compiles all prompt statements anew, with the names of the present script.
void session_compile_prompts(PetriSession *session);
// Makes the names of what has been evaluated and is in sight: the script's and those of the statements.
void session_collect_names(PetriSession *session);
void session_free_prompts(PetriSession *session);

#endif
