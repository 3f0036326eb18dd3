// petri.h: the C interface of libpetri, an engine for Flitter scripts with particle systems.
//
// A session holds one loaded script and its data: the state dictionary (values that persist from frame to frame), the
// particle systems that the script describes with `!physics` nodes, and a clock. Load a script, then step it. Each step
// computes one frame. It evaluates the script, which produces a tree of nodes, and then advances the particle systems.
// The systems store positions and velocities in the state dictionary.
//
// Further headers: petri-draw.h draws frames. petri-live.h is for hosts that run live, with a clock and input.
// petri-inspect.h prints, compares and explains frames. petri-edit.h is for editors and prompts. petri-ranks.h divides
// the work between processes.
//
// Rules for all functions, unless a comment says otherwise:
// - Only one thread at a time may use a session or an object obtained from it: a value, node, configuration or
//   snapshot. Different sessions are independent. Functions that take no handle may be called by any thread at any
//   time.
// - A struct argument is accessed only during the call. Later versions may add fields to the end of structs, except
//   PetriString, PetriItem, PetriValue and PetriColumn. A struct that the host passes to the library, or that a
//   callback receives, therefore starts with its size: set `size` to the size of the struct. A function that fills a
//   struct takes its size as an argument: pass `sizeof`. Fields that an older library does not know become 0. A call
//   that sets such a field fails.
// - Text is UTF-8. The length PETRI_NUL_TERMINATED means that the text ends at a NUL byte. Indices and item numbers
//   start at 0.
// - Functions that can fail return a PetriStatus. They may all return PETRI_OUT_OF_MEMORY, or PETRI_INVALID for invalid
//   arguments. Functions that load, step, print or evaluate may also return PETRI_LIMIT_EXCEEDED or PETRI_INTERRUPTED.
// - A call that fails changes nothing. If a script cannot be loaded, the current script stays loaded. An aborted frame
//   leaves the state unchanged (petri_step lists the exceptions).
// - Errors and warnings about scripts are reported through PetriOptions.on_diagnostic, once per position and load. The
//   library never prints or exits, and never changes the locale, signal handlers or working directory of the process.
// - Later versions may add values to enums. Ignore, or treat as unknown, a value that you do not know.
// - petri_set_global passes a value to a script: call it before petri_load, and again before any frame.
//   petri_define and petri_set_parameter pass text that a user has typed, and check it against the parameters.
// - From version 0.4 on, no public name is removed or changes its meaning. A name that is replaced stays as an alias
//   until version 2.0, and its comment says so. libpetri-draw and libpetri-archive keep these rules, too, but only work
//   with the libpetri of the same version, which the loader checks.
// - If a required pointer is NULL, a function does nothing and returns PETRI_INVALID, false, NULL or 0.
// - After fork, the child process may close the sessions of its parent, but must not use them for anything else.
#ifndef PETRI_H
#define PETRI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Version of this header. petri_version_number returns the version of the library, which may be newer.
#define PETRI_VERSION_MAJOR 0
#define PETRI_VERSION_MINOR 4
#define PETRI_VERSION_PATCH 0
#define PETRI_VERSION_NUMBER (PETRI_VERSION_MAJOR * 10000 + PETRI_VERSION_MINOR * 100 + PETRI_VERSION_PATCH)

#ifdef __GNUC__ // exported by a shared library; all other symbols are hidden
#define PETRI_API __attribute__((visibility("default")))
#else
#define PETRI_API
#endif

// Passed as the length of a string that ends at a NUL byte.
#define PETRI_NUL_TERMINATED SIZE_MAX

// A session. Created by petri_open, freed by petri_close.
typedef struct PetriSession PetriSession;

typedef enum PetriStatus {
    PETRI_OK,
    PETRI_INVALID,        // invalid argument, script or file; for scripts and files, diagnostics give the reason
    PETRI_LIMIT_EXCEEDED, // the work or memory limit of the script was exceeded; the call was aborted
    PETRI_OUT_OF_MEMORY,
    PETRI_UNSUPPORTED, // this build lacks a required library; a diagnostic names it
    PETRI_INTERRUPTED, // petri_interrupt was called; the call was aborted
} PetriStatus;

