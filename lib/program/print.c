// print.c: formatting of code for --dump=code.
#include "program/code.h"
#include "value/format.h"

static const struct {
    const char *name;
    const char *operands;
} opcodes[OP_COUNT] = {
#define OPCODE(id, name, operands, batch) {name, operands},
#include "program/opcode_list.h"
};

enum { MAX_CONSTANT_LENGTH = 60 }; // longer constants are truncated

static void print_constant(Text *out, const SymbolTable *symbols, Value value) {
    Text text = text_new(out->arena);
    format_value(&text, symbols, value);
    Str shown = str_truncate(text_str(&text), MAX_CONSTANT_LENGTH);
    text_add(out, shown);
    if (shown.len < text.len)
        text_add_format(out, "... (%u elements)", value.len);
}

static void print_operand(Text *out, const SymbolTable *symbols, const Code *code, int32_t operand) {
    if (operand == CODE_NO_OPERAND)
        text_add_c(out, "none");
    else if (operand < 0)
        print_constant(out, symbols, code->constants[(int64_t)code->constant_count + operand]);
    else
        text_add_format(out, "r%d", operand);
}

static void print_list(Text *out, const SymbolTable *symbols, const Code *code, const Instr *instr) {
    text_add_char(out, '(');
    for (uint32_t i = 0; i < instr->count; i++) {
        text_add_c(out, i ? ", " : "");
        if (instr->op == OP_NODE || instr->op == OP_YIELD_NODE)
            text_add_format(out, "%.*s=", STR_ARGS(instr->as.node->names[i]->name));
        print_operand(out, symbols, code, code->operands[instr->list + i]);
    }
    text_add_char(out, ')');
}

// Prints an operand of the kind 'x' (opcode_list.h): the name or names to which Instr.as or Instr.target refers.
static void print_extra(Text *out, const Instr *instr) {
    Str name = {0};
    switch ((Opcode)instr->op) {
    case OP_GLOBAL:
        name = str_from(engine_name_text((EngineName)instr->target));
        break;
    case OP_UNBOUND:
        name = instr->as.name->name;
        break;
    case OP_CLOSURE:
        name = instr->as.function->name;
        break;
    case OP_NODE:
    case OP_YIELD_NODE:
        name = instr->as.node->base->kind->name;
        break;
    case OP_BUILTIN:
        name = str_from(instr->as.builtin->name);
        break;
    case OP_DECORATE:
        for (uint32_t i = 0; i < instr->count; i++) {
            Str attr = instr->as.decorate->names[i]->name;
            text_add_format(out, "%s%.*s", i ? " " : "", STR_ARGS(attr));
        }
        break;
    default:
        break;
    }
    text_add(out, name);
}

static void print_operand_field(Text *out, const SymbolTable *symbols, const Code *code, const Instr *instr,
                                char format) {
    switch (format) {
    case 'd':
        text_add_format(out, "r%d =", instr->d);
        break;
    case 'a':
        print_operand(out, symbols, code, instr->a);
        break;
    case 'b':
        print_operand(out, symbols, code, instr->b);
        break;
    case 'c':
        print_operand(out, symbols, code, instr->c);
        break;
    case 'l':
        print_list(out, symbols, code, instr);
        break;
    case 'j':
        text_add_format(out, "to %u", instr->target);
        break;
    case 's':
        text_add_format(out, "r%d", instr->d);
        if (instr->count > 1)
            text_add_format(out, "-r%u", (uint32_t)instr->d + instr->count - 1);
        text_add_c(out, " =");
        break;
    case 'o':
        text_add_format(out, "loop %u", instr->loop);
        break;
    case 'i':
        text_add_format(out, "#%u", instr->target);
        break;
    default:
        print_extra(out, instr);
    }
}

static void print_code(Text *out, const SymbolTable *symbols, const Code *code) {
    for (uint32_t i = 0; i < code->count; i++) {
        const Instr *instr = &code->instrs[i];
        text_add_format(out, "%4u %4u  %-10s", i, source_line(instr->at->source, instr->at->span.start),
                        opcodes[instr->op].name);
        for (const char *format = opcodes[instr->op].operands; *format; format++) {
            text_add_char(out, ' ');
            print_operand_field(out, symbols, code, instr, *format);
        }
        text_add_char(out, '\n');
    }
    for (uint32_t i = 0; i < code->count; i++) {
        if (code->instrs[i].op != OP_CLOSURE)
            continue;
        const FunctionCode *function = code->instrs[i].as.function;
        text_add_format(out, "\n%.*s: parameters=%u captures=%u registers=%u\n", STR_ARGS(function->name),
                        function->param_count, function->capture_count, function->code->register_count);
        print_code(out, symbols, function->code);
    }
}

void program_print(Text *out, const SymbolTable *symbols, const Program *program) {
    text_add_format(out, "number, line, instruction; registers=%u\n", program->code->register_count);
    print_code(out, symbols, program->code);
}
