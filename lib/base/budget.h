// budget.h: the work and memory budget of a session.
//
// Work is counted in units of about 10 ns. One unit is, for example, a loop iteration, a call, a node or the addition
// of sixteen numbers. An operation charges its work before doing it, through the arena from which it allocates
// (arena.h). Large operations charge in chunks, because an interrupt is noticed only when work is charged. A block of
// memory is charged from its allocation until it is freed, even while none of it is in use.
#pragma once

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Budget {
    uint64_t work;                             // units charged since budget_begin; work_limit + 1: limit exceeded
    uint64_t next_check;                       // budget_check is called once `work` exceeds this value
    uint64_t work_limit;                       // maximum of `work`
    size_t memory;                             // bytes currently charged
    size_t memory_limit;                       // maximum of `memory`
    double refused_time;                       // sum of the times refused since budget_begin, in nanoseconds
    double refused_memory;                     // sum of the bytes refused since budget_begin
    double suggested_work;                     // last result of budget_suggest_work; 0: none
    bool memory_refused;                       // true if budget_reserve has failed since budget_begin
    atomic_bool *interrupt;                    // set by the host to interrupt the work; NULL: cannot be interrupted
    bool (*should_interrupt)(void *user_data); // called repeatedly during work; true: interrupt; NULL: not called
    void *user_data;                           // passed to should_interrupt
    bool retains;   // true: arena_retire keeps blocks in `retained`, because the host may still read them
    void *retained; // linked list of the ArenaBlocks that arena_retire has kept
} Budget;

// Number of bytes, or of doubles, that a simple loop over an array reads or fills for one unit of work.
enum { BUDGET_BYTES = 128, BUDGET_NUMBERS = BUDGET_BYTES / sizeof(double) };
// Number of elements that a long loop processes between two charges: small enough that an interrupt is noticed
// promptly, and large enough that the cost of charging is negligible.
enum { BUDGET_CHUNK = 1 << 14 };

enum { BUDGET_UNIT_TIME = 10 }; // nanoseconds of a unit of work

typedef enum BudgetOutcome { BUDGET_OK, BUDGET_EXCEEDED, BUDGET_INTERRUPTED } BudgetOutcome;

// Starts to count the work of an operation, such as loading a script: resets `work` and memory_refused. Memory stays
// charged. `interrupt` may be NULL.
void budget_begin(Budget *budget, uint64_t work_limit, atomic_bool *interrupt);
// Returns BUDGET_OK if work may continue, else the reason to stop. Sets next_check. Called if `work` exceeds
// next_check.
BudgetOutcome budget_check(Budget *budget);

// Charges `units`. Returns BUDGET_OK if work may continue. If the budget is NULL, nothing is charged.
static inline BudgetOutcome budget_charge(Budget *budget, uint64_t units) {
    if (!budget)
        return BUDGET_OK;
    budget->work = units < budget->work_limit - budget->work ? budget->work + units : budget->work_limit + 1;
    return budget->work <= budget->next_check ? BUDGET_OK : budget_check(budget);
}

// Charges an estimated time in nanoseconds. If the limit would be exceeded, adds the time to refused_time and returns
// false.
bool budget_charge_time(Budget *budget, double time);

// Drawing has a budget with three quarters of the session's work limit. Returns that part of a session's limit.
uint64_t budget_drawing_limit(uint64_t session_limit);
// Returns the session's work limit, in units of 2^20, that suffices to draw also what a drawing budget has refused.
// Never decreases, so that a message with the result does not change in each frame.
double budget_suggest_work(Budget *drawing);
// Like budget_suggest_work, for the memory limit in MiB. `limit` is the session's limit in bytes.
double budget_suggest_memory(const Budget *drawing, size_t limit);

// Returns how many bytes may still be reserved.
size_t budget_memory_left(const Budget *budget);
// Charges memory. Returns false, with nothing charged, if the limit would be exceeded.
bool budget_reserve(Budget *budget, size_t bytes);
// Releases memory that budget_reserve has charged.
void budget_release(Budget *budget, size_t bytes);