// Returns a short description of a status for messages, or "unknown status". Lives as long as the library.
PETRI_API const char *petri_status_text(PetriStatus status);

// Memory functions of the whole process, for hosts with their own allocator or memory accounting. To limit one script,
// use PetriOptions.memory_limit.
//
// The functions may be called by several threads at once. They must return normally (no longjmp, no exception) and must
// not call the library. They must stay valid until all sessions, pictures and painters are closed. The C library,
// Cairo, Pango, libpng, libjpeg and OpenGL do not use them for their internal allocations.
typedef struct PetriAllocator {
    size_t size; // sizeof(PetriAllocator)
    // Returns a block of `bytes` bytes (at least 1), aligned to 16, or NULL on failure. The library function that
    // needed the block then returns PETRI_OUT_OF_MEMORY.
    void *(*allocate)(void *user_data, size_t bytes);
    // Resizes a block, which may move, and keeps its contents. Returns NULL on failure, with the block unchanged.
    void *(*resize)(void *user_data, void *block, size_t bytes);
    void (*release)(void *user_data, void *block); // frees `block`, which is never NULL
    void *user_data;                               // passed to the functions
} PetriAllocator;

// Sets the memory functions of the process. Copies the struct. NULL restores the default, the functions of the C
// library. Call it before any other function, while no other thread uses the library. Returns PETRI_INVALID if a
// function is missing, if `size` is wrong, or while the library holds memory. It holds memory from the first petri_open
// or petri_painter_open until all sessions, pictures and painters are closed.
PETRI_API PetriStatus petri_set_allocator(const PetriAllocator *allocator);

// Severity of a diagnostic.
typedef enum PetriLevel { PETRI_ERROR, PETRI_WARNING, PETRI_NOTE } PetriLevel;

// An error, warning or note about a script. In a callback, the strings are valid only during the call.
typedef struct PetriDiagnostic {
    size_t size; // number of bytes of the struct that are filled
    PetriLevel level;
    const char *file; // NULL if the diagnostic has no position
    uint32_t line;    // from 1; 0 if the diagnostic has no position
    uint32_t column;  // in characters, from 1
    const char *text;
    const char *code; // short name of the kind, such as "unbound-name"; may be NULL
    // `FILE:LINE:COLUMN: level: text [code]`, then source line, carets and hint. Parts that do not exist are left out.
    // Ends in a newline.
    const char *rendered;
    const char *hint;    // advice for the user, such as "did you mean 'cos'?"; "": none
    uint32_t end_line;   // line of the first character after the marked range
    uint32_t end_column; // column of that character
} PetriDiagnostic;

// When physics uses neighbour lists instead of testing all pairs of particles. Does not affect results.
typedef enum PetriNeighbours {
    PETRI_NEIGHBOURS_AUTO, // when they are faster
    PETRI_NEIGHBOURS_NEVER,
    PETRI_NEIGHBOURS_ALWAYS,
} PetriNeighbours;

// Communication between processes that run one script together; see petri-ranks.h.
typedef struct PetriRanks PetriRanks;

// How frames are computed, for tests and measurements. Nothing in it affects results, and a later version may ignore a
// field. Set the other fields to 0 for the default.
typedef struct PetriTuning {
    size_t size;                // sizeof(PetriTuning)
    bool no_simplify;           // do not fold constant expressions at load time
    bool no_batches;            // execute each iteration of a loop on its own instead of many together
    PetriNeighbours neighbours; // default PETRI_NEIGHBOURS_AUTO
    // The most advanced vector instructions that physics may use: "scalar", "avx2" or "avx512". NULL or any other
    // string: the best available. The environment variable PETRI_CPU, read when the library is loaded, limits all
    // sessions in the same way.
    const char *cpu;
} PetriTuning;

