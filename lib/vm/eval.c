// eval.c: the evaluation of expressions; see vm.h. One function per form, one switch.
#include "vm/machine.h"

#include "value/seed.h"

#include <stdarg.h>

// vm_eval is a switch and nothing else: with the forms inlined into it, every evaluation would save their registers.
#define NOINLINE __attribute__((noinline))

static bool first_fault(Vm *vm, const Expr *at, uint64_t what) {
    if (vm->reported_count >= VM_REPORTED / 2)
        return false;
    uint32_t i = (uint32_t)hash_mix((uint64_t)(uintptr_t)at ^ what << 1) % VM_REPORTED;
    for (; vm->reported[i].at; i = (i + 1) % VM_REPORTED)
        if (vm->reported[i].at == at && vm->reported[i].what == what)
            return false;
    vm->reported[i] = (Reported){at, what};
    vm->reported_count++;
    return true;
}

static void report(Vm *vm, const Expr *at, DiagLevel level, const char *code, Str text) {
    Diag diag = {.level = level, .source = at->source, .span = at->span, .text = text, .code = code};
    vm->host.report(vm->host.host, &diag);
}

void vm_fault_text(Vm *vm, const Expr *at, const char *code, Str text) {
    if (first_fault(vm, at, hash_bytes(0, text.bytes, text.len)))
        report(vm, at, DIAG_WARNING, code, text);
}

void vm_fault(Vm *vm, const Expr *at, const char *code, const char *format, ...) {
    if (!first_fault(vm, at, (uint64_t)(uintptr_t)format))
        return;
    va_list args;
    va_start(args, format);
    Text text = text_new(vm->arena);
    text_add_va(&text, format, args);
    va_end(args);
    report(vm, at, DIAG_WARNING, code, text_str(&text));
}

bool vm_work(Vm *vm, const Expr *at) {
    enum { BETWEEN_LOOKS = 1024 }; // a power of two
    if (vm->stopped)
        return false;
    if (++vm->work % BETWEEN_LOOKS == 0 && vm->interrupt &&
        atomic_load_explicit(vm->interrupt, memory_order_relaxed)) {
        vm->stopped = true;
        return false;
    }
    if (vm->work <= vm->work_limit)
        return true;
    vm->stopped = true;
    report(vm, at, DIAG_ERROR, "work-limit",
           STR("the frame makes more than 134217728 calls and loop rounds; it is given up"));
    return false;
}

Value vm_finish(Vm *vm, const Expr *at, Vector *vector) {
    if (vector->overflow)
        vm_fault(vm, at, "too-long", "vector too long: the limit is 134217728 elements");
    return vector_finish(vector);
}

// Statements of which one has a value, the others being bindings.
NOINLINE static Value eval_single(Vm *vm, Frame *frame, const Expr *expr) {
    Value result = VALUE_NULL;
    for (uint32_t i = 0; i < expr->count; i++) {
        Value part = vm_eval(vm, frame, expr->children[i]);
        if (!expr_only_binds(expr->children[i]))
            result = part;
    }
    return result;
}

enum { FEW_PARTS = 8 };

// Up to FEW_PARTS numbers and short vectors of numbers, as keys and positions are: one allocation, no builder. False if
// the parts are of another kind; they are evaluated in any case.
static bool compose_few(Vm *vm, Frame *frame, const Expr *expr, Value *parts, uint32_t *count, Value *result) {
    uint32_t len = 0;
    bool numeric = true;
    for (uint32_t i = 0; i < expr->count; i++) {
        Value part = vm_eval(vm, frame, expr->children[i]);
        if (expr_only_binds(expr->children[i]))
            continue;
        numeric = numeric && part.kind == VALUE_NUMBERS && part.len < 1024;
        len += part.len;
        parts[(*count)++] = part;
    }
    if (!numeric || len < 2)
        return false;
    double *numbers = arena_alloc_array(vm->arena, len, sizeof *numbers);
    uint32_t at = 0;
    for (uint32_t i = 0; i < *count; i++)
        for (uint32_t k = 0; k < parts[i].len; k++)
            numbers[at++] = value_numbers(&parts[i])[k];
    *result = value_numbers_view(numbers, len);
    return true;
}

