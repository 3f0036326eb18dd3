// others.c: debug output (spec builtins.md B14).
#include "builtin/family.h"
#include "value/format.h"

Value builtin_debug(BuiltinContext *context, const Value *args, uint32_t count) {
    if (context->log) {
        Text text = text_new(context->arena);
        format_debug(&text, context->symbols, args[0]);
        context->log(context->user_data, text_str(&text));
    }
    return args[0];
}
