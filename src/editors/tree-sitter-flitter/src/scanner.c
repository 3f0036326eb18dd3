// scanner.c: the part of the grammar for tree-sitter that handles lines, indentation, comments and parentheses. The
// rules are those of lib/syntax/layout.c.
#include "tree_sitter/parser.h"

#include <stdlib.h>
#include <string.h>

enum { NEWLINE, INDENT, DEDENT, COMMENT, BLANK, OPEN, CLOSE };

enum {
    MAX_LEVELS = 240, // the state must fit into TREE_SITTER_SERIALIZATION_BUFFER_SIZE
    MAX_INDENT = 0x7fff,
    REJECTED = 0x8000, // bit of a level that the grammar does not accept; its end is not a token
};

typedef struct Scanner {
    uint16_t levels[MAX_LEVELS]; // indentation of the enclosing suites
    uint16_t level_count;
    uint16_t indent;  // indentation of the next line with code
    uint16_t parens;  // number of open parentheses, inside which line ends mean nothing
    uint8_t at_start; // true before the first line with code
    uint8_t between;  // true between a line end and the next line with code
} Scanner;

void *tree_sitter_flitter_external_scanner_create(void) {
    Scanner *scanner = calloc(1, sizeof *scanner);
    if (scanner) {
        scanner->level_count = 1;
        scanner->at_start = scanner->between = 1;
    }
    return scanner;
}

void tree_sitter_flitter_external_scanner_destroy(void *scanner) {
    free(scanner);
}

unsigned tree_sitter_flitter_external_scanner_serialize(void *payload, char *buffer) {
    const Scanner *scanner = payload;
    const uint16_t rest[] = {scanner->indent, scanner->parens, (uint16_t)(scanner->at_start | scanner->between << 1)};
    unsigned size = scanner->level_count * (unsigned)sizeof *scanner->levels;
    memcpy(buffer, rest, sizeof rest);
    memcpy(buffer + sizeof rest, scanner->levels, size);
    return size + (unsigned)sizeof rest;
}

void tree_sitter_flitter_external_scanner_deserialize(void *payload, const char *buffer, unsigned length) {
    Scanner *scanner = payload;
    uint16_t rest[3] = {0, 0, 1 | 1 << 1};
    memset(scanner, 0, sizeof *scanner);
    scanner->level_count = 1;
    if (length >= sizeof rest + sizeof *scanner->levels) {
        memcpy(rest, buffer, sizeof rest);
        memcpy(scanner->levels, buffer + sizeof rest, length - sizeof rest);
        scanner->level_count = (uint16_t)((length - sizeof rest) / sizeof *scanner->levels);
    }
    scanner->indent = rest[0];
    scanner->parens = rest[1];
    scanner->at_start = rest[2] & 1;
    scanner->between = rest[2] >> 1 & 1;
}

static void advance(TSLexer *lexer) {
    lexer->advance(lexer, false);
}

static bool is_blank(int32_t c) {
    return c == ' ' || c == '\t' || c == '\r';
}

// Reads blanks and returns their width: one per space, eight per tab.
static unsigned read_blanks(TSLexer *lexer) {
    unsigned width = 0;
    for (; is_blank(lexer->lookahead); advance(lexer))
        width += lexer->lookahead == '\t' ? 8 : lexer->lookahead == ' ';
    return width;
}

// Reads a comment up to the end of its line. Returns false if there is none.
static bool read_comment(TSLexer *lexer) {
    if (lexer->lookahead != '-')
        return false;
    advance(lexer);
    if (lexer->lookahead != '-')
        return false;
    while (lexer->lookahead != '\n' && !lexer->eof(lexer))
        advance(lexer);
    return true;
}

