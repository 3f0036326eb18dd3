// program.h: a compiled program: names resolved to slots, constants in place, nothing left to look up.
//
// A program is the code that its text comes down to (code.h), immutable, in one arena, replaced as a whole on reload.
// The expressions in between (expr.h) are gone when it is compiled. Every function, the main program and every module
// runs in a frame of slots; a nested function reaches outer values only through what it has captured by value when it
// was defined (spec language.md L9.1).
#ifndef PETRI_PROGRAM_PROGRAM_H
#define PETRI_PROGRAM_PROGRAM_H

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

// A parameter: `let NAME=NAME or DEFAULT` at the top level of a file, where nothing but -D could give the name on the
// right a value (parameters.c). What stands behind it in its line tells a person what it is for.
typedef struct Parameter {
    const Symbol *name;
    const Source *source;
    Span span;        // of the name
    Str default_text; // text of the default
    bool is_static;   // the default is the same in every frame: `value`
    Value value;
    Str comment; // without the range at its start
    double min;  // the comment's range, with its ends; infinite where it says nothing
    double max;
    double step; // 0: the comment has none
} Parameter;

// What a program does with a -D name.
typedef struct DefineUse {
    bool read;
    Origin bound; // where the program first binds the name itself; no source: nowhere
    bool by_let;  // … with a `let` at its top level
} DefineUse;

typedef struct Program {
    const Source *source;
    const Code *code;
    uint32_t lookup_count; // look-ups in the state, numbered for the machine to remember where they found what
    uint32_t param_count;  // the first slots: values that the host gives
    const Export *exports; // top-level bindings, in order: of a name bound several times the last counts
    uint32_t export_count;
    const Pragma *pragmas;
    uint32_t pragma_count;
    const Parameter *parameters; // in order
    uint32_t parameter_count;
    const DefineUse *define_uses; // of CompileOptions.defines, one by one
    const Str *imports;           // paths of the modules that it imports at its top level, as far as they are constant
    uint32_t import_count;
} Program;

// What compiling may ask of the host.
typedef struct CompileHost {
    void *user_data;
    // Parses another file for %include; NULL with a reason in *why (borrowed) if it cannot. The source must live as
    // long as the program, the tree until it is compiled.
    const Ast *(*include)(void *host, Str path, const Source **source, Str *reason);
    // Runs code in a fresh frame. False if that met anything dynamic (L17.2), a fault or a limit; then *value is null.
    // The value must live as long as the program: it is made in its arena, and dropped from there if the simplifier
    // has no use for it.
    bool (*evaluate)(void *host, const Code *code, Value *value);
} CompileHost;

typedef struct Define {
    const Symbol *name;
    Value value;
    const char *text; // name=value, as it was given
} Define;

typedef struct CompileOptions {
    bool module;           // neither engine names nor -D names are visible; unbound names are reported when reached
    bool lint;             // report what is hardly meant, too
    bool simplify;         // evaluate static parts now (L17.1)
    bool lines;            // note which lines instructions come from
    const Define *defines; // later ones count
    uint32_t define_count;
    const Symbol *const *params; // names of values that the host gives to each run; of equal ones the last counts
    uint32_t param_count;
    const struct Builtin *const *functions; // the host's, none of which has the name of a built-in
    uint32_t function_count;
    const struct FileAccess *files; // where modules come from, if it is not the disk; else NULL
    CompileHost host;
} CompileOptions;

// Compiles a parsed program. Faults are reported to the sink and never fatal. The program lives in `arena`, on its own;
// `scratch` takes what is needed until then and may be another one, for the syntax tree as well.
const Program *program_compile(Arena *arena, Arena *scratch, SymbolTable *symbols, const Source *source, const Ast *ast,
                               const CompileOptions *options, DiagSink *diags);

// The export of this name that counts, or NULL.
const Export *program_find_export(const Program *program, const Symbol *name);

// The parameter of this name, or NULL.
const Parameter *program_find_parameter(const Program *program, const Symbol *name);

const char *engine_name_text(EngineName name);
bool engine_name_exists(Str name);

// The program as indented text, for --dump=code.
void program_print(Text *out, const SymbolTable *symbols, const Program *program);

#endif
