// parser.y: the grammar, which builds a syntax tree from tokens (spec language.md L3). bison converts this file to C.
//
// No word is reserved. Before it passes a word that looks like a keyword, the driver calls gr_accepts to check whether
// the current parser state has an action for the keyword. If not, the driver passes the word as a name. The check uses
// the LALR(1) state directly after a shift, so default reductions and LAC (lookahead correction) must be off. L2.12
// tabulates where each keyword is accepted.
//
// Parse stacks contain only pointers into the program's arena, so no destructors are needed.
%code requires {
#include "ast/ast.h"
#include "ast/parse_context.h"
}

%define api.pure full
%define api.push-pull push
%define api.prefix {gr_}
%define api.token.prefix {}
%define api.location.type {Span}
%define lr.default-reduction accepting
%define parse.error custom
%locations
%expect 0
%param {ParseContext *context}

%union {
    Ast *ast;
    AstList *list;
}

%code provides {
#include <stdbool.h>
// Returns true if the parser can shift or reduce on this token in its current state.
bool gr_accepts(const gr_pstate *parser, int token);
}

%code {
#include "base/heap.h"

#include <string.h>

#define YYMALLOC heap_alloc
#define YYFREE heap_free
#define YYMAXDEPTH 200000
#define YYLLOC_DEFAULT(current, rhs, count)                                                                            \
    do {                                                                                                               \
        if (count)                                                                                                     \
            (current) = (Span){YYRHSLOC(rhs, 1).start, YYRHSLOC(rhs, count).end};                                      \
        else                                                                                                           \
            (current) = (Span){YYRHSLOC(rhs, 0).end, YYRHSLOC(rhs, 0).end};                                            \
    } while (0)

static void gr_error(const Span *span, ParseContext *context, const char *text);

static AstList *add_statement(AstList *list, Ast *statement, uint32_t end) {
    statement->end = end;
    return ast_list_add(list, statement);
}

// Returns `ast`. If the tree is too high, records an overflow and returns a small node instead.
static Ast *check_height(ParseContext *context, Ast *ast) {
    if (ast->height <= AST_MAX_HEIGHT)
        return ast;
    gr_error(&ast->span, context, NULL);
    return ast_literal(context->arena, ast->span, VALUE_NULL); // any small tree will do, because parsing has failed
}

static Ast *new_ast(ParseContext *context, AstKind kind, Span span, Ast *a, Ast *b, Ast *c, uint32_t count) {
    Ast *children[] = {a, b, c};
    return check_height(context, ast_new(context->arena, kind, span, NULL, children, count));
}

#define UNARY(kind, span, a) new_ast(context, kind, span, a, NULL, NULL, 1)
#define BINARY(kind, span, a, b) new_ast(context, kind, span, a, b, NULL, 2)
#define TERNARY(kind, span, a, b, c) new_ast(context, kind, span, a, b, c, 3)
#define NODE_OF(kind, span, name, list) check_height(context, ast_from_list(context->arena, kind, span, name, list))
#define LIST() ast_list_new(context->arena)
#define LIST1(item) ast_list_add(LIST(), item)

// Creates a node with a name and at most one child.
static Ast *new_named_ast(ParseContext *context, AstKind kind, Span span, const Ast *name, Ast *child) {
    Ast *children[] = {child};
    return check_height(context,
                         ast_new(context->arena, kind, span, name ? name->name : NULL, children, child ? 1 : 0));
}

// Creates a FUNC node with parameters and body.
static Ast *new_function_ast(ParseContext *context, Span span, const Ast *name, AstList *params, Span params_span, Ast *body) {
    Ast *children[] = {NODE_OF(AST_PARAMS, params_span, NULL, params), body};
    return check_height(context, ast_new(context->arena, AST_FUNC, span, name ? name->name : NULL, children, 2));
}

// If the list has one item, returns that item. Otherwise returns a node whose children are the items.
static Ast *one_or_list(ParseContext *context, AstKind kind, Span span, AstList *list) {
    return list->count == 1 ? list->items[0] : NODE_OF(kind, span, NULL, list);
}

// Returns a list of `first` followed by `rest`.
static AstList *prepend_item(ParseContext *context, Ast *first, const AstList *rest) {
    return ast_list_add_all(LIST1(first), rest);
}
}

