// builtin.h: the registry of built-in functions (spec builtins.md).
//
// A built-in is one row of builtin_list.h: name, function, parameters, purity and one line of help. The function gets
// its arguments in the order of the parameters; a missing argument is VALUE_ABSENT. It returns the specified value, or
// null for arguments of the wrong form. If the spec calls this a *bad call*, it also reports the call with
// builtin_error.
#pragma once

#include "base/file_access.h"
#include "value/node.h"
#include "value/value.h"

typedef struct FileCache FileCache;             // builtin/files.h
typedef struct NoiseCache NoiseCache;           // builtin/noise.h
typedef struct BuiltinPictures BuiltinPictures; // builtin/pictures.h

// The context of a call. All pointers are borrowed for the duration of the call.
typedef struct BuiltinContext {
    const struct Builtin *called;                    // the built-in that is called
    Arena *arena;                                    // owns results and temporaries
    const SymbolTable *symbols;                      // for converting symbols to text
    FileCache *files;                                // cache of file contents; NULL: file functions find no file
    NoiseCache *noise;                               // cache of permutations; NULL: they are computed in each call
    const FileAccess *file_access;                   // rules for file access; NULL: unrestricted
    BuiltinPictures *pictures;                       // fonts and rendered pictures; NULL: none
    Str directory;                                   // base of relative file names (L13.3); "": the working directory
    void (*report_error)(void *user_data, Str text); // receives the text of an error in the call
    void (*log)(void *user_data, Str text);          // receives a line from debug()
    void *user_data;
} BuiltinContext;

typedef Value BuiltinCall(BuiltinContext *context, const Value *args, uint32_t count);

typedef struct Builtin {
    const char *name;
    BuiltinCall *call;
    const char *parameters; // as in the spec: "xs, ys=0", "x", "xs, ..."; "..." means any further arguments
    uint8_t required;       // minimum number of arguments
    uint8_t fixed;          // number of parameters before "..."; `args` has at least this many elements
    bool variadic;
    bool named; // accepts parameters by name (B0.3)
    bool pure;  // the result depends only on the arguments, so constant calls can be folded (B0.5)
    // The function is element-wise (B0.4) if it is called with at least this many arguments; 0: never. An element of
    // the result then depends only on the elements of the arguments at the same index. This is true only if each
    // argument is a number or a vector, and if all vectors have the same length.
    uint8_t each;
#define BUILTIN_EACH_POINT UINT8_MAX // value of `each` for noise; see builtin_noise_points
    const char *help;
} Builtin;

extern const Builtin builtin_table[];
extern const uint32_t builtin_table_count;

// Returns the built-in with this name, or NULL if there is none.
const Builtin *builtin_find(Str name);

// Calls a built-in with positional and named arguments. If their number or a name is invalid, reports a *bad call*
// (B0.2, B0.3) and returns null.
Value builtin_call(BuiltinContext *context, const Builtin *builtin, const Value *args, uint32_t count,
                   const Symbol *const *names, const Value *named, uint32_t named_count);

// Reports the diagnostic "NAME: text" and returns null.
Value builtin_error(BuiltinContext *context, const char *name, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Looks up a predefined constant (L4.2): true false null inf nan pi π tau 𝜏. Returns false if the name is not a
// constant.
bool builtin_constant(Str name, Value *value);
