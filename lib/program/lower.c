// lower.c: lowering of expressions to instructions; see code.h.
//
// Temporaries are allocated like a stack above the slots, so a pending operand is never overwritten. A name used as an
// operand is not copied: the instruction reads its slot, still within the scope of the name. In `let x=VALUE`, the
// value is written directly to the slot of x. Names that VALUE binds may use the same slot, because x is not visible in
// VALUE. So the slot of x must not be written before all operands of VALUE have been read.
#include "program/lower.h"

#include "base/source.h"

// Returns the line of an instruction for the profile. An instruction that ends an expression of several lines belongs
// to the last line.
static uint32_t line_of(const Lowering *lowering, Opcode op, const Expr *at) {
    uint32_t last = lowering->instr_count;
    bool ends = op == OP_COMPOSE || op == OP_JUMP || op == OP_RETURN;
    if (ends && last > 0 && lowering->instrs[last - 1].at->source == at->origin.source)
        return lowering->lines[last - 1];
    return source_line(at->origin.source, at->origin.span.start);
}

// Emits instructions that compute an expression into register `d`.
static void lower_into(Lowering *lowering, const Expr *expr, int32_t d);

const Origin *lower_origin(Lowering *lowering, const Expr *expr) {
    if (lowering->origin_expr != expr)
        lowering->origin = arena_copy(lowering->options->arena, &expr->origin, sizeof expr->origin);
    lowering->origin_expr = expr;
    return lowering->origin;
}

const Symbol *const *lower_names(const Lowering *lowering, const Symbol *const *names, uint32_t count) {
    return count ? arena_copy(lowering->options->arena, names, count * sizeof *names) : NULL;
}

void lower_emit(Lowering *lowering, const Expr *at, Instr instr) {
    uint32_t capacity = lowering->instr_capacity;
    lowering->instrs =
        arena_grow_array(lowering->options->scratch, lowering->instrs, lowering->instr_count, &capacity, sizeof(Instr));
    if (lowering->options->lines) {
        uint32_t same = lowering->instr_capacity;
        lowering->lines = arena_grow_array(lowering->options->scratch, lowering->lines, lowering->instr_count, &same,
                                           sizeof(uint32_t));
        lowering->lines[lowering->instr_count] = line_of(lowering, (Opcode)instr.op, at);
    }
    lowering->instr_capacity = capacity;
    instr.at = lower_origin(lowering, at);
    lowering->instrs[lowering->instr_count++] = instr;
}

// Allocates a register, which stays in use until next_register is reset.
static int32_t add_temporary(Lowering *lowering) {
    int32_t temporary = lowering->next_register++;
    if (lowering->next_register > lowering->register_count)
        lowering->register_count = lowering->next_register;
    return temporary;
}

// Adds a constant and returns the operand that refers to it.
static int32_t add_constant(Lowering *lowering, Value value) {
    lowering->constants = arena_grow_array(lowering->options->scratch, lowering->constants, lowering->constant_count,
                                           &lowering->constant_capacity, sizeof(Value));
    lowering->constants[lowering->constant_count++] = value;
    return -(int32_t)lowering->constant_count;
}

int32_t lower_operand(Lowering *lowering, const Expr *expr) {
    if (expr->kind == EXPR_CONST)
        return add_constant(lowering, expr->as.value);
    if (expr->kind == EXPR_SLOT)
        return (int32_t)expr->slot;
    int32_t temporary = add_temporary(lowering);
    lower_into(lowering, expr, temporary);
    return temporary;
}

// Must be called after all operands have been lowered, because lowering nested expressions also appends lists.
// Appends a list of operands and returns its start in Code.operands.
static uint32_t add_operands(Lowering *lowering, const int32_t *operands, uint32_t count) {
    uint32_t start = lowering->operand_count;
    for (uint32_t i = 0; i < count; i++) {
        lowering->operands = arena_grow_array(lowering->options->scratch, lowering->operands, lowering->operand_count,
                                              &lowering->operand_capacity, sizeof(int32_t));
        lowering->operands[lowering->operand_count++] = operands[i];
    }
    return start;
}

uint32_t lower_operands(Lowering *lowering, const Expr *const *exprs, uint32_t count) {
    int32_t *operands = arena_alloc_array(lowering->options->scratch, count, sizeof *operands);
    for (uint32_t i = 0; i < count; i++)
        operands[i] = lower_operand(lowering, exprs[i]);
    return add_operands(lowering, operands, count);
}

void lower_patch_jump(Lowering *lowering, uint32_t jump) {
    lowering->instrs[jump].target = lowering->instr_count;
}

static uint32_t emit_jump(Lowering *lowering, uint16_t op, int32_t a, const Expr *at) {
    lower_emit(lowering, at, (Instr){.op = op, .a = a});
    return lowering->instr_count - 1;
}

