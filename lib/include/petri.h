// petri.h: the public interface of libpetri, an engine for Flitter scripts with `!physics` particle systems.
//
// A PetriSession owns everything: the loaded script, the state dictionary, the particle systems. Load a script, then
// step it; each step evaluates the script for one frame and lets its systems write the state dictionary.
//
// Rules that hold everywhere:
// - A session is used by one thread at a time, and so is what comes from it: values, nodes, configurations, snapshots.
//   Different sessions are independent. Functions that take no handle may be called by any thread at any time.
// - A parameter struct need only live until the call returns. Text is UTF-8; a length of PETRI_NUL_TERMINATED means
// NUL-terminated.
// - A function that can fail returns a PetriStatus; any of them may be PETRI_OUT_OF_MEMORY, for NULL arguments
// PETRI_INVALID,
//   and those that load, step, print or evaluate may be PETRI_LIMIT_EXCEEDED or PETRI_INTERRUPTED as well. Nothing is
//   half done: a script that cannot be loaded leaves the one that is running, and a frame that hits a limit or is
//   interrupted leaves the state as it was.
// - What is wrong with a script is told through the diagnostic callback, each thing once per place and load. Nothing in
//   the library prints, exits or changes the process's locale, signals or working directory.
// - Where NULL is not said to mean something, it is answered with PETRI_INVALID, false, NULL or 0, and nothing is done.
// - After fork, the child may close the sessions that it has from its parent, and do nothing else with them.
#ifndef PETRI_H
#define PETRI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

// Of this header; petri_version_number tells that of the library, which may be a later one.
#define PETRI_VERSION_MAJOR 0
#define PETRI_VERSION_MINOR 2
#define PETRI_VERSION_PATCH 0
#define PETRI_VERSION_NUMBER (PETRI_VERSION_MAJOR * 10000 + PETRI_VERSION_MINOR * 100 + PETRI_VERSION_PATCH)

#ifdef __GNUC__ // what a shared library shows; all else stays within it
#define PETRI_API __attribute__((visibility("default")))
#else
#define PETRI_API
#endif

#define PETRI_NUL_TERMINATED SIZE_MAX

typedef struct PetriSession PetriSession;

typedef enum PetriStatus {
    PETRI_OK,
    PETRI_INVALID,        // the script cannot be loaded, a definition cannot be read; diagnostics tell why
    PETRI_LIMIT_EXCEEDED, // a limit was reached: the frame was given up and changed nothing
    PETRI_OUT_OF_MEMORY,  // memory is used up: nothing has changed (but see petri_step)
    PETRI_UNSUPPORTED,    // this build lacks the library that it takes; a diagnostic tells which
    PETRI_INTERRUPTED,    // petri_interrupt was called: what was under way is given up and has changed nothing
} PetriStatus;

// A status in words, for messages; "unknown status" for other numbers. Lives as long as the library.
PETRI_API const char *petri_status_text(PetriStatus status);

// Memory functions for the whole process, for hosts with their own heap or accounting. To limit one script, use
// PetriOptions.memory_limit.
// Any thread may call the functions, several at once. They must return normally (no longjmp, no exception) and must not
// call the library. They are needed until the last session, picture and painter is closed. Memory that the C library,
// Cairo, Pango, libpng, libjpeg and OpenGL allocate internally does not come from here.
typedef struct PetriAllocator {
    size_t size; // sizeof(PetriAllocator)
    // Returns `bytes` (1 or more) aligned to 16, or NULL; the call in progress then returns PETRI_OUT_OF_MEMORY.
    void *(*allocate)(void *user_data, size_t bytes);
    // Resizes a block, which may move, and keeps its contents. Returns NULL on failure, with the block unchanged.
    void *(*resize)(void *user_data, void *block, size_t bytes);
    void (*release)(void *user_data, void *block); // frees a block; never NULL
    void *user_data;                               // passed to the functions
} PetriAllocator;
// To be called before anything else; the struct is copied. NULL: the C library, as it is from the start. PETRI_INVALID,
// and nothing is changed, if a function is missing, if `size` is another, or while the library holds memory: from the
// first petri_open or petri_painter_open until all sessions, pictures and painters are closed again. No other thread
// may use the library meanwhile.
PETRI_API PetriStatus petri_set_allocator(const PetriAllocator *allocator);

typedef enum PetriLevel { PETRI_ERROR, PETRI_WARNING, PETRI_NOTE } PetriLevel;

// One diagnostic. A callback must copy the texts that it keeps.
typedef struct PetriDiagnostic {
    PetriLevel level;
    const char *file; // NULL without a place
    uint32_t line;    // from 1
    uint32_t column;  // in characters, from 1
    const char *text;
    const char *code;     // short name of the kind, such as "unbound-name"; may be NULL
    const char *rendered; // `FILE:LINE:COLUMN: level: text [code]`, source line and carets; ends in a newline
    const char *hint;     // a second sentence that helps, such as "did you mean 'cos'?"; "" for none
    uint32_t end_line;    // of the first character behind what is meant
    uint32_t end_column;
} PetriDiagnostic;

