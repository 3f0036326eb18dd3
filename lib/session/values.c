// values.c: public access to values: their printed form, symbols, and the tree of the last frame.
#include "session/session.h"
#include "value/format.h"
#include "value/node_batch.h"

#include <math.h>
#include <string.h>

typedef struct Printed {
    PetriValue value;
    const char *text;
} Printed;

static PetriStatus print_value(PetriSession *session, void *context) {
    Printed *printed = context;
    Value value;
    arena_reset(&session->text_arena);
    if (session_import_value(&session->text_arena, printed->value, &value))
        printed->text = format_text(&session->text_arena, &session->symbols, value).bytes;
    return PETRI_OK;
}

const char *petri_format_value(PetriSession *session, PetriValue value) {
    if (!session)
        return NULL;
    Printed printed = {value, NULL};
    return session_protect(session, NULL, print_value, &printed) == PETRI_OK ? printed.text : NULL;
}

typedef struct SymbolRequest {
    const char *name;
    const Symbol *symbol;
} SymbolRequest;

static PetriStatus intern_symbol(PetriSession *session, void *context) {
    SymbolRequest *request = context;
    request->symbol = symbol_register(&session->symbols, str_from(request->name));
    return PETRI_OK;
}

double petri_symbol(PetriSession *session, const char *name) {
    if (!session || !name || !session_is_name(str_from(name)))
        return NAN;
    SymbolRequest request = {name, NULL};
    session_protect(session, NULL, intern_symbol, &request);
    return request.symbol ? request.symbol->number : NAN;
}

const char *petri_symbol_name(const PetriSession *session, double number) {
    const Symbol *symbol = session ? symbol_of_number(&session->symbols, number) : NULL;
    return symbol ? symbol->name.bytes : NULL;
}

// --- the tree

static const Node *node_of(const PetriNode *node) {
    return (const Node *)node;
}

static PetriStatus expand_value_batches(PetriSession *session, void *context) {
    (void)context;
    session->frame.tree = value_expand_batches(&session->frame.systems_arena, session->frame.tree);
    return PETRI_OK;
}

// Expands node batches first, because the public interface has single nodes only.
PetriValue petri_tree(const PetriSession *session) {
    if (!session)
        return (PetriValue){0};
    if (value_has_batches(session->frame.tree) &&
        session_protect((PetriSession *)session, NULL, expand_value_batches, NULL) != PETRI_OK)
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

const char *petri_tree_place(const PetriNode *node, uint32_t *line, uint32_t *column) {
    const NodeOrigin *place = node ? node_of(node)->origin : NULL;
    if (!place || !place->origin.source)
        return NULL;
    SourcePosition position = source_locate(place->origin.source, place->origin.span.start);
    if (line)
        *line = position.line;
    if (column)
        *column = position.column;
    return place->origin.source->name.bytes;
}

const PetriNode *petri_tree_child(const PetriNode *node, uint32_t number) {
    return node && number < node_of(node)->child_count ? (const PetriNode *)node_of(node)->children[number] : NULL;
}
