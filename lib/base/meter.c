// meter.c: see meter.h.
#include "base/meter.h"

void meter_begin(Meter *meter, uint64_t work_limit, atomic_bool *interrupt) {
    meter->work = meter->pause = 0;
    meter->work_limit = work_limit < UINT64_MAX / 2 ? work_limit : UINT64_MAX / 2;
    meter->interrupt = interrupt;
    meter->memory_refused = false;
}

MeterAnswer meter_look(Meter *meter) {
    enum { BETWEEN_LOOKS = 1024 };
    meter->pause = 0; // once it is to end, each charge comes here
    if (meter->interrupt && meter->wants_end && meter->wants_end(meter->host))
        atomic_store(meter->interrupt, true);
    if (meter->interrupt && atomic_load_explicit(meter->interrupt, memory_order_relaxed))
        return METER_INTERRUPTED;
    if (meter->work > meter->work_limit)
        return METER_WORK;
    uint64_t left = meter->work_limit - meter->work;
    meter->pause = meter->work + (left < BETWEEN_LOOKS ? left : BETWEEN_LOOKS);
    return METER_GOES_ON;
}

bool meter_take(Meter *meter, size_t bytes) {
    if (!meter)
        return true;
    if (bytes > meter->memory_limit || meter->memory > meter->memory_limit - bytes) {
        meter->memory_refused = true;
        return false;
    }
    meter->memory += bytes;
    return true;
}

void meter_give(Meter *meter, size_t bytes) {
    if (meter)
        meter->memory -= bytes;
}
