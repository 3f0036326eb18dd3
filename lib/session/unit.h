// unit.h: source files and what was made of them. Only load.c writes units and the loader.
#ifndef PETRI_SESSION_UNIT_H
#define PETRI_SESSION_UNIT_H

#include "base/diag.h"
#include "petri.h"
#include "program/program.h"

// A source file with what was made of it, in one arena. Modules are kept by path until the file changes.
typedef struct Unit Unit;
typedef struct Parsed Parsed;
struct Unit {
    Unit *next;
    Unit *same_hash; // the next module of a chain
    Arena arena;     // to be used through unit_arena
    Arena scratch;   // while it is compiled: syntax tree, expressions
    Str path;        // canonical; NUL-terminated
    Str folder;      // canonical, of a script; what it may read and write lies there
    Str version;     // changes when the file does: modification time, size, inode
    const Source *source;
    const Ast *ast;         // of what is compiled again and again: what was typed at the prompt, `trees`
    uint64_t work;          // that parsing it took
    Parsed *parsed;         // of `trees`: files that are included
    Unit *parse_cache;      // a reference to what was parsed before of the same text and what it includes, or NULL
    bool empty;             // there is no statement in it
    const Program *program; // NULL: could not be loaded
    Str error;              // … for this reason
    uint32_t references;    // freed with the last
    Str *included;          // canonical paths that an %include has taken; NUL-terminated
    uint32_t included_count;
    DiagSink parse_sink; // of the parse that is under way
    DiagSink sink;       // of the compilation
    bool retired;        // not finished, or replaced; freed when no frame can refer to it any more
};

// An included file with its syntax tree.
struct Parsed {
    Parsed *next;
    const Source *source;
    const Ast *ast;
    uint64_t work;
    Str version; // of the file, as a unit has it
};

enum { MODULE_CHAINS = 1024 };
typedef struct Loader {
    Unit *modules;                // list
    Unit *by_path[MODULE_CHAINS]; // the same, by hash of their paths
    uint64_t generation;          // counts the units that frames came to depend on (session_use_unit)
    Unit *pending;                // the script or text being loaded, for when its memory runs out
    Unit *compiling;              // whose compiler calls back
    bool lint;                    // petri_check is at work
    uint64_t static_work;         // work of evaluating ahead in this load
} Loader;

// The names that a program is given values for.
typedef struct Names {
    const Symbol *const *items;
    uint32_t count;
} Names;

// The unit's arena, whose escape is from now on that of the protected call at work.
Arena *unit_arena(const PetriSession *session, Unit *unit);
// Loads a unit within a protected call: reads, parses and compiles. It is returned even if that failed (program is
// NULL). A file that must be `regular` is no pipe, which may keep one waiting.
Unit *unit_load_file(PetriSession *session, const char *file, bool module, bool regular);
Unit *unit_load_text(PetriSession *session, Str name, Str text);
// The same text once more, because definitions have changed. It is parsed once: the first time that this is called.
Unit *unit_reload(PetriSession *session, Unit *unit);
// A unit of a text that is parsed but not compiled; `ast` is NULL if it does not parse.
Unit *unit_parse(PetriSession *session, Str name, Str text);
// Compiles a tree of the unit as a program with the given parameters.
const Program *unit_compile(PetriSession *session, Unit *unit, const Ast *ast, bool module, Names params);
// Gives a reference back; NULL is fine.
void unit_free(Unit *unit);
// To be told of each unit that frames come to depend on: what lies in it may lie where that of a freed one did.
Unit *session_use_unit(PetriSession *session, Unit *unit);
// For the machine: the module at a path. Within a protected call.
const Program *session_module(void *host, Str path, Str *reason);
// Forgets what was read, for the next script may not read it.
void session_clear_files(PetriSession *session);
// Frees modules that were replaced.
void session_free_retired(PetriSession *session);

#endif
