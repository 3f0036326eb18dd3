// builtin.h: the registry of built-in functions (spec builtins.md).
//
// A built-in is one row of builtin_list.h: name, function, parameters, purity, one line of help. The function gets its
// arguments by position, already matched with the parameters; one that was not given is VALUE_ABSENT. It returns the
// specified value, null for arguments of the wrong form, and reports a *bad call* of its own through builtin_error.
#ifndef PETRI_BUILTIN_BUILTIN_H
#define PETRI_BUILTIN_BUILTIN_H

#include "base/file_access.h"
#include "value/node.h"
#include "value/value.h"

typedef struct FileCache FileCache;   // builtin/files.h
typedef struct NoiseCache NoiseCache; // builtin/noise.h

// What a call may use. Everything is borrowed for the call.
typedef struct BuiltinContext {
    const struct Builtin *called;  // whose call it is
    Arena *arena;                  // results and temporaries
    const SymbolTable *symbols;    // for texts
    FileCache *files;              // NULL: file functions find no file
    NoiseCache *noise;             // NULL: permutations are made anew for each call
    const FileAccess *file_access; // NULL: all files may be used
    Str directory;                 // relative file names start here (L13.3); "" is the working directory
    void (*report_error)(void *user_data, Str text); // a diagnostic at the place of the call
    void (*log)(void *user_data, Str text);          // a line of debug()
    void *user_data;
} BuiltinContext;

typedef Value BuiltinCall(BuiltinContext *context, const Value *args, uint32_t count);

typedef struct Builtin {
    const char *name;
    BuiltinCall *call;
    const char *parameters; // as in the spec: "xs, ys=0", "x", "xs, ..."; a trailing "..." takes any number more
    uint8_t required;       // fewest arguments
    uint8_t fixed;          // parameters before "..."; also the length of args unless more were given
    bool variadic;
    bool named; // accepts parameters by name (B0.3)
    bool pure;  // B0.5
    // With so many arguments or more it is element-wise (B0.4): for numbers and vectors of one length the result is the
    // vector of the results for their elements, where it is a vector of that length. 0: it is not.
    uint8_t each;
#define BUILTIN_EACH_POINT UINT8_MAX // noise: see builtin_noise_points
    const char *help;
} Builtin;

extern const Builtin builtin_table[];
extern const uint32_t builtin_table_count;

// The row of a name, or NULL.
const Builtin *builtin_find(Str name);

// Calls a built-in with positional and named arguments; checks counts and names first (*bad call*, B0.2, B0.3).
Value builtin_call(BuiltinContext *context, const Builtin *builtin, const Value *args, uint32_t count,
                   const Symbol *const *names, const Value *named, uint32_t named_count);

// Reports "NAME: text" as a diagnostic; null.
Value builtin_error(BuiltinContext *context, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// A constant that is visible like a built-in (L4.2): true false null inf nan pi π tau 𝜏. False if there is none.
bool builtin_constant(Str name, Value *value);

#endif
