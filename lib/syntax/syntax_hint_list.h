// syntax_hint_list.h: what people bring along from other languages, and how Flitter says it.
//
// HINT(BEFORE, AFTER, "hint"): a hint for a syntax error whose line matches BEFORE up to the token that cannot stand
// there, and AFTER from that token on; both are extended regular expressions, and a comment counts as the end of the
// line. The first row that matches wins, so what is special comes first.
// clang-format off
#ifndef HINT
#define HINT(before, after, hint)
#endif
#define BEGIN "^[ \t]*"
#define BLANK "[ \t]*"
#define GAP "[ \t]+"
#define WORD "[A-Za-z_][A-Za-z0-9_]*"
#define COMMENT "comments start with --"
#define VECTOR "vectors are written with semicolons: 1;2;3"
#define TEXT "a text of several parts is written with semicolons: 'x=';x"
#define NO_BRACES "a block is what is indented: it has no braces"
#define NO_COLON "no colon here: the block is what is indented below"
#define FUNCTION "a function is written func f(x), with its value below, indented, or let f=func(x) x*2"
#define FILES "write import NAME from 'FILE.fl', or %include 'FILE.fl'"
#define FOR "a loop is written for i in ..10"
#define NO_TYPES "values have no types: let x=5"
#define LASTING "a name keeps its value for the frame; what goes on from frame to frame is the state, $(:name), or a !counter"
#define WHILE "there is no while: for i in ..10 repeats, if tests, and a !counter goes on from frame to frame"

// Comments.
HINT(BEGIN "$", "^#" BLANK "include", FILES)
HINT(BEGIN "$", "^(//|/[*])", COMMENT)
HINT("/$", "^[*]", COMMENT)
HINT("[*]$", "^/", COMMENT)
HINT(BEGIN "$", "^#", COMMENT)
HINT("", "^#([ \t#=-]|$)", COMMENT)
HINT("//" BLANK WORD "(" GAP WORD ")+", "", COMMENT "; // divides and rounds down")
HINT("//" BLANK WORD "$", "^[:.!?']", COMMENT "; // divides and rounds down")

// Functions.
HINT("(^|[^A-Za-z0-9_])(lambda|fn)(" GAP "[^:]*)?$", "^:", FUNCTION)
HINT("[=)]?" BLANK "$", "^=>", FUNCTION)
HINT("=$", "^>.*", FUNCTION)
HINT("-$", "^>", FUNCTION)
HINT(BEGIN "(def|function|fn|fun|sub|proc|void|defun)" GAP, "", FUNCTION)
HINT(BEGIN "(let|const|var)" GAP WORD BLANK "$", "^[(]", FUNCTION)
HINT(BEGIN "func.*[(,]" BLANK WORD BLANK "$", "^:", "values have no types: func f(x)")
HINT(BEGIN "func.*[)]" BLANK "$", "^->", "values have no types: func f(x)")
HINT(BEGIN "func.*[)]" BLANK "$", "^[^:{ \t]", FUNCTION)
HINT(BEGIN "return" GAP, "", "the last line of a function is its value: leave return away")

// Conditions and loops.
HINT(BEGIN "else" GAP "$", "^if", "write elif TEST")
HINT(BEGIN "(elseif|elsif)" GAP, "", "write elif TEST")
HINT(BEGIN "(if|elif)" GAP ".*$", "^then", "no then: the block is what is indented below")
HINT(BEGIN "for" GAP ".*$", "^do([^A-Za-z0-9_]|$)", "no do: the block is what is indented below")
HINT(BEGIN "while([ \t(]|$)", "", WHILE)
HINT(BEGIN "for" BLANK "$", "^[(]", FOR ", without parentheses")
HINT(BEGIN "for" GAP WORD BLANK "$", "^(=|:|of)", FOR)
HINT(BEGIN "for" GAP WORD BLANK "$", "^,", "several names are written with semicolons: for x;y in v")
HINT(BEGIN "(foreach|repeat|loop)" GAP, "", FOR)
HINT(BEGIN "(if|elif|else|for|func|where)([ \t(].*)?$", "^:([ \t]|$)", NO_COLON)
HINT("", "^[?]", "a choice is written A if TEST else B")

