// opcode_list.h: the instructions of the machine, one row each; see code.h for what the letters mean.
//
// OPCODE(ID, "name in --dump=code", "operands"). Operands that --dump=code shows, in order: d register written;
// a b c operand read; l the list of operands; j target of the jump; s registers bound; o loop; i number; x what was
// prepared.
// clang-format off
OPCODE(MOVE,       "move",       "da")   // d = a
OPCODE(CAPTURE,    "capture",    "di")   // d = what the running closure captured as number i
OPCODE(SELF,       "self",       "d")    // d = the running closure
OPCODE(GLOBAL,     "global",     "dx")   // d = a name of the engine
OPCODE(UNBOUND,    "unbound",    "dx")   // d = null, with a report
OPCODE(COMPOSE,    "compose",    "dl")   // d = the composition of l
OPCODE(UNPACK,     "unpack",     "sa")   // s = the elements of a
OPCODE(CLOSURE,    "closure",    "dlx")  // d = a closure; l: the defaults of its parameters
OPCODE(IMPORT,     "import",     "sa")   // s = names of the module whose file is a
OPCODE(FOR,        "for",        "osaj") // begins loop o over a: s = the first elements, or jumps if there are none
OPCODE(RANGE_INIT,       "range init",       "oabc") // prepares loop o to go over a..b|c
OPCODE(FOR_RANGE,   "for range",   "osj")  // begins the loop that was prepared
OPCODE(YIELD,   "yield",   "oa")   // adds a to the result of loop o
OPCODE(YIELD_NODE,    "yield node",    "olx")  // adds a node with attributes l to a run in the result of loop o
OPCODE(NEXT,       "next",       "osj")  // s = the next elements of loop o, and jumps back if there are any
OPCODE(END_LOOP,    "end loop",    "do")   // d = the result of loop o
OPCODE(JUMP,       "jump",       "j")
OPCODE(JUMP_TRUE,  "jump true",  "aj")   // if a is true
OPCODE(JUMP_FALSE, "jump false", "aj")   // if it is not
OPCODE(NODE,       "node",       "dlbx") // d = a node with attributes l, and with children b
OPCODE(APPEND,     "append",     "dab")  // d = a with children b
OPCODE(DECORATE,   "decorate",   "dblx") // d = b with the expression's tags, and with attributes l
OPCODE(CALL,       "call",       "dbl")  // d = the result of b, called with l
OPCODE(BUILTIN,    "builtin",    "dlx")  // d = the result of a built-in, called with l
OPCODE(XOR,        "xor",        "dab")
OPCODE(NOT,        "not",        "da")
OPCODE(EQ,         "eq",         "dab")
OPCODE(NE,         "ne",         "dab")
OPCODE(LT,         "lt",         "dab")  // here and in the next three, c: 1 if both are one object
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
OPCODE(LOOKUP,     "lookup",     "dli")  // d = the state under the key that l composes; i: the number of the place
OPCODE(RETURN,     "return",     "a")    // the value of the code
// clang-format on
