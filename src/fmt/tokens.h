// tokens.h: the tokens of a script, with the properties that determine its format.
#pragma once

#include "base/str.h"
#include "petri-edit.h"

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
    uint32_t breaks;      // number of line ends between the previous word and this one
    uint32_t level;       // level of the block that contains the word
    uint32_t indent;      // original indent of a word that starts a line (a tab counts as eight); else 0
    uint32_t segment;     // for a ROLE_SUM: index in Words.segments
    bool begins;          // true if the word starts a statement or a line of bindings
    bool joined;          // true if a backslash joins the word's line to the previous line
    bool ends_parameters; // true if the word closes the parameters of an inline function
} Word;

// A part of an expression, delimited by brackets, commas and operators of lower precedence than + and -.
typedef struct Segment {
    bool unspaced; // true if the segment is in brackets or in an attribute
    bool ranges;   // true if the segment contains a range
    bool mixed;    // true if the segment contains operators of higher precedence than + and -
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
