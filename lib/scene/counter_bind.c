// counter_bind.c: `!counter`, a value in the state that grows with time (spec counters.md).
//
// All operations are element-wise. The value is as long as the longest vector from which it is computed. Value and time
// are stored only if finite, so that an invalid frame does not affect later frames.
#include "base/number.h"
#include "scene/systems.h"

static double element(Value v, uint32_t i) {
    return value_numbers(&v)[i % v.len];
}

static uint32_t max_length(const Value *values, uint32_t count) {
    uint32_t len = 1;
    for (uint32_t i = 0; i < count; i++)
        if (values[i].len > len)
            len = values[i].len;
    return len;
}

static bool any_true(Value v) {
    for (uint32_t i = 0; i < v.len; i++)
        if (element(v, i) != 0)
            return true;
    return false;
}

// Returns the stored value if a counter can continue from it (finite numbers only), else null.
static Value usable_or_null(Value stored) {
    bool good = value_is_numeric(stored) && numbers_finite(value_numbers(&stored), stored.len, 1);
    return good ? stored : VALUE_NULL;
}

static void store_finite(const Reader *reader, State *state, Value key, Value v, const char *what) {
    if (numbers_finite(value_numbers(&v), v.len, 1))
        state_set(state, key, v);
    else
        reader_report(reader, "not-finite", what,
                      str_format(reader->arena, "the %s is not finite; the counter keeps the previous %s", what, what));
}

void counter_update(Scene *scene, const Node *node, const SceneFrame *frame) {
    Reader reader = {scene->schema, frame->arena, node, KIND_COUNTER, 1};
    CounterAttrs attrs;
    schema_defaults(KIND_COUNTER, &attrs);
    attrs.time = value_number(frame->time);
    reader_fill(&reader, &attrs);
    Value key = attrs.state, time = attrs.time, rate = attrs.rate, initial = attrs.initial;
    Value low = attrs.minimum, high = attrs.maximum, reset = attrs.reset;
    if (key.len == 0 || !state_key_valid(key)) {
        reader_report(&reader, "invalid-system", "",
                      STR("attribute 'state' must be numbers, symbols or strings, such as :x; the counter is skipped"));
        return;
    }
    Value time_key = scene_key(frame->arena, key, VALUE_NULL, scene->key_time);
    Value old = usable_or_null(state_get(frame->state, key)), last = usable_or_null(state_get(frame->state, time_key));
    bool is_new = old.len == 0;
    const Value first[] = {initial, low, high};
    const Value next[] = {old, rate, time, last, low, high, reset, any_true(reset) ? initial : VALUE_NULL};
    uint32_t len =
        is_new ? max_length(first, sizeof first / sizeof first[0]) : max_length(next, sizeof next / sizeof next[0]);
    double *values = arena_alloc_array(frame->arena, len, sizeof *values);
    for (uint32_t i = 0; i < len; i++) {
        double passed = last.len ? element(time, i) - element(last, i) : 0;
        bool start = is_new || (reset.len && element(reset, i) != 0);
        double x = start ? element(initial, i) : passed * element(rate, i) + element(old, i);
        if (low.len && x < element(low, i))
            x = element(low, i);
        if (high.len && x > element(high, i))
            x = element(high, i);
        values[i] = x;
    }
    store_finite(&reader, frame->state, key, value_numbers_view(values, len), "value");
    store_finite(&reader, frame->state, time_key, time, "time");
}
