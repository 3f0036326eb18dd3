// drawn_files.c: files that only drawing reads, such as images. A run without pictures does not read them, but its
// archive has them, so that its frames can be drawn later.
#include "petri-inspect.h"
#include "recording/archive.h"

#include <string.h>

enum { MAX_DEPTH = 64 };

static void add_file_of(PetriArchive *archive, const PetriNode *node) {
    PetriValue value = petri_tree_get(node, "filename");
    if (value.length != 1 || !value.items || value.items[0].type != PETRI_STRING)
        return;
    Str name = {value.items[0].as.string->bytes, value.items[0].as.string->length};
    // Each file is read only once, because reading it in every frame would take too long.
    if (!archive_find_file(archive, name, INT64_MAX))
        recorder_read_file(archive->session, name);
}

static void visit(PetriArchive *archive, const PetriNode *node, int depth) {
    const PetriNode *child;
    if (strcmp(petri_tree_kind(node), "physics") == 0)
        return; // has many nodes, and no files
    add_file_of(archive, node);
    for (uint32_t i = 0; depth < MAX_DEPTH && (child = petri_tree_child(node, i)); i++)
        visit(archive, child, depth + 1);
}

void archive_add_drawn_files(PetriArchive *archive) {
    PetriValue tree = petri_tree(archive->session);
    for (uint32_t i = 0; tree.items && i < tree.length; i++)
        if (tree.items[i].type == PETRI_NODE)
            visit(archive, tree.items[i].as.node, 0);
}
