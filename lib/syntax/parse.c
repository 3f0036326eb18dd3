// parse.c: the driver of the parser; see parse.h. It decides which words are keywords, builds literals and reports
// errors.
#include "syntax/parse.h"

#include "ast/literal.h"
#include "parser.h"
#include "syntax/content_sniff.h"
#include "syntax/layout.h"
#include "syntax/syntax_hints.h"

#include <string.h>

enum { MAX_EXPECTED = 3 }; // maximum number of expected tokens in a message; if there are more, it lists none

static uint32_t indentation(const Source *source, uint32_t line) {
    const char *text = source->text.bytes + source->line_starts[line - 1];
    return (uint32_t)strspn(text, " \t");
}

// Returns true if a line continues the `let` in the line of the last error: all lines after it are indented more.
// After an error in the first line of a `let`, its further bindings are not recognised.
static bool continues_let(ParseContext *context, uint32_t line) {
    const Source *source = context->source;
    uint32_t first = context->error_line;
    if (!context->failed || line <= first)
        return false;
    uint32_t let = indentation(source, first);
    const char *text = source->text.bytes + source->line_starts[first - 1] + let;
    if (strncmp(text, "let", 3) != 0 || (text[3] != ' ' && text[3] != '\t' && text[3] != '\n'))
        return false;
    for (uint32_t i = first < context->let_line ? context->let_line : first; i < line; i++) {
        uint32_t indent = indentation(source, i + 1);
        if (indent <= let && source->text.bytes[source->line_starts[i] + indent] != '\n')
            return false;
    }
    context->let_line = line;
    return true;
}

// Reports an error, unless it follows from the previous error in the same line or statement. Always sets
// context->failed.
static void report_error(ParseContext *context, Span span, const char *code, Str text, Str hint) {
    uint32_t line = source_line(context->source, span.start);
    bool follows = (context->failed && line == context->error_line) || continues_let(context, line);
    context->failed = true;
    if (follows)
        return;
    context->error_line = line;
    diag_report(context->diags, &(Diag){DIAG_ERROR, {context->source, span}, text, .hint = hint, .code = code});
}

// Reports an unexpected token. A hint for other languages' syntax (syntax_hints.h) takes precedence over `hint`.
static void report_token(ParseContext *context, Span span, Str text, Str hint) {
    bool is_recorded = context->diags->count < context->diags->limit;
    Str specific_hint = is_recorded ? syntax_hint_find(context->diags->arena, context->source, span) : (Str){0};
    report_error(context, span, "syntax", text, specific_hint.len ? specific_hint : hint);
}

// Reports that the program is nested too deeply. Parsing then stops.
static void report_overflow(ParseContext *context) {
    if (!context->too_deep)
        report_error(context, context->overflow_at, "too-deep",
                     str_format(context->arena, "nested too deeply: the limit is %d levels", AST_MAX_HEIGHT), (Str){0});
    context->too_deep = true;
}

static Str token_text(const ParseContext *context, Span span) {
    return (Str){context->source->text.bytes + span.start, span.end - span.start};
}

// Appends the name of a token, in quotes unless it is a description such as "end of line".
static void add_token_name(Text *out, const char *name) {
    static const char *const described[] = {
        "name",        "number",      "time code",         "string", "symbol", "node", "tag", "end of file",
        "end of line", "indentation", "end of indentation"};
    bool quote = name[0] != '\'';
    for (size_t i = 0; i < sizeof described / sizeof described[0]; i++)
        if (strcmp(name, described[i]) == 0)
            quote = false;
    text_add_format(out, quote ? "'%s'" : "%s", name);
}

// Returns true if the line above a token ends with `=`.
static bool follows_binding(const ParseContext *context, Span span) {
    const char *text = context->source->text.bytes;
    uint32_t at = span.start;
    while (at > 0 && strchr(" \t\n", text[at - 1]))
        at--;
    return at > 0 && text[at - 1] == '=';
}

// Returns a hint for a common mistake, or an empty string.
static Str syntax_hint(const ParseContext *context, Span span, const char *found, bool needs_block) {
    if (needs_block && follows_binding(context, span))
        return STR("write a value after the '=' above, or in an indented block below it");
    if (needs_block)
        return STR("add an indented block below the line above");
    if (strcmp(found, "'='") == 0)
        return STR("write '==' to compare, or 'let NAME=…' to name a value");
    if (strcmp(found, "indentation") == 0)
        return STR("the statement above cannot have an indented block");
    if (strcmp(found, "'['") == 0)
        return STR("separate vector elements with semicolons: 1;2;3");
    if (strcmp(found, "else") == 0 || strcmp(found, "elif") == 0)
        return STR("'else' and 'elif' must follow the block of an 'if', at the same indentation");
    return (Str){0};
}

