// tree_sitter.c: prints the syntax tree that the tree-sitter grammar builds, in the form of `petri run --dump=ast`.
//
// usage: tree_sitter FILE... Prints "FILE" and the tree, or "error LINE:COLUMN", for each file. `--query FILE` checks
// the query in that file; after `--captures FILE`, prints the captures of that query instead of trees; after `--own`,
// prints trees as tree-sitter does, with errors.
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tree_sitter/api.h>

const TSLanguage *tree_sitter_flitter(void);

static char *read_file(const char *path, uint32_t *length) {
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    size_t size = 0, room = 1 << 16;
    char *text = malloc(room);
    for (size_t n; (n = fread(text + size, 1, room - size - 1, file)) > 0; text = realloc(text, room *= 2))
        size += n;
    fclose(file);
    text[size] = '\0';
    *length = (uint32_t)size;
    return text;
}

static bool is_type(TSNode node, const char *type) {
    return !ts_node_is_null(node) && strcmp(ts_node_type(node), type) == 0;
}

static TSNode field(TSNode node, const char *name) {
    return ts_node_child_by_field_name(node, name, (uint32_t)strlen(name));
}

// Prints the name of a node as it is in the text, without its sigil.
static void print_text(const char *text, TSNode node, uint32_t sigil) {
    uint32_t start = ts_node_start_byte(node) + sigil;
    printf(" %.*s", (int)(ts_node_end_byte(node) - start), text + start);
}

// Prints line and column of a node. Columns count characters.
static void print_place(const char *text, TSNode node) {
    TSPoint start = ts_node_start_point(node);
    const char *line = text + ts_node_start_byte(node) - start.column;
    uint32_t column = 1;
    for (uint32_t i = 0; i < start.column; i++)
        column += ((unsigned char)line[i] & 0xc0) != 0x80;
    printf("  @%" PRIu32 ":%" PRIu32, start.row + 1, column);
}

static void print_node(const char *text, TSNode node, int depth);

static void print_own(TSNode root) {
    char *tree = ts_node_string(root);
    puts(tree);
    free(tree);
}

static void print_line(const char *kind, int depth) {
    printf("%*s%s\n", 2 * depth, "", kind);
}

static void print_children(const char *text, TSNode node, TSNode skipped, int depth) {
    for (uint32_t i = 0, count = ts_node_named_child_count(node); i < count; i++) {
        TSNode child = ts_node_named_child(node, i);
        if (!ts_node_eq(child, skipped))
            print_node(text, child, depth);
    }
}

// Prints a loop whose clauses are children `first` to the one before the body.
static void print_loops(const char *text, TSNode node, uint32_t first, int depth) {
    TSNode clause = ts_node_named_child(node, first);
    if (is_type(clause, "comment")) {
        print_loops(text, node, first + 1, depth);
    } else if (is_type(clause, "clause")) {
        print_line("for", depth);
        print_children(text, clause, (TSNode){0}, depth + 1);
        print_loops(text, node, first + 1, depth + 1);
    } else {
        print_node(text, clause, depth);
    }
}

