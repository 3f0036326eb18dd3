// lower_node.c: lowering of loops and nodes; see lower.h.
//
// If possible, one instruction creates a node with its attributes and children (build_node). Otherwise, DECORATE and
// APPEND extend a node step by step. If their length is limited, the parts of a loop's body are yielded one by one, so
// that no vector is made for an iteration.
#include "program/lower.h"
#include "value/node_batch.h"

// --- nodes

// Returns the node of a constant expression, or NULL.
static const Node *constant_node(const Expr *expr) {
    bool is_node = expr->kind == EXPR_CONST && expr->as.value.kind == VALUE_MIXED && expr->as.value.len == 1 &&
                   expr->as.value.as.items[0].type == ITEM_NODE;
    return is_node ? expr->as.value.as.items[0].as.node : NULL;
}

// If the value of an expression is a node without attributes and children, returns that node. Otherwise returns NULL.
static const Node *bare_node(const Expr *expr, Arena *arena) {
    if (expr->kind == EXPR_NODE) {
        NodeOrigin origin = {.origin = expr->origin};
        Node *node = node_new(arena, expr->as.name);
        node->origin = arena_copy(arena, &origin, sizeof origin);
        return node;
    }
    const Node *node = constant_node(expr);
    return node && node->attr_count == 0 && node->child_count == 0 ? node : NULL;
}

static bool names_differ(const Decoration *code) {
    for (uint32_t i = 0; i < code->attr_count; i++)
        for (uint32_t k = 0; k < i; k++)
            if (code->code.names[i] == code->code.names[k])
                return false;
    return true;
}

// Returns a copy of `node` with the positions of the attributes that `decorate` adds, for messages. If the node and the
// attributes are from different files, returns `node` itself.
static const Node *with_attr_origins(Arena *arena, const Node *node, const Expr *decorate) {
    const Decoration *code = decorate->as.decorate;
    if (!node->origin || node->origin->origin.source != decorate->origin.source)
        return node;
    struct AttrOrigin *attrs = arena_alloc_array(arena, code->attr_count, sizeof *attrs);
    for (uint32_t i = 0; i < code->attr_count; i++)
        attrs[i] = (struct AttrOrigin){code->code.names[i], code->spans[i]};
    NodeOrigin origin = {node->origin->origin, attrs, code->attr_count};
    Node *placed = arena_copy(arena, node, sizeof *node);
    placed->program_lifetime = false;
    placed->origin = arena_copy(arena, &origin, sizeof origin);
    return placed;
}

enum { MAX_DISTINCT = 64 }; // maximum number of attributes of a node that build_node can create

// Sets *instr to a NODE that creates the node of an expression with its attributes and children. Returns false if one
// instruction is not enough.
static bool build_node(Lowering *lowering, const Expr *expr, Instr *instr) {
    Arena *values = lowering->options->values;
    const Expr *append = expr->kind == EXPR_APPEND ? expr : NULL;
    const Expr *inner = append ? append->children[0] : expr;
    const Expr *decorate = inner->kind == EXPR_DECORATE ? inner : NULL;
    const Node *base = bare_node(decorate ? decorate->children[0] : inner, values);
    const Decoration *code = decorate ? decorate->as.decorate : NULL;
    if (!base || (code && (code->attr_count > MAX_DISTINCT || !names_differ(code))))
        return false;
    if (decorate)
        base = with_attr_origins(values, base, decorate);
    for (uint32_t i = 0; code && i < code->code.tag_count; i++)
        base = node_add_tag(values, base, code->code.tags[i]);
    NodeCode *node = arena_alloc(lowering->options->arena, sizeof *node);
    uint32_t count = code ? code->attr_count : 0;
    *node = (NodeCode){.base = base,
                       .names = code ? lower_names(lowering, code->code.names, count) : NULL,
                       .decorated = decorate ? lower_origin(lowering, decorate) : NULL,
                       .constant_children = append ? append->as.constant_children : NULL};
    uint32_t list = code ? lower_operands(lowering, decorate->children + 1, count) : 0;
    int32_t children = CODE_NO_OPERAND;
    if (append && !node->constant_children)
        children = lower_operand(lowering, append->children[1]);
    *instr = (Instr){.op = OP_NODE, .list = list, .count = count, .b = children, .as.node = node};
    return true;
}

// --- loops

void lower_yield(Lowering *lowering, int32_t a, uint16_t loop, const Expr *at) {
    lower_emit(lowering, at, (Instr){.op = OP_YIELD, .a = a, .loop = loop});
}

// Returns true if an expression has at most one element and is not a stream. A composition of such parts cannot exceed
// the length limit, so its parts can be yielded one by one.
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

// Returns true if none of the instructions keeps data that the current iteration allocated, so that this data can be
// freed.
static bool retains_nothing(const Instr *instrs, uint32_t count) {
    static const bool retained[OP_COUNT] = {
        [OP_CLOSURE] = true,  [OP_IMPORT] = true,     [OP_NODE] = true, [OP_APPEND] = true,
        [OP_DECORATE] = true, [OP_YIELD_NODE] = true, [OP_CALL] = true};
    for (uint32_t i = 0; i < count; i++)
        if (retained[instrs[i].op] || (instrs[i].op == OP_BUILTIN && !instrs[i].as.builtin->pure))
            return false;
    return true;
}

