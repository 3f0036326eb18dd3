// tree_lint.c: reports of nodes and attributes that a frame ignores, whether the frame is drawn or not.
#include "session/session.h"

// Returns the known kind of top-level node that is spelled most similarly, or an empty string.
static Str nearest_top_kind(Str kind) {
    StrNearest nearest = str_nearest(kind);
    for (int i = 0; i < KIND_COUNT; i++)
        if (schema_kinds[i].place == PLACE_SCENE || schema_kinds[i].place == PLACE_TOP)
            str_try_nearest(&nearest, str_from(schema_kinds[i].name));
    return nearest.found;
}

static bool is_top_kind(const Schema *schema, const Symbol *kind) {
    for (int i = 0; i < KIND_COUNT; i++)
        if (schema->kinds[i] == kind && (schema_kinds[i].place == PLACE_SCENE || schema_kinds[i].place == PLACE_TOP))
            return true;
    return false;
}

static void report_top_node(PetriSession *session, const Node *node) {
    Arena *arena = &session->frame.systems_arena;
    Str kind = node->kind->name, nearest = nearest_top_kind(kind);
    NodeRejection why = schema_rejection(kind);
    Text text = text_new(arena);
    text_add_format(&text, "'!%.*s' %s", STR_ARGS(kind),
                    why == NODE_UNSUPPORTED ? "is not supported; ignored" : "does nothing");
    if (why == NODE_MISPLACED)
        text_add_c(&text, " at the top level");
    schema_add_home(&text, kind);
    Str hint =
        why == NODE_UNKNOWN && nearest.len ? str_format(arena, "did you mean '!%.*s'?", STR_ARGS(nearest)) : (Str){0};
    Diag diag = {DIAG_WARNING, node_origin(node, NULL), text_str(&text), .hint = hint,
                 .code = schema_rejection_codes[why]};
    session_report_keyed(session, &diag, str_format(arena, "top %.*s", STR_ARGS(kind)));
}

// Without a window, nodes of unknown kinds are the output of a calculation, which `petri run` prints. They are then
// reported only if their name resembles that of a known kind.
static bool is_output(const Symbol *kind, bool has_window) {
    return !has_window && schema_rejection(kind->name) == NODE_UNKNOWN && !nearest_top_kind(kind->name).len;
}

void session_lint_top_nodes(PetriSession *session) {
    const Symbol *last = NULL; // kind of the previous node
    uint32_t at = 0;
    bool has_window = canvas_next_window(&session->schema, session->frame.tree, &at);
    for (uint32_t i = 0; session->frame.tree.kind == VALUE_MIXED && i < session->frame.tree.len; i++) {
        const Item *item = &session->frame.tree.as.items[i];
        if (item->type != ITEM_NODE || item->as.node->kind == last)
            continue;
        last = item->as.node->kind;
        if (!is_top_kind(&session->schema, last) && !is_output(last, has_window))
            report_top_node(session, item->as.node);
    }
}

// Reads all windows as for drawing, but does not check access to the files that they name.
static PetriStatus read_windows(PetriSession *session, void *context) {
    Arena *arena = context;
    Schema *schema = arena_copy(arena, &session->schema, sizeof *schema);
    const Node *window;
    schema->file_access = NULL;
    for (uint32_t at = 0; (window = canvas_next_window(schema, session->frame.tree, &at));) {
        canvas_read(schema, arena, window);
        if (session->frame.no_frame_yet)
            session_lint_drawings(schema, arena, window, session->config.program->source);
    }
    return PETRI_OK;
}

// Adds a pair of kinds. Returns true if it is new. If there are too many pairs, all count as known.
static bool add_repeated_pair(SeenNodes *seen, const Symbol *parent, const Symbol *child) {
    enum { CAPACITY = sizeof seen->pairs / sizeof *seen->pairs };
    for (uint32_t i = 0; i < seen->count; i++)
        if (seen->pairs[i][1] == child && seen->pairs[i][0] == parent)
            return false;
    if (seen->count == CAPACITY)
        return false;
    seen->pairs[seen->count][0] = parent;
    seen->pairs[seen->count++][1] = child;
    return true;
}

// Adds the pairs below a node. Visits at most *left nodes. Returns true if there are new pairs.
static bool add_pairs(SeenNodes *seen, const Node *parent, const Symbol *kind, int depth, uint32_t *left) {
    enum { MAX_DEPTH = 100 };  // deeper nodes are not drawn
    const Symbol *last = NULL; // kind of the previous child
    bool found = false;
    for (uint32_t i = 0; i < parent->child_count && depth < MAX_DEPTH && *left != 0; i++) {
        const Node *child = parent->children[i];
        --*left;
        found |= child->kind != last && add_repeated_pair(seen, kind, child->kind);
        last = child->kind;
        found |= child->child_count > 0 && add_pairs(seen, child, child->kind, depth + 1, left);
    }
    return found;
}

void session_lint_windows(PetriSession *session) {
    enum { MAX_NODES = 1 << 14 }; // the search takes at most 0.1 ms per frame, so it is not charged
    uint32_t at = 0, left = MAX_NODES;
    bool found = false;
    const Node *window;
    while ((window = canvas_next_window(&session->schema, session->frame.tree, &at)))
        found |= session->frame.no_frame_yet | add_pairs(&session->frame.seen, window, NULL, 0, &left);
    if (!found)
        return;
    Arena arena;
    session_arena(session, &arena, "windows", session->options.memory_limit);
    PetriStatus status = session_protect(session, &arena, read_windows, &arena);
    arena_free(&arena);
    if (status == PETRI_INTERRUPTED)
        petri_interrupt(session); // interrupts the rest of the frame
}
