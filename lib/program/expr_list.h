// expr_list.h: the kinds of expressions, one row each.
//
// SAME(KIND): the syntax tree has a node of this kind with the same children; compile_same converts it.
// PLAIN(KIND): like SAME. In addition, instruction OP_KIND computes the value from the values of the children.
// EXPR(KIND): any other kind, for which the compiler has special code.
//
// The comment of a row lists the children, or `-` if there are none. After a semicolon, it describes the fields of Expr
// that this kind uses. `…`: zero or more. `[ ]`: optional. A kind that binds slots binds `slot_count` slots, beginning
// with number `slot`.
// clang-format off
#ifndef SAME
#define SAME(kind) EXPR(kind)
#endif
#ifndef PLAIN
#define PLAIN(kind) SAME(kind)
#endif
EXPR(CONST)     // -; value
EXPR(NODE)      // -; name: kind of the new node
EXPR(SLOT)      // -; slot: the slot that is read
EXPR(CAPTURE)   // -; slot: index of a value that the running closure captured
EXPR(SELF)      // -; its value is the running closure
EXPR(GLOBAL)    // -; slot: an EngineName
EXPR(UNBOUND)   // -; name; when evaluated, its value is null and the name is reported
SAME(COMPOSE)   // part or binding…; slot: number of parts, which are the children with values
EXPR(BIND)      // value; slots to which the value is unpacked; the BIND itself has no value
EXPR(LET)       // BIND…; the LET itself has no value
EXPR(FUNC)      // default of each parameter (CONST null: none); function; its value is a new closure
EXPR(IMPORT)    // file; names, and the slots to which they are bound; has no value
EXPR(FOR)       // source, body; slots of the loop's names; can_batch
SAME(IF)        // test, value, [test, value]…, [else value]
SAME(APPEND)    // parent, children
EXPR(DECORATE)  // subject, value of each attribute; decorate: tags and attribute names
EXPR(CALL)      // callee, argument…, named argument…; call: names of the named arguments
SAME(OR)        // left, right
PLAIN(XOR)      // left, right
SAME(AND)       // left, right
PLAIN(NOT)      // operand
PLAIN(EQ)       // left, right
PLAIN(NE)       // left, right
PLAIN(LT)       // left, right; slot: 1 if both operands are the same name
PLAIN(GT)       // left, right; slot: 1 if both operands are the same name
PLAIN(LE)       // left, right; slot: 1 if both operands are the same name
PLAIN(GE)       // left, right; slot: 1 if both operands are the same name
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