// Reads the line end, if there is one, which is the token. Then looks for the next line with code and records its
// indentation.
static void read_lines(Scanner *scanner, TSLexer *lexer) {
    unsigned indent = 0;
    if (lexer->lookahead == '\n')
        advance(lexer);
    lexer->mark_end(lexer);
    scanner->between = false;
    for (;;) {
        indent = read_blanks(lexer);
        if (lexer->lookahead == '-' && !read_comment(lexer))
            break;
        if (lexer->lookahead != '\n')
            break;
        scanner->between = true;
        advance(lexer);
    }
    scanner->indent = (uint16_t)(lexer->eof(lexer) ? 0 : indent < MAX_INDENT ? indent : MAX_INDENT);
}

static bool found(TSLexer *lexer, int symbol) {
    lexer->result_symbol = (TSSymbol)symbol;
    return true;
}

// Finds the begin or the end of a suite. Returns false if the next line belongs to the same suite.
static bool read_level(Scanner *scanner, TSLexer *lexer, bool indent_is_valid) {
    lexer->mark_end(lexer);
    while (scanner->level_count > 1 && scanner->indent < (scanner->levels[scanner->level_count - 1] & MAX_INDENT)) {
        scanner->level_count--;
        if (!(scanner->levels[scanner->level_count] & REJECTED))
            return found(lexer, DEDENT);
    }
    if (scanner->indent == (scanner->levels[scanner->level_count - 1] & MAX_INDENT) ||
        scanner->level_count == MAX_LEVELS)
        return false;
    scanner->levels[scanner->level_count++] = (uint16_t)(scanner->indent | (indent_is_valid ? 0 : REJECTED));
    return found(lexer, INDENT);
}

// Skips blanks, and line ends after a backslash. Returns false at any other backslash.
static bool skip_blanks(TSLexer *lexer) {
    while (is_blank(lexer->lookahead) || lexer->lookahead == '\\') {
        bool continues = lexer->lookahead == '\\';
        lexer->advance(lexer, true);
        while (continues && lexer->lookahead == '\r')
            lexer->advance(lexer, true);
        if (continues && lexer->lookahead == '\n')
            lexer->advance(lexer, true);
        else if (continues)
            return false;
    }
    return true;
}

// Finds the line end before the first line, which each program has.
static bool read_start(Scanner *scanner, TSLexer *lexer) {
    if (lexer->lookahead == '#') { // perhaps `#!`, which ends with its line
        lexer->mark_end(lexer);
        advance(lexer);
        if (lexer->lookahead == '!')
            return false;
        scanner->between = false;
    } else {
        read_lines(scanner, lexer);
    }
    scanner->at_start = false;
    return found(lexer, NEWLINE);
}

bool tree_sitter_flitter_external_scanner_scan(void *payload, TSLexer *lexer, const bool *valid) {
    Scanner *scanner = payload;
    bool recovers = valid[INDENT] && valid[CLOSE]; // after an error, all tokens are valid
    if (!scanner->at_start && read_level(scanner, lexer, valid[INDENT]))
        return true;
    if (!skip_blanks(lexer))
        return false;
    if (scanner->at_start)
        return read_start(scanner, lexer);
    switch (lexer->lookahead) {
    case '-':
        if (!read_comment(lexer))
            return false;
        lexer->mark_end(lexer);
        return found(lexer, COMMENT);
    case '\n':
        if (scanner->between || (scanner->parens > 0 && !recovers)) {
            uint16_t indent = scanner->indent;
            read_lines(scanner, lexer);
            scanner->indent = indent;
            return found(lexer, BLANK);
        }
        scanner->parens = 0;
        read_lines(scanner, lexer);
        return found(lexer, NEWLINE);
    case '(':
    case ')': {
        bool opens = lexer->lookahead == '(';
        advance(lexer);
        lexer->mark_end(lexer);
        scanner->parens = (uint16_t)(opens ? scanner->parens + 1 : scanner->parens - (scanner->parens > 0));
        return found(lexer, opens ? OPEN : CLOSE);
    }
    default:
        if (!lexer->eof(lexer) || !valid[NEWLINE])
            return false;
        lexer->mark_end(lexer);
        scanner->indent = 0;
        scanner->parens = 0;
        return found(lexer, NEWLINE);
    }
}
