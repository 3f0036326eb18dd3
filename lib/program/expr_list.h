// expr_list.h: the kinds of expressions, one row each: what is simplified and then lowered to instructions.
//
// EXPR(KIND). children[] is named in the comment; `…` repeats.
// clang-format off
EXPR(CONST)    // value
EXPR(NODE)     // name: a fresh node of that kind
EXPR(SLOT)     // slot: a local of the current frame
EXPR(CAPTURE)  // slot: a value that the running closure captured
EXPR(SELF)     // the running closure
EXPR(GLOBAL)   // slot: an EngineName
EXPR(UNBOUND)  // name: reported when reached; null
EXPR(COMPOSE)  // part or binding…; slot: number of parts
EXPR(BIND)     // value; unpacked into slot_count slots from slot; null itself
EXPR(LET)      // BIND…; null itself
EXPR(FUNC)     // default… (CONST null where there is none); function: makes a closure
EXPR(IMPORT)   // file; names to bind from slot on; null itself
EXPR(FOR)      // source, body; names in slot_count slots from slot
EXPR(IF)       // test, value, [test, value]…, [else value]
EXPR(APPEND)   // parent, children
EXPR(DECORATE) // subject, attribute value…; decorations
EXPR(CALL)     // callee, argument…, named argument…; call
EXPR(OR)       // left, right
EXPR(XOR)      // left, right
EXPR(AND)      // left, right
EXPR(NOT)      // operand
EXPR(EQ)       // left, right
EXPR(NE)       // left, right
EXPR(LT)       // left, right; slot: 1 if both are one object
EXPR(GT)       // left, right; slot: 1 if both are one object
EXPR(LE)       // left, right; slot: 1 if both are one object
EXPR(GE)       // left, right; slot: 1 if both are one object
EXPR(IN)       // left, right
EXPR(RANGE)    // start, stop, step (CONST null where left out)
EXPR(ARITH)    // left, right; slot: an ArithOp
EXPR(NEG)      // operand
EXPR(POS)      // operand
EXPR(INDEX)    // vector, index
EXPR(LOOKUP)   // key
// clang-format on