// A vector's parts in order; also a suite's statements, of which bindings are no parts.
NOINLINE static Value eval_compose(Vm *vm, Frame *frame, const Expr *expr) {
    if (expr->slot == 1)
        return eval_single(vm, frame, expr);
    Vector vector = vector_new(vm->arena);
    Value few[FEW_PARTS], result;
    uint32_t count = 0;
    if (expr->count <= FEW_PARTS) {
        if (compose_few(vm, frame, expr, few, &count, &result))
            return result;
        for (uint32_t i = 0; i < count; i++)
            vector_add(&vector, few[i]);
        return vm_finish(vm, expr, &vector);
    }
    for (uint32_t i = 0; i < expr->count; i++) {
        Value part = vm_eval(vm, frame, expr->children[i]);
        if (!expr_only_binds(expr->children[i]))
            vector_add(&vector, part);
    }
    return vm_finish(vm, expr, &vector);
}

NOINLINE static Value eval_bind(Vm *vm, Frame *frame, const Expr *expr) {
    vm_bind(vm, frame, expr->slot, expr->slot_count, vm_eval(vm, frame, expr->children[0]));
    return VALUE_NULL;
}

NOINLINE static Value eval_let(Vm *vm, Frame *frame, const Expr *expr) {
    for (uint32_t i = 0; i < expr->count; i++)
        vm_eval(vm, frame, expr->children[i]);
    return VALUE_NULL;
}

void vm_bind(Vm *vm, Frame *frame, uint32_t slot, uint32_t count, Value value) {
    if (count == 1) {
        frame->slots[slot] = value;
        return;
    }
    for (uint32_t i = 0; i < count; i++)
        frame->slots[slot + i] =
            value.kind == VALUE_STREAM ? value_number(value_stream_item(value, i)) : value_element(vm->arena, value, i);
}

NOINLINE static Value eval_for(Vm *vm, Frame *frame, const Expr *expr) {
    Value source = vm_eval(vm, frame, expr->children[0]);
    const Expr *body = expr->children[1];
    Vector vector = vector_new(vm->arena);
    for (uint32_t at = 0; at < source.len && vm_work(vm, expr); at += expr->slot_count) {
        for (uint32_t i = 0; i < expr->slot_count; i++)
            frame->slots[expr->slot + i] = at + i < source.len ? value_element(vm->arena, source, at + i) : VALUE_NULL;
        vector_add(&vector, vm_eval(vm, frame, body));
        if (vector.overflow)
            break;
    }
    return vm_finish(vm, expr, &vector);
}

NOINLINE static Value eval_if(Vm *vm, Frame *frame, const Expr *expr) {
    uint32_t i = 0;
    for (; i + 1 < expr->count; i += 2)
        if (value_true(vm_eval(vm, frame, expr->children[i])))
            return vm_eval(vm, frame, expr->children[i + 1]);
    return i < expr->count ? vm_eval(vm, frame, expr->children[i]) : VALUE_NULL;
}

NOINLINE static Value eval_append(Vm *vm, Frame *frame, const Expr *expr) {
    Value parent = vm_eval(vm, frame, expr->children[0]);
    Value children = vm_eval(vm, frame, expr->children[1]);
    bool too_high = false;
    Value result = value_append(vm->arena, parent, children, &too_high);
    if (too_high)
        vm_fault(vm, expr, "too-deep", "node tree too deep: the limit is 12000 levels; not appended");
    return result;
}

NOINLINE static Value eval_decorate(Vm *vm, Frame *frame, const Expr *expr) {
    const DecorateCode *code = expr->as.decorate;
    Value subject = vm_eval(vm, frame, expr->children[0]);
    Attr *attrs = arena_alloc_array(vm->arena, code->attr_count, sizeof *attrs);
    for (uint32_t i = 0; i < code->attr_count; i++)
        attrs[i] = (Attr){code->names[i], vm_eval(vm, frame, expr->children[i + 1])};
    for (uint32_t i = 0; i < code->tag_count; i++)
        subject = value_add_tag(vm->arena, subject, code->tags[i]);
    bool too_high = false;
    if (code->attr_count)
        subject = value_set_attrs(vm->arena, subject, attrs, code->attr_count, &too_high);
    if (too_high)
        vm_fault(vm, expr, "too-deep", "nodes in attributes too deep: the limit is 12000 levels; not set");
    return subject;
}

