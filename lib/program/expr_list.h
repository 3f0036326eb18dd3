// expr_list.h: the kinds of expressions.
//
// EXPR(KIND). The comment lists the children, where `…` means repetition, then the fields in use. SAME(KIND): the
// syntax tree has a node of this kind with the same children. PLAIN(KIND): like SAME; also, an instruction with this
// name exists, whose operands are the children's values.
// clang-format off
#ifndef SAME
#define SAME(kind) EXPR(kind)
#endif
#ifndef PLAIN
#define PLAIN(kind) SAME(kind)
#endif
EXPR(CONST)     // value
EXPR(NODE)      // name: a new node of that kind
EXPR(SLOT)      // slot: a local of the current frame
EXPR(CAPTURE)   // slot: a value that the running closure captured
EXPR(SELF)      // the running closure
EXPR(GLOBAL)    // slot: an EngineName
EXPR(UNBOUND)   // name; null, and reported when evaluated
SAME(COMPOSE)   // part or binding…; slot: number of parts, which are the children with values
EXPR(BIND)      // value; unpacked to slot_count slots from slot; has no value
EXPR(LET)       // BIND…; has no value
EXPR(FUNC)      // default… (CONST null: none); function; creates a closure
EXPR(IMPORT)    // file; names, bound to slot_count slots from slot; has no value
EXPR(FOR)       // source, body; names bound to slot_count slots from slot
SAME(IF)        // test, value, [test, value]…, [else value]
SAME(APPEND)    // parent, children
EXPR(DECORATE)  // subject, attribute value…; decorations
EXPR(CALL)      // callee, argument…, named argument…; call
SAME(OR)        // left, right
PLAIN(XOR)      // left, right
SAME(AND)       // left, right
PLAIN(NOT)      // operand
PLAIN(EQ)       // left, right
PLAIN(NE)       // left, right
PLAIN(LT)       // left, right; slot: 1 if both are the same object
PLAIN(GT)       // left, right; slot: 1 if both are the same object
PLAIN(LE)       // left, right; slot: 1 if both are the same object
PLAIN(GE)       // left, right; slot: 1 if both are the same object
PLAIN(IN)       // left, right
EXPR(RANGE)     // start, stop, step (CONST null: omitted)
PLAIN(ADD)      // left, right
PLAIN(SUB)      // left, right
PLAIN(MUL)      // left, right
PLAIN(DIV)      // left, right
PLAIN(FLOORDIV) // left, right
PLAIN(MOD)      // left, right
PLAIN(POW)      // left, right
PLAIN(NEG)      // operand
PLAIN(POS)      // operand
SAME(INDEX)     // vector, index
SAME(LOOKUP)    // key
#undef EXPR
#undef SAME
#undef PLAIN
// clang-format on
