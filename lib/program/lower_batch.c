// lower_batch.c: batch plans for loops that the VM can execute in batches; see BatchPlan in code.h.
//
// A loop can be executed in batches if no iteration depends on another one: its calls have no side effects, its jumps
// lead forward within the body, and no register carries a value to the next iteration (number_columns).
#include "program/lower.h"

#include <string.h>

static const char *const operand_formats[OP_COUNT] = {
#define OPCODE(id, name, operands, batch) operands,
#include "program/opcode_list.h"
};

const BatchKind program_batch_kinds[OP_COUNT] = {
#define OPCODE(id, name, operands, batch) BATCH_##batch,
#include "program/opcode_list.h"
};

uint32_t program_operands_read(const int32_t *operands, const Instr *instr, int32_t *reads) {
    uint32_t count = 0;
    for (const char *format = operand_formats[instr->op]; *format; format++) {
        if (*format == 'a' || *format == 'b' || *format == 'c')
            reads[count++] = *format == 'a' ? instr->a : *format == 'b' ? instr->b : instr->c;
        for (uint32_t i = 0; *format == 'l' && i < instr->count; i++)
            reads[count++] = operands[instr->list + i];
    }
    return count;
}

// Returns the number of registers that an instruction writes. The first one is `d`.
static uint32_t count_written(const Instr *instr) {
    return strchr(operand_formats[instr->op], 's') ? instr->count : strchr(operand_formats[instr->op], 'd') != NULL;
}

// Returns false for calls that may have side effects, which are all calls except those of pure built-ins.
static bool calls_pure(const Lowering *lowering, const Instr *instr) {
    if (instr->op != OP_CALL)
        return instr->op != OP_BUILTIN || instr->as.builtin->pure;
    const Value *callee = instr->b < 0 ? &lowering->constants[-1 - instr->b] : NULL;
    if (!callee || callee->kind != VALUE_MIXED || callee->len != 1 || callee->as.items[0].type != ITEM_FUNCTION)
        return false;
    const Builtin *builtin = callee->as.items[0].as.function->builtin;
    return builtin && builtin->pure;
}

// Returns true if instruction i of a loop's body can be executed for a batch of iterations. It must not make iterations
// depend on each other, and its only effects must be values and errors. `end` is the end of the body.
static bool can_batch_instr(const Lowering *lowering, uint32_t i, uint32_t end) {
    const Instr *instr = &lowering->instrs[i];
    BatchKind kind = program_batch_kinds[instr->op];
    return kind != BATCH_NEVER && (kind != BATCH_JUMP || (instr->target > i && instr->target <= end)) &&
           (kind != BATCH_LAST || i + 1 == end) && calls_pure(lowering, instr) &&
           (!strchr(operand_formats[instr->op], 'l') || instr->count <= CODE_MAX_READ - 2);
}

// Assigns column numbers to the registers that a body writes. Returns false if there are too many columns, or if the
// body writes a register below plan->first_register. Also returns false if the body reads a register first and writes
// it later.
static bool number_columns(const Lowering *lowering, uint32_t start, BatchPlan *plan, uint8_t *columns) {
    for (uint32_t i = start; i < plan->end; i++) {
        const Instr *instr = &lowering->instrs[i];
        int32_t reads[CODE_MAX_READ];
        // Mark registers that are read before they are written. If such a register is written later, it would carry a
        // value from one iteration to the next.
        for (uint32_t k = i == start ? 0 : program_operands_read(lowering->operands, instr, reads); k-- > 0;)
            if (reads[k] >= plan->first_register && reads[k] != CODE_NO_OPERAND &&
                !columns[reads[k] - plan->first_register])
                columns[reads[k] - plan->first_register] = UINT8_MAX;
        for (uint32_t k = 0, count = i == start ? instr->count : count_written(instr); k < count; k++) {
            if (instr->d < plan->first_register)
                return false;
            uint8_t *column = &columns[(uint32_t)(instr->d - plan->first_register) + k];
            if (*column == UINT8_MAX || plan->column_count == CODE_MAX_COLUMNS)
                return false;
            if (!*column)
                *column = (uint8_t)++plan->column_count;
        }
        plan->yield_count += instr->op == OP_YIELD;
    }
    for (int32_t i = 0; i < lowering->register_count - plan->first_register; i++)
        columns[i] = columns[i] == UINT8_MAX ? 0 : columns[i];
    return true;
}

const BatchPlan *lower_batch(const Lowering *lowering, uint32_t start) {
    BatchPlan plan = {.end = lowering->instr_count, .first_register = lowering->instrs[start].d};
    uint32_t range = (uint32_t)(lowering->register_count - plan.first_register);
    for (uint32_t i = start + 1; i < plan.end; i++)
        if (!can_batch_instr(lowering, i, plan.end))
            return NULL;
    uint8_t *columns = arena_alloc(lowering->options->arena, range);
    memset(columns, 0, range);
    plan.columns = columns;
    plan.register_count = range;
    bool possible = range > 0 && number_columns(lowering, start, &plan, columns) && plan.yield_count <= CODE_MAX_YIELDS;
    return possible ? arena_copy(lowering->options->arena, &plan, sizeof plan) : NULL;
}