// Options of a session. Start with petri_default_options.
typedef struct PetriOptions {
    size_t size; // sizeof(PetriOptions)
    double fps;  // frames per second, unless the script has `%pragma fps`. Default 60
    // Follow the wall clock: petri_step waits until the frame is due, and the script's `time` is the time since frame
    // 0. Default false (lockstep): petri_step does not wait, and `time` is the frame number divided by fps.
    bool realtime;
    double run_time; // value of `run_time` in scripts, in seconds; NaN (the default): unlimited
    bool colour;     // colour PetriDiagnostic.rendered with ANSI escapes. Default false
    bool profile;    // measure the time of each source line, for petri_profile. Default false
    // Bytes of C stack that evaluation may use. Deeper recursion is reported as an error in the script. The default of
    // 4 MiB suits a thread with a stack of 8 MiB.
    size_t stack_limit;
    // Limits of each call, such as petri_step. A frame, load or picture that exceeds a limit is aborted with a
    // diagnostic that gives the position in the script. Work is counted, not timed, so a script is aborted at the same
    // point on every machine. A loop iteration, a call, a node or a group of sixteen numbers costs one unit, about 10
    // ns.
    size_t memory_limit; // bytes held for the script; petri itself uses up to about 64 MiB more. Default 2 GiB
    uint64_t work_limit; // units per call; default 2^30, about 10 s
    int threads;         // number of worker threads; 0 (the default): one per processor. Does not affect results
    // Keep a copy of the state while a frame is computed, so that an aborted frame can be rolled back completely. If
    // false (the default), an aborted frame can be partly done: each system has either completed the frame or not
    // started it. This is enough for a host that then exits.
    bool rollback_frames;
    // Folders that the script may use: NULL-terminated arrays of names, or NULL for none. A script may read files in
    // and below its own folder, the current directory and `read_folders`. It may write files (`!record`) in and below
    // its own folder and `write_folders`. "/" allows everything. petri_open copies the names.
    const char *const *read_folders;
    const char *const *write_folders;
    bool no_files;    // the script may not read, write or import any file. Default false
    bool keep_forces; // provide PetriSystem.force and petri_explain_force. Default false
    // Called for each diagnostic by the thread that uses the session. NULL (the default): not reported.
    void (*on_diagnostic)(void *user_data, const PetriDiagnostic *diagnostic);
    void *user_data; // passed to on_diagnostic, should_interrupt and on_file_read
    // Other processes that run the script together with this one (petri-ranks.h); NULL (the default): none. petri_open
    // copies the struct. All ranks need the same options, including `tuning`. If one rank is interrupted, all ranks
    // must be interrupted, and none may continue its session. Not supported by petri.c, libpetri in one file.
    const PetriRanks *ranks;
    // Provides the contents of all files: loaded scripts, modules, included files, images, and files that scripts read
    // with `read` and `csv`. NULL (the default): files are read from disk. Returns the bytes and sets *length, or
    // returns NULL if there is no such file. If this function is set, scripts may read every file that it provides, and
    // no others.
    //
    // `name` is the name passed to petri_load. For a file named by a script, it is the script's folder followed by that
    // name, with `.` and `..` resolved. A name that ends in a slash requests a folder (`./`: the current directory):
    // return the names of its files, one per line. If you return NULL, `glob` finds nothing.
    //
    // The bytes must not change until the session is closed, because the same address and length are assumed to mean
    // the same contents. The function may be called in any frame, and by threads that draw pictures. It must not call
    // the session.
    const char *(*read_file)(void *read_user_data, const char *name, size_t *length);
    void *read_user_data; // passed to read_file and read_unsaved
    // Called when a script imports or includes a file that is on disk. Returns contents to use instead, such as the
    // unsaved text of an editor, or NULL to use the file on disk. `name` is the canonical path of the file. The other
    // rules are those of read_file. NULL (the default): always use the file on disk.
    const char *(*read_unsaved)(void *read_user_data, const char *name, size_t *length);
    // Polled about every 10 µs during a call, by the same thread; return true to interrupt the call. For hosts whose
    // other threads cannot call petri_interrupt. Must not call the session. NULL (the default): never polled.
    bool (*should_interrupt)(void *user_data);
    // Called after the session has read a script, a module, an included file or a file that a script reads with `read`
    // or `csv`. `bytes` is NULL if there is no such file. Also called for each folder that `glob` lists: its name ends
    // in a slash, and `bytes` contains the names in it, one per line. `name` is relative to the script's folder, unless
    // it is outside. A session reads a file again only if the file has changed. The arguments are valid only during the
    // call. Must not call the session. NULL (the default): never called.
    void (*on_file_read)(void *user_data, const char *name, const char *bytes, size_t length);
    // Do not read a module again after it was imported, until petri_load or petri_reload reads the script. If false
    // (the default), a module whose file has changed is read again in the next frame.
    bool keep_modules;
    // Version of the specification by whose rules frames are computed, such as "0.3", or "0.3 barriers": only this rule
    // is that of 0.3 (lib/spec/README.md has the names). NULL (the default): the present version, and for the replay of
    // an archive, that of the archive.
    const char *spec;
    const PetriTuning *tuning; // NULL: the default. petri_open copies the struct
} PetriOptions;

