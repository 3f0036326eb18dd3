// tokens.h: a text's tokens with what its layout needs to know of them.
#ifndef PETRI_SRC_FMT_TOKENS_H
#define PETRI_SRC_FMT_TOKENS_H

#include "base/str.h"
#include "petri.h"

// How a token stands to its neighbours.
typedef enum Role {
    ROLE_OPERAND,  // a name, a literal
    ROLE_PREFIX,   // a sign, `$`, `@`, a range without start: none behind
    ROLE_UNSPACED, // none on both sides
    ROLE_SPACED,   // one on both sides: keywords, too
    ROLE_SUM,      // + or - between operands: as its sum is written
    ROLE_COMMA,    // one behind
    ROLE_OPEN,
    ROLE_CLOSE,
    ROLE_COMMENT,
} Role;

typedef struct Word {
    Str text;
    PetriTokenKind kind;
    Role role;
    uint32_t breaks;      // line ends before it
    uint32_t level;       // of the block that it is in
    uint32_t indent;      // of its line, as it is, if it begins one: a tab counts as eight
    uint32_t segment;     // of ROLE_SUM: where the precedence that it has begins
    bool begins;          // a statement, or a line of bindings
    bool joined;          // a backslash joins its line to the one before
    bool ends_parameters; // closes the parameters of an inline function
} Word;

// A part of an expression between operators that bind less than a sum.
typedef struct Segment {
    bool unspaced; // in brackets or an attribute
    bool ranges;   // has a range in it
    bool mixed;    // has operators in it that bind more
} Segment;

typedef struct Words {
    Str text;
    Word *items;
    size_t count;
    size_t capacity;
    Segment *segments;
    size_t segment_count;
    size_t segment_capacity;
    bool invalid;
} Words;

// Reads a text; to be freed. False if memory is used up or a character starts no token.
bool words_read(PetriSession *session, Str text, Words *words);
void words_free(Words *words);
// Where the word stands in its line as it is, in characters.
uint32_t word_column(const Words *words, const Word *word);
bool word_is(const Word *word, const char *text);
// Is it a sum's operator that is written without spaces?
bool word_is_unspaced(const Words *words, size_t at);

#endif
