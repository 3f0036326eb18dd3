// compile.h: what the compiler's files share: expressions (compile.c), names (scope.c) and what else they know.
#ifndef PETRI_PROGRAM_COMPILE_H
#define PETRI_PROGRAM_COMPILE_H

#include "program/expr.h"

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
    bool used;        // some name has been resolved to it
    bool is_constant; // its value is `constant`, whatever the frame
    Value constant;
    const Ast *value; // all of it is bound to this name; NULL: only a part, or something that is no value of a `let`
};

// The function whose body is being compiled.
typedef struct FunctionScope FunctionScope;
struct FunctionScope {
    FunctionScope *outer;
    const Symbol *self; // its own name, visible inside, or NULL
    Binding *scope;
    uint32_t next_slot;
    uint32_t frame_size;
    Capture *captures;
    const Symbol **capture_names;
    uint32_t capture_count;
    uint32_t capture_capacity;
};

// What an %include comes to.
typedef struct Include {
    const Ast *ast; // NULL: nothing
    const Source *source;
    Span span; // of the fault
    Str fault;
} Include;

typedef struct Compiler Compiler;
struct Compiler {
    Arena *arena;   // the program's
    Arena *scratch; // for what is dropped when it is compiled
    SymbolTable *symbols;
    const Source *source; // changes inside an included file
    const CompileOptions *options;
    DiagSink *diags;
    FunctionScope *function;
    bool in_include_path;  // compiling the file of an %include, where a test is meant to be known
    uint32_t repeats;      // loop bodies and functions around this place: it may be evaluated several times in a frame
    uint32_t lookup_count; // look-ups so far
    bool in_children;      // what is compiled next becomes children of a node, as it is or as a part of them
    bool is_module;        // the file only binds names: they are for others, so none is unused
    uint32_t depth;        // expressions around this place; 1: a statement of the top level
    DefineUse *define_uses;
    Parameter *parameters;
    uint32_t parameter_count;
    uint32_t parameter_capacity;
    Str *imports;
    uint32_t import_count;
    const Ast *subject;           // to which attributes or children are being added
    const Ast *key;               // that is being looked up in the state
    const Ast *parameter_use;     // the name on the right of the last parameter's binding: unbound, but meant so
    const Ast *parameter_default; // … and its default, if that is all there is on the right of an `or`
    Include *includes;            // in order
    uint32_t include_count;
    const Compiler *folding_pass; // without the simplifier: a compilation with it, for what has to be known beforehand
};

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
Expr *compile_constant(Compiler *compiler, const Ast *ast, Value value);
void compile_report(Compiler *compiler, Span span, DiagLevel level, const char *code, Str text, Str hint);

ScopeMark compile_scope_open(Compiler *compiler);
void compile_scope_close(Compiler *compiler, ScopeMark mark);
// Makes one name visible; returns its slot. `value` is the syntax tree of its value or NULL.
uint32_t compile_bind(Compiler *compiler, BindingKind kind, const Symbol *name, Span span, const Ast *value);
// Makes a NAMES node visible in consecutive slots; returns the first.
uint32_t compile_bind_names(Compiler *compiler, BindingKind kind, const Ast *names, const Ast *value);
// What one of `count` names gets of a value (L8.3).
Value compile_unpack(Compiler *compiler, Value value, uint32_t element, uint32_t count);
// Tells the `count` bindings made last that their value is a constant, to be unpacked if there are several.
void compile_set_constant(Compiler *compiler, uint32_t count, Value value);
// The binding that a name has here, in this function or an enclosing one, or NULL. Does not count as a use.
const Binding *compile_find_binding(const Compiler *compiler, const Symbol *name);
const Expr *compile_name(Compiler *compiler, const Ast *ast);
void compile_function_open(Compiler *compiler, FunctionScope *function, const Symbol *self);
// Returns to the enclosing function.
void compile_function_close(Compiler *compiler, FunctionScope *function);
// The built-in of this name, or the host's, or NULL.
const struct Builtin *compile_find_builtin(const Compiler *compiler, Str name);
// Whether nothing but -D can give a name of the top level a value here.
bool compile_is_free(const Compiler *compiler, const Symbol *name);

// Parameters (parameters.c). Notes a binding of a `let` that is one; to be called before its value is compiled.
void compile_note_parameter(Compiler *compiler, const Ast *binding);
// Notes what the default of the last parameter has been compiled to.
void compile_note_default(Compiler *compiler, const Expr *default_expr);
// Notes where a program binds a name that -D defines.
void compile_note_define(Compiler *compiler, const Binding *binding);

// The simplifier (fold.c). `mark` is the function's next slot before the expression was compiled: slots from there on
// are its own. Returns the expression, or what is left of it after static parts have been evaluated.
const Expr *fold_expr(Compiler *compiler, Expr *expr, uint32_t mark);
// Notes what a new expression depends on, from its kind and children.
void fold_set_dependencies(Expr *expr);
// Notes that an expression depends on whatever `part` depends on.
void fold_add_dependency(Expr *expr, const Expr *child);

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
