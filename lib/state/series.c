// series.c: see series.h.
#include "state/series.h"

#include "base/number.h"

#include <string.h>

static bool same_bits(double x, double y) {
    return number_bits(x) == number_bits(y);
}

double series_id(const Series *series, uint32_t pair) {
    return series->head[series->prefix_len] + pair;
}

void series_write_key(const Series *series, uint32_t pair, double *to) {
    memcpy(to, series->head, (series->prefix_len + 2) * sizeof *to);
    to[series->prefix_len] = series_id(series, pair);
}

static bool begins_with(const double *numbers, const double *prefix, uint32_t len) {
    uint32_t i = 0; // prefixes are too short for memcmp to pay
    while (i < len && same_bits(numbers[i], prefix[i]))
        i++;
    return i == len;
}

// Does a key begin as those of the series do and end as those of second slots, if it is as long?
static bool is_alike(const Series *series, Value key) {
    uint32_t n = series->prefix_len;
    return key.kind == VALUE_NUMBERS && (key.len == n + 1 || key.len == n + 2) &&
           begins_with(key.as.numbers, series->head, n) &&
           (key.len == n + 1 || same_bits(key.as.numbers[n + 1], series->head[n + 1]));
}

StateSlot series_find(const Series *series, Value key) {
    if (!is_alike(series, key))
        return STATE_NO_SLOT;
    double id = key.as.numbers[series->prefix_len], pair = id - series->head[series->prefix_len];
    if (!(pair >= 0 && pair < series->count))
        return STATE_NO_SLOT;
    uint32_t at = 2 * (uint32_t)pair + (key.len > series->prefix_len + 1);
    return at < series->count && same_bits(series_id(series, (uint32_t)pair), id) ? series->first + at : STATE_NO_SLOT;
}

bool series_is_next(const Series *series, Value key) {
    return is_alike(series, key) && key.len == series->prefix_len + 1 + series->count % 2 &&
           same_bits(key.as.numbers[series->prefix_len], series_id(series, series->count / 2));
}

bool series_follow(Value position, Value velocity, Value next_position, Value next_velocity) {
    if (velocity.kind != VALUE_NUMBERS || velocity.len < 3 || position.len != velocity.len - 1 ||
        position.kind != VALUE_NUMBERS || !begins_with(position.as.numbers, velocity.as.numbers, position.len))
        return false;
    Series series = {.count = 2, .prefix_len = velocity.len - 2, .head = velocity.as.numbers};
    if (!series_is_next(&series, next_position))
        return false;
    series.count++;
    return series_is_next(&series, next_velocity);
}

Value series_value(const Series *series, StateSlot slot) {
    uint32_t at = slot - series->first;
    if (at >= series->lent)
        return VALUE_NULL;
    const double *numbers = at < series->fresh ? series->numbers : series->before;
    return (Value){.len = series->len, .as.numbers = numbers + (size_t)at * series->len};
}

bool series_borrow(Series *series, StateSlot slot, StateLender lender, const double *numbers, uint32_t len) {
    uint32_t at = slot - series->first;
    if (at == 0 &&
        (series->lent == 0 || (series->fresh >= series->lent && series->lender == lender && series->len == len))) {
        series->before = series->numbers;
        series->numbers = numbers;
        series->lender = lender;
        series->len = len;
        series->fresh = 0;
    }
    if (at != series->fresh || series->lender != lender || series->len != len ||
        numbers != series->numbers + (size_t)at * len)
        return series_borrows(series, slot, lender) && series->len == len &&
               numbers == series_value(series, slot).as.numbers;
    series->fresh++;
    if (series->lent < series->fresh)
        series->lent = series->fresh;
    return true;
}
