// lower_node.c: loops and nodes; see lower.h.
#include "program/lower.h"

// --- loops

void lower_add_part(Lowering *lowering, int32_t a, uint16_t loop, const Expr *at) {
    lower_emit(lowering, at, (Instr){.op = OP_ADD_PART, .a = a, .loop = loop});
}

// Has an expression one element at the most, and is it no stream? Then a composition of such parts is not too long, and
// its parts can be added to what is around it one by one.
static bool is_small(const Expr *expr) {
    switch (expr->kind) {
    case EXPR_NODE:
        return true;
    case EXPR_CONST:
        return expr->as.value.len <= 1 && expr->as.value.kind != VALUE_STREAM;
    case EXPR_DECORATE:
    case EXPR_APPEND:
        return is_small(expr->children[0]);
    case EXPR_IF:
        for (uint32_t i = 0; i < expr->count; i++)
            if ((i % 2 == 1 || i + 1 == expr->count) && !is_small(expr->children[i]))
                return false;
        return true;
    default:
        return false;
    }
}

static bool has_small_parts(const Expr *expr) {
    for (uint32_t i = 0; i < expr->count; i++)
        if (!expr_only_binds(expr->children[i]) && !is_small(expr->children[i]))
            return false;
    return true;
}

void lower_part(Lowering *lowering, const Expr *expr, uint16_t loop) {
    int32_t mark = lowering->next_register;
    bool single = expr->kind == EXPR_COMPOSE && expr->slot == 1;
    if (expr->kind == EXPR_IF) {
        lower_if(lowering, expr, &(Target){.to_loop = true, .loop = loop});
    } else if (single || (expr->kind == EXPR_COMPOSE && expr->slot > 1 && has_small_parts(expr))) {
        for (uint32_t i = 0; i < expr->count; i++)
            if (expr_only_binds(expr->children[i]))
                lower_statement(lowering, expr->children[i]);
            else
                lower_part(lowering, expr->children[i], loop);
    } else {
        lower_add_part(lowering, lower_operand(lowering, expr), loop, expr);
    }
    lowering->next_register = mark;
}

void lower_for(Lowering *lowering, const Expr *expr, int32_t d) {
    int32_t source = lower_operand(lowering, expr->children[0]);
    uint16_t loop = (uint16_t)lowering->loop_depth++; // expressions are not nested as deeply as that
    if (lowering->loop_depth > lowering->loop_count)
        lowering->loop_count = lowering->loop_depth;
    Instr round = {.op = OP_FOR, .a = source, .d = (int32_t)expr->slot, .count = expr->slot_count, .loop = loop};
    uint32_t start = lowering->instr_count;
    lower_emit(lowering, expr, round);
    lower_part(lowering, expr->children[1], loop);
    round.op = OP_NEXT;
    round.target = start + 1;
    lower_emit(lowering, expr, round);
    lower_land(lowering, start);
    lower_emit(lowering, expr, (Instr){.op = OP_COLLECT, .d = d, .loop = loop});
    lowering->loop_depth--;
}

// --- nodes

// The node that an expression is before anything has been added to it, or NULL if it is something else.
static const Node *bare_node(const Expr *expr, Arena *arena) {
    if (expr->kind == EXPR_NODE) {
        NodeOrigin origin = {.place = expr->place};
        Node *node = node_new(arena, expr->as.name);
        node->origin = arena_copy(arena, &origin, sizeof origin);
        return node;
    }
    if (expr->kind != EXPR_CONST || expr->as.value.kind != VALUE_MIXED || expr->as.value.len != 1 ||
        expr->as.value.as.items[0].type != ITEM_NODE)
        return NULL;
    const Node *node = expr->as.value.as.items[0].as.node;
    return node->attr_count == 0 && node->child_count == 0 ? node : NULL;
}

static bool names_differ(const Decoration *code) {
    for (uint32_t i = 0; i < code->attr_count; i++)
        for (uint32_t k = 0; k < i; k++)
            if (code->code.names[i] == code->code.names[k])
                return false;
    return true;
}

// The node with the places of the attributes that are written with it, for messages.
static const Node *with_places(Arena *arena, const Node *node, const Expr *decorate) {
    const Decoration *code = decorate->as.decorate;
    if (!node->origin || node->origin->place.source != decorate->place.source)
        return node;
    struct AttrOrigin *attrs = arena_alloc_array(arena, code->attr_count, sizeof *attrs);
    for (uint32_t i = 0; i < code->attr_count; i++)
        attrs[i] = (struct AttrOrigin){code->code.names[i], code->spans[i]};
    NodeOrigin origin = {node->origin->place, attrs, code->attr_count};
    Node *placed = arena_copy(arena, node, sizeof *node);
    placed->program_lifetime = false;
    placed->origin = arena_copy(arena, &origin, sizeof origin);
    return placed;
}

enum { MOST_DISTINCT = 64 }; // attributes that are compared with each other

// A node with attributes and children that can be made at once; false if it cannot.
static bool whole_node(Lowering *lowering, const Expr *expr, int32_t d) {
    Arena *values = lowering->options->values;
    const Expr *append = expr->kind == EXPR_APPEND ? expr : NULL;
    const Expr *inner = append ? append->children[0] : expr;
    const Expr *decorate = inner->kind == EXPR_DECORATE ? inner : NULL;
    const Node *base = bare_node(decorate ? decorate->children[0] : inner, values);
    const Decoration *code = decorate ? decorate->as.decorate : NULL;
    if (!base || (code && (code->attr_count > MOST_DISTINCT || !names_differ(code))))
        return false;
    if (decorate)
        base = with_places(values, base, decorate);
    for (uint32_t i = 0; code && i < code->code.tag_count; i++)
        base = node_add_tag(values, base, code->code.tags[i]);
    NodeCode *node = arena_alloc(lowering->options->arena, sizeof *node);
    uint32_t count = code ? code->attr_count : 0;
    *node = (NodeCode){.base = base,
                       .names = code ? lower_names(lowering, code->code.names, count) : NULL,
                       .decorated = decorate ? lower_place(lowering, decorate) : NULL,
                       .kept = append ? append->as.kept : NULL};
    uint32_t list = code ? lower_operands(lowering, decorate->children + 1, count) : 0;
    int32_t children = CODE_NO_OPERAND;
    if (append && !node->kept)
        children = lower_operand(lowering, append->children[1]);
    lower_emit(lowering, expr,
               (Instr){.op = OP_NODE, .d = d, .list = list, .count = count, .b = children, .as.node = node});
    return true;
}

void lower_node(Lowering *lowering, const Expr *expr, int32_t d) {
    if (whole_node(lowering, expr, d))
        return;
    int32_t subject = lower_operand(lowering, expr->children[0]);
    if (expr->kind == EXPR_APPEND) {
        int32_t children = expr->as.kept ? CODE_NO_OPERAND : lower_operand(lowering, expr->children[1]);
        lower_emit(lowering, expr,
                   (Instr){.op = OP_APPEND, .d = d, .a = subject, .b = children, .as.kept = expr->as.kept});
        return;
    }
    DecorateCode code = expr->as.decorate->code;
    uint32_t count = expr->as.decorate->attr_count;
    code.tags = lower_names(lowering, code.tags, code.tag_count);
    code.names = lower_names(lowering, code.names, count);
    uint32_t list = lower_operands(lowering, expr->children + 1, count);
    const DecorateCode *kept = arena_copy(lowering->options->arena, &code, sizeof code);
    lower_emit(lowering, expr,
               (Instr){.op = OP_DECORATE, .d = d, .b = subject, .list = list, .count = count, .as.decorate = kept});
}
