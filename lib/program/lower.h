// lower.h: expressions to code; and what the files that do it share: lower.c, and lower_node.c for loops and nodes.
#ifndef PETRI_PROGRAM_LOWER_H
#define PETRI_PROGRAM_LOWER_H

#include "program/code.h"
#include "program/expr.h"

// How an expression is to be lowered.
typedef struct LowerOptions {
    Arena *arena;   // the code goes here
    Arena *values;  // parts of values that the code makes, which may outlive it
    Arena *scratch; // what is dropped afterwards
    uint32_t
        *lookup_count; // counts the look-ups of a program: raised by those in the expression; NULL: none is numbered
    bool lines;        // note the lines of instructions
} LowerOptions;

// The code of an expression that is evaluated in a frame of `slot_count` slots.
const Code *program_lower(const LowerOptions *options, const Expr *expr, uint32_t slot_count);

// The code under construction.
typedef struct Lowering {
    const LowerOptions *options;
    const Expr *origin_expr; // the expression whose place was put down last,
    const Origin *origin;    // … which is here
    Instr *instrs;
    uint32_t *lines; // as many as instructions, if wanted
    uint32_t instr_count;
    uint32_t instr_capacity;
    int32_t *operands;
    uint32_t operand_count;
    uint32_t operand_capacity;
    Value *constants; // the first one is operand -1
    uint32_t constant_count;
    uint32_t constant_capacity;
    int32_t next_register;
    int32_t register_count;
    uint32_t loop_depth;
    uint32_t loop_count;
    const Expr
        *yielded_node; // the node that each round of a loop makes, which may go into a run; NULL: there is no such node
    uint32_t yielded_loop; // … and the instruction that begins that loop
} Lowering;

// Where the value of an expression goes.
typedef struct Target {
    int32_t d;
    bool to_loop; // instead: it is a part of the result of the loop
    uint16_t loop;
} Target;

// Puts an instruction down; its place is that of `at`.
void lower_emit(Lowering *lowering, const Expr *at, Instr instr);
// The place of an expression, in the code.
const Origin *lower_origin(Lowering *lowering, const Expr *expr);
// A copy of names, in the code.
const Symbol *const *lower_names(const Lowering *lowering, const Symbol *const *names, uint32_t count);
// A register of its own until next_register is set back.
int32_t lower_temporary(Lowering *lowering);
int32_t lower_constant(Lowering *lowering, Value value);
// Emits what computes an expression and returns the operand that stands for its value.
int32_t lower_operand(Lowering *lowering, const Expr *expr);
uint32_t lower_operands(Lowering *lowering, const Expr *const *exprs, uint32_t count);
uint32_t lower_list(Lowering *lowering, const int32_t *operands, uint32_t count);
void lower_into(Lowering *lowering, const Expr *expr, int32_t d);
// A binding, whose value is null.
void lower_statement(Lowering *lowering, const Expr *expr);
// Makes a jump lead to what comes next.
void lower_patch_jump(Lowering *lowering, uint32_t jump);
void lower_if(Lowering *lowering, const Expr *expr, const Target *target);

void lower_for(Lowering *lowering, const Expr *expr, int32_t d);
// The value of a loop's body, or of a part of it.
void lower_yields(Lowering *lowering, const Expr *expr, uint16_t loop);
void lower_yield(Lowering *lowering, int32_t a, uint16_t loop, const Expr *at);
// Whether many rounds of the loop that begins with instruction `start` can be run at once, its body being all that
// follows; NULL if not.
const BatchPlan *lower_batch(const Lowering *lowering, uint32_t first);
// NODE, DECORATE and APPEND.
void lower_node(Lowering *lowering, const Expr *expr, int32_t d);

#endif