// When the particle engine keeps lists of neighbours instead of looking at all pairs. Results never depend on it.
typedef enum PetriNeighbours { PETRI_NEIGHBOURS_AUTO, PETRI_NEIGHBOURS_NEVER, PETRI_NEIGHBOURS_ALWAYS } PetriNeighbours;

// Processes that run the same script together, each with a session of its own that is given the same calls: they come
// to the same bits as one would alone, and share the work of large systems. Numbers go between them by these functions,
// in order: `runs` runs of `length` doubles, `stride` doubles from one to the next.
typedef struct PetriRanks {
    int rank; // of this process, from 0
    int rank_count;
    uint64_t min_pairs; // pairs of particles that are worth sharing; 0 (the default): as many as are found to be
    void *user_data;
    // Takes the numbers along and returns without waiting for the other.
    void (*send)(void *user_data, int to, const double *numbers, size_t count, size_t length, size_t stride);
    void (*receive)(void *user_data, int from, double *numbers, size_t count, size_t length, size_t stride);
    // The numbers of one rank become those of all.
    void (*broadcast)(void *user_data, int from, double *numbers, size_t count, size_t length, size_t stride);
    // Those of each rank r, which are at starts[r] up to starts[r + 1], become those of all.
    void (*allgatherv)(void *user_data, double *numbers, const size_t *starts);
    // Each number becomes the largest that a rank has. None is NaN.
    void (*allreduce_max)(void *user_data, double *numbers, size_t count);
    // Memory for so many doubles that all ranks see, such as that of one machine, until the next call, which all make
    // together; all get NULL if there is none, and may have no such function. What was written before one of the
    // functions above that all take part in is seen after it.
    double *(*alloc_shared)(void *user_data, size_t count);
    // After petri_interrupt, on all ranks, they need not wait for each other any more: numbers that do not come are 0.
} PetriRanks;

typedef struct PetriOptions {
    size_t size; // of the struct that the host was compiled with: petri_default_options sets it
    double fps;  // target frame rate; a script's `%pragma fps` wins. Default 60
    // Follow the wall clock: petri_step waits until the frame is due, and `time` is what has passed since frame 0.
    // Default false: lockstep, where `time` is frame/fps.
    bool realtime;
    double run_time; // the script's `run_time` in seconds; NaN (the default): unlimited
    bool simplify;   // evaluate static parts once, when loading; results never depend on it. Default true
    bool colour;     // colour `rendered` with ANSI escapes
    bool profile;    // measure the time of each source line, for petri_profile. Default false, which costs nothing
    // The C stack that evaluation may use; deeper recursion is a diagnostic. Default 4 MiB: a thread of 8 MiB is
    // enough.
    size_t stack_limit;
    // What a script may use; a frame, a load, a picture that needs more is given up with a diagnostic that tells what
    // in the script asked for it. Memory is all that the session holds for the script; what is petri's own (some 64 MiB
    // at the most) comes on top. Work is counted in units of some ten nanoseconds, by what is to be done and not by
    // time, so that the same frame is given up everywhere: a round of a loop, a call, a node, sixteen numbers added.
    size_t memory_limit;        // default 2 GiB
    uint64_t work_limit;        // of one call, such as petri_step. Default 2^30, some ten seconds
    int threads;                // worker threads, 0: as many as processors. Results never depend on it
    PetriNeighbours neighbours; // default: where they pay
    // Keep a copy of the state while a frame is made, so that a frame whose systems are being updated can be given up,
    // by petri_interrupt or because work or memory is used up, as if it had never been begun. Default false: then each
    // system has made that frame or stays as it was, which is for hosts that end there.
    bool rollback_frames;
    // The files that a script may use: it reads below its own folder, the current one and `read_folders`, it writes
    // (`!record`) below its own and `write_folders`. Lists of names that end in NULL, or NULL; "/" allows all.
    const char *const *read_folders;
    const char *const *write_folders;
    bool no_files;    // … it uses none at all, and imports none
    bool keep_forces; // for PetriSystem.force
    void (*on_diagnostic)(void *user_data, const PetriDiagnostic *diagnostic); // NULL: silent
    void *user_data;
    // Vector instructions that physics may use: "scalar", "avx2" or "avx512", or what there is below that. NULL (the
    // default) and other words: the best that there are; for the whole process the environment variable PETRI_CPU, read
    // once when the library is loaded, is the upper limit. Results never depend on it.
    const char *cpu;
    // NULL (the default): this process alone. All ranks must have the same options, `cpu` included; if one is
    // interrupted, all must be, and none may go on.
    const PetriRanks *ranks;
    // Where the files come from that are loaded and that scripts use: modules, includes, images, `read` and `csv`. NULL
    // (the default): the disk. Gives the bytes of a file and how many they are, or NULL if there is none; `name` is the
    // name of the script or, for what a script names, that of its folder before it, without dots. A script may then
    // read whatever this gives and nothing else. For a folder, a name that ends in a slash (`./` for the current one),
    // it gives the names in it, a line each; `glob` finds nothing where it gives NULL. The same address and length
    // stand for the same bytes, which must stay until the session is closed. It may be called in each frame, and by the
    // thread that draws a picture; nothing of the session may be called by it.
    const char *(*read_file)(void *read_user_data, const char *name, size_t *length);
    void *read_user_data;
    // The text that stands for a file on the disk which a script imports or includes, such as one that an editor has
    // not saved yet, or NULL: then the file counts. `name` is its canonical path; the rest is as for `read`.
    const char *(*read_unsaved)(void *read_user_data, const char *name, size_t *length);
    // For hosts whose other threads cannot call petri_interrupt, having none or sharing no memory: asked with `host`
    // every ten microseconds or so of a call, by its thread; true is such a wish. Nothing of the session may be called
    // by it. NULL (the default): nobody is asked.
    bool (*should_interrupt)(void *user_data);
} PetriOptions;

