// compile.h: what the compiler's files share: expressions (compile.c), names (scope.c) and what else they know.
#ifndef PETRI_PROGRAM_COMPILE_H
#define PETRI_PROGRAM_COMPILE_H

#include "program/program.h"

// What bound a name; decides what a lint says of it.
typedef enum BindingKind { BINDING_LET, BINDING_FUNC, BINDING_PARAM, BINDING_LOOP, BINDING_IMPORT } BindingKind;

// A name that is visible from here on. Bindings form a chain from the innermost outwards, one chain per function.
typedef struct Binding Binding;
struct Binding {
    Binding *outer;
    const Symbol *name;
    uint32_t slot;
    Span span;
    BindingKind kind;
    bool used;  // some name has been resolved to it
    bool known; // its value is `constant`, whatever the frame
    Value constant;
    // For %include: the syntax tree of the value and which of its unpacked elements this is. NULL: not static.
    const Ast *value;
    uint32_t element;
    uint32_t element_count;
};

// The function whose body is being compiled.
typedef struct FunctionScope FunctionScope;
struct FunctionScope {
    FunctionScope *outer;
    const Symbol *self; // its own name, visible inside, or NULL
    Binding *scope;
    uint32_t next_slot;
    uint32_t frame_size;
    const Expr **captures; // in the enclosing function
    const Symbol **capture_names;
    uint32_t capture_count;
    uint32_t capture_capacity;
    bool dynamic; // uses something that is not static (L17.2)
    // A scratch function that evaluates a static expression: outer names are found from here and become constants.
    FunctionScope *static_outer;
    Binding *static_scope;
};

typedef struct Compiler {
    Arena *arena;
    SymbolTable *symbols;
    const Source *source; // changes inside an included file
    const CompileOptions *options;
    DiagSink *diags;
    FunctionScope *function;
    bool ahead;       // compiling a syntax tree once more, for its static value
    uint32_t repeats; // loop bodies and functions around this place: it may be evaluated several times in a frame
    uint32_t places;  // look-ups so far
    bool is_module;   // the file only binds names: they are for others, so none is unused
    uint32_t depth;   // expressions around this place; 1: a statement of the top level
    DefineUse *define_uses;
    Parameter *parameters;
    uint32_t parameter_count;
    uint32_t parameter_capacity;
    Str *imports;
    uint32_t import_count;
    const Ast *subject; // to which attributes or children are being added
    const Ast *key;     // that is being looked up in the state
} Compiler;

typedef struct ScopeMark {
    Binding *scope;
    uint32_t next_slot;
} ScopeMark;

const Expr *compile_expr(Compiler *compiler, const Ast *ast);
// The code of an expression in a frame of so many slots.
const Code *compile_code(Compiler *compiler, const Expr *expr, uint32_t slot_count);
// FUNC as a value, whether it has a name or not.
const Expr *compile_closure(Compiler *compiler, const Ast *ast);
Expr *compile_expr_new(Compiler *compiler, ExprKind kind, const Ast *ast, const Expr *const *children, uint32_t count);
void compile_report(Compiler *compiler, Span span, DiagLevel level, const char *code, Str text, Str hint);

ScopeMark compile_scope_open(Compiler *compiler);
void compile_scope_close(Compiler *compiler, ScopeMark mark);
// Makes one name visible; returns its slot. `value` is its static syntax tree or NULL.
uint32_t compile_bind(Compiler *compiler, BindingKind kind, const Symbol *name, Span span, const Ast *value);
// Makes a NAMES node visible in consecutive slots; returns the first.
uint32_t compile_bind_names(Compiler *compiler, BindingKind kind, const Ast *names, const Ast *value);
// What one of `count` names gets of a value (L8.3).
Value compile_unpack(Compiler *compiler, Value value, uint32_t element, uint32_t count);
// Tells the `count` bindings made last that their value is a constant, to be unpacked if there are several.
void compile_set_known(Compiler *compiler, uint32_t count, Value value);
// The binding that a name has here, in this function or an enclosing one, or NULL. Does not count as a use.
const Binding *compile_find_binding(const Compiler *compiler, const Symbol *name);
const Expr *compile_name(Compiler *compiler, const Ast *ast);
void compile_function_open(Compiler *compiler, FunctionScope *function, const Symbol *self);
// Fills frame size and captures of `code` and returns to the enclosing function.
void compile_function_close(Compiler *compiler, FunctionScope *function, FunctionCode *code);
// The resolved path of an %include; false (after a diagnostic, or silently for null) if there is none.
bool compile_include_path(Compiler *compiler, const Ast *file, Str *path);

// The value of a syntax tree as it stands here; false if it is not static.
bool compile_static_value(Compiler *compiler, const Ast *ast, Value *value);
// Whether nothing but -D can give a name of the top level a value here.
bool compile_is_free(const Compiler *compiler, const Symbol *name);

// Parameters (parameters.c). Notes a binding of a `let` that is one; to be called before its value is compiled.
void compile_note_parameter(Compiler *compiler, const Ast *binding);
// Whether a name is that on the right of a parameter's binding.
bool compile_uses_parameter(const Compiler *compiler, const Ast *name);
// Notes where a program binds a name that -D defines.
void compile_note_define(Compiler *compiler, const Binding *binding);

// The simplifier (fold.c). `mark` is the function's next slot before the expression was compiled: slots from there on
// are its own. Returns the expression, or what is left of it after static parts have been evaluated.
const Expr *fold_expr(Compiler *compiler, Expr *expr, uint32_t mark);
// Notes what a new expression depends on, from its kind and children.
void fold_describe(Expr *expr);
// Notes that an expression depends on whatever `part` depends on.
void fold_depend(Expr *expr, const Expr *part);

// Lints, for `petri check`: things that are no faults but hardly meant (lint.c). All do nothing unless asked for.
void lint_bind(Compiler *compiler, const Binding *binding);
// Bindings from `scope` down to `end`, which go out of sight.
void lint_unused(Compiler *compiler, const Binding *scope, const Binding *end);
void lint_call(Compiler *compiler, const Ast *ast, const Expr *callee, const CallCode *code);
void lint_branches(Compiler *compiler, const Expr *expr);
void lint_negation(Compiler *compiler, const Ast *ast);
void lint_arith(Compiler *compiler, const Ast *ast, const Expr *expr);
void lint_import(Compiler *compiler, const Ast *ast, const Expr *file);
void lint_pragma(Compiler *compiler, const Ast *pragma);

#endif
