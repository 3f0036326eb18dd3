// drawn_files.c: files that only drawing reads, such as images. A run without pictures does not read them, but its
// archive has them, so that its frames can be drawn later.
#include "base/file.h"
#include "session/recorder.h"
#include "session/session.h"
#include "value/tree_memo.h"

enum {
    MAX_DRAWN_DEPTH = 100, // deeper nodes are not drawn
    READ_WORK = 500,       // units of work of the attempt to read a file
};

typedef struct DrawnSearch {
    RecorderKnowsFile *knows;
    void *user_data;
    const Symbol *filename;
    const Symbol *physics;
    Arena arena;
    TreeMemo depths; // smallest depth at which a node was visited, because frames can share nodes
} DrawnSearch;

typedef struct FileRequest {
    Str name;
    Arena arena;
} FileRequest;

static PetriStatus read_requested_file(PetriSession *session, void *context) {
    enum { MAX_BYTES = 256 << 20 };
    FileRequest *request = context;
    Str bytes, path = path_join(&request->arena, session->reach.directory, request->name);
    const char *problem;
    file_read(&request->arena, &session->reach, str_to_c(&request->arena, path), true, MAX_BYTES, &bytes, NULL,
              &problem);
    return PETRI_OK;
}

static void read_drawn_file(PetriSession *session, Str name) {
    FileRequest request = {.name = name};
    session_arena(session, &request.arena, "file", SIZE_MAX);
    session_protect(session, &request.arena, read_requested_file, &request);
    arena_free(&request.arena);
}

static void read_file_of(PetriSession *session, DrawnSearch *search, const Node *node) {
    Value value = node_get(node, search->filename);
    if (value.kind != VALUE_MIXED || value.len != 1 || value.as.items[0].type != ITEM_STRING)
        return;
    Str name = value.as.items[0].as.string->text;
    // Each file is read only once, because reading it in every frame would take too long.
    if (search->knows(search->user_data, name))
        return;
    arena_charge(&search->arena, READ_WORK);
    read_drawn_file(session, name);
}

// A batch has the same file name in all its nodes (value/node_batch.h).
static void visit(PetriSession *session, DrawnSearch *search, const Node *node, uint64_t depth) {
    uint64_t before;
    if (node->kind == search->physics)
        return;                          // has many nodes, and no files
    session->schema.current_node = node; // for the report of a limit
    if (tree_memo_find(&search->depths, &search->arena, node, NULL, &before) && before <= depth)
        return;
    tree_memo_store(&search->depths, node, NULL, depth);
    read_file_of(session, search, node);
    for (uint32_t i = 0; depth < MAX_DRAWN_DEPTH && i < node->child_count; i++)
        visit(session, search, node->children[i], depth + 1);
}

static PetriStatus visit_tree(PetriSession *session, void *context) {
    DrawnSearch *search = context;
    Value tree = session->frame.tree;
    search->filename = symbol_intern(&session->symbols, STR("filename"));
    search->physics = symbol_intern(&session->symbols, STR("physics"));
    for (uint32_t i = 0; tree.kind == VALUE_MIXED && i < tree.len; i++)
        if (tree.as.items[i].type == ITEM_NODE)
            visit(session, search, tree.as.items[i].as.node, 0);
    return PETRI_OK;
}

PetriStatus recorder_read_drawn_files(PetriSession *session, RecorderKnowsFile *knows, void *user_data) {
    DrawnSearch search = {.knows = knows, .user_data = user_data};
    session_arena(session, &search.arena, "files", SIZE_MAX);
    PetriStatus status = session_protect(session, &search.arena, visit_tree, &search);
    arena_free(&search.arena);
    session_report_abort(session, status, "the search for files to archive");
    if (status == PETRI_INTERRUPTED)
        petri_interrupt(session); // interrupts the next frame
    return status;
}
