// session.h: what the session's files share; the public face is petri.h.
#ifndef PETRI_SESSION_SESSION_H
#define PETRI_SESSION_SESSION_H

#include "petri.h"

#include "builtin/files.h"
#include "builtin/noise.h"
#include "canvas/automatic.h"
#include "canvas/read.h"
#include "scene/scene.h"
#include "vm/vm.h"

// A source file with what was made of it, in one arena. Modules are kept by path until the file changes.
typedef struct Unit Unit;
struct Unit {
    Unit *next;
    Arena arena;
    Str path;    // canonical
    Str version; // changes when the file does: modification time, size, inode
    const Source *source;
    const Ast *ast;
    const Program *program; // NULL: could not be loaded
    Str why;                // … for this reason
    Str *included;          // canonical paths that an %include has taken
    uint32_t included_count;
    DiagSink sink; // of the parse or compilation that is under way
    bool retired;  // replaced; freed when no frame can refer to it any more
};

enum { MOST_AUTO_SYSTEMS = 64 }; // in one automatic picture

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
    Define *defines;
    uint32_t define_count;
    uint32_t define_capacity;
    Unit *program;       // the loaded script, or NULL
    Unit *modules;       // list
    uint64_t generation; // counts the programs and modules that were dropped
    Unit *fresh;         // the script that was begun to be loaded last, for when its memory runs out
    Unit *loading;       // whose compiler calls back
    bool lint;           // petri_check is at work
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
    double start;       // of realtime: the session's time of frame 0
    double due;         // of realtime: when the next frame is due
    double held;        // of realtime: seconds by which the session's clock is behind the monotonic one
    double performance; // of realtime
    bool slow_frame;
    bool in_frame;
};

// Gives a diagnostic to the host unless it was given before.
void session_tell(PetriSession *session, const Diag *diag);
// A diagnostic without a place.
void session_tell_text(PetriSession *session, DiagLevel level, const char *code, Str text);
// Hands over what a sink has collected.
void session_tell_all(PetriSession *session, const DiagSink *sink);

// Loads a unit: reads, parses and compiles. The unit is returned even if that failed (program is NULL).
Unit *unit_load_file(PetriSession *session, const char *file, bool module);
Unit *unit_load_text(PetriSession *session, Str name, Str text);
void unit_free(Unit *unit);
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

#endif