// Writes the default options to the first `size` bytes of `options`. Use petri_default_options instead.
PETRI_API void petri_options_init(PetriOptions *options, size_t size);

// Returns the default options.
static inline PetriOptions petri_default_options(void) {
    PetriOptions options;
    petri_options_init(&options, sizeof options);
    return options;
}

// Returns why petri_open cannot use the options, such as "fps is not positive and finite", or NULL if it can. Lives as
// long as the library.
PETRI_API const char *petri_options_problem(const PetriOptions *options);

// Creates a session without a script. Free it with petri_close. Returns NULL if the options have a problem, else if out
// of memory.
PETRI_API PetriSession *petri_open(const PetriOptions *options);

// Frees a session and sets the handle to NULL. NULL handles are ignored. Free its configurations and snapshots first.
PETRI_API void petri_close(PetriSession **session);

// Defines a name for the scripts that are loaded from now on, like the option `-D` of the command. `definition` is
// "name=value", where the value is one or more elements separated by `;`: numbers, time codes, `:symbols` or strings.
// Returns PETRI_INVALID if `definition` has no equals sign, or if the name is not valid. Loading a script warns about
// definitions that the script does not use.
PETRI_API PetriStatus petri_define(PetriSession *session, const char *definition);

// Loads a script from a file. The next frame is frame 0. The state dictionary is kept; petri_reset clears it. `file`
// appears in messages, and relative file names in the script start from its folder. Returns PETRI_INVALID if the file
// cannot be read or is not a valid script, or if called within a callback.
PETRI_API PetriStatus petri_load(PetriSession *session, const char *file);

// Like petri_load, but loads the script from memory. `name` appears in messages, and relative file names start from its
// folder. For a stream, use a name such as `<stdin>`. Returns PETRI_INVALID if the text is not a valid script. Copies
// the text.
PETRI_API PetriStatus petri_load_text(PetriSession *session, const char *name, const char *text, size_t length);

// Loads a changed script while frame numbers, time and beat continue. Pipes cannot be reloaded. Tempo and fps change
// only if their pragma changed. If `file` is NULL, compiles the loaded text again with the current definitions, and
// does not repeat diagnostics that were already reported. Returns PETRI_INVALID for the same reasons as petri_load, and
// if `file` is NULL but no script is loaded.
PETRI_API PetriStatus petri_reload(PetriSession *session, const char *file);

// Computes the next frame, starting with frame 0: evaluates the script, then advances its particle systems. In real
// time, waits until the frame is due. Returns PETRI_INVALID if no script is loaded, or if called within a callback.
//
// An aborted frame leaves the session as it was before the call. If PetriOptions.rollback_frames is false, there are
// two exceptions. If the evaluation exceeds a limit, frame number and time advance, but the systems do not. If the
// frame is aborted while systems are advanced, frame number and time advance, and each system has either completed or
// not started the frame.
PETRI_API PetriStatus petri_step(PetriSession *session);