static void print_node(const char *text, TSNode node, int depth) {
    static const char *const wrappers[] = {"parenthesised", "arguments", "elif", "else"};
    static const char *const renamed[][2] = {
        {"program", "suite"},    {"let_stable", "let-stable"}, {"composed", "compose"}, {"decorated", "decorate"},
        {"function", "func"},    {"parameters", "params"},     {"parameter", "param"},  {"attribute", "attr"},
        {"conditional", "cond"}, {"argument", "named"},        {"number", "literal"},   {"string", "literal"},
        {"timecode", "literal"}, {"symbol", "literal"},        {"variable", "name"}};
    static const char *const named[] = {"function", "parameter", "attribute", "argument", "pragma"};
    const char *type = ts_node_type(node), *kind = type;
    if (strcmp(type, "comment") == 0 || strcmp(type, "shebang") == 0)
        return;
    for (size_t i = 0; i < sizeof wrappers / sizeof *wrappers; i++)
        if (strcmp(type, wrappers[i]) == 0) {
            print_children(text, node, (TSNode){0}, depth);
            return;
        }
    for (size_t i = 0; i < sizeof renamed / sizeof *renamed; i++)
        if (strcmp(type, renamed[i][0]) == 0)
            kind = renamed[i][1];
    if (strcmp(type, "for") == 0 && is_type(ts_node_named_child(node, 0), "clause")) {
        print_loops(text, node, 0, depth);
        return;
    }
    TSNode operator= field(node, "operator"), skipped = {0};
    char word[8] = "";
    if (!ts_node_is_null(operator)) {
        snprintf(word, sizeof word, "%s", ts_node_type(operator));
        kind = strcmp(type, "unary") != 0 ? word : word[0] == '-' ? "neg" : word[0] == '+' ? "pos" : word;
    }
    printf("%*s%s", 2 * depth, "", kind);
    bool is_leaf = true;
    if (strcmp(kind, "name") == 0)
        print_text(text, node, 0);
    else if (strcmp(type, "node") == 0 || strcmp(type, "tag") == 0)
        print_text(text, node, 1);
    else
        is_leaf = strcmp(kind, "literal") == 0;
    for (size_t i = 0; i < sizeof named / sizeof *named; i++)
        if (strcmp(type, named[i]) == 0 && !ts_node_is_null(skipped = field(node, "name")))
            print_text(text, skipped, 0);
    if (is_leaf)
        print_place(text, node);
    puts("");
    if (strcmp(type, "range") == 0 && ts_node_is_null(field(node, "start")))
        print_line("(none)", depth + 1);
    if (strcmp(type, "for") == 0) { // of an expression; the body comes first
        skipped = field(node, "body");
        print_children(text, node, skipped, depth + 1);
        print_node(text, skipped, depth + 1);
    } else {
        print_children(text, node, skipped, depth + 1);
    }
    if ((strcmp(type, "range") == 0 && ts_node_is_null(field(node, "step"))) ||
        (strcmp(type, "conditional") == 0 && ts_node_is_null(field(node, "else"))))
        print_line("(none)", depth + 1);
}

// Returns the first error below the node, or the null node.
static TSNode find_error(TSNode node) {
    if (is_type(node, "ERROR") || ts_node_is_missing(node) || !ts_node_has_error(node))
        return ts_node_has_error(node) || ts_node_is_missing(node) ? node : (TSNode){0};
    for (uint32_t i = 0, count = ts_node_child_count(node); i < count; i++) {
        TSNode error = find_error(ts_node_child(node, i));
        if (!ts_node_is_null(error))
            return error;
    }
    return node;
}

static TSQuery *read_query(const char *path) {
    uint32_t length, offset = 0;
    TSQueryError error = TSQueryErrorNone;
    char *text = read_file(path, &length);
    TSQuery *query = text ? ts_query_new(tree_sitter_flitter(), text, length, &offset, &error) : NULL;
    if (!query)
        printf("%s: error %d at byte %" PRIu32 ": %.30s\n", path, (int)error, offset, text ? text + offset : "");
    free(text);
    return query;
}

// Prints the captures of a query. The predicates of the query are not evaluated.
static void print_captures(const char *text, TSNode root, const TSQuery *query) {
    TSQueryCursor *cursor = ts_query_cursor_new();
    ts_query_cursor_exec(cursor, query, root);
    TSQueryMatch match;
    for (uint32_t index, length; ts_query_cursor_next_capture(cursor, &match, &index);) {
        TSQueryCapture capture = match.captures[index];
        printf("%s", ts_query_capture_name_for_id(query, capture.index, &length));
        print_place(text, capture.node);
        puts("");
    }
    ts_query_cursor_delete(cursor);
}

int main(int argc, char **argv) {
    TSQuery *captures = NULL;
    bool own = false;
    TSParser *parser = ts_parser_new();
    if (!ts_parser_set_language(parser, tree_sitter_flitter()))
        return 1;
    for (int i = 1; i < argc; i++) {
        bool captures_follow = strcmp(argv[i], "--captures") == 0;
        if (captures_follow || strcmp(argv[i], "--query") == 0) {
            TSQuery *query = i + 1 < argc ? read_query(argv[++i]) : NULL;
            if (!query)
                return 1;
            ts_query_delete(captures_follow ? captures : query);
            captures = captures_follow ? query : captures;
            continue;
        }
        if (strcmp(argv[i], "--own") == 0) {
            own = true;
            continue;
        }
        uint32_t length;
        char *text = read_file(argv[i], &length);
        TSTree *tree = text ? ts_parser_parse_string(parser, NULL, text, length) : NULL;
        if (!tree)
            return 1;
        puts(argv[i]);
        TSNode root = ts_tree_root_node(tree);
        if (own) {
            print_own(root);
        } else if (ts_node_has_error(root)) {
            printf("error");
            print_place(text, find_error(root));
            puts("");
        } else if (captures) {
            print_captures(text, root, captures);
        } else {
            print_node(text, root, 0);
        }
        ts_tree_delete(tree);
        free(text);
    }
    ts_query_delete(captures);
    ts_parser_delete(parser);
}