%token <ast> NAME "name" NUMBER "number" TIMECODE "time code" STRING "string" SYMBOL "symbol" NODE "node" TAG "tag"
%token END 0 "end of file" NEWLINE "end of line" INDENT "indentation" DEDENT "end of indentation"
%token PRAGMA "%pragma" INCLUDE "%include"
%token LET "let" STABLE "stable" FUNC "func" IMPORT "import" FROM "from" FOR "for" IN "in"
%token IF "if" ELIF "elif" ELSE "else" WHERE "where" AND "and" OR "or" XOR "xor" NOT "not"
%token APPEND "<<" EQ "==" NE "!=" LE "<=" GE ">=" DOTS ".." FLOORDIV "//" POW "**"

%nterm <ast> pragma suite if_suite item statement lead template for_statement if_statement
%nterm <ast> binding wbind names param chain decorated attr comp lambda loopish cond disj conj neg cmp range sum prod unary
%nterm <ast> power post atom literal named_arg
%nterm <list> pragmas items bindings lets params params_opt for_clauses name_list attrs decorations compose wbinds
%nterm <list> args args_opt named_args elifs

// Resolves a conflict: a name after the bindings of a `where` starts a further binding (L3.1).
%precedence WHERE_END
%precedence NAME

%%

program:
    opt_newline pragmas items {
        context->program = NODE_OF(AST_SUITE, ((Span){0, @items.end}), NULL, ast_list_add_all($pragmas, $items));
    }
  ;

opt_newline: %empty | NEWLINE;

pragmas:
    %empty { $$ = LIST(); }
  | pragmas pragma { $$ = ast_list_add($1, $2); }
  ;
pragma:
    "%pragma" NAME literal NEWLINE {
        $$ = new_named_ast(context, AST_PRAGMA, (Span){@1.start, @literal.end}, $NAME, $literal);
    }
  ;

items:
    %empty { $$ = LIST(); }
  | items item { $$ = $item ? add_statement($1, $item, @item.end) : $1; }
  | items error NEWLINE { $$ = $1; yyerrok; }
  | items error suite { $$ = $1; yyerrok; }
  ;

suite: NEWLINE INDENT items DEDENT { $$ = NODE_OF(AST_SUITE, @items, NULL, $items); };
// The suite of an `if` has its own rule, so that `else` is a keyword only after such a suite (L2.12, K2).
if_suite: NEWLINE INDENT items DEDENT { $$ = NODE_OF(AST_SUITE, @items, NULL, $items); };

item:
    statement
  | "let" lets { $$ = NODE_OF(AST_LET, @$, NULL, $lets); }
  | "let" "stable" lets { $$ = NODE_OF(AST_LET_STABLE, @$, NULL, $lets); }
  | "let" names '=' suite {
        $$ = NODE_OF(AST_LET, @$, NULL, LIST1(BINARY(AST_BINDING, @$, $names, $suite)));
    }
  | "func" NAME '(' params_opt ')' suite { $$ = new_function_ast(context, @$, $NAME, $params_opt, @params_opt, $suite); }
  | "func" '(' params_opt ')' suite { $$ = new_function_ast(context, @$, NULL, $params_opt, @params_opt, $suite); }
  | "import" names "from" comp NEWLINE { $$ = BINARY(AST_IMPORT, @$, $names, $comp); }
  ;

lets:
    bindings NEWLINE
  | bindings NEWLINE INDENT let_lines DEDENT { $$ = ast_list_add_all($1, $let_lines); }
  ;

%nterm <list> let_lines;
let_lines:
    let_line
  | let_lines let_line { $$ = ast_list_add_all($1, $2); }
  ;
%nterm <list> let_line;
let_line:
    bindings NEWLINE
  | error NEWLINE { $$ = LIST(); yyerrok; }
  ;

bindings:
    binding { $$ = LIST1($1); }
  | bindings binding { $$ = ast_list_add($1, $2); }
  ;

binding: names '=' comp { $$ = BINARY(AST_BINDING, @$, $names, $comp); };

names: name_list { $$ = NODE_OF(AST_NAMES, @$, NULL, $1); };
name_list:
    NAME { $$ = LIST1($1); }
  | name_list ';' NAME { $$ = ast_list_add($1, $3); }
  ;

params_opt: %empty { $$ = LIST(); } | params;
params:
    param { $$ = LIST1($1); }
  | params ',' param { $$ = ast_list_add($1, $3); }
  ;
param:
    NAME { $$ = new_named_ast(context, AST_PARAM, @$, $1, NULL); }
  | NAME '=' decorated { $$ = new_named_ast(context, AST_PARAM, @$, $1, $3); }
  ;

