// code.h: what the machine runs: expressions lowered to instructions over registers.
//
// Each function, the main program and each module is one Code. Its registers are the function's slots followed by
// temporaries. An operand is the number of a register, or a negative one: the constants are put just before the first
// register when the code is entered, so that both are read in the same way. Instructions that take several operands
// find their numbers in a list. Every instruction knows its place in the source, for diagnostics. Code refers to
// nothing that was only needed to make it.
//
//   !particle id=i position=2*i;0       mul      r3 = 2 r0
//                                       compose  r3 = (r3, 0)
//                                       node     r4 = particle (r0, r3)
//
// The order of evaluation is that of the expressions; nothing is moved or left out.
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

// A node that is made at once: what is known of it beforehand.
typedef struct NodeCode {
    const Node *base;                  // kind and tags
    const Symbol *const *names;        // of the attributes, each once
    const Origin *decorated;           // where they were added, or NULL
    const NodeList *constant_children; // constant children, or NULL
} NodeCode;

// What a closure takes along when it is made.
typedef enum CaptureKind {
    CAPTURE_SLOT,  // of the enclosing function
    CAPTURE_OUTER, // what the enclosing closure has captured
    CAPTURE_SELF,  // the enclosing closure
} CaptureKind;

typedef struct Capture {
    CaptureKind kind;
    uint32_t slot;
} Capture;

typedef struct FunctionCode {
    Str name;                    // "<anon>" without one
    const Symbol *const *params; // they have the first slots
    uint32_t param_count;
    uint32_t capture_count;
    const Capture *captures;
    const Code *code; // of the body
} FunctionCode;

typedef struct CallCode {
    uint32_t arg_count;         // positional
    const Symbol *const *names; // of the named ones
    uint32_t named_count;
} CallCode;

typedef struct DecorateCode {
    const Symbol *const *tags;
    uint32_t tag_count;
    const Symbol *const *names; // of the attributes
} DecorateCode;

// A loop of whose body many rounds can be run at once, instruction by instruction: no round depends on another one, and
// nothing is to be seen of them but their parts. Each register that the body writes is a column then, with a value for
// each round.
typedef struct BatchPlan {
    uint32_t end;            // the NEXT
    int32_t first_register;  // of the registers that may be columns,
    uint32_t register_count; // … which are so many;
    const uint8_t *columns;  // of each of them: which column it is, from 1; 0: none, it is the same in all rounds
    uint32_t column_count;
    uint32_t yield_count; // ADD_PARTs
} BatchPlan;

enum { CODE_MAX_COLUMNS = 64, CODE_MAX_YIELDS = 8, CODE_MAX_READ = 32 }; // registers that one instruction reads

typedef struct Instr {
    uint16_t op;
    uint16_t loop;
    int32_t d; // register written, or the first that is bound; YIELD_NODE: whether nothing else of the round stays
    union {
        int32_t a;
        uint32_t list; // position of the first operand in `operands`
    };
    int32_t b;
    union {
        int32_t c;
        uint32_t count; // of the list, or of the registers bound
    };
    uint32_t
        target; // instruction to jump to; number of a capture or a place; YIELD_NODE: the register of the loop's name
    const Origin *at;
    union {
        const NodeCode *node;
        const NodeList *constant_children; // APPEND: constant children, or NULL
        const DecorateCode *decorate;
        const FunctionCode *function; // CLOSURE
        const CallCode *call;
        const Builtin *builtin;
        const BatchPlan *batch_plan; // FOR, FOR_RANGE: NULL if rounds are run one by one
        const Symbol *name;          // UNBOUND
        const Symbol *const *names;  // IMPORT
        const Origin *inner_origin;  // SLICE: the place of the range; LOOKUP: that of the key
    } as;
} Instr;

struct Code {
    const Source *source; // in which it begins
    const Instr *instrs;
    uint32_t count;
    uint32_t register_count;
    uint32_t slot_count; // registers that names have; they start as null in the main program and in modules
    uint32_t loop_count; // greatest number of loops within each other
    const int32_t *operands;
    const Value *constants; // the last one is operand -1
    uint32_t constant_count;
    const uint32_t *lines; // of each instruction the line of the source, from 1; NULL unless asked for
};

// The operands that an instruction reads: CODE_MAX_READ at most if it belongs to a BatchPlan. `operands`: of the
// code.
uint32_t program_operands_read(const int32_t *operands, const Instr *instr, int32_t *reads);

#endif