// Writes the defaults of the first `size` bytes of options.
PETRI_API void petri_options_init(PetriOptions *options, size_t size);
static inline PetriOptions petri_default_options(void) {
    PetriOptions options;
    petri_options_init(&options, sizeof options);
    return options;
}

// A session without a script, which lives until petri_close, or NULL if memory is used up or the options were not
// initialised or make no sense.
PETRI_API PetriSession *petri_open(const PetriOptions *options);
// Frees the session and sets the handle to NULL. A handle that is NULL already is fine.
PETRI_API void petri_close(PetriSession **session);

// Defines a name for the scripts loaded from now on (`-D`): "name=value", where value is `;`-separated numbers with
// suffixes, time codes, `:symbols` or strings. PETRI_INVALID without an equals sign, or if that which is before it is
// no name. Loading a script tells of definitions that it does not take.
PETRI_API PetriStatus petri_define(PetriSession *session, const char *definition);

// Loads a script from a file; frames count from 0 again, the state dictionary is kept. `file` is also what messages
// call it and what relative file names in it start from. PETRI_INVALID if it cannot be read or is no script.
PETRI_API PetriStatus petri_load(PetriSession *session, const char *file);
// The same from text; `name` stands for the file, one such as `<stdin>` for a stream. PETRI_INVALID likewise.
PETRI_API PetriStatus petri_load_text(PetriSession *session, const char *name, const char *text, size_t length);
// The same, while frame numbers, time and beat go on: for a script that was changed, and whose file is no pipe. Of
// tempo and fps, those count anew whose pragma was changed. NULL stands for the text that was loaded last, for when
// definitions have changed: what was told of it is not told again. PETRI_INVALID likewise, and if there is none.
PETRI_API PetriStatus petri_reload(PetriSession *session, const char *file);
// The files that the loaded script was made from, by number from 0: itself, what it includes, and modules that some
// script has imported. NULL beyond the last. Valid until the next load or step.
PETRI_API const char *petri_source_file(PetriSession *session, size_t number);
// Compiles a file and makes its first frame for the diagnostics only, with the names that are defined: what would be
// told when it is loaded, run and drawn, and what is hardly meant. No system goes on, nothing is drawn or written, and
// the loaded script runs on as if nothing had happened. PETRI_INVALID if it cannot be read or is no script.
PETRI_API PetriStatus petri_check(PetriSession *session, const char *file);
// The same for a text; `name` stands for the file. PETRI_INVALID likewise.
PETRI_API PetriStatus petri_check_text(PetriSession *session, const char *name, const char *text, size_t length);

// Evaluates the next frame (0 first) and updates its systems. PETRI_INVALID if no script is loaded. PETRI_OUT_OF_MEMORY
// while systems are updated changes nothing with PetriOptions.interruptible; without, the frame counts, and each system
// has made it or stays as it was.
PETRI_API PetriStatus petri_step(PetriSession *session);
// The same at a time in seconds and a beat of the host's own, from which petri_step would go on; it never waits.
// Systems rest in a frame whose time is not later than that of the one before. PETRI_INVALID, too, if they are not
// finite.
PETRI_API PetriStatus petri_step_at(PetriSession *session, double time, double beat);

// In real time: seconds until the next frame is due, for a host that has other things to do than to wait in petri_step;
// 0 if it is due, and in lockstep.
PETRI_API double petri_seconds_until_due(const PetriSession *session);
// In real time: the time that has passed since the last frame does not count, so that the next one follows it as if
// nothing had happened in between. For hosts that pause, or take long over something.
PETRI_API void petri_resync_clock(PetriSession *session);

// A parameter of the loaded script: `let NAME=NAME or DEFAULT -- 1..500 what it is` at its top level, which takes the
// value that a definition of NAME gives it, if that is true, else its default. A range at the start of the comment
// (`1..500`, `0..1|0.05` with a step, `0..` with one end) is for people and hosts: what is outside is a warning.
typedef struct PetriParameter {
    const char *name;
    const char *default_value; // the default as the script has it
    const char *value;         // the present value in printed form; `fallback` if only a frame can tell
    const char *comment;       // behind it in its line, without the range; "" for none
    double number;             // the present value; NaN unless it is known to be one number
    double default_number;     // the default; likewise
    double min;                // the comment's range; infinite where it has no end
    double max;
    double step;      // 0: the comment has none
    bool defined;     // a definition gives the present value
    bool settable;    // false: of a module, which sees no definitions
    const char *file; // where it stands
    uint32_t line;    // from 1
    uint32_t column;  // in characters, from 1
} PetriParameter;
// By number from 0, the script's own and those of what it includes first, then those of the modules that it imports at
// its top level; false beyond the last. Texts are valid until the next call that may change or show anything.
PETRI_API bool petri_parameter(PetriSession *session, size_t number, PetriParameter *parameter);
// Gives a parameter of the script another value, as petri_define reads it, or its default if `value` is NULL. The next
// frame has it, while state, frame numbers, time and beat go on. PETRI_INVALID, and nothing is changed, if the script
// has no such parameter, if the default is a number and the value is none, or if included files cannot be read any
// more.
PETRI_API PetriStatus petri_set_parameter(PetriSession *session, const char *name, const char *value);