statement:
    decorated NEWLINE
  | decorated suite { $$ = BINARY(AST_APPEND, @1, $1, $2); }
  | lead statement { $$ = BINARY(AST_APPEND, @1, $1, $2); }
  | template NEWLINE
  | template suite {
        $$ = NODE_OF(AST_TEMPLATE, @1, NULL, ast_list_add(prepend_item(context, $1->children[0],
                     &(AstList){.items = (Ast **)$1->children + 1, .count = $1->count - 1}), $2));
    }
  | for_statement
  | if_statement
  | "%include" comp NEWLINE { $$ = UNARY(AST_INCLUDE, @comp, $comp); }
  ;

// The beginning of a statement: `parent <<`. The rest of the statement is on the same line or on the next.
lead:
    decorated "<<"
  | decorated "<<" NEWLINE
  ;

template: '@' atom attrs { $$ = NODE_OF(AST_TEMPLATE, @$, NULL, prepend_item(context, $atom, $attrs)); };
attrs:
    %empty { $$ = LIST(); }
  | attrs attr { $$ = ast_list_add($1, $2); }
  ;

// Several clauses form nested loops; the first clause is the outermost loop. In the list `for_clauses`, each
// names item is followed by its source.
for_statement: "for" for_clauses suite {
        $$ = $suite;
        for (uint32_t i = $for_clauses->count; i > 0; i -= 2)
            $$ = TERNARY(AST_FOR, @for_clauses, $for_clauses->items[i - 2], $for_clauses->items[i - 1], $$);
    };
for_clauses:
    names "in" comp { $$ = ast_list_add(LIST1($1), $3); }
  | for_clauses ',' names "in" comp { $$ = ast_list_add(ast_list_add($1, $3), $5); }
  ;

if_statement:
    "if" comp if_suite elifs {
        $$ = NODE_OF(AST_IF, @comp, NULL, ast_list_add_all(ast_list_add(LIST1($2), $3), $4));
    }
  | "if" comp if_suite elifs "else" suite {
        AstList *branches = ast_list_add_all(ast_list_add(LIST1($2), $3), $4);
        $$ = NODE_OF(AST_IF, @comp, NULL, ast_list_add(branches, $suite));
    }
  ;
elifs:
    %empty { $$ = LIST(); }
  | elifs "elif" comp if_suite { $$ = ast_list_add(ast_list_add($1, $3), $4); }
  ;

chain:
    decorated
  | decorated "<<" chain { $$ = BINARY(AST_APPEND, @1, $1, $3); }
  ;

decorated:
    comp
  | comp decorations { $$ = NODE_OF(AST_DECORATE, @$, NULL, prepend_item(context, $1, $2)); }
  ;
decorations:
    TAG { $$ = LIST1($1); }
  | attr { $$ = LIST1($1); }
  | decorations TAG { $$ = ast_list_add($1, $2); }
  | decorations attr { $$ = ast_list_add($1, $2); }
  ;
attr: NAME '=' comp { $$ = new_named_ast(context, AST_ATTR, @$, $1, $3); };

comp: compose { $$ = one_or_list(context, AST_COMPOSE, @$, $1); };
compose:
    lambda { $$ = LIST1($1); }
  | compose ';' lambda { $$ = ast_list_add($1, $3); }
  ;

lambda:
    "func" '(' params_opt ')' lambda { $$ = new_function_ast(context, @$, NULL, $params_opt, @params_opt, $5); }
  | loopish
  ;

loopish:
    cond
  | loopish "for" names "in" cond { $$ = TERNARY(AST_FOR, @$, $names, $cond, $1); }
  | loopish "where" wbinds %prec WHERE_END { $$ = NODE_OF(AST_WHERE, @$, NULL, prepend_item(context, $1, $wbinds)); }
  ;
wbinds:
    wbind { $$ = LIST1($1); }
  | wbinds wbind { $$ = ast_list_add($1, $2); }
  ;
wbind: names '=' cond { $$ = BINARY(AST_BINDING, @$, $1, $3); };

cond:
    disj
  | disj "if" disj { $$ = TERNARY(AST_COND, @$, $1, $3, NULL); }
  | disj "if" disj "else" cond { $$ = TERNARY(AST_COND, @$, $1, $3, $5); }
  ;

disj:
    conj
  | disj "or" conj { $$ = BINARY(AST_OR, @$, $1, $3); }
  | disj "xor" conj { $$ = BINARY(AST_XOR, @$, $1, $3); }
  ;
conj: neg | conj "and" neg { $$ = BINARY(AST_AND, @$, $1, $3); };
neg: cmp | "not" neg { $$ = UNARY(AST_NOT, @$, $2); };

