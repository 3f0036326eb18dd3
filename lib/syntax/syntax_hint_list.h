// syntax_hint_list.h: hints for syntax errors caused by habits from other languages.
//
// HINT(BEFORE, AFTER, "hint"). BEFORE must match the part of the line to the left of the unexpected token, and AFTER
// the rest of the line, from the token on. Both are POSIX extended regular expressions. If a comment starts at the
// token, AFTER is matched with an empty text. The first matching row is used, so special cases come first.
// clang-format off
#ifndef HINT
#define HINT(before, after, hint)
#endif
#define BEGIN "^[ \t]*"
#define BLANK "[ \t]*"
#define GAP "[ \t]+"
#define WORD "[A-Za-z_][A-Za-z0-9_]*"
#define COMMENT "comments start with '--'"
#define VECTOR "separate vector elements with semicolons: 1;2;3"
#define TEXT "join strings and values with semicolons: 'x=';x"
#define NO_BRACES "indent the block instead of using braces"
#define NO_COLON "remove the colon and indent the block below"
#define FUNCTION "write 'func f(x)' with its value indented below, or 'let f=func(x) x*2'"
#define FILES "write 'import NAME from \"FILE.fl\"' or '%include \"FILE.fl\"'"
#define FOR "write a loop as 'for i in ..10'"
#define NO_TYPES "remove the type: let x=5"
#define LASTING \
    "names keep their values for one frame only; for values that last, use the state, '$(:name)', or a !counter"
#define ATTRIBUTES "write attributes as 'name=value', such as text='hello'"
#define NO_UNIT "remove the unit; lengths are pixels, times are seconds"
#define TURNS "write angles in turns: 90deg, or 2/tau for 2 radians"
#define BELOW "put the node on the next line, indented"
#define WHILE "use 'for i in ..10' to repeat, 'if' to test, or a !counter to count from frame to frame"

// Lines that begin with %.
HINT(BEGIN "$", "^%" BLANK "pragma" GAP, "move the pragma to the top of the script, before all other lines")
HINT(BEGIN "$", "^%[A-Za-z_]", "lines that begin with % are '%pragma NAME VALUE' and '%include \"FILE.fl\"'")

// Comments.
HINT(BEGIN "$", "^#" BLANK "include", FILES)
HINT(BEGIN "$", "^(//|/[*])", COMMENT)
HINT("/$", "^[*]", COMMENT)
HINT("[*]$", "^/", COMMENT)
HINT(BEGIN "$", "^#", COMMENT)
HINT("", "^#([ \t#=-]|$)", COMMENT)
HINT("//" BLANK WORD "(" GAP WORD ")+", "", COMMENT "; '//' divides and rounds down")
HINT("//" BLANK WORD "$", "^[:.!?']", COMMENT "; '//' divides and rounds down")

// Functions.
HINT("(^|[^A-Za-z0-9_])(lambda|fn)(" GAP "[^:]*)?$", "^:", FUNCTION)
HINT("[=)]?" BLANK "$", "^=>", FUNCTION)
HINT("=$", "^>.*", FUNCTION)
HINT("-$", "^>", FUNCTION)
HINT(BEGIN "(def|function|fn|fun|sub|proc|void|defun)" GAP, "", FUNCTION)
HINT(BEGIN "(let|const|var)" GAP WORD BLANK "$", "^[(]", FUNCTION)
HINT(BEGIN "func.*[(,]" BLANK WORD BLANK "$", "^:", "remove the type: func f(x)")
HINT(BEGIN "func.*[)]" BLANK "$", "^->", "remove the type: func f(x)")
HINT(BEGIN "func.*[)]" BLANK "$", "^[^:{ \t]", FUNCTION)
HINT(BEGIN "return" GAP, "", "remove 'return'; a function returns the values of its lines")

// Conditions and loops.
HINT(BEGIN "else" GAP "$", "^if", "write 'elif TEST'")
HINT(BEGIN "(elseif|elsif)" GAP, "", "write 'elif TEST'")
HINT(BEGIN "(if|elif)" GAP ".*$", "^then", "remove 'then' and indent the block below")
HINT(BEGIN "for" GAP ".*$", "^do([^A-Za-z0-9_]|$)", "remove 'do' and indent the block below")
HINT(BEGIN "while([ \t(]|$)", "", WHILE)
HINT(BEGIN "for" BLANK "$", "^[(]", FOR ", without parentheses")
HINT(BEGIN "for" GAP WORD BLANK "$", "^(=|:|of)", FOR)
HINT(BEGIN "for" GAP WORD BLANK "$", "^,", "separate names with semicolons: for x;y in v")
HINT(BEGIN "(foreach|repeat|loop)" GAP, "", FOR)
HINT(BEGIN "(if|elif|else|for|func|where)([ \t(].*)?$", "^:([ \t]|$)", NO_COLON)
HINT("", "^[?]", "write 'A if TEST else B'")
HINT(BEGIN "(if|elif)([ \t(].*)?$", "^!" BLANK "[^A-Za-z_ \t]", "write 'not x' to negate a value")
HINT(BEGIN "(for|if|elif|else)([ \t(].*)?$", "^!", BELOW)