static void emit_move(Lowering *lowering, int32_t d, int32_t a, const Expr *at) {
    if (d != a)
        lower_emit(lowering, at, (Instr){.op = OP_MOVE, .d = d, .a = a});
}

// Emits the instruction `op`, whose operands are the values of the one or two children of `expr`.
static void emit_operator(Lowering *lowering, uint16_t op, const Expr *expr, int32_t d) {
    int32_t a = lower_operand(lowering, expr->children[0]);
    int32_t b = expr->count > 1 ? lower_operand(lowering, expr->children[1]) : a;
    if (expr->slot) // <, >, <= or >= with the same object on both sides (L5.5)
        emit_move(lowering, d, add_constant(lowering, value_number(op == OP_LE || op == OP_GE)), expr);
    else
        lower_emit(lowering, expr, (Instr){.op = op, .d = d, .a = a, .b = b});
}

static void lower_load(Lowering *lowering, const Expr *expr, int32_t d) {
    uint16_t op = expr->kind == EXPR_CAPTURE  ? OP_CAPTURE
                  : expr->kind == EXPR_SELF   ? OP_SELF
                  : expr->kind == EXPR_GLOBAL ? OP_GLOBAL
                                              : OP_UNBOUND;
    Instr instr = {.op = op, .d = d, .target = expr->slot, .a = expr->dynamic};
    if (op == OP_UNBOUND)
        instr.as.name = expr->as.name;
    lower_emit(lowering, expr, instr);
}

// --- statements that bind names and have no value

static void lower_bind(Lowering *lowering, const Expr *expr) {
    const Expr *value = expr->children[0];
    if (expr->slot_count == 1) {
        lower_into(lowering, value, (int32_t)expr->slot);
        return;
    }
    int32_t a = lower_operand(lowering, value);
    lower_emit(lowering, expr, (Instr){.op = OP_UNPACK, .d = (int32_t)expr->slot, .count = expr->slot_count, .a = a});
}

static void lower_import(Lowering *lowering, const Expr *expr) {
    int32_t a = lower_operand(lowering, expr->children[0]);
    lower_emit(lowering, expr,
               (Instr){.op = OP_IMPORT,
                       .d = (int32_t)expr->slot,
                       .count = expr->slot_count,
                       .a = a,
                       .as.names = lower_names(lowering, expr->as.names, expr->slot_count)});
}

void lower_statement(Lowering *lowering, const Expr *expr) {
    int32_t mark = lowering->next_register;
    if (expr->kind == EXPR_BIND)
        lower_bind(lowering, expr);
    else if (expr->kind == EXPR_IMPORT)
        lower_import(lowering, expr);
    else
        for (uint32_t i = 0; i < expr->count; i++)
            lower_statement(lowering, expr->children[i]);
    lowering->next_register = mark;
}

// --- values

static void lower_compose(Lowering *lowering, const Expr *expr, int32_t d) {
    if (expr->slot == 1 && !expr_only_binds(expr->children[expr->count - 1])) {
        for (uint32_t i = 0; i + 1 < expr->count; i++)
            lower_statement(lowering, expr->children[i]);
        lower_into(lowering, expr->children[expr->count - 1], d);
        return;
    }
    int32_t *parts = arena_alloc_array(lowering->options->scratch, expr->slot, sizeof *parts);
    uint32_t count = 0;
    for (uint32_t i = 0; i < expr->count; i++)
        if (expr_only_binds(expr->children[i]))
            lower_statement(lowering, expr->children[i]);
        else
            parts[count++] = lower_operand(lowering, expr->children[i]);
    if (count < 2) {
        emit_move(lowering, d, count ? parts[0] : add_constant(lowering, VALUE_NULL), expr);
        return;
    }
    uint32_t list = add_operands(lowering, parts, count);
    lower_emit(lowering, expr, (Instr){.op = OP_COMPOSE, .d = d, .list = list, .count = count});
}

// Emits `or` or `and`: the right side is evaluated only if the result is not the left value.
static void lower_short_circuit(Lowering *lowering, const Expr *expr, int32_t d) {
    int32_t left = lower_operand(lowering, expr->children[0]);
    int32_t result = add_temporary(lowering);
    emit_move(lowering, result, left, expr);
    uint32_t jump = emit_jump(lowering, expr->kind == EXPR_OR ? OP_JUMP_TRUE : OP_JUMP_FALSE, result, expr);
    lower_into(lowering, expr->children[1], result);
    lower_patch_jump(lowering, jump);
    emit_move(lowering, d, result, expr);
}