// After a list of names, `expected` holds the tokens that can follow such a list in any kind of statement, among them
// `=`, `in` and `from`. Returns the token that fits this statement, whose kind is known from the first word of the
// line. Returns NULL if there is none.
static const char *after_names(const ParseContext *context, Span span, const char *const *expected, int count) {
    static const struct {
        const char *word;
        const char *wanted;
    } statements[] = {{"let", "'='"}, {"for", "in"}, {"import", "from"}};
    bool in = false, from = false;
    for (int i = 0; i < count; i++) {
        in |= strcmp(expected[i], "in") == 0;
        from |= strcmp(expected[i], "from") == 0;
    }
    Str line = str_trim(source_locate(context->source, span.start).text);
    for (size_t i = 0; in && from && i < sizeof statements / sizeof statements[0]; i++)
        if (str_starts_with(line, str_from(statements[i].word)))
            return statements[i].wanted;
    return NULL;
}

static void report_unexpected(ParseContext *context, const Unexpected *unexpected) {
    const char *found = unexpected->found, *const *expected = unexpected->expected;
    int count = unexpected->expected_count;
    Span span = unexpected->span;
    const char *wanted = after_names(context, span, expected, count);
    if (wanted) {
        expected = &wanted;
        count = 1;
    } else if (count > MAX_EXPECTED) {
        count = 0;
    }
    bool needs_block = count == 1 && strcmp(expected[0], "indentation") == 0;
    Text text = text_new(context->arena);
    Str word = token_text(context, span);
    text_add_c(&text, "unexpected ");
    bool layout = strncmp(found, "end of", 6) == 0 || strcmp(found, "indentation") == 0;
    if (!layout && word.len > 0 && word.len <= 40 && !memchr(word.bytes, '\n', word.len)) {
        // A name, literal, keyword or operator is shown as written.
        bool described = strcmp(found, "name") == 0 || strcmp(found, "node") == 0 || strcmp(found, "symbol") == 0 ||
                         strcmp(found, "tag") == 0 || strcmp(found, "number") == 0 || strcmp(found, "string") == 0 ||
                         strcmp(found, "time code") == 0;
        text_add_format(&text, described ? "%s %.*s" : "%s'%.*s'", described ? found : "", STR_ARGS(word));
    } else {
        add_token_name(&text, found);
    }
    bool ends = strcmp(found, "end of line") == 0 || strcmp(found, "end of file") == 0;
    if (count == 0 && unexpected->value_expected && ends)
        text_add_c(&text, ", expected an expression");
    for (int i = 0; i < count; i++) {
        text_add_c(&text, i == 0 ? ", expected " : i + 1 < count ? ", " : " or ");
        if (needs_block)
            text_add_c(&text, "an indented block");
        else
            add_token_name(&text, expected[i]);
    }
    report_token(context, span, text_str(&text), syntax_hint(context, span, found, needs_block));
}

// Reports a character that cannot start a token.
static void report_character(ParseContext *context, Span span) {
    Str text = token_text(context, span);
    size_t at = 0;
    int32_t c = utf8_next(text, &at);
    if (c == '\'' || c == '"')
        report_error(context, span, "syntax", STR("unterminated string"),
                     STR("close the string on its line, or use ''' or \"\"\" for several lines"));
    else if (c == '\\')
        report_error(context, span, "syntax",
                     STR("a backslash outside a string must be the last character of its line"), (Str){0});
    else if (c == 0xfeff)
        report_error(context, span, "syntax", STR("a byte-order mark (U+FEFF) is allowed only at the start of a file"),
                     (Str){0});
    else if (c < 0x20 || c == 0x7f)
        report_error(context, span, "syntax",
                     str_format(context->arena, "unexpected control character U+%04X", (unsigned)c),
                     STR("is this a text file?"));
    else if (c == ':' || c == '!' || c == '#')
        report_token(context, span, str_format(context->arena, "'%c' must be directly followed by a name", (int)c),
                     c == '!' ? STR("write 'not' to negate a value") : (Str){0});
    else
        report_token(context, span,
                     str_format(context->arena, "unexpected character '%.*s' (U+%04X)", STR_ARGS(text), (unsigned)c),
                     (Str){0});
}

// Returns true if the text is indented with both tabs and spaces.
static bool mixes_tabs(Str text) {
    bool tabs = false, spaces = false, leading = true;
    for (size_t i = 0; i < text.len; i++) {
        char c = text.bytes[i];
        leading = c == '\n' || (leading && (c == ' ' || c == '\t'));
        tabs |= leading && c == '\t';
        spaces |= leading && c == ' ';
    }
    return tabs && spaces;
}

