// expr_list.h: the kinds of executable expressions, one row each: what the machine evaluates.
//
// EXPR(KIND, "name in --dump=code"). children[] is named in the comment; `…` repeats.
// clang-format off
EXPR(CONST,   "const")    // value
EXPR(NODE,    "node")     // name: a fresh node of that kind
EXPR(SLOT,    "slot")     // slot: a local of the current frame
EXPR(CAPTURE, "capture")  // slot: a value that the running closure captured
EXPR(SELF,    "self")     // the running closure
EXPR(GLOBAL,  "global")   // slot: an EngineName
EXPR(UNBOUND, "unbound")  // name: reported when reached; null
EXPR(COMPOSE, "compose")  // part or binding…; slot: number of parts
EXPR(BIND,    "bind")     // value; unpacked into slot_count slots from slot; null itself
EXPR(LET,     "let")      // BIND…; null itself
EXPR(FUNC,    "func")     // function: makes a closure
EXPR(IMPORT,  "import")   // file; import: names to bind from slot on; null itself
EXPR(FOR,     "for")      // source, body; names in slot_count slots from slot
EXPR(IF,      "if")       // test, value, [test, value]…, [else value]
EXPR(APPEND,  "append")   // parent, children
EXPR(DECORATE,"decorate") // subject, attribute value…; decorations
EXPR(CALL,    "call")     // callee, argument…, named argument…; call
EXPR(OR,      "or")       // left, right
EXPR(XOR,     "xor")      // left, right
EXPR(AND,     "and")      // left, right
EXPR(NOT,     "not")      // operand
EXPR(EQ,      "eq")       // left, right
EXPR(NE,      "ne")       // left, right
EXPR(LT,      "lt")       // left, right; slot: 1 if both are one object
EXPR(GT,      "gt")       // left, right; slot: 1 if both are one object
EXPR(LE,      "le")       // left, right; slot: 1 if both are one object
EXPR(GE,      "ge")       // left, right; slot: 1 if both are one object
EXPR(IN,      "in")       // left, right
EXPR(RANGE,   "range")    // start, stop, step (CONST null where left out)
EXPR(ARITH,   "arith")    // left, right; slot: an ArithOp
EXPR(NEG,     "neg")      // operand
EXPR(POS,     "pos")      // operand
EXPR(INDEX,   "index")    // vector, index
EXPR(LOOKUP,  "lookup")   // key
// clang-format on
