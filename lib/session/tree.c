// tree.c: public access to the tree of the last frame.
#include "session/session.h"
#include "value/node_batch.h"

#include <string.h>

static const Node *node_of(const PetriNode *node) {
    return (const Node *)node;
}

static PetriStatus expand_batches(PetriSession *session, void *context) {
    (void)context;
    session->frame.tree = value_expand_batches(&session->frame.systems_arena, session->frame.tree);
    return PETRI_OK;
}

// Expands node batches first, because the public interface has single nodes only.
PetriValue petri_tree(const PetriSession *session) {
    if (!session)
        return (PetriValue){0};
    if (value_has_batches(session->frame.tree) &&
        session_protect((PetriSession *)session, NULL, expand_batches, NULL) != PETRI_OK)
        return (PetriValue){0};
    return session_export_value(&session->frame.tree);
}

const char *petri_tree_kind(const PetriNode *node) {
    return node ? node_of(node)->kind->name.bytes : NULL;
}

const char *petri_tree_tag(const PetriNode *node, uint32_t number) {
    return node && number < node_of(node)->tag_count ? node_of(node)->tags[number]->name.bytes : NULL;
}

const char *petri_tree_attribute(const PetriNode *node, uint32_t number, PetriValue *value) {
    if (!node || !value || number >= node_of(node)->attr_count)
        return NULL;
    const Attr *attr = &node_of(node)->attrs[number];
    *value = session_export_value(&attr->value);
    return attr->name->name.bytes;
}

PetriValue petri_tree_get(const PetriNode *node, const char *name) {
    for (uint32_t i = 0; node && name && i < node_of(node)->attr_count; i++)
        if (strcmp(node_of(node)->attrs[i].name->name.bytes, name) == 0)
            return session_export_value(&node_of(node)->attrs[i].value);
    return (PetriValue){0};
}

const PetriNode *petri_tree_child(const PetriNode *node, uint32_t number) {
    return node && number < node_of(node)->child_count ? (const PetriNode *)node_of(node)->children[number] : NULL;
}
