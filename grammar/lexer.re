// lexer.re: the lexer, which splits source code into tokens (spec language.md L2). re2c converts this file to C.
//
// The lexer does not depend on context. The driver of the parser (lib/syntax/parse.c) decides whether a word is a
// keyword, whether %pragma and %include are allowed, and what a newline means.
#include "ast/token.h"

#include "base/unicode.h"
#include "parser.h"

#include <string.h>

Lexer lexer_new(const Source *source) {
    Lexer lexer = {.source = source};
    const char *text = source->text.bytes;
    uint32_t at = 0;
    while (text[at] == ' ' || text[at] == '\t')
        at++;
    if (text[at] == '#' && text[at + 1] == '!')
        lexer.at = (uint32_t)((const char *)memchr(text + at, '\n', source->text.len - at) - text) + 1;
    return lexer;
}

// Returns the offset after the name that starts at `at`, or `at` if there is none. Apostrophes are allowed only at the
// end of a name.
static uint32_t name_end(const Source *source, uint32_t at) {
    size_t end = at;
    for (size_t next = end; next < source->text.len; end = next) {
        int32_t c = utf8_next(source->text, &next);
        if (c < 0 || !(end == at ? unicode_starts_name((uint32_t)c) : unicode_continues_name((uint32_t)c)))
            break;
    }
    while (end > at && source->text.bytes[end] == '\'')
        end++;
    return (uint32_t)end;
}

static int keyword_of(Str word) {
    static const struct {
        Str word;
        int kind;
    } keywords[] = {
        {STR("let"), LET},   {STR("stable"), STABLE}, {STR("func"), FUNC},   {STR("import"), IMPORT},
        {STR("from"), FROM}, {STR("for"), FOR},       {STR("in"), IN},       {STR("if"), IF},
        {STR("elif"), ELIF}, {STR("else"), ELSE},     {STR("where"), WHERE}, {STR("and"), AND},
        {STR("or"), OR},     {STR("xor"), XOR},       {STR("not"), NOT},
    };
    for (size_t i = 0; i < sizeof keywords / sizeof keywords[0]; i++)
        if (str_equal(word, keywords[i].word))
            return keywords[i].kind;
    return 0;
}

static Token token_to(Lexer *lexer, uint32_t start, uint32_t end, int kind) {
    lexer->at = end;
    return (Token){.kind = kind, .span = {start, end}};
}

static Token bad_character(Lexer *lexer, uint32_t start) {
    size_t end = start;
    utf8_next(lexer->source->text, &end);
    return token_to(lexer, start, (uint32_t)end, GR_UNDEF);
}

// Returns the token of a word, or of a symbol, node or tag. The last three start with `:`, `!` or `#`.
static Token word(Lexer *lexer, uint32_t start) {
    const char *text = lexer->source->text.bytes;
    char sigil = text[start];
    bool has_sigil = sigil == ':' || sigil == '!' || sigil == '#';
    uint32_t from = start + has_sigil, end = name_end(lexer->source, from);
    if (end == from)
        return bad_character(lexer, start);
    if (!has_sigil) {
        Token token = token_to(lexer, start, end, NAME);
        token.keyword = keyword_of((Str){text + start, end - start});
        return token;
    }
    return token_to(lexer, start, end, sigil == ':' ? SYMBOL : sigil == '!' ? NODE : TAG);
}

Token lexer_next(Lexer *lexer) {
    const unsigned char *base = (const unsigned char *)lexer->source->text.bytes;
    const unsigned char *YYCURSOR, *YYMARKER, *YYLIMIT = base + lexer->source->text.len;
    uint32_t start;

#define TOKEN(kind) return token_to(lexer, start, (uint32_t)(YYCURSOR - base), kind)

again:
    start = lexer->at;
    YYCURSOR = base + start;
    /*!re2c
        re2c:define:YYCTYPE = "unsigned char";
        re2c:yyfill:enable = 0;
        re2c:eof = 0;

        lf        = "\n";
        blank     = [ \t];
        comment   = "--" [^\n]*;
        newline   = (comment? lf blank*)+;
        d         = [0-9];
        digits    = d [_0-9]*;
        suffix    = "p" | "n" | "u" | "\xc2\xb5" | "m" | "k" | "M" | "G" | "T" | "\xc2\xb0" | "deg";
        number    = (digits ("." digits)? | "." digits) ([eE] [-+]? digits)? suffix?;
        timecode  = (d+ ":")? [0-5]? d ":" [0-5]? d ("." d+)?;
        pair      = "\\" [^\n];
        short1    = "'" ([^'\\\n] | pair)* "'";
        short2    = "\"" ([^"\\\n] | pair)* "\"";
        long1     = "'''" (("'" | "''")? ([^'\\] | pair))* "'''";
        long2     = "\"\"\"" (("\"" | "\"\"")? ([^"\\] | pair))* "\"\"\"";

        $                       { TOKEN(END); }
        (blank | "\\\n")+       { lexer->at = (uint32_t)(YYCURSOR - base); goto again; }
        newline                 { TOKEN(NEWLINE); }
        timecode                { TOKEN(TIMECODE); }
        number                  { TOKEN(NUMBER); }
        long1 | long2           { TOKEN(STRING); }
        short1 | short2         { TOKEN(STRING); }
        "%pragma"               { TOKEN(PRAGMA); }
        "%include"              { TOKEN(INCLUDE); }
        "<<"                    { TOKEN(APPEND); }
        "=="                    { TOKEN(EQ); }
        "!="                    { TOKEN(NE); }
        "<="                    { TOKEN(LE); }
        ">="                    { TOKEN(GE); }
        ".."                    { TOKEN(DOTS); }
        "//"                    { TOKEN(FLOORDIV); }
        "**"                    { TOKEN(POW); }
        [@,$=<>[\]+%;/*|()-]   { TOKEN(base[start]); }
        [A-Za-z_:!#\x80-\xff]   { return word(lexer, start); }

        ['"] {
            TOKEN(GR_UNDEF);
        }
        * { return bad_character(lexer, start); }
    */
}