// Emits a branch of an `if`. Its value goes to a register or, in a loop's body, is yielded.
static void lower_branch(Lowering *lowering, const Expr *expr, const Target *target) {
    int32_t mark = lowering->next_register;
    if (target->to_loop)
        lower_yields(lowering, expr, target->loop);
    else
        lower_into(lowering, expr, target->d);
    lowering->next_register = mark;
}

void lower_if(Lowering *lowering, const Expr *expr, const Target *target) {
    uint32_t *ends = arena_alloc_array(lowering->options->scratch, expr->count, sizeof *ends), end_count = 0, i = 0;
    for (; i + 1 < expr->count; i += 2) {
        int32_t mark = lowering->next_register;
        int32_t test = lower_operand(lowering, expr->children[i]);
        uint32_t past = emit_jump(lowering, OP_JUMP_FALSE, test, expr->children[i]);
        lowering->next_register = mark;
        lower_branch(lowering, expr->children[i + 1], target);
        ends[end_count++] = emit_jump(lowering, OP_JUMP, 0, expr);
        lower_patch_jump(lowering, past);
    }
    if (i < expr->count)
        lower_branch(lowering, expr->children[i], target);
    else if (target->to_loop)
        lower_yield(lowering, add_constant(lowering, VALUE_NULL), target->loop, expr);
    else
        emit_move(lowering, target->d, add_constant(lowering, VALUE_NULL), expr);
    while (end_count > 0)
        lower_patch_jump(lowering, ends[--end_count]);
}

static void lower_closure(Lowering *lowering, const Expr *expr, int32_t d) {
    uint32_t list = lower_operands(lowering, expr->children, expr->count);
    lower_emit(lowering, expr,
               (Instr){.op = OP_CLOSURE, .d = d, .list = list, .count = expr->count, .as.function = expr->as.function});
}

// Returns the built-in that a call can execute directly, or NULL. In such a call, all arguments are positional and no
// parameter is omitted, so that arguments need not be matched to parameters.
static const Builtin *direct_builtin(const Expr *callee, const CallCode *code) {
    if (callee->kind != EXPR_CONST || callee->as.value.kind != VALUE_MIXED || callee->as.value.len != 1 ||
        callee->as.value.as.items[0].type != ITEM_FUNCTION || code->named_count > 0)
        return NULL;
    const Builtin *builtin = callee->as.value.as.items[0].as.function->builtin;
    bool fits =
        builtin && code->arg_count >= builtin->fixed && (builtin->variadic || code->arg_count == builtin->fixed);
    return fits ? builtin : NULL;
}

static void lower_call(Lowering *lowering, const Expr *expr, int32_t d) {
    const Builtin *builtin = direct_builtin(expr->children[0], expr->as.call);
    int32_t callee = builtin ? 0 : lower_operand(lowering, expr->children[0]);
    uint32_t list = lower_operands(lowering, expr->children + 1, expr->count - 1);
    Instr instr = {
        .op = OP_BUILTIN, .d = d, .b = callee, .list = list, .count = expr->count - 1, .as.builtin = builtin};
    if (!builtin) {
        CallCode code = *expr->as.call;
        code.names = lower_names(lowering, code.names, code.named_count);
        instr.op = OP_CALL;
        instr.as.call = arena_copy(lowering->options->arena, &code, sizeof code);
    }
    lower_emit(lowering, expr, instr);
}

// Emits a lookup. The parts of a composed key become operands, so that the key vector need not be built.
static void lower_lookup(Lowering *lowering, const Expr *expr, int32_t d) {
    const Expr *key = expr->children[0];
    bool parts = key->kind == EXPR_COMPOSE && key->slot > 1;
    for (uint32_t i = 0; parts && i < key->count; i++)
        parts = !expr_only_binds(key->children[i]);
    uint32_t count = parts ? key->count : 1;
    uint32_t list = lower_operands(lowering, parts ? key->children : expr->children, count);
    Instr instr = {
        .op = OP_LOOKUP, .d = d, .list = list, .count = count, .as.inner_origin = lower_origin(lowering, key)};
    instr.target = lowering->options->lookup_count ? (*lowering->options->lookup_count)++ : UINT32_MAX;
    lower_emit(lowering, expr, instr);
}

// Emits an INDEX. For `vector[start..stop]`, emits a SLICE, so that the range need not be built.
static void lower_subscript(Lowering *lowering, const Expr *expr, int32_t d) {
    const Expr *range = expr->children[1];
    bool slice = range->kind == EXPR_RANGE && range->children[2]->kind == EXPR_CONST &&
                 value_is_null(range->children[2]->as.value);
    if (!slice) {
        emit_operator(lowering, OP_INDEX, expr, d);
        return;
    }
    int32_t a = lower_operand(lowering, expr->children[0]);
    int32_t b = lower_operand(lowering, range->children[0]);
    int32_t c = lower_operand(lowering, range->children[1]);
    lower_emit(
        lowering, expr,
        (Instr){.op = OP_SLICE, .d = d, .a = a, .b = b, .c = c, .as.inner_origin = lower_origin(lowering, range)});
}

