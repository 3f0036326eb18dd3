// layout.c: see layout.h.
//
// Words are written line by line to Writer.text. Comments after code follow in a second pass (write_lines), when the
// widths of all lines are known. layout_same checks that the words and the compiled code are unchanged.
#include "fmt/layout.h"

#include "base/source.h"
#include "fmt/tokens.h"

#include <stdlib.h>
#include <string.h>

enum { INDENT = 4, MAX_LEVELS = 2100 };

// A line of the result. The comment after its code is written later, when its column is known.
typedef struct Line {
    size_t start; // start and end of the code in Writer.text
    size_t end;
    const Word *comment; // comment after the code; NULL: none
    uint32_t width;      // width of the code in characters
} Line;

// A word with which later lines can be aligned: the first word after an opening bracket, or after the first `=` of a
// statement.
typedef struct Anchor {
    const Word *word; // NULL: none yet
    uint32_t indent;  // indent of the line with the opening bracket, in the result
    uint32_t column;  // column of the word in the result
} Anchor;

typedef struct Writer {
    const Words *words;
    Text text;
    Line *lines;
    size_t line_count;
    size_t line_capacity;
    size_t next;                  // index of the first word of the statement after the current comment
    uint32_t indent;              // indent of the current line
    uint32_t level;               // level of the current statement
    uint32_t indents[MAX_LEVELS]; // indents[L]: indent of level L in the original text
    uint32_t depth;               // number of open brackets
    Anchor anchors[MAX_LEVELS];   // anchors[0]: of the statement; anchors[D]: of the bracket at depth D
} Writer;

static Line *current_line(Writer *writer) {
    return &writer->lines[writer->line_count - 1];
}

static void end_line(Writer *writer) {
    if (writer->line_count == 0)
        return;
    current_line(writer)->end = writer->text.len;
    Str code = {writer->text.bytes + current_line(writer)->start, writer->text.len - current_line(writer)->start};
    for (size_t i = code.len; i > 0; i--) {
        if (code.bytes[i - 1] == '\n') { // a string contains a newline: measure only the part after it
            code = (Str){code.bytes + i, code.len - i};
            break;
        }
    }
    current_line(writer)->width = (uint32_t)utf8_length(code);
}

static void begin_line(Writer *writer, uint32_t indent) {
    end_line(writer);
    if (writer->line_count == writer->line_capacity) {
        writer->line_capacity = writer->line_capacity == 0 ? 256 : 2 * writer->line_capacity;
        writer->lines = memory_realloc(writer->lines, writer->line_capacity * sizeof *writer->lines);
    }
    text_add_c(&writer->text, "");
    writer->lines[writer->line_count++] = (Line){.start = writer->text.len};
    writer->indent = indent;
    text_add_format(&writer->text, "%*s", (int)indent, "");
}

// Returns the level of a comment on its own line. The level lies between those of the previous and the next statement.
// It is the deepest of these levels whose original indent does not exceed the original indent of the comment.
static uint32_t comment_level(Writer *writer, size_t at) {
    const Words *words = writer->words;
    const Word *comment = &words->items[at];
    writer->next = writer->next > at ? writer->next : at;
    while (writer->next < words->count && !words->items[writer->next].begins)
        writer->next++;
    const Word *next = writer->next < words->count ? &words->items[writer->next] : NULL;
    uint32_t level = !next ? 0 : next->level;
    if (level > writer->level)
        return comment->indent >= next->indent ? level : writer->level;
    uint32_t found = writer->level;
    while (found > level && writer->indents[found] > comment->indent)
        found--;
    return found;
}

// Returns the indent of a line that continues a statement.
static uint32_t continued_indent(const Writer *writer, const Word *word) {
    const Anchor *anchor = &writer->anchors[writer->depth];
    if (anchor->word && word->role != ROLE_CLOSE && word->indent == word_column(writer->words, anchor->word))
        return anchor->column;
    return writer->depth == 0 ? INDENT * (writer->level + 1) : anchor->indent + (word->role == ROLE_CLOSE ? 0 : INDENT);
}

static uint32_t indent_of(Writer *writer, size_t at) {
    const Word *word = &writer->words->items[at];
    if (word->begins) {
        writer->level = word->level;
        writer->depth = 0;
        writer->anchors[0] = (Anchor){0};
        if (word->level < MAX_LEVELS)
            writer->indents[word->level] = word->indent;
        return INDENT * word->level;
    }
    bool own = word->role == ROLE_COMMENT && writer->depth == 0;
    return own ? INDENT * comment_level(writer, at) : continued_indent(writer, word);
}

static bool space_between(const Words *words, size_t at) {
    const Word *before = &words->items[at - 1], *word = &words->items[at];
    if (word_is(before, "-") && word_is(word, "-"))
        return true; // two dashes would start a comment
    if (before->role == ROLE_OPEN || before->role == ROLE_PREFIX || before->role == ROLE_UNSPACED ||
        word->role == ROLE_CLOSE || word->role == ROLE_UNSPACED || word->role == ROLE_COMMA)
        return false;
    if (before->role == ROLE_COMMA || before->role == ROLE_SPACED || word->role == ROLE_SPACED)
        return !(word->role == ROLE_OPEN && word_is(before, "func"));
    if (before->role == ROLE_SUM || word->role == ROLE_SUM)
        return !word_is_unspaced(words, before->role == ROLE_SUM ? at - 1 : at);
    // An opening bracket after an operand is a call or an index, which gets no space.
    return word->role != ROLE_OPEN || before->ends_parameters;
}