static void report_layout(ParseContext *context, const Token *token) {
    report_error(context, token->span, "syntax", str_from(token->error),
                 !token->fatal && mixes_tabs(context->source->text)
                     ? STR("do not mix tabs and spaces: a tab counts as eight spaces")
                     : (Str){0});
    context->too_deep |= token->fatal;
}

// Returns the node of a literal token. Reports an error and returns NULL if the literal is invalid.
static Ast *literal_ast(ParseContext *context, const Token *token) {
    Str text = token_text(context, token->span), string;
    double x = 0;
    const Symbol *symbol;
    const char *complaint = NULL;
    switch (token->kind) {
    case NUMBER:
        complaint = literal_number(text, &x);
        break;
    case TIMECODE:
        x = literal_timecode(text);
        break;
    case SYMBOL:
        symbol = symbol_register(context->symbols, (Str){text.bytes + 1, text.len - 1});
        if (symbol)
            x = symbol->number;
        else
            complaint = "this symbol has the same value as another symbol: rename one";
        break;
    default:
        complaint = literal_string(context->arena, text, &string);
        if (!complaint)
            return ast_literal(context->arena, token->span, value_string(context->arena, string));
    }
    if (!complaint)
        return ast_literal(context->arena, token->span, value_number(x));
    report_error(context, token->span, "syntax", str_from(complaint), (Str){0});
    context->reported = true;
    return NULL;
}

static Ast *named_token(ParseContext *context, const Token *token, AstKind kind, uint32_t sigil) {
    Str text = token_text(context, token->span);
    const Symbol *name = symbol_intern(context->symbols, (Str){text.bytes + sigil, text.len - sigil});
    return ast_new(context->arena, kind, token->span, name, NULL, 0);
}

// Returns the semantic value of a token. Changes the kind of an invalid literal to GR_UNDEF.
static GR_STYPE token_value(ParseContext *context, Token *token) {
    GR_STYPE result = {0};
    switch (token->kind) {
    case NAME:
        result.ast = named_token(context, token, AST_NAME, 0);
        break;
    case NODE:
        result.ast = named_token(context, token, AST_NODE, 1);
        break;
    case TAG:
        result.ast = named_token(context, token, AST_TAG, 1);
        break;
    case NUMBER:
    case TIMECODE:
    case STRING:
    case SYMBOL:
        result.ast = literal_ast(context, token);
        if (!result.ast)
            token->kind = GR_UNDEF;
        break;
    default:
        break;
    }
    return result;
}

// Shortens a token to its first `len` bytes and changes its kind. The lexer continues after these bytes.
static void resize_token(Layout *layout, Token *token, int kind, uint32_t len) {
    token->kind = kind;
    token->span.end = token->span.start + len;
    layout_resume(layout, token->span.end);
}

// Decides by context whether a word or a directive is a keyword (L2.2, L2.12).
static void resolve_keyword(const ParseContext *context, Layout *layout, const gr_pstate *parser, Token *token) {
    Str text = token_text(context, token->span);
    if ((token->kind == PRAGMA || token->kind == INCLUDE) && !gr_accepts(parser, token->kind)) {
        resize_token(layout, token, '%', 1);
    } else if (token->kind == NAME && token->keyword && gr_accepts(parser, token->keyword)) {
        token->kind = token->keyword;
    } else if (token->kind == NAME) {
        // After a list of names, where no name can follow, `in` or `from` is also recognised as the prefix of a word:
        // `for x in1;2` means `for x in 1;2` (K11).
        if (gr_accepts(parser, IN) && !gr_accepts(parser, AND) && str_starts_with(text, STR("in")))
            resize_token(layout, token, IN, 2);
        else if (gr_accepts(parser, FROM) && str_starts_with(text, STR("from")))
            resize_token(layout, token, FROM, 4);
    }
}

// Adds a hint to the error of a token that follows an unclosed parenthesis on an earlier line. Returns true if there is
// such a parenthesis.
static bool add_paren_hint(ParseContext *context, const Layout *layout, const Token *token, uint32_t errors_before) {
    if (layout->paren_count == 0)
        return false;
    SourcePosition open = source_locate(context->source, layout->parens[layout->paren_count - 1]);
    bool later = token->kind == END || source_line(context->source, token->span.start) > open.line;
    if (later && context->diags->count > errors_before)
        context->diags->items[context->diags->count - 1].hint =
            str_format(context->diags->arena, "the parenthesis opened at line %u, column %u is not closed", open.line,
                       open.column);
    return later;
}

