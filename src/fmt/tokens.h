// tokens.h: the tokens of a script, with the properties that determine its format.
#ifndef PETRI_SRC_FMT_TOKENS_H
#define PETRI_SRC_FMT_TOKENS_H

#include "base/str.h"
#include "petri.h"

// How a token is spaced.
typedef enum Role {
    ROLE_OPERAND,  // a name or literal
    ROLE_PREFIX,   // a sign, `$`, `@` or `..` without a start value: no space after it
    ROLE_UNSPACED, // no space on either side
    ROLE_SPACED,   // a space on both sides; also keywords
    ROLE_SUM,      // + or - between operands: spaced or not, see word_is_unspaced
    ROLE_COMMA,    // a space after it
    ROLE_OPEN,     // an opening bracket
    ROLE_CLOSE,    // a closing bracket
    ROLE_COMMENT,
} Role;

typedef struct Word {
    Str text;
    PetriTokenKind kind;
    Role role;
    uint32_t breaks;      // number of line ends before it
    uint32_t level;       // level of its block
    uint32_t indent;      // if it starts a line: original indent, where a tab counts as eight; else 0
    uint32_t segment;     // if ROLE_SUM: index of its segment
    bool begins;          // starts a statement or a line of bindings
    bool joined;          // a backslash joins its line to the previous one
    bool ends_parameters; // closes the parameters of an inline function
} Word;

// A part of an expression, delimited by brackets, commas and operators of lower precedence than + and -.
typedef struct Segment {
    bool unspaced; // is in brackets or in an attribute
    bool ranges;   // contains a range
    bool mixed;    // contains operators of higher precedence than + and -
} Segment;

typedef struct Words {
    Str text;
    Word *items;
    size_t count;
    size_t capacity;
    Segment *segments;
    size_t segment_count;
    size_t segment_capacity;
    bool invalid; // true if the script has an invalid token
} Words;

// Reads a script. The caller frees the words with words_free, even after a failure. Returns false if the script has an
// invalid token, or if out of memory.
bool words_read(PetriSession *session, Str text, Words *words);
void words_free(Words *words);
// Returns the column of the word in the original text, in characters.
uint32_t word_column(const Words *words, const Word *word);
bool word_is(const Word *word, const char *text);
// Returns true if the word is a ROLE_SUM that is written without spaces.
bool word_is_unspaced(const Words *words, size_t at);

#endif
