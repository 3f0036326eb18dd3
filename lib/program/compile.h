// compile.h: internal declarations of the compiler. Its files, from those that call to those that are called:
//
//   compile.c     syntax tree to expressions
//   scope.c       scopes, and the expression that a name becomes
//   parameters.c  what `let NAME=NAME or DEFAULT` declares
//   lint*.c       mistakes; key_uses.c: state keys; optional.c: uses of names that may be unbound
//   names.c       what a name is bound to, and hints about names that nothing binds
//   fold.c        the simplifier, which calls the expressions' code: lower.c, lower_node.c, lower_batch.c
//   expr.c        new expressions, and reports
#pragma once

#include "program/expr.h"

// The construct that binds a name. It determines which lints apply.
typedef enum BindingKind { BINDING_LET, BINDING_FUNC, BINDING_PARAM, BINDING_LOOP, BINDING_IMPORT } BindingKind;

// What lints need to know about the value of a name that a `let` or a loop binds.
typedef struct Traits {
    bool is_fixed;      // it certainly is the same in every frame
    bool follows_clock; // it depends on a name such as `time`
    bool counts;        // it is an element of a range of whole numbers
    bool is_whole;      // it is a whole number
    double largest;     // if is_whole: the largest absolute value of the constants from which it is computed
} Traits;

// A visible name. The bindings of a function form a linked list that starts with the innermost binding.
typedef struct Binding Binding;
struct Binding {
    Binding *outer;
    const Symbol *name;
    uint32_t slot;
    Span span;
    BindingKind kind;
    bool used;        // a use of the name was resolved to this binding
    bool is_constant; // the value is always `constant`
    Traits traits;
    Value constant;
    // Syntax tree of the value; NULL: the name is one of several of a `let`, or is not bound by `let` or `func`.
    const Ast *value;
};

// The function whose body is being compiled.
typedef struct FunctionScope FunctionScope;
struct FunctionScope {
    FunctionScope *outer;
    const Symbol *self;  // name of the function, visible in its body; NULL: none
    Binding *scope;      // innermost visible binding
    uint32_t next_slot;  // first free slot
    uint32_t frame_size; // maximum of next_slot
    Capture *captures;
    const Symbol **capture_names; // names of the elements of `captures`
    uint32_t capture_count;
    uint32_t capture_capacity;
};

// Result of an %include.
typedef struct Include {
    const Ast *ast; // NULL: nothing to include
    const Source *source;
    Span span; // position at which an error is reported
    Str error; // error message; empty: none
} Include;

typedef struct NameUses NameUses;
typedef struct Compiler Compiler;
struct Compiler {
    Arena *arena;   // data of the program
    Arena *scratch; // temporary data of the compilation
    SymbolTable *symbols;
    const Source *source; // file that is being compiled: the program's source, or an included file
    const CompileOptions *options;
    DiagSink *diags;
    FunctionScope *function;
    bool in_include_path; // the path of an %include is being compiled; lints are off
    // Number of enclosing loops and functions, plus 1 in a module; if > 0, the code may be executed repeatedly in a
    // frame.
    uint32_t repeats;
    // Number of enclosing functions, and of enclosing loops and `if` that depend on more than constants. If 0, the code
    // is executed in the same way in every frame.
    uint32_t varies;
    bool restarts;         // a system was compiled that may start later than in the first frame
    uint32_t lookup_count; // number of state lookups so far
    uint32_t lookups;      // number of enclosing state lookups
    KeyUses keys;
    bool in_children; // the value of the expression compiled next becomes all or some of a node's children
    bool is_module;   // the file only binds names, for other files to import, so no name is reported as unused
    uint32_t depth;   // nesting depth of the current expression; 1: a top-level statement
    DefineUse *define_uses;
    Parameter *parameters;
    uint32_t parameter_count;
    uint32_t parameter_capacity;
    Str *imports;
    uint32_t import_count;
    const Ast *root;              // the whole file
    NameUses *uses;               // uses of names in `root` and in included files; NULL: not collected yet (optional.c)
    const Ast *subject;           // latest expression to which attributes or children are added; used for a hint
    const Ast *key;               // key of the latest state lookup; used for a hint
    const Ast *state_attr;        // value of the latest attribute `state`; used for a hint
    const Ast *parameter_use;     // NAME of the last parameter `let X=NAME or DEFAULT`; not reported if unbound
    const Ast *parameter_test;    // second NAME of `let X=NAME if NAME != null else DEFAULT`, or NULL
    const Ast *parameter_default; // DEFAULT of the last parameter; NULL: the right side has several `or`
    Include *includes;            // in order of the %include directives
    uint32_t include_count;
    // If the simplifier is off, the program is first compiled with it. This is the compiler of that first compilation,
    // from which the included files and the defaults of parameters are taken. Otherwise NULL.
    const Compiler *folding_pass;
};

// State that is restored at the end of a scope.
typedef struct ScopeMark {
    Binding *scope;
    uint32_t next_slot;
} ScopeMark;

Expr *compile_expr_new(Compiler *compiler, ExprKind kind, const Ast *ast, const Expr *const *children, uint32_t count);
Expr *compile_constant(Compiler *compiler, const Ast *ast, Value value);
// Sets the dependencies of a new expression, which follow from its kind and its children.
void compile_set_dependencies(Expr *expr);
void compile_report(Compiler *compiler, Span span, DiagLevel level, const char *code, Str text, Str hint);