// Passes a token to the parser. Returns YYPUSH_MORE, 0 at the end of the program, or 1 if the parser could not recover
// from an error.
static int push_token(ParseContext *context, Layout *layout, gr_pstate *parser, Token *token) {
    if (token->error)
        report_layout(context, token);
    uint32_t errors_before = context->diags->count;
    context->reported = token->kind == GR_UNDEF;
    if (token->kind == GR_UNDEF && !token->error)
        report_character(context, token->span);
    GR_STYPE semantic = token_value(context, token);
    Span span = token->span;
    context->unexpected.found = NULL;
    int status = gr_push_parse(parser, token->kind, &semantic, &span, context);
    if (context->overflow)
        report_overflow(context);
    if (context->unexpected.found && !context->reported)
        report_unexpected(context, &context->unexpected);
    if (context->diags->count > errors_before || context->reported) {
        bool unclosed = add_paren_hint(context, layout, token, errors_before);
        layout_recover(layout, token, unclosed && !context->error_tolerant);
    }
    return status;
}

static void notify_token(const ParseContext *context, const Token *token) {
    if (context->on_token)
        context->on_token(context->user_data, token);
}

// Skips the rest of the line after an error from which the grammar cannot recover. Returns NEWLINE or END.
static int skip_line(const ParseContext *context, Layout *layout) {
    Token token;
    do {
        token = layout_next(layout);
        notify_token(context, &token);
    } while (token.kind != NEWLINE && token.kind != END);
    return token.kind;
}

static bool check_text(ParseContext *context) {
    const Source *source = context->source;
    const char *encoding = content_sniff_encoding(source);
    size_t bad = utf8_find_error(source->text);
    if (encoding) {
        context->failed = true;
        Str text = str_format(context->arena, "'%.*s' is %s text: save it as UTF-8", STR_ARGS(source->name), encoding);
        diag_report(context->diags, &(Diag){.level = DIAG_ERROR, .text = text, .code = "encoding"});
    } else if (bad < source->text.len) {
        report_error(context, (Span){(uint32_t)bad, (uint32_t)bad + 1}, "encoding", STR("the file is not valid UTF-8"),
                     str_format(context->arena, "save the file as UTF-8; byte 0x%02X is invalid",
                                (unsigned char)source->text.bytes[bad]));
    }
    return !context->failed;
}

// A parse in progress. The parser is allocated on the heap.
typedef struct Parsing {
    ParseContext *context;
    Layout *layout;
    gr_pstate *parser;
    ParseCompleteness completeness; // result of probe_completeness
} Parsing;

// Creates a parser, executes `call` and frees the parser, even if an arena escapes.
static void run_with_parser(Parsing *parsing, void (*call)(void *parsing)) {
    ParseContext *context = parsing->context;
    Arena *arenas[] = {context->arena, context->symbols->arena, context->diags->arena};
    layout_init(parsing->layout, context->source);
    parsing->parser = gr_pstate_new();
    ArenaOutcome end =
        parsing->parser ? arena_protect(arenas, sizeof arenas / sizeof *arenas, call, parsing) : ARENA_OUT_OF_MEMORY;
    if (parsing->parser)
        gr_pstate_delete(parsing->parser);
    if (end != ARENA_OK)
        arena_escape(context->arena, end);
}

// In error-tolerant mode, ends an incomplete statement at the end of its line, so that the next statement and the
// enclosing block are not lost. `before` is the kind of the token before `token`. Returns the result of push_token, or
// YYPUSH_MORE if there was nothing to do.
static int close_statement(const Parsing *parsing, int before, const Token *token) {
    bool begins = before == NEWLINE || before == DEDENT || token->kind == DEDENT || token->kind == END;
    if (!parsing->context->error_tolerant || !begins || token->kind == INDENT || token->kind == NEWLINE ||
        gr_accepts(parsing->parser, token->kind) || (token->keyword && gr_accepts(parsing->parser, token->keyword)))
        return YYPUSH_MORE;
    Token end = {.kind = NEWLINE, .span = {token->span.start, token->span.start}};
    return push_token(parsing->context, parsing->layout, parsing->parser, &end);
}

// Continues with a new parser after an error from which the grammar cannot recover, such as an error in the first line.
static void restart_parser(Parsing *parsing) {
    gr_pstate_delete(parsing->parser);
    parsing->parser = gr_pstate_new();
    if (!parsing->parser)
        arena_exhausted(parsing->context->arena);
}