static void lower_range(Lowering *lowering, const Expr *expr, int32_t d) {
    int32_t parts[3];
    for (int i = 0; i < 3; i++)
        parts[i] = lower_operand(lowering, expr->children[i]);
    lower_emit(lowering, expr, (Instr){.op = OP_RANGE, .d = d, .a = parts[0], .b = parts[1], .c = parts[2]});
}

static void lower_move(Lowering *lowering, const Expr *expr, int32_t d) {
    emit_move(lowering, d, lower_operand(lowering, expr), expr);
}

static void lower_binding(Lowering *lowering, const Expr *expr, int32_t d) {
    lower_statement(lowering, expr);
    emit_move(lowering, d, add_constant(lowering, VALUE_NULL), expr);
}

static void lower_if_value(Lowering *lowering, const Expr *expr, int32_t d) {
    lower_if(lowering, expr, &(Target){.d = d});
}

static void lower_into(Lowering *lowering, const Expr *expr, int32_t d) {
    static const struct {
        void (*lower)(Lowering *lowering, const Expr *expr, int32_t d);
        uint16_t plain; // if `lower` is NULL: instruction whose operands are the children's values
    } lowerings[EXPR_COUNT] = {
#define EXPR(kind)
#define SAME(kind)
#define PLAIN(kind) [EXPR_##kind] = {NULL, OP_##kind},
#include "program/expr_list.h"
        [EXPR_CONST] = {.lower = lower_move},        [EXPR_SLOT] = {.lower = lower_move},
        [EXPR_CAPTURE] = {.lower = lower_load},      [EXPR_SELF] = {.lower = lower_load},
        [EXPR_GLOBAL] = {.lower = lower_load},       [EXPR_UNBOUND] = {.lower = lower_load},
        [EXPR_COMPOSE] = {.lower = lower_compose},   [EXPR_BIND] = {.lower = lower_binding},
        [EXPR_LET] = {.lower = lower_binding},       [EXPR_IMPORT] = {.lower = lower_binding},
        [EXPR_FUNC] = {.lower = lower_closure},      [EXPR_FOR] = {.lower = lower_for},
        [EXPR_IF] = {.lower = lower_if_value},       [EXPR_NODE] = {.lower = lower_node},
        [EXPR_APPEND] = {.lower = lower_node},       [EXPR_DECORATE] = {.lower = lower_node},
        [EXPR_CALL] = {.lower = lower_call},         [EXPR_OR] = {.lower = lower_short_circuit},
        [EXPR_AND] = {.lower = lower_short_circuit}, [EXPR_RANGE] = {.lower = lower_range},
        [EXPR_INDEX] = {.lower = lower_subscript},   [EXPR_LOOKUP] = {.lower = lower_lookup}};
    int32_t mark = lowering->next_register;
    if (lowerings[expr->kind].lower)
        lowerings[expr->kind].lower(lowering, expr, d);
    else
        emit_operator(lowering, lowerings[expr->kind].plain, expr, d);
    lowering->next_register = mark;
}

// Returns the constants in reverse order, so that operand -1 is the last one.
static const Value *reversed_constants(const Lowering *lowering) {
    uint32_t count = lowering->constant_count;
    Value *constants = arena_alloc_array(lowering->options->arena, count, sizeof *constants);
    for (uint32_t i = 0; i < count; i++)
        constants[count - 1 - i] = lowering->constants[i];
    return constants;
}

const Code *program_lower(const LowerOptions *options, const Expr *expr, uint32_t slot_count) {
    Lowering lowering = {
        .options = options, .next_register = (int32_t)slot_count, .register_count = (int32_t)slot_count};
    int32_t result = lower_operand(&lowering, expr);
    lower_emit(&lowering, expr, (Instr){.op = OP_RETURN, .a = result});
    Arena *arena = options->arena;
    Code *code = arena_alloc(arena, sizeof *code);
    *code = (Code){.source = expr->origin.source,
                   .instrs = arena_copy(arena, lowering.instrs, lowering.instr_count * sizeof(Instr)),
                   .count = lowering.instr_count,
                   .register_count = (uint32_t)lowering.register_count,
                   .slot_count = slot_count,
                   .loop_count = lowering.loop_count,
                   .operands = arena_copy(arena, lowering.operands, lowering.operand_count * sizeof(int32_t)),
                   .constants = reversed_constants(&lowering),
                   .constant_count = lowering.constant_count,
                   .lines = options->lines ? arena_copy(arena, lowering.lines, lowering.instr_count * sizeof(uint32_t))
                                           : NULL};
    return code;
}
