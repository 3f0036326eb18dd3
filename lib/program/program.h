// program.h: a compiled program: names resolved to slots, constants in place, nothing left to look up.
//
// A program is an immutable tree of expressions, and the code they come down to (code.h), in one arena, replaced as a
// whole on reload. Every function, the main
// program and every module runs in a frame of slots; a nested function reaches outer values only through what it has
// captured by value when it was defined (spec language.md L9.1).
#ifndef PETRI_PROGRAM_PROGRAM_H
#define PETRI_PROGRAM_PROGRAM_H

#include "base/diag.h"
#include "ast/ast.h"
#include "value/node.h"
#include "value/ops.h"
#include "value/value.h"

typedef enum ExprKind {
#define EXPR(kind) EXPR_##kind,
#include "program/expr_list.h"
#undef EXPR
} ExprKind;

typedef enum EngineName {
#define ENGINE_NAME(id, text, is_static) ENGINE_##id,
#include "program/engine_names.h"
#undef ENGINE_NAME
    ENGINE_NAME_COUNT
} EngineName;

typedef struct Expr Expr;
typedef struct Code Code; // program/code.h

typedef struct FunctionCode {
    Str name; // "<anon>" without one
    uint32_t param_count;
    const Symbol *const *params;
    const Expr *const *defaults; // evaluated at the definition; NULL entries have none
    const Expr *body;
    const Code *code;    // of the body
    uint32_t frame_size; // slots: parameters first
    uint32_t capture_count;
    const Expr *const *captures; // evaluated at the definition, in the enclosing frame
} FunctionCode;

typedef struct ImportCode {
    const Symbol *const *names;
    uint32_t count;
} ImportCode;

typedef struct CallCode {
    uint32_t arg_count;         // positional
    const Symbol *const *names; // of the named ones
    uint32_t named_count;
} CallCode;

typedef struct DecorateCode {
    const Symbol *const *tags;
    uint32_t tag_count;
    const Symbol *const *names; // of the attributes
    const Span *spans;          // … and where they stand
    uint32_t attr_count;
} DecorateCode;

struct Expr {
    ExprKind kind;
    uint32_t count; // children
    uint32_t slot;
    uint32_t slot_count;
    // For the simplifier (fold.c): what the value depends on.
    bool dynamic;    // something that may change from frame to frame
    bool enclosed;   // the running closure: its captures or itself
    uint32_t lowest; // the lowest slot that is read, UINT32_MAX if none
    const Source *source;
    Span span;
    union {
        Value value;        // CONST
        const Symbol *name; // NODE, UNBOUND
        const FunctionCode *function;
        const ImportCode *import;
        const CallCode *call;
        const DecorateCode *decorate;
        const NodeList *kept; // APPEND: the children, if they are constant; or NULL
    } as;
    const Expr *const *children;
};

// Is an expression a statement that binds names and has no value of its own?
static inline bool expr_only_binds(const Expr *expr) {
    return expr->kind == EXPR_BIND || expr->kind == EXPR_LET || expr->kind == EXPR_IMPORT;
}

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
    Span span;      // of the name
    const Ast *use; // the name on the right: unbound, but meant so
    Str fallback;   // text of the default
    bool is_static; // the default is the same in every frame: `value`
    Value value;
    Str comment;  // without the range at its start
    double least; // the comment's range, with its ends; infinite where it says nothing
    double most;
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
    const Expr *body;
    const Code *code; // of the body
    uint32_t frame_size;
    uint32_t place_count;  // look-ups in the state, numbered for the machine to remember where they found what
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
    void *host;
    // Parses another file for %include; NULL with a reason in *why (borrowed) if it cannot. The tree must live as long
    // as the program.
    const Ast *(*include)(void *host, Str path, const Source **source, Str *why);
    // Evaluates an expression that reads no slot from outside, in a fresh frame. False if that met anything dynamic
    // (L17.2), a fault or a limit; then *value is null. The value must live as long as the program.
    bool (*evaluate)(void *host, const Expr *expr, uint32_t frame_size, Value *value);
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
    CompileHost host;
} CompileOptions;

// Compiles a parsed program. Faults are reported to the sink and never fatal. Everything lives in the arena.
const Program *program_compile(Arena *arena, SymbolTable *symbols, const Source *source, const Ast *ast,
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