cmp:
    range
  | range "==" range { $$ = BINARY(AST_EQ, @$, $1, $3); }
  | range "!=" range { $$ = BINARY(AST_NE, @$, $1, $3); }
  | range '<' range { $$ = BINARY(AST_LT, @$, $1, $3); }
  | range '>' range { $$ = BINARY(AST_GT, @$, $1, $3); }
  | range "<=" range { $$ = BINARY(AST_LE, @$, $1, $3); }
  | range ">=" range { $$ = BINARY(AST_GE, @$, $1, $3); }
  | range "in" range { $$ = BINARY(AST_IN, @$, $1, $3); }
  ;

range:
    sum
  | sum ".." sum { $$ = TERNARY(AST_RANGE, @$, $1, $3, NULL); }
  | sum ".." sum '|' sum { $$ = TERNARY(AST_RANGE, @$, $1, $3, $5); }
  | ".." sum { $$ = TERNARY(AST_RANGE, @$, NULL, $2, NULL); }
  | ".." sum '|' sum { $$ = TERNARY(AST_RANGE, @$, NULL, $2, $4); }
  ;

sum:
    prod
  | sum '+' prod { $$ = BINARY(AST_ADD, @$, $1, $3); }
  | sum '-' prod { $$ = BINARY(AST_SUB, @$, $1, $3); }
  ;
prod:
    unary
  | prod '*' unary { $$ = BINARY(AST_MUL, @$, $1, $3); }
  | prod '/' unary { $$ = BINARY(AST_DIV, @$, $1, $3); }
  | prod "//" unary { $$ = BINARY(AST_FLOORDIV, @$, $1, $3); }
  | prod '%' unary { $$ = BINARY(AST_MOD, @$, $1, $3); }
  ;
unary:
    power
  | '-' unary { $$ = UNARY(AST_NEG, @$, $2); }
  | '+' unary { $$ = UNARY(AST_POS, @$, $2); }
  ;
power: post | power "**" post { $$ = BINARY(AST_POW, @$, $1, $3); };

post:
    atom
  | post '(' args_opt ')' { $$ = NODE_OF(AST_CALL, @$, NULL, prepend_item(context, $1, $3)); }
  | post '[' chain ']' { $$ = BINARY(AST_INDEX, @$, $1, $3); }
  ;
args_opt: %empty { $$ = LIST(); } | args | args ',' named_args { $$ = ast_list_add_all($1, $3); } | named_args;
args:
    chain { $$ = LIST1($1); }
  | args ',' chain { $$ = ast_list_add($1, $3); }
  ;
named_args:
    named_arg { $$ = LIST1($1); }
  | named_args ',' named_arg { $$ = ast_list_add($1, $3); }
  ;
named_arg: NAME '=' chain { $$ = new_named_ast(context, AST_NAMED, @$, $1, $3); };

atom:
    literal
  | NAME
  | '$' atom { $$ = UNARY(AST_LOOKUP, @$, $2); }
  | '(' chain ')' { $$ = $2; }
  ;
literal: NUMBER | TIMECODE | STRING | SYMBOL | NODE;

%%

bool gr_accepts(const gr_pstate *parser, int token) {
    yysymbol_kind_t symbol = YYTRANSLATE(token);
    int at = yypact[*parser->yyssp] + symbol;
    return at >= 0 && at <= YYLAST && yycheck[at] == symbol && !yytable_value_is_error(yytable[at]);
}

static int yyreport_syntax_error(const yypcontext_t *at, ParseContext *context) {
    yysymbol_kind_t expected[PARSE_ALTERNATIVES], found = yypcontext_token(at);
    int count = yypcontext_expected_tokens(at, expected, PARSE_ALTERNATIVES);
    Unexpected *unexpected = &context->unexpected;
    *unexpected = (Unexpected){.found = found == YYSYMBOL_YYEMPTY ? "nothing" : yysymbol_name(found),
                               .span = *yypcontext_location(at),
                               .expected_count = count > 0 ? count : 0,
                               .value_expected = gr_accepts(at->yyps, NUMBER)};
    for (int i = 0; i < count; i++)
        unexpected->expected[i] = yysymbol_name(expected[i]);
    return 0;
}

// Records where the program is nested too deeply. check_height calls this function, and bison if its stack is full.
static void gr_error(const Span *span, ParseContext *context, const char *text) {
    (void)text;
    if (!context->overflow)
        context->overflow_at = *span;
    context->overflow = true;
}