// A parameter of the loaded script, declared at its top level by `let NAME=NAME or DEFAULT -- RANGE DESCRIPTION`. Its
// value is the one set with petri_define or petri_set_parameter, else the default. `or` would replace a value that is
// false, such as 0, so such a value is an error. `let NAME=NAME if NAME != null else DEFAULT` accepts all values.
// `let X=NAME or NUMBERS` declares the parameter NAME if the script uses NAME only there.
// RANGE is optional: `1..500`, `0..1|0.05` with a step, or `0..` with one end. The range is a recommendation: a value
// outside it causes a warning.
typedef struct PetriParameter {
    const char *name;
    const char *default_value; // source text of the default
    const char *value;         // current value in printed form; default_value if the value varies from frame to frame
    const char *comment;       // comment after the declaration, without the range; "": none
    double number;             // current value; NaN if it is not known to be a single number
    double default_number;     // default; NaN if it is not known to be a single number
    double min;                // lower end of the range; -INFINITY: none
    double max;                // upper end of the range; INFINITY: none
    double step;               // step of the range; 0: none
    bool defined;              // true if the current value comes from a definition
    bool settable;             // false: the parameter of an imported module, which cannot be set
    const char *file;          // position of the declaration
    uint32_t line;             // from 1
    uint32_t column;           // in characters, from 1
    bool accepts_false;        // false: a value that is false, such as 0, is an error unless the default is false too
} PetriParameter;

// Gets a parameter of the script by number: first the parameters of the script and its included files, then those of
// modules imported at its top level. Returns false past the last, or if out of memory. The strings are valid until the
// next call that uses the session.
PETRI_API bool petri_parameter(PetriSession *session, size_t number, PetriParameter *parameter, size_t size);

// Sets a parameter of the script to a value written as in petri_define, or resets it to its default if `value` is NULL.
// The change takes effect in the next frame. State, frame numbers, time and beat continue. Returns PETRI_INVALID if the
// script has no such parameter, if the default is a number and the value is not, if the value is false and the
// parameter does not accept that, or if an included file can no longer be read.
PETRI_API PetriStatus petri_set_parameter(PetriSession *session, const char *name, const char *value);

// The frame that was computed last.
typedef struct PetriFrame {
    int64_t number; // -1: no frame yet
    double time;    // seconds since frame 0; frame number / fps after petri_restore, even in real time
    double beat;
    double fps;
    double tempo;              // beats per minute
    uint64_t physics_steps;    // simulation steps of all systems in this frame
    double evaluation_seconds; // time spent on evaluating the script
    double physics_seconds;    // time spent on the particle systems
} PetriFrame;

// Gets the data of the last frame.
PETRI_API bool petri_frame(const PetriSession *session, PetriFrame *frame, size_t size);

// Returns the number of the last frame; -1: no frame yet.
PETRI_API int64_t petri_frame_number(const PetriSession *session);

// Interrupts the session's current call, or its next call if none is in progress. A step, load, check, picture, print
// or evaluation then returns PETRI_INTERRUPTED within a few milliseconds. May be called by any thread and by signal
// handlers, unlike all other functions of a session.
PETRI_API void petri_interrupt(PetriSession *session);

// Returns true if an interrupt is pending, and clears it.
PETRI_API bool petri_clear_interrupt(PetriSession *session);

// Clears the state dictionary. The next frame is frame 0 of the loaded script. Diagnostics that were already reported
// are reported again, so that each run says when its motion becomes meaningless.
PETRI_API void petri_reset(PetriSession *session);

// Writes a state file: the state dictionary, the frame number and the data that the systems need to resume. User input
// is not saved. Replaces the file atomically and flushes it to disk. Returns PETRI_INVALID, with a diagnostic, if it
// cannot be written.
PETRI_API PetriStatus petri_save(PetriSession *session, const char *file);

// Restores a state written by petri_save. Call it after petri_load. The next frame is the one after the saved frame,
// bit-identical to the frame that the saving session would have computed. If the file does not exist, returns PETRI_OK
// and changes nothing. Returns PETRI_INVALID, with a diagnostic, if the file cannot be read or is truncated or corrupt.
PETRI_API PetriStatus petri_restore(PetriSession *session, const char *file);

