// opcode_list.h: the instructions of the VM.
//
// OPCODE(ID, "name in --dump=code", "operands"). Each letter is one operand, in the order in which --dump=code
// prints them. d: register written; a, b, c: operands read; l: list of operands read; j: jump target; s: registers
// bound; o: loop; i: number (Instr.target); x: other data (Instr.as or Instr.target).
// clang-format off
OPCODE(MOVE,       "move",       "da")   // d = a
OPCODE(CAPTURE,    "capture",    "di")   // d = captured value number i of the running closure
OPCODE(SELF,       "self",       "d")    // d = the running closure
OPCODE(GLOBAL,     "global",     "dx")   // d = the value of an engine name
OPCODE(UNBOUND,    "unbound",    "dx")   // d = null; reports the name as unbound
OPCODE(COMPOSE,    "compose",    "dl")   // d = the composition of l
OPCODE(UNPACK,     "unpack",     "sa")   // s = the elements of a
OPCODE(CLOSURE,    "closure",    "dlx")  // d = a closure; l: the defaults of its parameters
OPCODE(IMPORT,     "import",     "sa")   // s = names exported by the module with path a
OPCODE(FOR,        "for",        "osaj") // starts loop o over a: s = first elements, or jumps if there are none
OPCODE(RANGE_INIT,       "range init",       "oabc") // prepares loop o over the range a..b|c
OPCODE(FOR_RANGE,   "for range",   "osj")  // starts the prepared loop: s = first number, or jumps if there is none
OPCODE(YIELD,   "yield",   "oa")   // adds a to the result of loop o
OPCODE(YIELD_NODE,    "yield node",    "olx")  // adds a node with attributes l to a batch in the result of loop o
OPCODE(NEXT,       "next",       "osj")  // s = next elements of loop o, and jumps back if there are any
OPCODE(END_LOOP,    "end loop",    "do")   // d = the result of loop o
OPCODE(JUMP,       "jump",       "j")
OPCODE(JUMP_TRUE,  "jump true",  "aj")   // jumps if a is true
OPCODE(JUMP_FALSE, "jump false", "aj")   // jumps if a is false
OPCODE(NODE,       "node",       "dlbx") // d = a node with attributes l, and with children b
OPCODE(APPEND,     "append",     "dab")  // d = a with children b
OPCODE(DECORATE,   "decorate",   "dblx") // d = b with the expression's tags, and with attributes l
OPCODE(CALL,       "call",       "dbl")  // d = the result of b, called with l
OPCODE(BUILTIN,    "builtin",    "dlx")  // d = the result of a built-in, called with l
OPCODE(XOR,        "xor",        "dab")
OPCODE(NOT,        "not",        "da")
OPCODE(EQ,         "eq",         "dab")
OPCODE(NE,         "ne",         "dab")
OPCODE(LT,         "lt",         "dab")  // LT, GT, LE and GE also use Instr.c
OPCODE(GT,         "gt",         "dab")
OPCODE(LE,         "le",         "dab")
OPCODE(GE,         "ge",         "dab")
OPCODE(IN,         "in",         "dab")
OPCODE(RANGE,      "range",      "dabc") // d = a..b|c
OPCODE(ADD,        "add",        "dab")
OPCODE(SUB,        "sub",        "dab")
OPCODE(MUL,        "mul",        "dab")
OPCODE(DIV,        "div",        "dab")
OPCODE(FLOORDIV,   "floordiv",   "dab")
OPCODE(MOD,        "mod",        "dab")
OPCODE(POW,        "pow",        "dab")
OPCODE(NEG,        "neg",        "da")
OPCODE(POS,        "pos",        "da")
OPCODE(INDEX,      "index",      "dab")  // d = a[b]
OPCODE(SLICE,      "slice",      "dabc") // d = a[b..c]
OPCODE(LOOKUP,     "lookup",     "dli")  // d = state value for the key composed of l; i: number of the lookup
OPCODE(RETURN,     "return",     "a")    // ends the code with the result a
// clang-format on