// Updates anchors and bracket depth for a word that is about to be written.
static void track_brackets(Writer *writer, size_t at) {
    const Word *word = &writer->words->items[at], *before = at == 0 || word->breaks > 0 ? NULL : word - 1;
    Anchor *anchor = &writer->anchors[writer->depth];
    bool first = before && (writer->depth > 0 ? before->role == ROLE_OPEN : word_is(before, "="));
    if (first && !anchor->word) {
        const char *begins = writer->text.bytes + current_line(writer)->start;
        anchor->word = word;
        anchor->column = (uint32_t)utf8_length((Str){begins, writer->text.len - current_line(writer)->start});
    }
    if (word->role == ROLE_OPEN && writer->depth + 1 < MAX_LEVELS)
        writer->anchors[++writer->depth] = (Anchor){.indent = writer->indent};
    else if (word->role == ROLE_CLOSE && writer->depth > 0)
        writer->depth--;
}

static void add_empty_lines(Writer *writer, const Word *word, uint32_t indent) {
    uint32_t max_empty = indent == 0 ? 2 : 1, empty = word->breaks - 1;
    for (uint32_t i = 0; writer->line_count > 0 && i < empty && i < max_empty; i++)
        begin_line(writer, 0);
}

static void add_word(Writer *writer, size_t at) {
    const Words *words = writer->words;
    const Word *word = &words->items[at];
    if (writer->line_count == 0 || word->breaks > 0) {
        uint32_t indent = indent_of(writer, at);
        if (word->joined && words->items[at - 1].kind != PETRI_TOKEN_COMMENT)
            text_add_c(&writer->text, " \\");
        else if (word->breaks > 1)
            add_empty_lines(writer, word, indent);
        begin_line(writer, indent);
    } else if (word->role == ROLE_COMMENT) {
        current_line(writer)->comment = word;
        return;
    } else if (space_between(words, at)) {
        text_add_c(&writer->text, " ");
    }
    track_brackets(writer, at);
    text_add(&writer->text, word->text);
}

// Returns the common column for the comments after code on consecutive lines, the first of which is line `at`. Keeps
// the original column if all these comments have the same column and the code of each line ends before it.
static uint32_t comment_column(const Writer *writer, size_t at) {
    uint32_t max_width = 0, column = word_column(writer->words, writer->lines[at].comment);
    for (size_t i = at; i < writer->line_count && writer->lines[i].comment; i++) {
        max_width = writer->lines[i].width > max_width ? writer->lines[i].width : max_width;
        column = word_column(writer->words, writer->lines[i].comment) == column ? column : 0;
    }
    return column >= max_width + 2 ? column : max_width + 2;
}

static void write_lines(const Writer *writer, Text *out) {
    uint32_t column = 0;
    bool after_code = false;
    for (size_t i = 0; i < writer->line_count; i++) {
        const Line *at = &writer->lines[i];
        text_add(out, (Str){writer->text.bytes + at->start, at->end - at->start});
        if (at->comment) {
            column = after_code ? column : comment_column(writer, i);
            text_add_format(out, "%*s", (int)(column - at->width), "");
            text_add(out, at->comment->text);
        }
        after_code = at->comment;
        text_add_c(out, "\n");
    }
}

Str layout_normalise(Text *text) {
    static const char mark[] = "\xef\xbb\xbf";
    size_t skipped = strncmp(text->bytes, mark, strlen(mark)) == 0 ? strlen(mark) : 0;
    char *bytes = text->bytes + skipped;
    return (Str){bytes, source_unify_lines(bytes, text->len - skipped)};
}

bool layout_text(PetriSession *session, Str text, Text *out) {
    Words words;
    bool read = words_read(session, text, &words);
    if (read) {
        Writer *writer = memory_calloc(sizeof *writer);
        writer->words = &words;
        for (size_t i = 0; i < words.count; i++)
            add_word(writer, i);
        end_line(writer);
        text_add_c(out, "");
        write_lines(writer, out);
        text_free(&writer->text);
        free(writer->lines);
        free(writer);
    }
    words_free(&words);
    return read;
}

// Appends the compiled code of a script to `code`. Leaves out the first two columns of each row, because they contain
// line numbers, which formatting can change.
static bool read_code(PetriSession *session, const char *name, Str text, Text *code) {
    SCOPED_TEXT dump = {0};
    if (petri_load_text(session, name, text.bytes, text.len) != PETRI_OK ||
        petri_dump(session, PETRI_DUMP_CODE, text_collect, &dump) != PETRI_OK)
        return false;
    Str row;
    for (size_t at = 0; text_next_line(&dump, &at, &row);) {
        size_t skipped = strspn(row.bytes, " ");
        skipped += strspn(row.bytes + skipped, "0123456789 ");
        text_add(code, (Str){row.bytes + skipped, row.len - skipped});
        text_add_c(code, "\n");
    }
    return true;
}

static bool same_words(const Words *a, const Words *b) {
    bool same = a->count == b->count;
    for (size_t i = 0; same && i < a->count; i++) {
        const Word *one = &a->items[i], *other = &b->items[i];
        same = one->kind == other->kind && str_equal(one->text, other->text) && one->begins == other->begins &&
               (one->level == other->level || one->kind == PETRI_TOKEN_COMMENT);
    }
    return same;
}

bool layout_same(PetriSession *session, const char *name, Str before, Str after) {
    Words a, b = {0};
    bool same = words_read(session, before, &a) && words_read(session, after, &b) && same_words(&a, &b);
    words_free(&a);
    words_free(&b);
    SCOPED_TEXT old_code = {0};
    SCOPED_TEXT new_code = {0};
    return same && read_code(session, name, before, &old_code) && read_code(session, name, after, &new_code) &&
           old_code.len == new_code.len && memcmp(old_code.bytes, new_code.bytes, old_code.len) == 0;
}