// The frame that petri_step made last.
typedef struct PetriFrame {
    int64_t number; // -1 before the first
    double time;    // 0 in frame 0; after petri_restore frame/fps, in real time as well
    double beat;
    double fps;
    double tempo;
    uint64_t physics_steps;    // simulation steps of all systems in this frame
    double evaluation_seconds; // time spent on the script
    double physics_seconds;    // time spent on the systems
} PetriFrame;
// A copy.
PETRI_API PetriFrame petri_frame(const PetriSession *session);

// What the user's hands do, for the `!pointer` and `!key` nodes inside a script's `!window`. Report it whenever it
// happens; the next frame sees it in the state dictionary, from the second frame with the node on. What was pressed and
// let go between two frames counts as pressed for one. A session that is told nothing writes nothing.
enum {
    PETRI_BUTTON_LEFT = 1,
    PETRI_BUTTON_MIDDLE = 2,
    PETRI_BUTTON_RIGHT = 4, // further buttons: 8, 16, 32, 64, 128
};
typedef struct PetriPointer {
    bool inside;      // the pointer is over the window
    double x;         // if it is: 0 at the left edge to 1 at the right; what is beyond counts as the edge
    double y;         // 0 at the top to 1 at the bottom
    unsigned buttons; // those that are down, as bits
} PetriPointer;
// NULL: the user has turned away; the pointer is outside, all buttons and keys are let go. PETRI_INVALID for a position
// that is not finite.
PETRI_API PetriStatus petri_report_pointer(PetriSession *session, const PetriPointer *pointer);
// A key goes down or up: a letter, a digit, or a word such as "space", "left", "page_up", "f1", "left_shift" (README).
// PETRI_INVALID for other names.
PETRI_API PetriStatus petri_report_key(PetriSession *session, const char *name, bool pressed);
// Whether a `!key` in the last frame asked for the key, so that it should not mean anything else to the host.
PETRI_API bool petri_key_is_bound(PetriSession *session, const char *name);
// Asks for an end of what is under way (or of the next): a step, a load, a picture, a text that is printed or evaluated
// returns PETRI_INTERRUPTED, within some milliseconds. The one function that may be called from a signal handler or
// from another thread.
PETRI_API void petri_interrupt(PetriSession *session);
// Whether such a wish has not been met yet; forgets it.
PETRI_API bool petri_clear_interrupt(PetriSession *session);

// Changes the clock from here on: frame number, time and beat do not jump. PETRI_INVALID unless above 0 and finite.
PETRI_API PetriStatus petri_set_tempo(PetriSession *session, double tempo);
PETRI_API PetriStatus petri_set_fps(PetriSession *session, double fps);
// The longest step of all systems, whatever they say themselves; 0: as they say. PETRI_INVALID below 0 or not finite.
PETRI_API PetriStatus petri_set_resolution(PetriSession *session, double resolution);
PETRI_API double petri_resolution(const PetriSession *session);
// Forgets the state dictionary and goes to before frame 0.
PETRI_API void petri_reset(PetriSession *session);

// A session's configuration: script, definitions, statements of the prompt, clock rates, resolution. It is shared, not
// copied, and must be freed before the session is closed.
typedef struct PetriConfig PetriConfig;
// The present one, or NULL if memory is used up. Free with petri_config_free, which takes NULL, too.
PETRI_API PetriConfig *petri_config_get(PetriSession *session);
PETRI_API void petri_config_free(PetriConfig *config);
// Goes back to a configuration of this session; state, frame, time and beat stay.
PETRI_API void petri_config_apply(PetriSession *session, PetriConfig *config);
// A number that is another whenever the configuration is; modules that changed on disk count as well.
PETRI_API uint64_t petri_config_revision(const PetriSession *session);

// A copy of all that decides how a session goes on: state, systems, input, clock and configuration. Free it before the
// session.
typedef struct PetriSnapshot PetriSnapshot;
// NULL if memory is used up. Free with petri_snapshot_free, which takes NULL, too.
PETRI_API PetriSnapshot *petri_snapshot(PetriSession *session);
PETRI_API void petri_snapshot_free(PetriSnapshot *snapshot);
PETRI_API size_t petri_snapshot_bytes(const PetriSnapshot *snapshot); // of its own; a configuration is shared
// Goes back to just after the frame of a snapshot of this session: the next frames are the same to the last bit, as
// long as the files that the script reads are. The frame's tree is not there until then. PETRI_OUT_OF_MEMORY changes
// nothing.
PETRI_API PetriStatus petri_rewind(PetriSession *session, const PetriSnapshot *snapshot);