static void parse_tokens(void *context) {
    Parsing *parsing = context;
    Layout *layout = parsing->layout;
    int status = YYPUSH_MORE, before = NEWLINE;
    while (status == YYPUSH_MORE && !parsing->context->too_deep) {
        Token token = layout_next(layout);
        if (close_statement(parsing, before, &token) == 1)
            restart_parser(parsing);
        before = token.kind;
        resolve_keyword(parsing->context, layout, parsing->parser, &token);
        notify_token(parsing->context, &token);
        status = push_token(parsing->context, layout, parsing->parser, &token);
        if (status == 1 && token.kind != END) {
            restart_parser(parsing);
            status = token.kind == NEWLINE || skip_line(parsing->context, layout) == NEWLINE ? YYPUSH_MORE : 1;
        }
    }
}

// Returns true if a statement that starts with this token often has an indented block.
static bool accepts_children(int kind) {
    return kind == NODE || kind == '@';
}

// Returns true if an invalid token is the third quote of an unfinished long string. The lexer reads the first two
// quotes as an empty string.
static bool opens_string(Str text, Span span) {
    uint32_t start = span.start < 2 ? 0 : span.start - 2;
    Str string = {text.bytes + start, text.len - start};
    return str_starts_with(string, STR("'''")) || str_starts_with(string, STR("\"\"\""));
}

// Returns the completeness of a text after its last newline. `first` is the first token of the last top-level
// statement.
static ParseCompleteness completeness_after_line(const Layout *layout, const gr_pstate *parser, int first) {
    if (layout->level_count > 1)
        return PARSE_EXTENDABLE;
    if (!gr_accepts(parser, INDENT))
        return PARSE_COMPLETE;
    return !gr_accepts(parser, END) ? PARSE_NEEDS_BLOCK : accepts_children(first) ? PARSE_EXTENDABLE : PARSE_COMPLETE;
}

static ParseCompleteness probe_completeness(ParseContext *context, Layout *layout, gr_pstate *parser) {
    Str text = context->source->text;
    int first = NEWLINE; // first token of the last top-level statement
    bool begins = true;
    for (;;) {
        Token token = layout_next(layout);
        resolve_keyword(context, layout, parser, &token);
        if (token.kind == GR_UNDEF || token.error)
            return !token.error && opens_string(text, token.span) ? PARSE_INCOMPLETE : PARSE_COMPLETE;
        if (token.kind == END)
            return layout->paren_count > 0 || str_ends_with(text, STR("\\\n")) ? PARSE_INCOMPLETE : PARSE_COMPLETE;
        if (begins && token.kind != NEWLINE)
            first = token.kind;
        begins = token.kind == NEWLINE && layout->level_count == 1;
        if (push_token(context, layout, parser, &token) != YYPUSH_MORE || context->failed)
            return PARSE_COMPLETE;
        if (token.kind == NEWLINE && token.span.end >= text.len)
            return completeness_after_line(layout, parser, first);
    }
}

static void probe_tokens(void *context) {
    Parsing *parsing = context;
    parsing->completeness = probe_completeness(parsing->context, parsing->layout, parsing->parser);
}

ParseCompleteness parse_completeness(Arena *arena, SymbolTable *symbols, const Source *source) {
    DiagSink discarded = diag_sink_new(arena, 0);
    ParseContext context = {.arena = arena, .symbols = symbols, .source = source, .diags = &discarded};
    Parsing parsing = {.context = &context, .completeness = PARSE_COMPLETE};
    if (utf8_find_error(source->text) == source->text.len) {
        parsing.layout = arena_alloc(arena, sizeof *parsing.layout);
        run_with_parser(&parsing, probe_tokens);
    }
    return parsing.completeness;
}

static void parse_source(ParseContext *context) {
    if (check_text(context))
        run_with_parser(&(Parsing){context, arena_alloc(context->arena, sizeof(Layout)), NULL, PARSE_COMPLETE},
                        parse_tokens);
}

const Ast *parse_program(Arena *arena, SymbolTable *symbols, const Source *source, DiagSink *diags) {
    ParseContext context = {.arena = arena, .symbols = symbols, .source = source, .diags = diags};
    parse_source(&context);
    if (context.failed && !content_sniff_encoding(source))
        content_sniff_report(source, diags);
    return context.failed ? NULL : context.program;
}

const Ast *parse_tolerant(Arena *arena, SymbolTable *symbols, const Source *source, ParseTokenCallback *seen,
                          void *user_data) {
    DiagSink discarded = diag_sink_new(arena, 0);
    ParseContext context = {.arena = arena,
                            .symbols = symbols,
                            .source = source,
                            .diags = &discarded,
                            .error_tolerant = true,
                            .on_token = seen,
                            .user_data = user_data};
    parse_source(&context);
    return context.program;
}