NOINLINE static Value eval_range(Vm *vm, Frame *frame, const Expr *expr) {
    Value start = vm_eval(vm, frame, expr->children[0]);
    Value stop = vm_eval(vm, frame, expr->children[1]);
    Value step = vm_eval(vm, frame, expr->children[2]);
    bool too_long = false;
    Value range = op_range(vm->arena, start, stop, step, &too_long);
    if (too_long)
        vm_fault(vm, expr, "too-long", "range too long: the limit is 134217728 elements");
    return range;
}

NOINLINE static Value index_stream(Vm *vm, Value stream, Value index) {
    if (!value_is_numeric(index))
        return VALUE_NULL;
    const double *at = value_numbers(&index);
    if (index.len == 1)
        return value_number(value_stream_item(stream, value_stream_position(at[0])));
    double *items = arena_alloc_array(vm->arena, index.len, sizeof *items);
    for (uint32_t i = 0; i < index.len; i++)
        items[i] = value_stream_item(stream, value_stream_position(at[i]));
    return value_numbers_view(items, index.len);
}

NOINLINE static Value eval_index(Vm *vm, Frame *frame, const Expr *expr) {
    Value vector = vm_eval(vm, frame, expr->children[0]);
    Value index = vm_eval(vm, frame, expr->children[1]);
    return vector.kind == VALUE_STREAM ? index_stream(vm, vector, index) : value_index(vm->arena, vector, index);
}

// The dictionary's value is copied into the frame: systems may overwrite it in place after the evaluation.
NOINLINE static Value eval_lookup(Vm *vm, Frame *frame, const Expr *expr) {
    Value key = vm_eval(vm, frame, expr->children[0]);
    vm->met_dynamic = true;
    return vm->state ? value_copy(vm->arena, state_get(vm->state, key)) : VALUE_NULL;
}

static Value truth(bool x) {
    return value_number(x ? 1 : 0);
}

// A stream counts as null for != (L5.4).
static Value stream_as_null(Value v) {
    return v.kind == VALUE_STREAM ? VALUE_NULL : v;
}

NOINLINE static Value eval_compare(Vm *vm, Frame *frame, const Expr *expr) {
    Value a = vm_eval(vm, frame, expr->children[0]);
    Value b = vm_eval(vm, frame, expr->children[1]);
    ExprKind kind = expr->kind;
    if (kind == EXPR_EQ)
        return truth(value_equal(a, b));
    if (kind == EXPR_NE)
        return truth(!value_equal(stream_as_null(a), stream_as_null(b)));
    if (kind == EXPR_IN)
        return truth(value_contains(a, b));
    int order = expr->slot ? 0 : value_compare(a, b);
    if (order == VALUE_INCOMPARABLE)
        return VALUE_NULL;
    switch (kind) {
    case EXPR_LT:
        return truth(order == -1);
    case EXPR_GT:
        return truth(order == 1);
    case EXPR_LE:
        return truth(order != 1);
    default:
        return truth(order != -1);
    }
}

NOINLINE static Value eval_arith(Vm *vm, Frame *frame, const Expr *expr) {
    Value a = vm_eval(vm, frame, expr->children[0]);
    Value b = vm_eval(vm, frame, expr->children[1]);
    // Two numbers and one of the four simple operations: no need to go through vectors.
    if (a.len == 1 && b.len == 1 && a.kind == VALUE_NUMBERS && b.kind == VALUE_NUMBERS)
        switch ((ArithOp)expr->slot) {
        case ARITH_ADD:
            return value_number(a.as.number + b.as.number);
        case ARITH_SUB:
            return value_number(a.as.number - b.as.number);
        case ARITH_MUL:
            return value_number(a.as.number * b.as.number);
        case ARITH_DIV:
            return value_number(a.as.number / b.as.number);
        default:
            break;
        }
    return op_arith(vm->arena, (ArithOp)expr->slot, a, b);
}

