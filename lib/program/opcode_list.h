// opcode_list.h: the instructions of the VM.
//
// OPCODE(ID, "name in --dump=code", "operands", BATCH): the VM has special code for the instruction.
// FUNCTION(ID, "name", "operands", BATCH, function): d is the result of vm_FUNCTION (vm/machine.h).
// NUMBERS(ID, "name", "operands", formula, function): if the operands are single numbers, d is the value of the
// formula, in which x is operand a and y is operand b; otherwise d is the result of vm_FUNCTION. BATCH is PURE.
//
// Each letter of the operands is one operand, in the order in which --dump=code prints them. d: register written; a, b,
// c: operands read; l: list of operands read; j: jump target; s: registers bound; o: loop; i: number (Instr.target);
// x: other data (Instr.as or Instr.target). BATCH says how a loop that contains the instruction is executed in batches:
// a BatchKind without its prefix (code.h).
// clang-format off
#ifndef FUNCTION
#define FUNCTION(id, name, operands, batch, function) OPCODE(id, name, operands, batch)
#endif
#ifndef NUMBERS
#define NUMBERS(id, name, operands, formula, function) FUNCTION(id, name, operands, PURE, function)
#endif
OPCODE(MOVE,         "move",       "da",   MOVE)             // d = a
FUNCTION(CAPTURE,    "capture",    "di",   PURE, capture)    // d = captured value number i of the running closure
FUNCTION(SELF,       "self",       "d",    PURE, self)       // d = the running closure
FUNCTION(GLOBAL,     "global",     "dx",   PURE, global)     // d = the value of an engine name
FUNCTION(UNBOUND,    "unbound",    "dx",   NEVER, unbound)   // d = null; reports the name as unbound
FUNCTION(COMPOSE,    "compose",    "dl",   PURE, compose)    // d = the composition of l
OPCODE(UNPACK,       "unpack",     "sa",   UNPACK)           // s = the elements of a
FUNCTION(CLOSURE,    "closure",    "dlx",  NEVER, closure)   // d = a closure; l: the defaults of its parameters
OPCODE(IMPORT,       "import",     "sa",   NEVER)            // s = names exported by the module with path a
OPCODE(FOR,          "for",        "osaj", NEVER)            // starts loop o over a: s = first elements, or jumps if there are none
OPCODE(RANGE_INIT,   "range init", "oabc", NEVER)            // prepares loop o over the range a..b|c
OPCODE(FOR_RANGE,    "for range",  "osj",  NEVER)            // starts the prepared loop: s = first number, or jumps if there is none
OPCODE(YIELD,        "yield",      "oa",   YIELD)            // adds a to the result of loop o
OPCODE(YIELD_NODE,   "yield node", "olx",  LAST)             // adds a node with attributes l to a batch in the result of loop o
OPCODE(NEXT,         "next",       "osj",  NEVER)            // s = next elements of loop o, and jumps back if there are any
OPCODE(END_LOOP,     "end loop",   "do",   NEVER)            // d = the result of loop o
OPCODE(JUMP,         "jump",       "j",    JUMP)
OPCODE(JUMP_TRUE,    "jump true",  "aj",   JUMP)             // jumps if a is true
OPCODE(JUMP_FALSE,   "jump false", "aj",   JUMP)             // jumps if a is false
FUNCTION(NODE,       "node",       "dlbx", DISTINCT, node)     // d = a node with attributes l, and with children b
FUNCTION(APPEND,     "append",     "dab",  DISTINCT, append)   // d = a with children b
FUNCTION(DECORATE,   "decorate",   "dblx", DISTINCT, decorate) // d = b with the expression's tags, and with attributes l
FUNCTION(CALL,       "call",       "dbl",  PURE, call)       // d = the result of b, called with l
FUNCTION(BUILTIN,    "builtin",    "dlx",  PURE, builtin)    // d = the result of a built-in, called with l
NUMBERS(XOR,         "xor",        "dab",  x == 0 ? y : y == 0 ? x : 0, xor)
NUMBERS(NOT,         "not",        "da",   x == 0, not)
NUMBERS(EQ,          "eq",         "dab",  x == y, equal)
NUMBERS(NE,          "ne",         "dab",  x != y, equal)
NUMBERS(LT,          "lt",         "dab",  x < y, order)
NUMBERS(GT,          "gt",         "dab",  !(x <= y), order) // true if an operand is NaN (L5.5)
NUMBERS(LE,          "le",         "dab",  x <= y, order)
NUMBERS(GE,          "ge",         "dab",  !(x < y), order)  // true if an operand is NaN
FUNCTION(IN,         "in",         "dab",  PURE, in)
FUNCTION(RANGE,      "range",      "dabc", PURE, range)      // d = a..b|c
NUMBERS(ADD,         "add",        "dab",  op_number(ARITH_ADD, x, y), arith) // ADD to POW: in the order of ArithOp
NUMBERS(SUB,         "sub",        "dab",  op_number(ARITH_SUB, x, y), arith)
NUMBERS(MUL,         "mul",        "dab",  op_number(ARITH_MUL, x, y), arith)
NUMBERS(DIV,         "div",        "dab",  op_number(ARITH_DIV, x, y), arith)
NUMBERS(FLOORDIV,    "floordiv",   "dab",  op_number(ARITH_FLOORDIV, x, y), arith)
NUMBERS(MOD,         "mod",        "dab",  op_number(ARITH_MOD, x, y), arith)
FUNCTION(POW,        "pow",        "dab",  PURE, arith)
NUMBERS(NEG,         "neg",        "da",   -x, negate)
NUMBERS(POS,         "pos",        "da",   x, plus)
FUNCTION(INDEX,      "index",      "dab",  PURE, index)      // d = a[b]
FUNCTION(SLICE,      "slice",      "dabc", PURE, slice)      // d = a[b..c]
FUNCTION(LOOKUP,     "lookup",     "dli",  DISTINCT, lookup) // d = state value for the key composed of l; i: number of the lookup
OPCODE(RETURN,       "return",     "a",    NEVER)            // ends the code with the result a
#undef OPCODE
#undef FUNCTION
#undef NUMBERS
// clang-format on
