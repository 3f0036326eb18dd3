// unit.h: source files and their compiled programs. Only load.c and memory.c modify units and the loader.
#pragma once

#include "base/diag.h"
#include "petri.h"
#include "program/program.h"

// A source file with its compiled program, in one arena. Modules are cached by path until their file changes. When a
// script is compiled again because definitions changed, it gets a parse cache. This is another unit, which holds only
// the syntax trees of the script and its included files.
typedef struct Unit Unit;
typedef struct Parsed Parsed;
struct Unit {
    Unit *next;
    Unit *same_hash; // next module in the same chain of Loader.by_path
    Arena arena;     // memory of the program; call unit_arena to get it
    Arena scratch;   // temporary data of the compiler: syntax tree, expressions
    Str path;        // canonical path of the file, NUL-terminated; without a file: name for messages
    Str folder;      // canonical folder of a script, in which it may read and write files; empty for modules
    Str version;     // identifies the contents: modification time, size, inode; empty: not from a file
    const Source *source;
    const Ast *ast;         // syntax tree of prompt input or a parse cache, kept to be compiled again; else NULL
    uint64_t work;          // in a parse cache: work units that parsing the script took
    Parsed *parsed;         // in a parse cache: list of the included files
    Unit *parse_cache;      // counted reference to the script's parse cache, or NULL
    bool empty;             // true if the file contains no statements
    const Program *program; // compiled program; NULL: the unit could not be loaded
    Str error;              // why the unit could not be loaded
    uint32_t references;    // reference count
    Str *included;          // canonical paths of included files; NUL-terminated
    uint32_t included_count;
    DiagSink parse_sink; // diagnostics of the current parse
    DiagSink sink;       // diagnostics of the compilation
    Unit *last_good;     // counted reference to the module's last version with a program, if this one has none; or NULL
    uint64_t load;       // value of Loader.loads when the module was read
    bool retired;        // true if incomplete or replaced; the unit is freed as soon as no frame can refer to it
};

// An included file with its syntax tree.
struct Parsed {
    Parsed *next;
    const Source *source;
    const Ast *ast;
    uint64_t work;
    Str version; // version of the file, as in Unit
};

enum { MODULE_CHAINS = 1024 };
typedef struct Loader {
    Unit *modules;                // list of imported modules
    Unit *by_path[MODULE_CHAINS]; // hash table that maps paths to modules
    uint64_t generation;          // number of units that frames have used so far (session_use_unit)
    uint64_t loads;               // number of times that the script was loaded or reloaded from its file
    Unit *pending;                // unit being loaded, which is freed if the load is aborted
    Unit *compiling;              // unit that is being compiled; NULL: none
    bool lint;                    // true: report likely mistakes, for petri_check
    uint64_t static_work;         // work units that constant folding has used in this load
} Loader;

// Names of values that a program receives as parameters.
typedef struct Names {
    const Symbol *const *items;
    uint32_t count;
} Names;

// Returns a new unit. Called within a protected call.
Unit *unit_new(PetriSession *session);
// Returns the unit's arena, ready for use in the current protected call: a failed allocation aborts that call.
Arena *unit_arena(const PetriSession *session, Unit *unit);
// Reads, parses and compiles a file. Returns a unit even on failure; its `program` is then NULL. If `regular` is true,
// rejects pipes, because reading them could block. Called within a protected call.
Unit *unit_load_file(PetriSession *session, const char *file, bool module, bool regular);
// Like unit_load_file, for a script in memory.
Unit *unit_load_text(PetriSession *session, Str name, Str text);
// Compiles the text of a unit again with the current definitions. Returns the new unit. Only the first reload of a text
// parses it; later reloads use the parse cache, unless `read_again` is set: then included files are read again.
Unit *unit_reload(PetriSession *session, Unit *unit, bool read_again);
// Returns a unit with parsed but uncompiled text of the prompt. Its `ast` is NULL if the text has syntax errors.
Unit *unit_parse(PetriSession *session, Str text);
// Compiles a syntax tree of the unit into a program with the given parameters.
const Program *unit_compile(PetriSession *session, Unit *unit, const Ast *ast, bool module, Names params);
// Releases a reference. Frees the unit when no reference is left. NULL is ignored.
void unit_free(Unit *unit);
// Must be called before frames use a unit for the first time. Increments Loader.generation, because data of the unit
// may have the same addresses as data of a freed unit. Caches that compare addresses also compare the generation.
// Returns the unit.
Unit *session_use_unit(PetriSession *session, Unit *unit);
// Returns the module at a path for the virtual machine. If its file has changed and cannot be compiled, returns the
// last good version. On failure, sets *reason and returns NULL. Called within a protected call.
const Program *session_module(void *host, Str path, Str *reason);
// Clears all cached files and modules, because the next script may not be allowed to read them.
void session_clear_files(PetriSession *session);
// Adds a unit to Loader.by_path.
void session_add_module(PetriSession *session, Unit *unit);
// Returns the cached module with a canonical path, or NULL.
Unit *session_find_module(PetriSession *session, Str path);