// A value of the language: a vector of numbers, strings, nodes or functions. null is the vector of length 0. Symbols
// are numbers (petri_symbol).
//
// A value refers to memory of the session, and each function documents how long its result is valid. A host may build
// values from its own memory; functions that take a value copy the data that they keep.
typedef enum PetriType { PETRI_NUMBER, PETRI_STRING, PETRI_NODE, PETRI_FUNCTION } PetriType;
typedef struct PetriNode PetriNode;
typedef struct PetriString {
    const char *bytes; // UTF-8; may contain NUL bytes; not NUL-terminated
    size_t length;     // in bytes
} PetriString;
typedef struct PetriItem {
    PetriType type;
    union {
        double number;
        const PetriString *string;
        const PetriNode *node;
        const void *function;
    } as;
} PetriItem;
typedef struct PetriValue {
    uint32_t length;        // number of elements; 0: null
    const double *numbers;  // elements, if all are numbers, else NULL
    const PetriItem *items; // elements, if some are not numbers, else NULL
} PetriValue;

// Returns the printed form of a value, which scripts can read back if it contains only numbers and strings. Returns
// NULL if out of memory or if the value is invalid. Valid until the next petri_format_value, step, load or printing
// call.
PETRI_API const char *petri_format_value(PetriSession *session, PetriValue value);

// Returns the number that represents the symbol `:name`, which is the same in all sessions. Returns NaN if the name is
// not valid, or if out of memory.
PETRI_API double petri_symbol(PetriSession *session, const char *name);

// Returns the name of the symbol that a number represents, or NULL if it represents none. Valid as long as the session.
PETRI_API const char *petri_symbol_name(const PetriSession *session, double number);

// Returns the value of a key in the state dictionary, which scripts read with `$`. Returns null if there is no such
// key, if the key is invalid, or if out of memory. Valid until the state may change: until the next step, load,
// petri_state_set, petri_reset, petri_rewind or petri_restore.
PETRI_API PetriValue petri_state_get(PetriSession *session, PetriValue key);

// Stores a value in the state dictionary, or removes the key if the value is null. Scripts can read it in the next
// frame. Keys and values consist of numbers and strings. Returns PETRI_INVALID if an element has another type, if a
// number in the value is not finite, if the key contains NaN, or if called within a callback.
PETRI_API PetriStatus petri_state_set(PetriSession *session, PetriValue key, PetriValue value);

// Iterates over the state dictionary. Keys are ordered element by element: numbers, including symbols, come before
// strings; -0 comes before 0; strings are compared by their bytes; a prefix comes first. Set *cursor to 0 before the
// first call. Returns false after the last entry, or if out of memory. Keys and values are valid as long as the results
// of petri_state_get.
PETRI_API bool petri_state_next(PetriSession *session, uint32_t *cursor, PetriValue *key, PetriValue *value);

// Sets the value of a global name, which scripts read like any other name. The first call with a name adds the name for
// scripts that are loaded afterwards. Later calls change its value for the next frame without a reload, even to null.
// The name is not visible in modules and cannot be removed. Returns PETRI_INVALID if the name is not valid or belongs
// to the engine (such as `time`), if the value contains nodes or functions, or if called within a callback.
PETRI_API PetriStatus petri_set_global(PetriSession *session, const char *name, PetriValue value);

// Returns the tree of the last frame: its top-level nodes, and possibly other elements. Returns null if there is no
// frame, or if out of memory. The tree and everything in it are valid until the next step, load, petri_prompt,
// petri_rewind, petri_restore or petri_reset.
PETRI_API PetriValue petri_tree(const PetriSession *session);

// Returns the kind of a node: the word after its `!`. Valid as long as the node.
PETRI_API const char *petri_tree_kind(const PetriNode *node);

// Returns a tag of a node by number, or NULL past the last. Valid as long as the node.
PETRI_API const char *petri_tree_tag(const PetriNode *node, uint32_t number);

