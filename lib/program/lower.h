// lower.h: lowering of expressions to code (lower.c), of loops and nodes (lower_node.c), and batch plans
// (lower_batch.c).
#pragma once

#include "program/code.h"
#include "program/expr.h"

typedef struct LowerOptions {
    Arena *arena;   // memory of the code
    Arena *values;  // memory of values that the code refers to; they may live longer than the code
    Arena *scratch; // temporary data
    // Points to a counter of the program's state lookups. Each lookup gets its value as a number and increases it.
    // NULL: lookups are not numbered.
    uint32_t *lookup_count;
    bool lines; // record the source line of each instruction
} LowerOptions;

// Returns the code of an expression that uses `slot_count` slots.
const Code *program_lower(const LowerOptions *options, const Expr *expr, uint32_t slot_count);

// The code under construction.
typedef struct Lowering {
    const LowerOptions *options;
    const Expr *origin_expr; // expression whose position was stored last in the code's arena
    const Origin *origin;    // stored position of origin_expr
    Instr *instrs;
    uint32_t *lines; // line of each instruction, if LowerOptions.lines is set
    uint32_t instr_count;
    uint32_t instr_capacity;
    int32_t *operands;
    uint32_t operand_count;
    uint32_t operand_capacity;
    Value *constants; // operand -1 refers to the first element; Code.constants has them in reverse order
    uint32_t constant_count;
    uint32_t constant_capacity;
    int32_t next_register;  // first unused register
    int32_t register_count; // maximum of next_register
    uint32_t loop_depth;    // number of enclosing loops
    uint32_t loop_count;    // maximum of loop_depth
    // Expression of the only node that an iteration of the innermost loop creates; NULL: none, or it cannot be batched.
    const Expr *yielded_node;
    uint32_t yielded_loop; // index of the instruction that starts the innermost loop
} Lowering;

// Destination of the value of an expression.
typedef struct Target {
    int32_t d;     // register
    bool to_loop;  // the value is yielded to `loop`, and `d` is not used
    uint16_t loop; // nesting depth of the loop
} Target;

// Appends an instruction with the position of `at`.
void lower_emit(Lowering *lowering, const Expr *at, Instr instr);
// Stores the position of an expression in the code's arena and returns it.
const Origin *lower_origin(Lowering *lowering, const Expr *expr);
// Returns a copy of names, in the code's arena.
const Symbol *const *lower_names(const Lowering *lowering, const Symbol *const *names, uint32_t count);
// Emits the instructions, if any, that compute an expression. Returns the operand that contains its value.
int32_t lower_operand(Lowering *lowering, const Expr *expr);
// Like lower_operand for several expressions. Returns the start of the list of their operands.
uint32_t lower_operands(Lowering *lowering, const Expr *const *exprs, uint32_t count);
// Emits a statement that only binds names.
void lower_statement(Lowering *lowering, const Expr *expr);
// Sets the target of the jump at index `jump` to the instruction that is emitted next.
void lower_patch_jump(Lowering *lowering, uint32_t jump);
void lower_if(Lowering *lowering, const Expr *expr, const Target *target);

void lower_for(Lowering *lowering, const Expr *expr, int32_t d);
// Emits a loop's body, or a part of it, and instructions that yield its values.
void lower_yields(Lowering *lowering, const Expr *expr, uint16_t loop);
void lower_yield(Lowering *lowering, int32_t a, uint16_t loop, const Expr *at);
// Returns the batch plan of the loop that starts at instruction `start`. All instructions emitted after `start` must be
// the loop's body. Returns NULL if the loop must be executed iteration by iteration.
const BatchPlan *lower_batch(const Lowering *lowering, uint32_t start);
// Emits a NODE, DECORATE or APPEND.
void lower_node(Lowering *lowering, const Expr *expr, int32_t d);
