// tokens.c: see tokens.h.
//
// The properties of a word follow from the words before it. Only the spaces around + and - depend on their whole
// segment. So a word refers to its segment, and word_is_unspaced is called when all words are read.
#include "fmt/tokens.h"

#include "cli/memory.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_DEPTH = 2100 }; // maximum depth of nested brackets; the language allows fewer

// State of add_token, which receives the tokens one by one.
typedef struct Reader {
    Words *words;
    size_t end;     // offset of the end of the previous token
    size_t last;    // 1 + index of the last word that is not a comment; 0: none
    uint32_t level; // level of the current block
    bool begins;    // true if the next word starts a statement
    uint32_t depth; // number of open brackets
    // Both arrays are indexed by depth. Index 0 is for the statement, outside all brackets.
    size_t segments[MAX_DEPTH]; // index of the current segment at each depth
    bool functions[MAX_DEPTH];  // true if the bracket holds the parameters of an inline function
    bool binds;                 // true if the statement binds names, so that its `=` do not set attributes
} Reader;

uint32_t word_column(const Words *words, const Word *word) {
    const char *begins = word->text.bytes;
    while (begins > words->text.bytes && begins[-1] != '\n')
        begins--;
    return (uint32_t)utf8_length((Str){begins, (size_t)(word->text.bytes - begins)});
}

bool word_is(const Word *word, const char *text) {
    return str_equal(word->text, str_from(text));
}

static bool is_one_of(const Word *word, const char *list) {
    return str_word_number(word->text, list) >= 0;
}

static bool ends_operand(const Word *word) {
    return word->role == ROLE_OPERAND || word->role == ROLE_CLOSE;
}

// Starts a segment in the innermost bracket.
static Segment *push_segment(Reader *reader, bool unspaced) {
    Words *words = reader->words;
    if (words->segment_count == words->segment_capacity) {
        words->segment_capacity = words->segment_capacity == 0 ? 64 : 2 * words->segment_capacity;
        words->segments = memory_realloc(words->segments, words->segment_capacity * sizeof *words->segments);
    }
    reader->segments[reader->depth] = words->segment_count;
    words->segments[words->segment_count] = (Segment){.unspaced = unspaced};
    return &words->segments[words->segment_count++];
}

static Segment *current_segment(const Reader *reader) {
    return &reader->words->segments[reader->segments[reader->depth]];
}

static Role operator_role(const Word *word, bool binary) {
    if (is_one_of(word, "( ["))
        return ROLE_OPEN;
    if (is_one_of(word, ") ]"))
        return ROLE_CLOSE;
    if (is_one_of(word, "+ - .. $ @") && !binary)
        return ROLE_PREFIX;
    return is_one_of(word, "+ -")                  ? ROLE_SUM
           : word_is(word, ",")                    ? ROLE_COMMA
           : is_one_of(word, "<< == != < > <= >=") ? ROLE_SPACED
                                                   : ROLE_UNSPACED;
}

static Role role_of(const Word *word, const Word *before) {
    switch (word->kind) {
    case PETRI_TOKEN_KEYWORD:
        return ROLE_SPACED;
    case PETRI_TOKEN_COMMENT:
        return ROLE_COMMENT;
    case PETRI_TOKEN_OPERATOR:
        return operator_role(word, !word->begins && before && ends_operand(before));
    default:
        return ROLE_OPERAND;
    }
}

static bool opens_function(const Word *before) {
    return before && before->kind == PETRI_TOKEN_KEYWORD && word_is(before, "func");
}

// Updates the current segment (see Segment) with a word. A statement, an opening bracket, a comma, and a keyword or
// operator that binds more weakly than + and - start a new segment. A closing bracket returns to
// the segment that contains the opening bracket.
static void split_segment(Reader *reader, Word *word, const Word *before) {
    if (word->begins) {
        reader->depth = 0;
        reader->binds = word->kind == PETRI_TOKEN_KEYWORD && word_is(word, "let");
        push_segment(reader, false);
    }
    bool in_brackets = reader->depth > 0;
    switch (word->role) {
    case ROLE_OPEN:
        reader->depth += reader->depth + 1 < MAX_DEPTH;
        reader->functions[reader->depth] = opens_function(before);
        push_segment(reader, true);
        break;
    case ROLE_CLOSE:
        word->ends_parameters = reader->functions[reader->depth];
        reader->depth -= reader->depth > 0;
        break;
    case ROLE_SUM:
        word->segment = (uint32_t)reader->segments[reader->depth];
        break;
    case ROLE_COMMA:
        push_segment(reader, in_brackets);
        break;
    case ROLE_SPACED:
        push_segment(reader, word_is(word, "in") ||
                                 (current_segment(reader)->unspaced && (in_brackets || !word_is(word, "<<"))));
        break;
    case ROLE_UNSPACED:
        if (word_is(word, "="))
            push_segment(reader, in_brackets || !reader->binds);
        else if (word_is(word, ";"))
            push_segment(reader, current_segment(reader)->unspaced);
        else if (is_one_of(word, ".. |"))
            current_segment(reader)->ranges = true;
        else
            current_segment(reader)->mixed = true;
        break;
    default:
        current_segment(reader)->ranges |= word->role == ROLE_PREFIX && word_is(word, "..");
        break;
    }
}

