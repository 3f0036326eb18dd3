// stream.c: see stream.h.
//
// Items at consecutive positions are computed by array functions, which have the same bits as those for single items.
#include "value/stream.h"

#include "base/cpu.h"
#include "base/number.h"
#include "maths/arrays.h"
#include "maths/random.h"

double value_stream_item(Value stream, uint64_t i) {
    switch ((StreamKind)stream.stream) {
    case STREAM_UNIFORM:
        return random_uniform(stream.as.key, i);
    case STREAM_BETA:
        return random_beta(stream.as.key, i);
    default:
        return random_normal(stream.as.key, i);
    }
}

static void consecutive_items(Value stream, uint64_t first, uint32_t count, double *to) {
    if (count > 1 && stream.stream == STREAM_UNIFORM)
        maths_arrays(cpu_detected.level)->uniform(stream.as.key, first, count, to);
    else if (count > 1 && stream.stream == STREAM_NORMAL)
        random_normals(cpu_detected.level, stream.as.key, first, count, to);
    else
        for (uint32_t i = 0; i < count; i++)
            to[i] = value_stream_item(stream, first + i);
}

void value_stream_items(Value stream, const double *at, uint32_t count, double *to) {
    for (uint32_t i = 0, run; i < count; i += run) {
        uint64_t first = value_stream_position(at[i]);
        run = 1;
        while (i + run < count && first + run != 0 && value_stream_position(at[i + run]) == first + run)
            run++;
        consecutive_items(stream, first, run, to + i);
    }
}

uint64_t value_stream_position(double x) {
    double whole = number_floor(x);
    // Outside the range of signed 64-bit integers, the result is the smallest of them on every machine, as with x86
    // conversions.
    if (!(whole >= -9223372036854775808.0 && whole < 9223372036854775808.0))
        return UINT64_C(1) << 63;
    return (uint64_t)(int64_t)whole;
}
