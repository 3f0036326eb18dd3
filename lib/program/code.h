// code.h: code of the VM: instructions that work on registers.
//
// A Code is compiled from a function, the main program or a module. Its registers are the slots, followed by
// temporaries. An operand is the number of a register. Negative numbers are constants, which are copied to the memory
// directly before the first register when the code is entered, so that both are read in the same way. Instructions with
// many operands refer to a list of numbers. Every instruction has a position in the source, for diagnostics. Code
// contains no pointers to data of the compiler.
//
//   !particle id=i position=2*i;0       mul      r3 = 2 r0
//                                       compose  r3 = (r3, 0)
//                                       node     r4 = particle (r0, r3)
//
// Instructions are in the order of evaluation. None is moved or omitted.
#ifndef PETRI_PROGRAM_CODE_H
#define PETRI_PROGRAM_CODE_H

#include "builtin/builtin.h"
#include "program/program.h"
#include "value/node.h"

typedef enum Opcode {
#define OPCODE(id, name, operands) OP_##id,
#include "program/opcode_list.h"
#undef OPCODE
    OP_COUNT
} Opcode;

#define CODE_NO_OPERAND INT32_MAX

// The constant parts of a node that one instruction creates.
typedef struct NodeCode {
    const Node *base;                  // kind and tags
    const Symbol *const *names;        // names of the attributes, without duplicates
    const Origin *decorated;           // position of the node with its attributes; NULL: it has none
    const NodeList *constant_children; // NULL: the children are not constant
} NodeCode;

// Where a new closure finds a captured value.
typedef enum CaptureKind {
    CAPTURE_SLOT,  // in a slot of the enclosing function
    CAPTURE_OUTER, // among the captured values of the enclosing closure
    CAPTURE_SELF,  // the enclosing closure itself
} CaptureKind;

typedef struct Capture {
    CaptureKind kind;
    uint32_t slot;
} Capture;

typedef struct FunctionCode {
    Str name;                    // "<anon>" for an anonymous function
    const Symbol *const *params; // parameters, which use the first slots
    uint32_t param_count;
    uint32_t capture_count;
    const Capture *captures;
    const Code *code; // code of the body
} FunctionCode;

typedef struct CallCode {
    uint32_t arg_count;         // number of positional arguments, which come first
    const Symbol *const *names; // names of the named arguments
    uint32_t named_count;
} CallCode;

typedef struct DecorateCode {
    const Symbol *const *tags;
    uint32_t tag_count;
    const Symbol *const *names; // names of the attributes
} DecorateCode;

// Plan for a loop whose iterations are independent and whose only effect is the values they yield, so that a batch of
// iterations can be executed one instruction at a time. Registers written by the body become columns.
typedef struct BatchPlan {
    uint32_t end;            // index of the NEXT instruction
    int32_t first_register;  // first register that may be a column
    uint32_t register_count; // number of registers that may be columns
    const uint8_t *columns;  // by register - first_register: column number from 1; 0: uniform
    uint32_t column_count;
    uint32_t yield_count; // number of YIELD instructions
} BatchPlan;

// Limits of a batch plan. CODE_MAX_READ limits the registers that one instruction reads.
enum { CODE_MAX_COLUMNS = 64, CODE_MAX_YIELDS = 8, CODE_MAX_READ = 32 };

typedef struct Instr {
    uint16_t op;
    uint16_t loop; // nesting depth of the loop, from 0
    int32_t d;     // register written, or first register bound; YIELD_NODE: 1 if the iteration retains nothing else
    union {
        int32_t a;
        uint32_t list; // index of the first operand in Code.operands
    };
    int32_t b;
    union {
        int32_t c;
        uint32_t count; // number of operands in the list, or of registers bound
    };
    // Instruction to jump to; number of a capture, engine name or lookup; YIELD_NODE: register of the loop's name.
    uint32_t target;
    const Origin *at; // position in the source
    union {
        const NodeCode *node;
        const NodeList *constant_children; // APPEND: NULL: not constant
        const DecorateCode *decorate;
        const FunctionCode *function; // CLOSURE
        const CallCode *call;
        const Builtin *builtin;
        const BatchPlan *batch_plan; // FOR, FOR_RANGE: NULL: iterations are executed one by one
        const Symbol *name;          // UNBOUND
        const Symbol *const *names;  // IMPORT
        const Origin *inner_origin;  // SLICE: position of the range; LOOKUP: position of the key
    } as;
} Instr;

struct Code {
    const Source *source; // source of its first instruction
    const Instr *instrs;
    uint32_t count;
    uint32_t register_count;
    uint32_t slot_count; // registers of names; null initially in the main program and in modules
    uint32_t loop_count; // maximum nesting depth of loops
    const int32_t *operands;
    const Value *constants; // the last constant is operand -1
    uint32_t constant_count;
    const uint32_t *lines; // source line of each instruction, from 1; NULL: not recorded
};

// Stores the operands that an instruction reads in `reads` and returns their number, at most CODE_MAX_READ for an
// instruction of a BatchPlan. `operands` is Code.operands.
uint32_t program_operands_read(const int32_t *operands, const Instr *instr, int32_t *reads);

#endif