// Writes the state dictionary, the frame number and what the systems need to go on (not what the user's hands do) to a
// file, replaced as a whole and synchronised to the disk. PETRI_INVALID (with a diagnostic) if it cannot be written.
PETRI_API PetriStatus petri_save(PetriSession *session, const char *file);
// Takes a saved state back, after petri_load: the next frame is the one after that which was saved, and goes on from it
// to the last bit. A file that does not exist is PETRI_OK and changes nothing. One that cannot be read, is cut short or
// damaged is PETRI_INVALID (with a diagnostic) and changes nothing either.
PETRI_API PetriStatus petri_restore(PetriSession *session, const char *file);

// A value of the language: a vector of numbers, or of elements of several kinds. It is a view of what lies in the
// session, and lives as long as the function says that gives it; functions that take one copy what they keep. A host
// makes one from its own numbers or elements. Symbols are numbers (petri_symbol).
typedef enum PetriType { PETRI_NUMBER, PETRI_STRING, PETRI_NODE, PETRI_FUNCTION } PetriType;
typedef struct PetriNode PetriNode;
typedef struct PetriString {
    const char *bytes; // UTF-8; U+0000 may be among it, and no NUL byte follows
    size_t length;
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
    uint32_t length;        // elements; 0: null
    const double *numbers;  // if all are numbers, else NULL
    const PetriItem *items; // if some are not, else NULL
} PetriValue;
// The printed form of a value, which the language reads back if there are only numbers and strings in it. NULL if
// memory is used up or it is no value. Valid until the next petri_format_value, step or load, or text that is printed.
PETRI_API const char *petri_format_value(PetriSession *session, PetriValue value);
// The number that is the symbol `:name`; NaN if the name is none, or memory is used up. It never changes.
PETRI_API double petri_symbol(PetriSession *session, const char *name);
// The name of the symbol that a number is, or NULL. Valid as long as the session.
PETRI_API const char *petri_symbol_name(const PetriSession *session, double number);

// The state dictionary, which scripts read with `$`. A value is valid until something may change the state: a step,
// petri_state_set, a load, petri_reset, petri_rewind or petri_restore.
//
// The value under a key; null if there is none, the key is none, or memory is used up.
PETRI_API PetriValue petri_state_get(PetriSession *session, PetriValue key);
// Stores a value under a key, or removes it if the value is null; the next frame has it. Keys and values are numbers
// and strings; PETRI_INVALID for others, a value that is not finite or a key with NaN, and within a callback.
PETRI_API PetriStatus petri_state_set(PetriSession *session, PetriValue key, PetriValue value);
// The entries, one after the other, in the order in which their keys came to be there: `*cursor` starts at 0; false at
// the end.
PETRI_API bool petri_state_next(PetriSession *session, uint32_t *cursor, PetriValue *key, PetriValue *value);

// A name of the host's, which scripts read as any other name and whose value may be another in each frame: the scripts
// that are loaded from now on see it, and need not be loaded again for another value. Like definitions it is not seen
// by modules. The name stays with the session; null is a value. PETRI_INVALID if it is no name or one of the engine's
// (such as `time`), for nodes and functions, and within a callback.
PETRI_API PetriStatus petri_set_global(PetriSession *session, const char *name, PetriValue value);

// The tree that the last frame has come to: its nodes, and perhaps other elements. All that is reached from it is valid
// until the next step, load or text typed at the prompt, petri_rewind, petri_restore or petri_reset.
PETRI_API PetriValue petri_tree(const PetriSession *session);
// Of a node: the word behind its `!`, its tags, attributes and children by number from 0; NULL beyond the last. Valid
// as long as the node.
PETRI_API const char *petri_tree_kind(const PetriNode *node);
PETRI_API const char *petri_tree_tag(const PetriNode *node, uint32_t number);
PETRI_API const char *petri_tree_attribute(const PetriNode *node, uint32_t number, PetriValue *value); // its name
PETRI_API const PetriNode *petri_tree_child(const PetriNode *node, uint32_t number);
// The attribute of this name, or null. Valid as long as the node.
PETRI_API PetriValue petri_tree_get(const PetriNode *node, const char *name);

// A built-in function of the host's own. While it runs, nothing of its session may be called but petri_symbol_name and
// what takes a PetriCall, and it must return: no longjmp, no exception.
typedef struct PetriCall PetriCall;
// The arguments are those by position, then null for each parameter that has none; a `...` may bring more. All is valid
// during the call. The result is copied, unless it is made of petri_call_alloc_numbers; null for what is no value.
typedef PetriValue PetriFunctionCall(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count);
typedef struct PetriFunction {
    size_t size; // sizeof(PetriFunction)
    const char *name;
    const char
        *parameters;  // such as "x, y=0, ...": those with a default may be left out; eight at the most before `...`
    const char *help; // a line; may be NULL
    bool pure; // the same arguments always give the same result, so that a call may be made once, when a script is
               // loaded
    PetriFunctionCall *call;
    void *user_data; // for `call`
} PetriFunction;
// Adds a function for the scripts and modules loaded from now on. It stays with the session, and texts are copied.
// PETRI_INVALID for a name that is none, is the engine's, a built-in's or another function's, for parameters that make
// no sense, and within a callback.
PETRI_API PetriStatus petri_add_function(PetriSession *session, const PetriFunction *function);
// Room for the numbers of a result; NULL if memory is used up. Valid until the call returns its result.
PETRI_API double *petri_call_alloc_numbers(PetriCall *call, uint32_t count);
// Tells the script's author what is wrong with the arguments, as `NAME: text` at the place of the call, once; the
// result is null then. The text is copied and may be cut after 200 bytes.
PETRI_API void petri_call_error(PetriCall *call, const char *text);

