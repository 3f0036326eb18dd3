// random.c: pseudo-random streams and shuffling (spec builtins.md B9.1, B9.7).
#include "builtin/family.h"
#include "value/stream.h"
#include "value/value_hash.h"

#define STREAM(name, kind)                                                                                             \
    BUILTIN_IS(name, value_stream(kind, value_seed_hash(context->arena, value_or(args[0], VALUE_NULL))))

STREAM(uniform, STREAM_UNIFORM)
STREAM(beta, STREAM_BETA)
STREAM(normal, STREAM_NORMAL)

// Returns the index of the element with which element i of `len` is exchanged. It is i + floor(s * (len - i)), at most
// len - 1, where s is item i of the source.
static uint32_t shuffle_partner(Value source, uint32_t i, uint32_t len) {
    uint32_t step = (uint32_t)(value_stream_item(source, i) * (len - i));
    return step < len - i ? i + step : len - 1;
}

Value builtin_shuffle(BuiltinContext *context, const Value *args, uint32_t count) {
    Value source = args[0], xs = args[1];
    if (source.kind != VALUE_STREAM || source.stream == STREAM_NORMAL)
        return builtin_error(context, "shuffle", "the source must be a stream from 'uniform' or 'beta'");
    if (xs.len <= 1)
        return xs.len ? xs : VALUE_NULL;
    if (xs.kind == VALUE_NUMBERS) {
        double *numbers = arena_copy(context->arena, xs.as.numbers, xs.len * sizeof *numbers);
        for (uint32_t i = 0; i + 1 < xs.len; i++) {
            arena_charge_chunk(context->arena, i, 4);
            uint32_t j = shuffle_partner(source, i, xs.len);
            double moved = numbers[i];
            numbers[i] = numbers[j];
            numbers[j] = moved;
        }
        return value_numbers_view(numbers, xs.len);
    }
    Item *items = arena_copy(context->arena, xs.as.items, xs.len * sizeof *items);
    for (uint32_t i = 0; i + 1 < xs.len; i++) {
        arena_charge_chunk(context->arena, i, 4);
        uint32_t j = shuffle_partner(source, i, xs.len);
        Item moved = items[i];
        items[i] = items[j];
        items[j] = moved;
    }
    return (Value){.len = xs.len, .kind = VALUE_MIXED, .as.items = items};
}