// Files.
HINT(BEGIN "(import|from)" GAP, "", FILES)
HINT(BEGIN "(include|require|use|using)" GAP, "", FILES)

// Names and types.
HINT(BEGIN "let" GAP "(" WORD "[;, \t]*)+$", "^:", NO_TYPES)
HINT(BEGIN "let" GAP "(" WORD "[;, \t]*)+$", "^,", "separate names with semicolons: let x;y=1;2")
HINT(BEGIN "let" GAP "$", "^[(]", "separate names with semicolons: let x;y=1;2")
HINT(BEGIN "(const|var|local|int|float|double|auto|val|string|bool)" GAP, "", "write 'let x=5'")
HINT("[-+*/%|&^]$", "^=", LASTING)
HINT("[+][+]$", "^$", LASTING)
HINT(BEGIN WORD BLANK "$", "^:=", "write 'let x=5' to name a value")

// Operators.
HINT("", "^&", "write 'A and B'")
HINT("", "^[|]", "write 'A or B'")
HINT("[=!]=$", "^=", "write '==' or '!='")
HINT("<$", "^>", "write 'A != B'")
HINT("", "^is([^A-Za-z0-9_]|$)", "write 'A == B'")
HINT("", "^not" GAP "in([^A-Za-z0-9_]|$)", "write 'not x in v'")
HINT("[^A-Za-z0-9_]not" GAP "$", "^in([^A-Za-z0-9_]|$)", "write 'not x in v'")
HINT("", "^\\^", "write 'x**2' for a power")

// Strings and numbers.
HINT(BEGIN "!" WORD "(" GAP "#" WORD ")*" GAP "$", "^['\"]", ATTRIBUTES)
HINT("(^|[^A-Za-z0-9_])[bfruBFRU]$", "^['\"]", TEXT)
HINT("['\"]" BLANK "$", "^['\"]", TEXT)
HINT("['\"]" BLANK "%" BLANK "[(][^)]*$", "^,", TEXT)
HINT("", "^`", "write strings in quotes: 'one'; " TEXT)
HINT("[0-9]$", "^[.]([^.]|$)", "write '1.0' or '1'")
HINT("[0-9]%$", "^$", "write 0.5 for 50%; '%' is the remainder of a division")
HINT("console$", "^[.]", "write 'debug(value)' to print a value")
HINT(BEGIN "(import|%include)" GAP, "^[.]", FILES)
HINT("[A-Za-z0-9_)]$", "^[.]([^.]|$)", "write functions as 'sin(x)' and elements as 'v[0]', without a dot")

// Nodes.
HINT(BEGIN "$", "^<[A-Za-z/]", "a node is written !name a=1 b=2")
HINT(BEGIN "!.*;" BLANK WORD BLANK "$", "^=[^=]", "separate attributes with spaces: !name a=1 b=2")
HINT(BEGIN "let" GAP ".*;" BLANK WORD BLANK "$", "^=[^=]", "separate bindings with spaces: let a=1 b=2")
HINT(BEGIN "!.*" GAP WORD BLANK "$", "^:", "write attributes as 'name=value'")
HINT(BEGIN "!" WORD BLANK "$", "^[{].*[=:]", "write attributes after the name: !name a=1 b=2")

// Vectors and blocks.
HINT("[0-9]" BLANK "(rad|degrees)" BLANK "$", "", TURNS)
HINT("[0-9](px|em|pt|mm|cm|ms|s)" BLANK "$", "", NO_UNIT)
HINT("", "^(\u2018|\u2019|\u201a|\u201c|\u201d|\u201e|\u00ab|\u00bb)", "write strings in straight quotes: 'text'")
HINT("[^A-Za-z0-9_](sin|cos|tan|polar|angle|sqrt|abs|floor|ceil|round|exp|log|min|max|sum|len|hypot|hsv|uniform|normal)" GAP
     "$", "^[-.0-9A-Za-z(:]", "write the arguments of a function in parentheses: sin(x)")
HINT("[0-9]" GAP "$", "^[.]?[0-9]", VECTOR)
HINT("", "^," BLANK WORD BLANK "=[^=]", "remove the comma: name=value name=value")
HINT("", "^," BLANK "[^ \t]", VECTOR)
HINT("[=(;,]" BLANK "$", "^[{]", VECTOR)
HINT("", "^[{}]", NO_BRACES)
HINT(";$", "^$", "remove the semicolon; a statement ends with its line")
// The last row is a guess: words after what looks like a tag are probably a comment.
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
#undef ATTRIBUTES
#undef BELOW
#undef WHILE