NOINLINE static Value eval_logic(Vm *vm, Frame *frame, const Expr *expr) {
    Value left = vm_eval(vm, frame, expr->children[0]);
    bool is_true = value_true(left);
    if (expr->kind == EXPR_OR && is_true)
        return left;
    if (expr->kind == EXPR_AND && !is_true)
        return left;
    Value right = vm_eval(vm, frame, expr->children[1]);
    if (expr->kind != EXPR_XOR || !is_true)
        return right;
    return value_true(right) ? value_number(0) : left;
}

NOINLINE static Value eval_not(Vm *vm, Frame *frame, const Expr *expr) {
    return truth(!value_true(vm_eval(vm, frame, expr->children[0])));
}

NOINLINE static Value eval_sign(Vm *vm, Frame *frame, const Expr *expr) {
    Value v = vm_eval(vm, frame, expr->children[0]);
    return expr->kind == EXPR_NEG ? op_negate(vm->arena, v) : op_plus(v);
}

NOINLINE static Value eval_import(Vm *vm, Frame *frame, const Expr *expr) {
    vm->met_dynamic = true;
    if (!vm->is_static)
        vm_import(vm, frame, expr);
    return VALUE_NULL;
}

NOINLINE static Value eval_node(Vm *vm, const Expr *expr) {
    return value_node(vm->arena, node_new(vm->arena, expr->as.name));
}

NOINLINE static Value eval_unbound(Vm *vm, const Expr *expr) {
    vm_fault(vm, expr, "unbound-name", "unbound name '%.*s' is null", (int)expr->as.name->name.len,
             expr->as.name->name.bytes);
    return VALUE_NULL;
}

Value vm_eval(Vm *vm, Frame *frame, const Expr *expr) {
    switch (expr->kind) {
    case EXPR_CONST:
        return expr->as.value;
    case EXPR_NODE:
        return eval_node(vm, expr);
    case EXPR_SLOT:
        return frame->slots[expr->slot];
    case EXPR_CAPTURE:
        return frame->closure->captures[expr->slot];
    case EXPR_SELF:
        return frame->closure->self;
    case EXPR_GLOBAL:
        vm->met_dynamic |= expr->dynamic;
        return vm->globals[expr->slot];
    case EXPR_UNBOUND:
        return eval_unbound(vm, expr);
    case EXPR_COMPOSE:
        return eval_compose(vm, frame, expr);
    case EXPR_BIND:
        return eval_bind(vm, frame, expr);
    case EXPR_LET:
        return eval_let(vm, frame, expr);
    case EXPR_FUNC:
        return vm_make_closure(vm, frame, expr);
    case EXPR_IMPORT:
        return eval_import(vm, frame, expr);
    case EXPR_FOR:
        return eval_for(vm, frame, expr);
    case EXPR_IF:
        return eval_if(vm, frame, expr);
    case EXPR_APPEND:
        return eval_append(vm, frame, expr);
    case EXPR_DECORATE:
        return eval_decorate(vm, frame, expr);
    case EXPR_CALL:
        return vm_call_expr(vm, frame, expr);
    case EXPR_OR:
    case EXPR_XOR:
    case EXPR_AND:
        return eval_logic(vm, frame, expr);
    case EXPR_NOT:
        return eval_not(vm, frame, expr);
    case EXPR_EQ:
    case EXPR_NE:
    case EXPR_LT:
    case EXPR_GT:
    case EXPR_LE:
    case EXPR_GE:
    case EXPR_IN:
        return eval_compare(vm, frame, expr);
    case EXPR_RANGE:
        return eval_range(vm, frame, expr);
    case EXPR_ARITH:
        return eval_arith(vm, frame, expr);
    case EXPR_NEG:
    case EXPR_POS:
        return eval_sign(vm, frame, expr);
    case EXPR_INDEX:
        return eval_index(vm, frame, expr);
    case EXPR_LOOKUP:
        return eval_lookup(vm, frame, expr);
    }
    return VALUE_NULL;
}
