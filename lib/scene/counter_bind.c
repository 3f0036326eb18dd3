// counter_bind.c: `!counter`: a value that grows with time, kept in the state.
//
// The value is a vector, element by element: it starts at clamp(initial) and each frame becomes
// clamp(value + (time − last time)·rate). It is as long as the longest of its attributes; shorter ones repeat.
#include "base/number.h"
#include "scene/systems.h"

static double element(Value v, uint32_t i) {
    return value_numbers(&v)[i % v.len];
}

static uint32_t longest(const Value *values, uint32_t count) {
    uint32_t len = 1;
    for (uint32_t i = 0; i < count; i++)
        if (values[i].len > len)
            len = values[i].len;
    return len;
}

void counter_update(Scene *scene, const Node *node, const SceneFrame *frame) {
    Reader reader = {scene->schema, frame->arena, node, KIND_COUNTER, 1};
    CounterAttrs attrs;
    schema_defaults(KIND_COUNTER, &attrs);
    attrs.time = value_number(frame->time);
    reader_fill(&reader, &attrs);
    Value key = attrs.state, time = attrs.time, rate = attrs.rate, initial = attrs.initial;
    Value low = attrs.minimum, high = attrs.maximum;
    if (key.len == 0 || !state_key_valid(key)) {
        reader_report(&reader, "skipped-system", "", STR("no usable state key; the counter is skipped"));
        return;
    }
    Value time_key = scene_key(frame->arena, key, VALUE_NULL, scene->key_time);
    Value stored = state_get(frame->state, key), last = state_get(frame->state, time_key);
    bool start = !value_is_numeric(stored) || !value_is_numeric(last) || value_true(attrs.reset);
    Value parts[] = {initial, rate, low, high, time, start ? VALUE_NULL : stored};
    uint32_t len = longest(parts, sizeof parts / sizeof parts[0]);
    double *values = arena_alloc_array(frame->arena, len, sizeof *values);
    for (uint32_t i = 0; i < len; i++) {
        double x =
            start ? element(initial, i) : element(stored, i) + (element(time, i) - element(last, i)) * element(rate, i);
        if (low.len && x < element(low, i))
            x = element(low, i);
        if (high.len && x > element(high, i))
            x = element(high, i);
        values[i] = x;
    }
    if (!numbers_finite(values, len, 1)) {
        reader_report(&reader, "not-finite", "", STR("the value is not finite; the counter keeps its last one"));
        return;
    }
    state_set(frame->state, key, value_numbers_view(values, len));
    state_set(frame->state, time_key, time);
}