// Returns the name of an attribute by number and stores its value, or returns NULL past the last. Valid as long as the
// node.
PETRI_API const char *petri_tree_attribute(const PetriNode *node, uint32_t number, PetriValue *value);

// Returns the name of the file with the code that made a node, and stores its line and column there, both from 1.
// Returns NULL if the place is not known. Valid as long as the node.
PETRI_API const char *petri_tree_place(const PetriNode *node, uint32_t *line, uint32_t *column);

// Returns a child of a node by number, or NULL past the last. Valid as long as the node.
PETRI_API const PetriNode *petri_tree_child(const PetriNode *node, uint32_t number);

// Returns the value of the attribute with this name, or null. Valid as long as the node.
PETRI_API PetriValue petri_tree_get(const PetriNode *node, const char *name);

// A call of a host function, valid until the function returns.
typedef struct PetriCall PetriCall;

// A function of the host that scripts call like a built-in function. `arguments` holds one value per parameter, null if
// the call omits the argument. If the parameters end with `...`, further values may follow. The arguments are valid
// during the call. The result is copied, unless its numbers come from petri_call_alloc_numbers; an invalid result
// becomes null. The function may only call petri_symbol_name and the functions that take a PetriCall. It must return
// normally: no longjmp, no exception.
typedef PetriValue PetriFunctionCall(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count);

// Description of a host function.
typedef struct PetriFunction {
    size_t size; // sizeof(PetriFunction)
    const char *name;
    // Parameters, such as "x, y=0, ...". Those with a default may be omitted in calls. At most eight before `...`.
    const char *parameters;
    const char *help;        // one line; may be NULL
    bool pure;               // equal arguments always give the same result; calls may be folded at load time
    PetriFunctionCall *call; // the function
    void *user_data;         // passed to `call`
} PetriFunction;

// Adds a host function for the scripts and modules that are loaded from now on. It cannot be removed. Copies the struct
// and its strings. Returns PETRI_INVALID if the name is not valid or already in use by the engine, a built-in or
// another host function, if the parameters are not valid, or if called within a callback.
PETRI_API PetriStatus petri_add_function(PetriSession *session, const PetriFunction *function);

// Allocates memory for the numbers of a host function's result, which then needs no copy. Returns NULL if out of
// memory. Valid until the function returns. Freed by the session.
PETRI_API double *petri_call_alloc_numbers(PetriCall *call, uint32_t count);

// Reports an error in the arguments of a host function. The diagnostic is `NAME: text`, at the position of the call,
// and is reported only once. The result of the call is then null. Copies the text, truncated to 199 bytes.
PETRI_API void petri_call_error(PetriCall *call, const char *text);

// A property of all particles of a system. The numbers of particle i start at `data[i * stride]`.
typedef struct PetriColumn {
    const double *data; // NULL: not available
    size_t stride;      // in doubles; 0: all particles have the same value
} PetriColumn;

// A particle system of the last frame. Anchors are included. The columns point into the session's memory, and are valid
// until the next step, load, petri_rewind, petri_restore or petri_reset.
typedef struct PetriSystem {
    const char *name;    // state prefix in printed form, such as ":cells"; valid as long as the columns
    uint32_t dimensions; // number of elements of each position, velocity and force
    uint32_t particle_count;
    uint32_t force_count; // number of force appliers and barriers
    uint64_t steps;       // simulation steps in the frame
    PetriColumn position; // may contain numbers that are not finite
    PetriColumn velocity;
    // Sum of all forces on each particle in the last step of the frame; 0 for anchors. `data` is NULL if no step was
    // taken, or without PetriOptions.keep_forces.
    PetriColumn force;
    PetriColumn radius;
    PetriColumn mass;
    PetriColumn charge;
    const bool *anchor; // true for anchors; the entry of particle i is `anchor[i * anchor_stride]`
    size_t anchor_stride;
} PetriSystem;

// Returns the number of particle systems in the current frame.
PETRI_API size_t petri_system_count(PetriSession *session);