// Sets reader->binds if the statement starts with `name=` or `name;name=`, as only bindings do.
static void find_binding(Reader *reader, const Word *word) {
    const Words *words = reader->words;
    if (!word_is(word, "=") || word->role != ROLE_UNSPACED || reader->depth > 0)
        return;
    size_t at = words->count;
    while (at > 0 && !words->items[at - 1].begins &&
           (words->items[at - 1].kind == PETRI_TOKEN_NAME || word_is(&words->items[at - 1], ";")))
        at--;
    reader->binds |= at > 0 && words->items[at - 1].begins && words->items[at - 1].kind == PETRI_TOKEN_NAME;
}

static uint32_t count_breaks(Str gap) {
    uint32_t breaks = 0;
    for (size_t i = 0; i < gap.len; i++)
        breaks += gap.bytes[i] == '\n';
    return breaks;
}

static uint32_t line_indent(Str text, size_t at) {
    uint32_t indent = 0;
    while (at > 0 && text.bytes[at - 1] != '\n')
        indent += text.bytes[--at] == '\t' ? 8 : 1;
    return indent;
}

static void add_word(Reader *reader, const PetriToken *token) {
    Words *words = reader->words;
    Str gap = {words->text.bytes + reader->end, token->start - reader->end};
    bool comment = token->kind == PETRI_TOKEN_COMMENT;
    Word word = {
        .text = {words->text.bytes + token->start, token->end - token->start},
        .kind = token->kind,
        .breaks = count_breaks(gap),
        .level = reader->level,
        .begins = reader->begins && !comment,
        .joined = !reader->begins && memchr(gap.bytes, '\\', gap.len),
    };
    word.text = comment ? str_trim(word.text) : word.text;
    word.indent = word.breaks > 0 ? line_indent(words->text, token->start) : 0;
    const Word *before = reader->last > 0 ? &words->items[reader->last - 1] : NULL;
    word.role = role_of(&word, before);
    if (!comment) {
        find_binding(reader, &word);
        split_segment(reader, &word, before);
        reader->begins = false;
    }
    if (words->count == words->capacity) {
        words->capacity = words->capacity == 0 ? 256 : 2 * words->capacity;
        words->items = memory_realloc(words->items, words->capacity * sizeof *words->items);
    }
    words->items[words->count++] = word;
    reader->last = comment ? reader->last : words->count;
    reader->end = token->end;
}

static void add_token(void *user_data, const PetriToken *token) {
    Reader *reader = user_data;
    switch (token->kind) {
    case PETRI_TOKEN_INVALID:
        reader->words->invalid = true;
        break;
    case PETRI_TOKEN_NEWLINE:
        reader->begins = true;
        break;
    case PETRI_TOKEN_INDENT:
        reader->level++;
        break;
    case PETRI_TOKEN_DEDENT:
        reader->level -= reader->level > 0;
        break;
    default:
        add_word(reader, token);
        break;
    }
}

bool words_read(PetriSession *session, Str text, Words *words) {
    Reader *reader = memory_calloc(sizeof *reader);
    *words = (Words){.text = text};
    reader->words = words;
    reader->begins = true;
    push_segment(reader, false);
    PetriStatus status = petri_tokenise(session, text.bytes, text.len, add_token, reader);
    free(reader);
    return status == PETRI_OK && !words->invalid;
}

void words_free(Words *words) {
    free(words->items);
    free(words->segments);
    *words = (Words){0};
}

bool word_is_unspaced(const Words *words, size_t at) {
    const Word *word = &words->items[at];
    const Segment *part = &words->segments[word->segment];
    bool before_sign =
        at + 1 < words->count && words->items[at + 1].role == ROLE_PREFIX && is_one_of(&words->items[at + 1], "+ -");
    return word->role == ROLE_SUM && !before_sign && (part->ranges || (part->unspaced && !part->mixed));
}
