// ast_list.h: the kinds of syntax tree nodes, one row each.
//
// AST(KIND, "name in --dump=ast"). The comment of a row lists the children. `names` is a child of kind NAMES. `?`
// marks a child that can be NULL, `…` zero or more children of a kind, and `[ ]` children that can be absent. If `name`
// or `value` is alone or before a semicolon, it is not a child but the field Ast.name or Ast.value.
// clang-format off
AST(LITERAL,    "literal")      // value; a number, string or symbol
AST(NODE,       "node")         // name; the kind of the new node
AST(NAME,       "name")         // name
AST(NAMES,      "names")        // NAME…
AST(COMPOSE,    "compose")      // part…
AST(SUITE,      "suite")        // statement…, including LET, FUNC and IMPORT
AST(LET,        "let")          // BINDING…
AST(LET_STABLE, "let-stable")   // BINDING…
AST(BINDING,    "binding")      // names, value
AST(FUNC,       "func")         // name or NULL; PARAMS, body
AST(PARAMS,     "params")       // PARAM…
AST(PARAM,      "param")        // name; default?
AST(IMPORT,     "import")       // names, file
AST(INCLUDE,    "include")      // file
AST(PRAGMA,     "pragma")       // name; value
AST(FOR,        "for")          // names, source, body
AST(IF,         "if")           // test, suite, [test, suite]…, [else suite]
AST(APPEND,     "append")       // parent, children
AST(DECORATE,   "decorate")     // subject, TAG or ATTR…
AST(TAG,        "tag")          // name
AST(ATTR,       "attr")         // name; value
AST(TEMPLATE,   "template")     // callee, ATTR…, [SUITE]
AST(COND,       "cond")         // then, test, else?
AST(WHERE,      "where")        // body, BINDING…
AST(OR,         "or")           // left, right
AST(XOR,        "xor")          // left, right
AST(AND,        "and")          // left, right
AST(NOT,        "not")          // operand
AST(EQ,         "==")           // left, right
AST(NE,         "!=")           // left, right
AST(LT,         "<")            // left, right
AST(GT,         ">")            // left, right
AST(LE,         "<=")           // left, right
AST(GE,         ">=")           // left, right
AST(IN,         "in")           // left, right
AST(RANGE,      "range")        // start?, stop, step?
AST(ADD,        "+")            // left, right
AST(SUB,        "-")            // left, right
AST(MUL,        "*")            // left, right
AST(DIV,        "/")            // left, right
AST(FLOORDIV,   "//")           // left, right
AST(MOD,        "%")            // left, right
AST(POW,        "**")           // left, right
AST(NEG,        "neg")          // operand
AST(POS,        "pos")          // operand
AST(CALL,       "call")         // callee, argument…, NAMED…
AST(NAMED,      "named")        // name; value
AST(INDEX,      "index")        // vector, index
AST(LOOKUP,     "lookup")       // key
// clang-format on