ScopeMark compile_scope_open(Compiler *compiler);
void compile_scope_close(Compiler *compiler, ScopeMark mark);
// Binds one name and returns its slot. `value` is the syntax tree of the name's value, or NULL (Binding.value).
uint32_t compile_bind(Compiler *compiler, BindingKind kind, const Symbol *name, Span span, const Ast *value);
// Binds the names of a NAMES node in consecutive slots and returns the first slot. `value` is the syntax tree of their
// value or, for a loop, of its source; NULL: none.
uint32_t compile_bind_names(Compiler *compiler, BindingKind kind, const Ast *names, const Ast *value);
// Marks the last `count` bindings as constant, with this value. If `count` is greater than 1, the value is unpacked to
// them.
void compile_set_constant(Compiler *compiler, uint32_t count, Value value);
// Returns the innermost binding of a name from `scope` outwards, or NULL.
Binding *compile_scope_find(Binding *scope, const Symbol *name);
// Returns the visible binding of a name in the current or an enclosing function, or NULL. Does not mark the binding as
// used.
const Binding *compile_find_binding(const Compiler *compiler, const Symbol *name);
const Expr *compile_name(Compiler *compiler, const Ast *ast);
// Returns true if the use `ast` of an unbound name is only a test: the left side of `or` or `and`, the operand of
// `not`, or a test of `if`.
bool compile_is_tested(Compiler *compiler, const Ast *ast);
// Returns true if the script tests the name somewhere, once per name: later calls return false.
bool compile_list_optional(Compiler *compiler, const Symbol *name);
// Returns how often the name is used, at most 3.
uint32_t compile_count_uses(Compiler *compiler, const Symbol *name);
// Returns true if there is a hint about the probable cause of an unbound name in the value of the name `bound`, such as
// a similar name.
bool compile_has_hint(Compiler *compiler, const Ast *use, const Symbol *bound);
// Returns a hint about the probable cause of an unbound name, or an empty string.
Str compile_unbound_hint(Compiler *compiler, const Ast *ast);
// Adds the uses of names in an included file.
void compile_add_uses(Compiler *compiler, const Ast *ast);
void compile_function_open(Compiler *compiler, FunctionScope *function, const Symbol *self);
// Ends a function and continues with the enclosing function.
void compile_function_close(Compiler *compiler, FunctionScope *function);
// Returns the built-in or host function with this name, or NULL.
const struct Builtin *compile_find_builtin(const Compiler *compiler, Str name);
// Returns the EngineName that a name has in a main program, or -1. *is_static becomes whether its value never changes.
int compile_find_engine_name(const Compiler *compiler, Str name, bool *is_static);
// Returns true if a name can get a value only from a definition (-D) at this point of the top level.
bool compile_is_free(const Compiler *compiler, const Symbol *name);

// Parameters (parameters.c).
// Records `binding` as a parameter if it declares one (Parameter). Called for each binding of a `let` before the value
// of the binding is compiled.
void compile_note_parameter(Compiler *compiler, const Ast *binding);
// Records the compiled default of the last parameter.
void compile_note_default(Compiler *compiler, const Expr *default_expr);
// If -D defines the name of `binding`, records where the program first binds it.
void compile_note_define(Compiler *compiler, const Binding *binding);

// Uses of state keys (key_uses.c).
// Record a literal; a lookup whose value is only tested (ignores other expressions); a vector.
void compile_note_literal(Compiler *compiler, const Ast *ast);
void compile_note_test(Compiler *compiler, const Ast *ast);
void compile_note_vector(Compiler *compiler, const Ast *vector);

// The simplifier (fold.c).
// Replaces an expression with a constant, or with a simpler expression, if possible. Otherwise returns the expression
// itself. `mark` is FunctionScope.next_slot before the expression was compiled, so the names that the expression binds
// have slots >= mark.
const Expr *fold_expr(Compiler *compiler, Expr *expr, uint32_t mark);

// Lints of mistakes (lint.c, lint_angles.c, lint_nodes.c), which every load reports.
// Warns if the value of `ast`, where numbers are needed, is a stream of random numbers. lint_streams checks each child.
void lint_stream(Compiler *compiler, const Ast *ast);
void lint_streams(Compiler *compiler, const Ast *ast);
// Check angles in the arguments of a CALL, and in an attribute of a node.
void lint_call_angles(Compiler *compiler, const Ast *call);
void lint_attribute_angles(Compiler *compiler, const Symbol *node, const Ast *attr);
// Checks the attributes of a node. The names in them must still be visible.
void lint_node(Compiler *compiler, const Ast *decorate);
// Returns true if an expression is a range of whole numbers.
bool lint_is_count(const Compiler *compiler, const Ast *ast);
// Returns true if an expression is always a whole number: whole constants and names of loops over whole numbers, and
// their sums and products. *largest becomes the largest absolute value of the constants if that is larger.
bool lint_is_whole(const Compiler *compiler, const Ast *ast, double *largest);
// Returns true if an expression certainly has the same value in every frame. The names in it must still be visible.
bool lint_is_fixed(const Compiler *compiler, const Ast *ast);
// Returns the traits of a name that is bound to the value of an expression or, in a loop, to its elements.
Traits lint_traits(const Compiler *compiler, const Ast *value);

// Lints for `petri check` (lint.c): code that is valid but unlikely to be intended. They do nothing unless
// CompileOptions.lint is set.
void lint_bind(Compiler *compiler, const Binding *binding);
// Called at the end of a scope. Reports its unused names: the bindings from `scope` up to, but not including, `end`.
void lint_unused(Compiler *compiler, const Binding *scope, const Binding *end);
void lint_call(Compiler *compiler, const Ast *ast, const Expr *callee, const CallCode *code);
void lint_branches(Compiler *compiler, const Expr *expr);
void lint_negation(Compiler *compiler, const Ast *ast);
void lint_arith(Compiler *compiler, const Ast *ast, const Expr *expr);
void lint_import(Compiler *compiler, const Ast *ast, const Expr *file);
void lint_pragma(Compiler *compiler, const Ast *pragma);