// Numbers of the particles of a system where they lie: those of particle i begin at `data[i * stride]`.
typedef struct PetriColumn {
    const double *data; // NULL if there are none
    size_t stride;      // 0: all particles have the same
} PetriColumn;

// A particle system of the last frame. Anchors are particles, too. Its columns point into the session, and nothing is
// copied: they are valid until the next step, load, rewind, restore or clear.
typedef struct PetriSystem {
    const char *name;    // its state prefix in printed form, such as ":cells"; valid as the columns are
    uint32_t dimensions; // doubles of a position, velocity or force
    uint32_t particle_count;
    uint32_t force_count; // force appliers and barriers
    uint64_t steps;       // simulation steps in the frame
    PetriColumn position; // may be non-finite
    PetriColumn velocity;
    PetriColumn force; // the sum of all forces in the frame's last step, 0 on an anchor. `data` is NULL if no step was
                       // made, or without PetriOptions.keep_forces
    PetriColumn radius;
    PetriColumn mass;
    PetriColumn charge;
    const bool *anchor; // that of particle i is `anchor[i * anchor_stride]`
    size_t anchor_stride;
} PetriSystem;
// By number from 0 in order of declaration; false beyond the last, and if memory is used up.
PETRI_API bool petri_system(PetriSession *session, size_t number, PetriSystem *system);
// For hosts whose users hold columns for longer: from now on those that are no longer valid stay readable, with what
// they held last or hold by chance, until this is called with false, or the session is closed. Their memory counts.
PETRI_API void petri_keep_columns(PetriSession *session, bool keep);
// The id of a particle; null if there is none. Valid until the next petri_particle_id or petri_system_force, and as the
// columns are.
PETRI_API PetriValue petri_particle_id(PetriSession *session, size_t system, uint32_t particle);
// The ids of all particles, if each is one number (as a symbol is); else `data` is NULL, and if memory is used up. Made
// when they are asked for first and whenever the system has got others, and charged as the script's memory is. Valid as
// the columns are.
PETRI_API PetriColumn petri_particle_ids(PetriSession *session, size_t system);
// How ranks (PetriOptions.ranks) share a system, and what this one has sent for it so far. A message to all is one.
typedef enum PetriDecomposition {
    PETRI_REPLICATED,        // each does all of it: it is small, or so are the forces
    PETRI_FORCE_DECOMPOSED,  // forces without reach: blocks of pairs are dealt out
    PETRI_DOMAIN_DECOMPOSED, // each has the particles of a region
} PetriDecomposition;
typedef struct PetriRankStats {
    PetriDecomposition decomposition; // in the last frame
    uint64_t frames;                  // that simulated
    uint64_t steps;
    uint64_t step_bytes; // sent within steps
    uint64_t step_messages;
    uint64_t reductions;  // decisions that all ranks took together: twice the logarithm of their number in messages
    uint64_t frame_bytes; // sent at the end of frames, for all to have all particles
    uint64_t own;         // particles of its region, summed over the steps
    uint64_t halo;        // those of other regions that it was told of, likewise
} PetriRankStats;
// False if there is no such system.
PETRI_API bool petri_rank_stats(PetriSession *session, size_t system, PetriRankStats *traffic);
// The number of the particle that has an id; false if there is none, or memory is used up.
PETRI_API bool petri_find_particle(PetriSession *session, size_t system, PetriValue id, uint32_t *particle);

// A force applier or barrier: what can be seen of it.
typedef struct PetriForce {
    const char *kind;       // its node, without the `!`, such as "distance"; lives as long as the library
    double strength;        // before easing in
    uint32_t from;          // distance: the particles that it joins
    uint32_t to;            //
    const double *position; // barrier: a point on it, and its unit normal; else NULL
    const double *normal;
} PetriForce;

// By number from 0 in order of declaration; false beyond the last, and if memory is used up. Vectors are valid until
// the next petri_system_force or petri_particle_id, and as the columns of the system are.
PETRI_API bool petri_system_force(PetriSession *session, size_t system, uint32_t number, PetriForce *force);

// Whether the last frame has anything to draw: a window with a canvas, or physics. A library of its own draws it
// (petri-draw.h).
PETRI_API bool petri_has_picture(PetriSession *session);

