// others.c: debug output, and stubs of functions for rendered images and fonts (spec builtins.md B14).
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

BUILTIN_IS(sample, value_or(args[2], VALUE_NULL))
BUILTIN_IS(measure_text,
           builtin_error(context, "measure_text", "not supported: text is measured only when it is drawn"))
