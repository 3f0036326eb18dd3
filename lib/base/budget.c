// budget.c: see budget.h.
//
// A charge only adds its work and compares the sum with next_check (base/arena.h). budget_check looks at the interrupt
// and the limit after every CHECK_INTERVAL units.
#include "base/budget.h"

#include <math.h>

void budget_begin(Budget *budget, uint64_t work_limit, atomic_bool *interrupt) {
    budget->work = budget->next_check = 0;
    budget->work_limit = work_limit < UINT64_MAX / 2 ? work_limit : UINT64_MAX / 2;
    budget->interrupt = interrupt;
    budget->refused_time = budget->refused_memory = 0;
    budget->memory_refused = false;
}

BudgetOutcome budget_check(Budget *budget) {
    enum { CHECK_INTERVAL = 1024 };
    budget->next_check = 0; // after an interrupt or an exceeded limit, every charge calls this function
    if (budget->interrupt && budget->should_interrupt && budget->should_interrupt(budget->user_data))
        atomic_store(budget->interrupt, true);
    if (budget->interrupt && atomic_load_explicit(budget->interrupt, memory_order_relaxed))
        return BUDGET_INTERRUPTED;
    if (budget->work > budget->work_limit)
        return BUDGET_EXCEEDED;
    uint64_t left = budget->work_limit - budget->work;
    budget->next_check = budget->work + (left < CHECK_INTERVAL ? left : CHECK_INTERVAL);
    return BUDGET_OK;
}

bool budget_charge_time(Budget *budget, double time) {
    double work = time / BUDGET_UNIT_TIME;
    if (!(work <= (double)(budget->work_limit - budget->work))) {
        budget->refused_time += isfinite(time) ? time : 0;
        return false;
    }
    budget->work += (uint64_t)work;
    return true;
}

uint64_t budget_drawing_limit(uint64_t session_limit) {
    return session_limit / 4 * 3;
}

// Rounds up to two digits, after adding a tenth because the figures are estimates.
static double round_up(double number) {
    double unit = 1, more = 1.1 * number;
    while (more / unit >= 100 && unit < 1e18)
        unit *= 10;
    return ceil(more / unit) * unit;
}

double budget_suggest_work(Budget *drawing) {
    double work = (double)drawing->work + drawing->refused_time / BUDGET_UNIT_TIME;
    double needed = round_up(work / 3 * 4 / (1 << 20));
    if (needed > drawing->suggested_work)
        drawing->suggested_work = needed;
    return drawing->suggested_work;
}

double budget_suggest_memory(const Budget *drawing, size_t limit) {
    return round_up(((double)limit + drawing->refused_memory) / (1 << 20));
}

size_t budget_memory_left(const Budget *budget) {
    return budget->memory < budget->memory_limit ? budget->memory_limit - budget->memory : 0;
}

bool budget_reserve(Budget *budget, size_t bytes) {
    if (!budget)
        return true;
    if (bytes > budget->memory_limit || budget->memory > budget->memory_limit - bytes) {
        budget->memory_refused = true;
        budget->refused_memory += (double)bytes;
        return false;
    }
    budget->memory += bytes;
    return true;
}

void budget_release(Budget *budget, size_t bytes) {
    if (budget)
        budget->memory -= bytes;
}