// The kinds of nodes that do something, with their attributes, for help and completion. Indices count from 0; false
// beyond the last. Texts live as long as the library.
typedef struct PetriNodeKind {
    const char *name; // without the `!`
    const char *area; // "physics", "canvas" or "canvas3d"; `group` is a kind of each
    const char *help;
    // Of a force: lines `F = …`, with `if` for cases of which the first counts, and what they take before them; else
    // "". n dimensions, δ the length of a step; of a particle, or of the first and second of a pair: r radius, m mass,
    // q charge, v velocity, l the distance of the two, s that from a wall. Above 0 a pair is pushed apart. A force has
    // the unit mass·length/time², each of them as the script chooses.
    const char *formula;
} PetriNodeKind;

typedef struct PetriNodeAttribute {
    const char *name;
    const char *type;          // as words, such as "number" or ":butt, :round or :square"
    const char *default_value; // the default, as words; "" for none
    const char *help;          // "" where the name says all
    const char *unit;          // as words, such as "turns"; "" for none
} PetriNodeAttribute;
// By number from 0; false beyond the last.
PETRI_API bool petri_node_kind(size_t kind, PetriNodeKind *out);
PETRI_API bool petri_node_attribute(size_t kind, size_t attribute, PetriNodeAttribute *out);

// What a frame's text holds (spec cli.md 3.3), in this order.
enum {
    PETRI_PRINT_TREE = 1,
    PETRI_PRINT_STATE = 2,
    PETRI_PRINT_LOG = 4,
    PETRI_PRINT_ERROR = 8,
    PETRI_PRINT_HASH = 16, // the SHA-256 of what PETRI_PRINT_STATE writes, whether that is asked for or not
};

// Takes a piece of text; false stops the writing.
typedef bool PetriWriteCallback(void *user_data, const char *text, size_t length);

// Writes `@FRAME time=T beat=B` and the sections asked for. PETRI_INVALID if the writer said stop.
PETRI_API PetriStatus petri_print(PetriSession *session, unsigned sections, PetriWriteCallback *write, void *user_data);
// Only the log lines of the frame, each `> text`. PETRI_INVALID likewise.
PETRI_API PetriStatus petri_print_log(PetriSession *session, PetriWriteCallback *write, void *user_data);

// Writes where the time has gone since the script was loaded, one line for each source line that was evaluated, one for
// the systems and one for `output_seconds`, which the host has spent on output; the longest first. PETRI_INVALID
// without the option `profile`, or if the writer said stop.
PETRI_API PetriStatus petri_profile(PetriSession *session, double output_seconds, PetriWriteCallback *write,
                                    void *user_data);

// A prompt: text typed by a person. It and the names that it binds are evaluated in the state after the last frame.
// Names of the script's top level have their values of the frame, before its systems were updated. If the configuration
// changes, the script is evaluated for the frame again, in the state before it if the session is `interruptible` and
// has made the frame itself, else in the state after it. Before the first frame it is evaluated for frame 0.

typedef enum PetriCompleteness {
    PETRI_COMPLETE,    // the text is complete, or wrong whatever follows
    PETRI_EXTENDABLE,  // it is complete, and indented lines would go on with it
    PETRI_NEEDS_BLOCK, // indented lines must follow
    PETRI_INCOMPLETE,  // it cannot end here
} PetriCompleteness;
// Whether more lines are needed. A text for which memory does not suffice counts as whole, with a diagnostic.
PETRI_API PetriCompleteness petri_prompt_check(PetriSession *session, const char *text, size_t length);

// What became of the statements of a text.
typedef struct PetriPromptResult {
    uint32_t values;   // evaluated once and written
    uint32_t bindings; // `let`, `func`, `import`: kept and evaluated in each frame, after the script
    uint32_t nodes; // statements that begin with a node, or an `if` or `for` around one: kept likewise, and their nodes
                    // are added to those of the script; they are written, too, as they are now
    const char *shadowed; // a name bound that the script's top level binds, too: the script goes on with its own; or
                          // NULL. Valid as long as the session
} PetriPromptResult;
// Takes a text, statement by statement. Values are written in printed form, nodes as trees, debug() as `> text`.
// PETRI_INVALID if it does not parse; a statement that was given up is not kept.
PETRI_API PetriStatus petri_prompt(PetriSession *session, const char *text, size_t length, PetriWriteCallback *write,
                                   void *user_data, PetriPromptResult *result);
// Drops what the prompt has kept: nodes, or bindings as well. Returns how many statements that were; none if
// memory is used up.
PETRI_API uint32_t petri_prompt_clear(PetriSession *session, bool bindings);
// A statement that is evaluated in each frame, by number from 0; NULL beyond the last. Valid until the next call that
// changes the configuration.
PETRI_API const char *petri_prompt_statement(const PetriSession *session, size_t number);

typedef struct PetriEvaluation {
    bool is_true;
    uint32_t length; // of the vector
    double number;   // NaN unless it is one number
    double seconds;  // that the evaluation took, without compilation
} PetriEvaluation;
// Evaluates one expression; its value is written in one line, without end, unless `write` is NULL. PETRI_INVALID if it
// is none.
PETRI_API PetriStatus petri_evaluate(PetriSession *session, const char *text, size_t length, PetriEvaluation *result,
                                     PetriWriteCallback *write, void *user_data);
