// program.h: compiled programs, in which all names are resolved to slots.
//
// A program is immutable code (code.h) in one arena. A reload replaces the whole program. The intermediate expressions
// (expr.h) are freed after compilation. Each function, module and main program has its own slots. A nested function
// accesses outer values only through captures, which are copied when it is defined (spec language.md L9.1).
#pragma once

#include "ast/ast.h"
#include "base/diag.h"
#include "value/value.h"

typedef enum EngineName {
#define ENGINE_NAME(id, text, is_static) ENGINE_##id,
#include "program/engine_names.h"
#undef ENGINE_NAME
    ENGINE_NAME_COUNT
} EngineName;

typedef struct Code Code; // program/code.h

typedef struct Export {
    const Symbol *name;
    uint32_t slot;
} Export;

typedef struct Pragma {
    const Symbol *name;
    Value value;
    const Source *source;
    Span span;
} Pragma;

// A parameter: `let NAME=NAME or DEFAULT` or `let NAME=NAME if NAME != null else DEFAULT` at the top level of a file,
// if the NAME after = can get a value only from -D (parameters.c). A comment after the parameter on the same line
// describes it.
typedef struct Parameter {
    const Symbol *name;
    const Source *source;
    Span span;        // position of the name
    Str default_text; // source text of the default
    bool keeps_false; // a definition that is false, such as 0, counts: `let NAME=NAME if NAME != null else DEFAULT`
    bool is_static;   // the default is the constant `value`
    Value value;
    Str comment; // comment that describes the parameter, without the range at its start
    double min;  // lower end of the range in the comment, inclusive; -INFINITY: none
    double max;  // upper end of the range, inclusive; INFINITY: none
    double step; // step of the range; 0: none
} Parameter;

// How a program uses a name that -D defines.
typedef struct DefineUse {
    bool read;    // the program reads the value that -D defines
    Origin bound; // position at which the program first binds the same name; source NULL: nowhere
    bool by_let;  // the binding at `bound` is a top-level `let`
} DefineUse;

// `$KEY;VALUE` without parentheses, which is `($KEY);VALUE`.
typedef struct LooseKey {
    double symbol; // the key
    Origin origin; // of the whole vector
} LooseKey;

// What a program says about keys of the state (key_uses.c), for lints.
typedef struct KeyUses {
    double *symbols; // symbols that occur outside of lookups, each once
    Origin *tested;  // lookups whose value the script expects to be null
    LooseKey *loose;
    uint32_t symbol_count, tested_count, loose_count;
    uint32_t symbol_capacity, tested_capacity, loose_capacity;
    bool ids_change; // there may be other particles in other frames
    bool incomplete; // there are too many symbols, or some are in other files
} KeyUses;

typedef struct Program {
    const Source *source;
    const Code *code;
    uint32_t lookup_count; // number of state lookups; the VM has an inline cache for each
    uint32_t param_count;  // number of values that the host passes to each run; they are in the first slots
    const Export *exports; // top-level bindings, in source order; if a name is repeated, the last one is used
    uint32_t export_count;
    const Pragma *pragmas;
    uint32_t pragma_count;
    const Parameter *parameters; // in source order
    uint32_t parameter_count;
    const DefineUse *define_uses; // one element per element of CompileOptions.defines
    const Str *imports;           // constant paths of modules imported at the top level
    uint32_t import_count;
    const KeyUses *keys;
} Program;

// Functions that the compiler calls.
typedef struct CompileHost {
    void *user_data;
    // Parses a file for %include. On failure, returns NULL and sets *reason, which belongs to the host. The source must
    // live as long as the program, and the tree until the end of the compilation.
    const Ast *(*include)(void *host, Str path, const Source **source, Str *reason);
    // Executes `code` in a new frame and sets *value to its result. Returns false and sets *value to null if the code
    // is dynamic (L17.2), fails or exceeds a limit. The value is allocated in the program's arena. If the simplifier
    // does not use the value, it rewinds the arena.
    bool (*evaluate)(void *host, const Code *code, Value *value);
} CompileHost;

typedef struct Define {
    const Symbol *name;
    Value value;
    const char *text; // the definition in the form name=value
} Define;

typedef struct CompileOptions {
    bool module;   // compile a module: engine and -D names are not visible, and unbound names are reported at run time
    bool lint;     // also report code that is unlikely to be intended
    bool simplify; // fold constant expressions (L17.1)
    bool lines;    // record the source line of each instruction
    const Define *defines; // if a name is repeated, the last definition is used
    uint32_t define_count;
    const Symbol *const *params; // names of values that each run receives; if a name is repeated, the last one is used
    uint32_t param_count;
    const struct Builtin *const *functions; // host functions; none may have the name of a built-in
    uint32_t function_count;
    const struct FileAccess *files; // access to the files of modules; NULL: they are read from the disk
    CompileHost host;
} CompileOptions;

// Compiles a parsed program. Errors are reported to the sink and are never fatal. The program is allocated in `arena`
// and refers to nothing else. Temporary data is allocated in `scratch`, which may also contain the syntax tree.
const Program *program_compile(Arena *arena, Arena *scratch, SymbolTable *symbols, const Source *source, const Ast *ast,
                               const CompileOptions *options, DiagSink *diags);

// Returns the last export with this name, or NULL.
const Export *program_find_export(const Program *program, const Symbol *name);

// Returns the parameter with this name, or NULL.
const Parameter *program_find_parameter(const Program *program, const Symbol *name);

// Returns a hint with the declaration of a parameter that also accepts values that are false.
Str program_null_test(Arena *arena, const Parameter *parameter);

const char *engine_name_text(EngineName name);
bool engine_name_exists(Str name);

// Appends the code of a program as text, for --dump=code.
void program_print(Text *out, const SymbolTable *symbols, const Program *program);
