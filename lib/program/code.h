// code.h: code of the VM: instructions that work on registers.
//
// A Code is compiled from a function, the main program or a module. Its registers are the slots, which hold the values
// of names, followed by temporaries. An operand is the number of a register. A negative operand refers to a constant:
// when the code is entered, its constants are copied to the memory directly before the first register. So constants and
// registers are read in the same way. An instruction with many operands refers to a list in Code.operands. Every
// instruction has a position in the source, for diagnostics. Code contains no pointers to data of the compiler.
//
// The code of a node, where r0 is the slot of i:
//
//   !particle id=i position=2*i;0       mul      r3 = 2 r0
//                                       compose  r3 = (r3, 0)
//                                       node     r4 = particle (r0, r3)
//
// Instructions are in the order of evaluation. The compiler neither reorders nor removes them.
#pragma once

#include "builtin/builtin.h"
#include "program/program.h"
#include "value/node.h"

typedef enum Opcode {
#define OPCODE(id, name, operands, batch) OP_##id,
#include "program/opcode_list.h"
    OP_COUNT
} Opcode;

// How the VM executes an instruction for a batch of a loop's iterations (BatchPlan).
typedef enum BatchKind {
    BATCH_NEVER,    // not at all: if the body contains the instruction, iterations are executed one by one
    BATCH_JUMP,     // selects the iterations that execute the next instructions; only for jumps ahead within the body
    BATCH_YIELD,    // collects the values that the iterations yield
    BATCH_LAST,     // after all other instructions; only for the last instruction of the body
    BATCH_MOVE,     // copies a column
    BATCH_UNPACK,   // writes several columns
    BATCH_PURE,     // calls a function for each iteration, or only once if the operands are equal in all iterations
    BATCH_DISTINCT, // calls a function for each iteration, because results must differ in identity or depend on order
} BatchKind;

#define CODE_NO_OPERAND INT32_MAX

// The constant parts of a node that one instruction creates.
typedef struct NodeCode {
    const Node *base;                  // prototype of the node, with its kind and tags
    const Symbol *const *names;        // names of the attributes, without duplicates
    const Origin *decorated;           // position of the node's tags and attributes; NULL: it has neither
    const NodeList *constant_children; // NULL: no children, or they are computed at run time
} NodeCode;

// Where a new closure finds a captured value.
typedef enum CaptureKind {
    CAPTURE_SLOT,  // in a slot of the enclosing function
    CAPTURE_OUTER, // among the captured values of the enclosing closure
    CAPTURE_SELF,  // the enclosing closure itself
} CaptureKind;

typedef struct Capture {
    CaptureKind kind;
    uint32_t slot; // number of the slot or of the captured value; unused for CAPTURE_SELF
} Capture;

typedef struct FunctionCode {
    Str name;                    // "<anon>" for an anonymous function
    const Symbol *const *params; // names of the parameters, whose values are in the first slots
    uint32_t param_count;
    uint32_t capture_count;
    const Capture *captures;
    const Code *code; // code of the body
} FunctionCode;

typedef struct CallCode {
    uint32_t arg_count;         // number of positional arguments, which precede the named ones
    const Symbol *const *names; // names of the named arguments
    uint32_t named_count;
} CallCode;

typedef struct DecorateCode {
    const Symbol *const *tags;
    uint32_t tag_count;
    const Symbol *const *names; // names of the attributes
} DecorateCode;

// Plan for a loop that can be executed in batches: each instruction is executed for a batch of iterations before the
// next instruction. The iterations must be independent, and their only effects must be errors and yielded values. A
// register that the body writes becomes a column, which has a value for each iteration.
typedef struct BatchPlan {
    uint32_t end;            // index of the loop's NEXT instruction
    int32_t first_register;  // register to which columns[0] belongs
    uint32_t register_count; // number of elements of `columns`
    // By register: number of its column, from 1; 0: no column, because the register has the same value in all
    // iterations.
    const uint8_t *columns;
    uint32_t column_count;
    uint32_t yield_count; // number of YIELD instructions in the body
} BatchPlan;

// Limits of a batch plan: columns, YIELD instructions, and operands that one instruction reads.
enum { CODE_MAX_COLUMNS = 64, CODE_MAX_YIELDS = 8, CODE_MAX_READ = 32 };

typedef struct Instr {
    uint16_t op;
    uint16_t loop; // instructions of loops: nesting depth of the loop, from 0
    // Register written, or first of the registers bound. YIELD_NODE: 1 if all data that the iteration allocated can be
    // freed after the node was added to a node batch; otherwise 0.
    int32_t d;
    union {
        int32_t a;
        uint32_t list; // index of the first operand in Code.operands
    };
    int32_t b; // NOT, NEG, POS: the same as `a`
    union {
        int32_t c;      // third operand
        uint32_t count; // number of operands in the list, or of registers bound
    };
    // Depends on the instruction: index of the instruction to jump to, or number of a capture, engine name or lookup.
    // YIELD_NODE: register of the loop variable.
    uint32_t target;
    const Origin *at; // position in the source
    union {
        const NodeCode *node;
        const NodeList *constant_children; // APPEND; NULL: the children are operand b
        const DecorateCode *decorate;
        const FunctionCode *function; // CLOSURE
        const CallCode *call;
        const Builtin *builtin;
        const BatchPlan *batch_plan; // FOR, FOR_RANGE; NULL: iterations are executed one by one
        const Symbol *name;          // UNBOUND
        const Symbol *const *names;  // IMPORT
        const Origin *inner_origin;  // SLICE: position of the range; LOOKUP: position of the key
    } as;
} Instr;

struct Code {
    // Source of the compiled expression; instructions from included files have other sources (Instr.at).
    const Source *source;
    const Instr *instrs;
    uint32_t count;
    uint32_t register_count;
    uint32_t slot_count; // number of slots; in the main program and in modules, they are initially null
    uint32_t loop_count; // maximum nesting depth of loops
    const int32_t *operands;
    const Value *constants; // operand -1 refers to the last constant
    uint32_t constant_count;
    const uint32_t *lines; // source line of each instruction, from 1; NULL: not recorded
};

extern const BatchKind program_batch_kinds[OP_COUNT];

// Stores in `reads` the operands that `instr` reads, and returns their number. An instruction in the body of a loop
// with a BatchPlan has at most CODE_MAX_READ operands. `operands` is Code.operands of the code that contains `instr`.
uint32_t program_operands_read(const int32_t *operands, const Instr *instr, int32_t *reads);