// Evaluates the script for the present frame, or frame 0, as for the prompt, if petri_step has not done so: for
// petri_print. PETRI_INVALID if no script is loaded.
PETRI_API PetriStatus petri_preview(PetriSession *session);

// A name that the prompt can see, besides built-ins, by number from 0; NULL beyond the last. Names may come twice.
// Valid as long as the session.
PETRI_API const char *petri_visible_name(const PetriSession *session, size_t number);

// The tokens of a text, for editors: comments among them, and where lines end and blocks begin and end.
typedef enum PetriTokenKind {
    PETRI_TOKEN_NAME,
    PETRI_TOKEN_KEYWORD, // a word where it is one; %pragma and %include, too
    PETRI_TOKEN_NUMBER,  // time codes, too
    PETRI_TOKEN_STRING,
    PETRI_TOKEN_SYMBOL,
    PETRI_TOKEN_NODE,
    PETRI_TOKEN_TAG,
    PETRI_TOKEN_OPERATOR, // brackets and punctuation, too
    PETRI_TOKEN_COMMENT,  // without the line's end; what `#!` begins, too
    PETRI_TOKEN_INVALID,  // no token starts with this
    PETRI_TOKEN_NEWLINE,  // a statement may end here, or the head of a block; of no length, as the next two are
    PETRI_TOKEN_INDENT,
    PETRI_TOKEN_DEDENT,
} PetriTokenKind;
typedef struct PetriToken {
    PetriTokenKind kind;
    size_t start; // in bytes from the text's beginning
    size_t end;
} PetriToken;
typedef void PetriTokenCallback(void *user_data, const PetriToken *token);
// Gives the tokens of a text in order; its lines end in LF, and it begins with no byte-order mark. Where it does not
// parse, it goes on behind that, PETRI_OK all the same; of text that is not UTF-8 it gives none. `take` calls nothing
// of the session.
PETRI_API PetriStatus petri_tokenise(PetriSession *session, const char *text, size_t length,
                                     PetriTokenCallback *callback, void *user_data);

// What the names of a text stand for, for editors; built-ins, the engine's names and attributes are not the text's.
typedef enum PetriNameKind {
    PETRI_NAME_USE,
    PETRI_NAME_LET, // of a `where`, too
    PETRI_NAME_FUNC,
    PETRI_NAME_PARAMETER,
    PETRI_NAME_LOOP,
    PETRI_NAME_IMPORT,
} PetriNameKind;
typedef struct PetriBinding {
    PetriNameKind kind;
    size_t start; // of the name, in bytes from the text's beginning
    size_t end;
    size_t
        binding_start;  // of a use: where the name starts that binds it; PETRI_NUL_TERMINATED: nothing of the text does
    size_t scope_start; // of others: where it is visible
    size_t scope_end;
    size_t value_start; // … and what it is bound to: a value, a function, a file
    size_t value_end;
    bool is_sole;   // … the value is bound to this name alone
    uint32_t depth; // … in so many blocks and functions
} PetriBinding;
typedef void PetriBindingCallback(void *user_data, const PetriBinding *name);
// Gives the names that are bound or used, as petri_tokenise gives tokens, PETRI_OK even where the text does not parse.
PETRI_API PetriStatus petri_bindings(PetriSession *session, const char *text, size_t length,
                                     PetriBindingCallback *callback, void *user_data);

typedef enum PetriDump { PETRI_DUMP_AST, PETRI_DUMP_CODE } PetriDump;
// Writes the loaded script's syntax tree or compiled code. PETRI_INVALID without one, or if the writer said stop.
PETRI_API PetriStatus petri_dump(PetriSession *session, PetriDump what, PetriWriteCallback *write, void *user_data);

// How many diagnostics were given since the session was opened, by level.
PETRI_API uint64_t petri_diagnostic_count(const PetriSession *session, PetriLevel level);
// The last diagnostics, a hundred at the most, by number from 0, the oldest first; false beyond the last. Texts are
// valid until the next diagnostic, petri_clear_diagnostics or petri_close.
PETRI_API bool petri_diagnostic(const PetriSession *session, size_t number, PetriDiagnostic *diagnostic);
// Keeps none of those given so far, so that petri_diagnostic shows what the next calls have to say.
PETRI_API void petri_clear_diagnostics(PetriSession *session);

// One built-in function, for help. `index` counts from 0; false beyond the last. Texts live as long as the library.
typedef struct PetriBuiltin {
    const char *name;
    const char *parameters;
    const char *help;
} PetriBuiltin;
PETRI_API bool petri_builtin(size_t index, PetriBuiltin *builtin);
// The same for those that the host has added. Valid as long as the session.
PETRI_API bool petri_host_function(const PetriSession *session, size_t number, PetriBuiltin *function);

// A number as `--runtime` takes it: seconds with suffix or a time code. False if it is none.
PETRI_API bool petri_parse_number(const char *text, double *x);

// The library's version as text, such as "0.2.0", and as a number like PETRI_VERSION_NUMBER. Lives as long
// as the library.
PETRI_API const char *petri_version(void);
PETRI_API int petri_version_number(void);

#ifdef __cplusplus
}
#endif

#endif