// Emits a YIELD_NODE for the node of an iteration, so that it can be stored as a row of a node batch. Returns false if
// that is not possible.
static bool lower_yield_node(Lowering *lowering, const Expr *expr, uint16_t loop) {
    Instr row;
    if (expr != lowering->yielded_node || !build_node(lowering, expr, &row))
        return false;
    const Instr *start = &lowering->instrs[lowering->yielded_loop];
    row.op = OP_YIELD_NODE;
    row.loop = loop;
    row.target = (uint32_t)start->d;
    row.d = retains_nothing(start + 1, lowering->instr_count - lowering->yielded_loop - 1);
    lower_emit(lowering, expr, row);
    return true;
}

// Returns the expression of the only node that a loop's body creates. Returns NULL if there is no such node, or if
// nodes of its kind cannot be batched.
static const Expr *sole_node(const Expr *expr) {
    while (expr->kind == EXPR_COMPOSE && expr->slot == 1)
        for (uint32_t i = 0, count = expr->count; i < count; i++)
            if (!expr_only_binds(expr->children[i])) {
                expr = expr->children[i];
                break;
            }
    if (expr->kind != EXPR_DECORATE || expr->as.decorate->attr_count > NODE_BATCH_MAX_ATTRS)
        return NULL;
    const Expr *bare = expr->children[0];
    const Node *known = constant_node(bare);
    const Symbol *kind = bare->kind == EXPR_NODE ? bare->as.name : known ? known->kind : NULL;
    return kind && kind->batched ? expr : NULL;
}

void lower_yields(Lowering *lowering, const Expr *expr, uint16_t loop) {
    int32_t mark = lowering->next_register;
    bool single = expr->kind == EXPR_COMPOSE && expr->slot == 1;
    if (expr->kind == EXPR_IF) {
        lower_if(lowering, expr, &(Target){.to_loop = true, .loop = loop});
    } else if (single || (expr->kind == EXPR_COMPOSE && expr->slot > 1 && has_small_parts(expr))) {
        for (uint32_t i = 0; i < expr->count; i++)
            if (expr_only_binds(expr->children[i]))
                lower_statement(lowering, expr->children[i]);
            else
                lower_yields(lowering, expr->children[i], loop);
    } else if (!lower_yield_node(lowering, expr, loop)) {
        lower_yield(lowering, lower_operand(lowering, expr), loop, expr);
    }
    lowering->next_register = mark;
}

void lower_for(Lowering *lowering, const Expr *expr, int32_t d) {
    const Expr *over = expr->children[0];
    bool spans = over->kind == EXPR_RANGE;
    int32_t source[3];
    for (int i = 0; i < (spans ? 3 : 1); i++)
        source[i] = lower_operand(lowering, spans ? over->children[i] : over);
    uint16_t loop = (uint16_t)lowering->loop_depth++; // fits in 16 bits, because the nesting of expressions is limited
    if (lowering->loop_depth > lowering->loop_count)
        lowering->loop_count = lowering->loop_depth;
    if (spans) // the loop counts through the range without building it
        lower_emit(lowering, over,
                   (Instr){.op = OP_RANGE_INIT, .loop = loop, .a = source[0], .b = source[1], .c = source[2]});
    Instr loop_instr = {
        .op = spans ? OP_FOR_RANGE : OP_FOR, .d = (int32_t)expr->slot, .count = expr->slot_count, .loop = loop};
    loop_instr.a = spans ? 0 : source[0];
    uint32_t start = lowering->instr_count;
    lower_emit(lowering, expr, loop_instr);
    const Expr *outer_row = lowering->yielded_node;
    uint32_t outer_loop = lowering->yielded_loop;
    lowering->yielded_node = expr->can_batch && expr->slot_count == 1 ? sole_node(expr->children[1]) : NULL;
    lowering->yielded_loop = start;
    lower_yields(lowering, expr->children[1], loop);
    lowering->yielded_node = outer_row;
    lowering->yielded_loop = outer_loop;
    lowering->instrs[start].as.batch_plan = lower_batch(lowering, start);
    loop_instr.op = OP_NEXT;
    loop_instr.target = start + 1;
    lower_emit(lowering, expr, loop_instr);
    lower_patch_jump(lowering, start);
    lower_emit(lowering, expr, (Instr){.op = OP_END_LOOP, .d = d, .loop = loop});
    lowering->loop_depth--;
}

void lower_node(Lowering *lowering, const Expr *expr, int32_t d) {
    Instr whole;
    if (build_node(lowering, expr, &whole)) {
        whole.d = d;
        lower_emit(lowering, expr, whole);
        return;
    }
    int32_t subject = lower_operand(lowering, expr->children[0]);
    if (expr->kind == EXPR_APPEND) {
        int32_t children = expr->as.constant_children ? CODE_NO_OPERAND : lower_operand(lowering, expr->children[1]);
        lower_emit(lowering, expr,
                   (Instr){.op = OP_APPEND,
                           .d = d,
                           .a = subject,
                           .b = children,
                           .as.constant_children = expr->as.constant_children});
        return;
    }
    DecorateCode code = expr->as.decorate->code;
    uint32_t count = expr->as.decorate->attr_count;
    code.tags = lower_names(lowering, code.tags, code.tag_count);
    code.names = lower_names(lowering, code.names, count);
    uint32_t list = lower_operands(lowering, expr->children + 1, count);
    const DecorateCode *retained = arena_copy(lowering->options->arena, &code, sizeof code);
    lower_emit(lowering, expr,
               (Instr){.op = OP_DECORATE, .d = d, .b = subject, .list = list, .count = count, .as.decorate = retained});
}