// Files.
HINT(BEGIN "(import|from)" GAP, "", FILES)
HINT(BEGIN "(include|require|use|using)" GAP, "", FILES)

// Names and types.
HINT(BEGIN "let" GAP "(" WORD "[;, \t]*)+$", "^:", NO_TYPES)
HINT(BEGIN "let" GAP "(" WORD "[;, \t]*)+$", "^,", "several names are written with semicolons: let x;y=1;2")
HINT(BEGIN "let" GAP "$", "^[(]", "several names are written with semicolons: let x;y=1;2")
HINT(BEGIN "(const|var|local|int|float|double|auto|val|string|bool)" GAP, "", "write let x=5")
HINT("[-+*/%|&^]$", "^=", LASTING)
HINT("[+][+]$", "^$", LASTING)
HINT(BEGIN WORD BLANK "$", "^:=", "to name a value write let x=5")

// Operators.
HINT("", "^&", "write A and B")
HINT("", "^[|]", "write A or B")
HINT("[=!]=$", "^=", "two signs are enough: == and !=")
HINT("<$", "^>", "write A != B")
HINT("", "^is([^A-Za-z0-9_]|$)", "write A == B")
HINT("", "^not" GAP "in([^A-Za-z0-9_]|$)", "write not x in v")
HINT("[^A-Za-z0-9_]not" GAP "$", "^in([^A-Za-z0-9_]|$)", "write not x in v")
HINT("", "^\\^", "a power is written x**2")

// Texts and numbers.
HINT("(^|[^A-Za-z0-9_])[bfruBFRU]$", "^['\"]", TEXT)
HINT("['\"]" BLANK "$", "^['\"]", TEXT)
HINT("['\"]" BLANK "%" BLANK "[(][^)]*$", "^,", TEXT)
HINT("", "^`", "a text stands in quotes: 'one'; " TEXT)
HINT("[0-9]$", "^[.]([^.]|$)", "write 1.0 or 1")
HINT("[0-9]%$", "^$", "% is the remainder of a division: a half is 0.5")
HINT("console$", "^[.]", "to see a value write debug(value)")
HINT(BEGIN "(import|%include)" GAP, "^[.]", FILES)
HINT("[A-Za-z0-9_)]$", "^[.]([^.]|$)", "nothing stands behind a dot: a function is sin(x), an element v[0]")

// Nodes.
HINT(BEGIN "$", "^<[A-Za-z/]", "a node is written !name a=1 b=2")
HINT(BEGIN "!.*;" BLANK WORD BLANK "$", "^=[^=]", "no semicolons between attributes: !name a=1 b=2")
HINT(BEGIN "let" GAP ".*;" BLANK WORD BLANK "$", "^=[^=]", "no semicolons between names: let a=1 b=2")
HINT(BEGIN "!.*" GAP WORD BLANK "$", "^:", "an attribute is written name=value")
HINT(BEGIN "!" WORD BLANK "$", "^[{].*[=:]", "attributes follow the name: !name a=1 b=2")

// Vectors and blocks.
HINT("", "^," BLANK WORD BLANK "=[^=]", "no commas here: name=value name=value")
HINT("", "^," BLANK "[^ \t]", VECTOR)
HINT("[=(;,]" BLANK "$", "^[{]", VECTOR)
HINT("", "^[{}]", NO_BRACES)
HINT(";$", "^$", "a statement ends with its line; a vector may not end in a semicolon")
// Last, for it is a guess: words behind what looks like a tag.
HINT("[ \t]#[A-Za-z]+" GAP "[A-Za-z]+$", "^($|[A-Za-z])", COMMENT)
// clang-format on

#undef HINT
#undef BEGIN
#undef BLANK
#undef GAP
#undef WORD
#undef COMMENT
#undef VECTOR
#undef TEXT
#undef NO_BRACES
#undef NO_COLON
#undef FUNCTION
#undef FILES
#undef FOR
#undef NO_TYPES
#undef LASTING
#undef WHILE
