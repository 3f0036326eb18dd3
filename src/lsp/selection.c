// selection.c: selection ranges, with which an editor extends the selection: token, value, attribute or argument,
// contents of brackets, brackets, statement, block, enclosing blocks, text.
#include "lsp/server.h"

#include <string.h>

// A growing selection around an offset. `json` has the ranges so far; each but the last contains the next as `parent`.
typedef struct Selection {
    const RequestContext *request;
    JsonWriter *json;
    size_t offset;
    size_t start; // last range
    size_t end;
    size_t count;
} Selection;

// Adds a range if it contains the offset and is larger than the last range.
static void grow(Selection *selection, size_t start, size_t end) {
    bool around = start <= selection->offset && selection->offset <= end;
    if (selection->count > 0)
        around = start <= selection->start && selection->end <= end && end - start > selection->end - selection->start;
    if (!around)
        return;
    json_open(selection->json, selection->count == 0 ? NULL : "parent", "{");
    document_put_range(selection->json, "range", selection->request->document, start, end,
                       selection->request->server->utf8);
    selection->start = start;
    selection->end = end;
    selection->count++;
}

static void grow_to_tokens(Selection *selection, size_t first, size_t last) {
    const PetriToken *tokens = selection->request->document->tokens;
    grow(selection, tokens[first].start, tokens[last].end);
}

// Returns 1 for an opening bracket, -1 for a closing one, else 0.
static int bracket(const Document *document, size_t token) {
    Str text = document_token(document, token);
    if (document->tokens[token].kind != PETRI_TOKEN_OPERATOR || text.len != 1)
        return 0;
    return strchr("([{", text.bytes[0]) ? 1 : strchr(")]}", text.bytes[0]) ? -1 : 0;
}

// Returns true for the name of an attribute, binding or named argument.
static bool is_named(const Document *document, size_t token) {
    return document->tokens[token].kind == PETRI_TOKEN_NAME && document_is(document, token + 1, "=");
}

// What surrounds a token on one side, inside the same brackets or statement. Each is the last token of its kind.
typedef struct Side {
    size_t argument; // of the argument, which ends at a comma
    size_t binding;  // of the `name=value`; on the left side SIZE_MAX: there is none
    size_t all;      // of the brackets' contents, or of the statement
} Side;

// Walks from a token to the left up to the token `limit`.
static Side left_of(const Document *document, size_t token, size_t limit) {
    Side side = {.argument = SIZE_MAX, .binding = is_named(document, token) ? token : SIZE_MAX, .all = token};
    int depth = bracket(document, token) < 0;
    for (; side.all > limit; side.all--) {
        int turn = bracket(document, side.all - 1);
        if (depth == 0 && turn > 0)
            break;
        depth -= turn;
        if (depth != 0)
            continue;
        if (side.argument == SIZE_MAX && document_is(document, side.all - 1, ","))
            side.argument = side.all;
        if (side.argument == SIZE_MAX && side.binding == SIZE_MAX && is_named(document, side.all - 1))
            side.binding = side.all - 1;
    }
    side.argument = side.argument == SIZE_MAX ? side.all : side.argument;
    return side;
}

// Walks from a token to the right up to the token `limit`.
static Side right_of(const Document *document, size_t token, size_t limit) {
    Side side = {.argument = SIZE_MAX, .binding = SIZE_MAX, .all = token};
    int depth = bracket(document, token) > 0;
    for (; side.all < limit; side.all++) {
        int turn = bracket(document, side.all + 1);
        if (depth == 0 && turn < 0)
            break;
        depth += turn;
        if (depth != 0 || turn != 0)
            continue;
        bool comma = document_is(document, side.all + 1, ",");
        side.argument = comma && side.argument == SIZE_MAX ? side.all : side.argument;
        side.binding =
            (comma || is_named(document, side.all + 1)) && side.binding == SIZE_MAX ? side.all : side.binding;
    }
    side.argument = side.argument == SIZE_MAX ? side.all : side.argument;
    side.binding = side.binding == SIZE_MAX ? side.all : side.binding;
    return side;
}

// Grows from a token to its statement, which consists of the tokens from `first` to `last`.
static void grow_in_statement(Selection *selection, size_t token, size_t first, size_t last) {
    const Document *document = selection->request->document;
    grow_to_tokens(selection, token, token);
    for (;;) {
        Side left = left_of(document, token, first), right = right_of(document, token, last);
        if (left.binding != SIZE_MAX && left.binding + 2 <= right.binding)
            grow_to_tokens(selection, left.binding + 2, right.binding);
        if (left.binding != SIZE_MAX)
            grow_to_tokens(selection, left.binding, right.binding);
        grow_to_tokens(selection, left.argument, right.argument);
        grow_to_tokens(selection, left.all, right.all);
        if (left.all == first || right.all == last)
            break;
        token = left.all - 1;
        grow_to_tokens(selection, token, right.all + 1);
    }
    grow_to_tokens(selection, first, last);
}

// Grows from the statement at a token to the blocks around it.
static void grow_to_blocks(Selection *selection, size_t first) {
    const Document *document = selection->request->document;
    grow(selection, document->tokens[first].start, document_block_end(document, first));
    for (size_t level = document_level(document, first), body = first; level > 0 && first-- > 0;) {
        if (!document_begins(document, first) || document_level(document, first) > level)
            continue;
        if (document_level(document, first) == level) {
            body = first;
            continue;
        }
        level = document_level(document, first);
        size_t end = document_block_end(document, first);
        grow(selection, document->tokens[body].start, end);
        grow(selection, document->tokens[first].start, end);
        body = first;
    }
}

// Returns the token at an offset: at the end of a name, the name; in a space, a token beside it.
static size_t token_at(const Document *document, size_t offset) {
    size_t token = document_token_at(document, offset);
    bool after = token > 0 && document->tokens[token - 1].end == offset;
    bool word = token < document->token_count && document->tokens[token].start == offset &&
                document->tokens[token].kind != PETRI_TOKEN_OPERATOR;
    bool new_statement =
        token < document->token_count && document->tokens[token].start > offset && document_begins(document, token);
    return token > 0 && (token == document->token_count || (after && !word) || new_statement) ? token - 1 : token;
}

static void select_at(Selection *selection) {
    const Document *document = selection->request->document;
    if (document->token_count > 0) {
        size_t token = token_at(document, selection->offset), first = token, last = token;
        while (first > 0 && !document_begins(document, first))
            first--;
        while (last + 1 < document->token_count && !document_begins(document, last + 1))
            last++;
        while (last > token && document->tokens[last].kind == PETRI_TOKEN_COMMENT)
            last--;
        grow_in_statement(selection, token, first, last);
        grow_to_blocks(selection, first);
    }
    grow(selection, 0, document->text.len);
}

void answer_selection(const RequestContext *request, JsonWriter *result, const char **problem) {
    (void)problem;
    const Json *positions = json_get(request->params, "positions");
    json_open(result, NULL, "[");
    for (const Json *position = NULL; (position = json_next(positions, position));) {
        Selection selection = {.request = request, .json = result};
        selection.offset = document_offset(request->document, position, request->server->utf8);
        select_at(&selection);
        for (size_t i = 0; i < selection.count; i++)
            json_close(result, "}");
    }
    json_close(result, "]");
}
