// lower_rounds.c: which loops the machine may run many rounds of at once; see RoundsCode in code.h.
#include "program/lower.h"

#include <string.h>

static const char *const letters[OP_COUNT] = {
#define OPCODE(id, name, operands) operands,
#include "program/opcode_list.h"
#undef OPCODE
};

uint32_t program_reads(const int32_t *operands, const Instr *instr, int32_t *reads) {
    uint32_t count = 0;
    for (const char *letter = letters[instr->op]; *letter; letter++) {
        if (*letter == 'a' || *letter == 'b' || *letter == 'c')
            reads[count++] = *letter == 'a' ? instr->a : *letter == 'b' ? instr->b : instr->c;
        for (uint32_t i = 0; *letter == 'l' && i < instr->count; i++)
            reads[count++] = operands[instr->list + i];
    }
    return count;
}

// The registers that an instruction writes begin with `d`.
static uint32_t count_written(const Instr *instr) {
    return strchr(letters[instr->op], 's') ? instr->count : strchr(letters[instr->op], 'd') != NULL;
}

// Is what is called a built-in that does nothing but give a value?
static bool calls_pure(const Lowering *lowering, const Instr *instr) {
    if (instr->op != OP_CALL)
        return instr->op != OP_BUILTIN || instr->as.builtin->pure;
    const Value *callee = instr->b < 0 ? &lowering->constants[-1 - instr->b] : NULL;
    if (!callee || callee->kind != VALUE_MIXED || callee->len != 1 || callee->as.items[0].type != ITEM_FUNCTION)
        return false;
    const Builtin *builtin = callee->as.items[0].as.function->builtin;
    return builtin && builtin->pure;
}

// Instructions whose rounds do not depend on each other and do nothing but give values, or faults.
static bool fits(const Lowering *lowering, uint32_t i, uint32_t end) {
    static const bool never[OP_COUNT] = {
        [OP_UNBOUND] = true, [OP_CLOSURE] = true, [OP_IMPORT] = true,   [OP_FOR] = true,
        [OP_SPAN] = true,    [OP_NEXT] = true,    [OP_FOR_SPAN] = true, [OP_RETURN] = true};
    const Instr *instr = &lowering->instrs[i];
    bool jumps = instr->op == OP_JUMP || instr->op == OP_JUMP_TRUE || instr->op == OP_JUMP_FALSE;
    return !never[instr->op] && (!jumps || (instr->target > i && instr->target <= end)) &&
           calls_pure(lowering, instr) && (instr->op != OP_ADD_ROW || i + 1 == end) &&
           (!strchr(letters[instr->op], 'l') || instr->count <= CODE_MOST_READ - 2);
}

// Numbers the registers that a body writes; false if those are too many, or if one is read before it is written.
static bool number_columns(const Lowering *lowering, uint32_t start, RoundsCode *rounds, uint8_t *columns) {
    for (uint32_t i = start; i < rounds->end; i++) {
        const Instr *instr = &lowering->instrs[i];
        int32_t reads[CODE_MOST_READ];
        // A register that is written further on keeps no value from round to round.
        for (uint32_t k = i == start ? 0 : program_reads(lowering->operands, instr, reads); k-- > 0;)
            if (reads[k] >= rounds->first && reads[k] != CODE_NO_OPERAND && !columns[reads[k] - rounds->first])
                columns[reads[k] - rounds->first] = UINT8_MAX;
        for (uint32_t k = 0, count = i == start ? instr->count : count_written(instr); k < count; k++) {
            if (instr->d < rounds->first)
                return false;
            uint8_t *column = &columns[(uint32_t)(instr->d - rounds->first) + k];
            if (*column == UINT8_MAX || rounds->column_count == CODE_MOST_COLUMNS)
                return false;
            if (!*column)
                *column = (uint8_t)++rounds->column_count;
        }
        rounds->part_count += instr->op == OP_ADD_PART;
    }
    for (int32_t i = 0; i < lowering->register_count - rounds->first; i++)
        columns[i] = columns[i] == UINT8_MAX ? 0 : columns[i];
    return true;
}

const RoundsCode *lower_rounds(const Lowering *lowering, uint32_t start) {
    RoundsCode rounds = {.end = lowering->instr_count, .first = lowering->instrs[start].d};
    uint32_t range = (uint32_t)(lowering->register_count - rounds.first);
    for (uint32_t i = start + 1; i < rounds.end; i++)
        if (!fits(lowering, i, rounds.end))
            return NULL;
    uint8_t *columns = arena_alloc(lowering->options->arena, range);
    memset(columns, 0, range);
    rounds.columns = columns;
    rounds.range = range;
    bool may = range > 0 && number_columns(lowering, start, &rounds, columns) && rounds.part_count <= CODE_MOST_PARTS;
    return may ? arena_copy(lowering->options->arena, &rounds, sizeof rounds) : NULL;
}