// Gets a particle system by number, in the order of the script. Returns false past the last (petri_system_count), or if
// out of memory.
PETRI_API bool petri_system(PetriSession *session, size_t number, PetriSystem *system, size_t size);

// A force of the host, called once at the start of each physics step of each system, before any particle moves.
// `system` describes the particles as in petri_system, but with the positions and velocities at the start of the step;
// `force` and `anchor` are not available, and `steps` is 0. `clock` is the simulation clock of the system and `delta`
// the length of the step, both in seconds. `force` has `dimensions` numbers for each particle, all 0: the function
// adds forces there, which act on the particles like their attribute `force`, and are ignored for anchors. A force that
// is not finite causes a warning, and the particle keeps its velocity in this step. All arguments are valid only during
// the call. Returns false to interrupt the frame. Must not call the session and must return normally: no longjmp, no
// exception.
//
// Results stay deterministic if the forces depend only on the arguments. Threads do not affect the arguments. Frames
// that are computed again (petri_rewind) and explanations of forces call the function again. The step accounts for the
// force to first order, like for all forces.
typedef bool PetriForceCallback(void *user_data, const PetriSystem *system, double clock, double delta, double *force);

// Sets the force of the host from the next frame on; NULL: none. Potential energies do not include it. Archives cannot
// record it. Returns PETRI_INVALID if called within a callback, or if the session has several ranks.
PETRI_API PetriStatus petri_set_force_callback(PetriSession *session, PetriForceCallback *callback, void *user_data);

// Sets whether the memory of columns stays readable, with unspecified contents, after the columns become invalid. Use
// it in hosts that cannot control when columns are last read, such as garbage-collected languages. The memory counts
// towards the memory limit. It is freed by a call with `keep` false, or by petri_close.
PETRI_API void petri_keep_columns(PetriSession *session, bool keep);

// Returns the id of a particle by its number in the system, or null if there is no such particle. Valid until the next
// call that gets data about a system, such as petri_system, and at most as long as the columns.
PETRI_API PetriValue petri_particle_id(PetriSession *session, size_t system, uint32_t particle);

// Returns the ids of all particles, if each id is a single number or symbol. Otherwise, or if out of memory, `data` is
// NULL. The column is built on the first request and again after the particles change. Its memory counts towards the
// memory limit. Valid as long as the other columns.
PETRI_API PetriColumn petri_particle_ids(PetriSession *session, size_t system);

// Finds the number of the particle with the given id. Returns false if there is none, or if out of memory.
PETRI_API bool petri_find_particle(PetriSession *session, size_t system, PetriValue id, uint32_t *particle);

// Returns true if the last frame has something to draw: a window with a canvas, or a particle system. Use petri-draw.h
// to draw it.
PETRI_API bool petri_has_picture(PetriSession *session);

// Receives a chunk of the output, which need not end at a line break. Returns false to stop.
typedef bool PetriWriteCallback(void *user_data, const char *text, size_t length);

// Returns the number of diagnostics of a level that were reported since the session was opened.
PETRI_API uint64_t petri_diagnostic_count(const PetriSession *session, PetriLevel level);

// Gets one of the last 100 diagnostics by number, oldest first, for hosts without on_diagnostic. Returns false past the
// last. The strings are valid until the next diagnostic, petri_clear_diagnostics or petri_close.
PETRI_API bool petri_diagnostic(const PetriSession *session, size_t number, PetriDiagnostic *diagnostic, size_t size);

// Removes the stored diagnostics, so that petri_diagnostic returns only diagnostics of later calls.
PETRI_API void petri_clear_diagnostics(PetriSession *session);

// Returns the version of the library, such as "0.4.0". Lives as long as the library.
PETRI_API const char *petri_version(void);

// Returns the version of the library as a number, like PETRI_VERSION_NUMBER.
PETRI_API int petri_version_number(void);

// Returns the version of the specification by which a session computes its frames, such as "0.4"; NULL: the present
// version. Valid until the library is unloaded.
PETRI_API const char *petri_spec(const PetriSession *session);

#ifdef __cplusplus
}
#endif

#endif
