// budget.h: how much work and memory a script may have: one budget for all that a session does for it.
//
// Work is counted in units of about ten nanoseconds: a round of a loop, a call, a node, sixteen numbers that are added.
// It is charged before it is done, by what an operation will look at, through the arena that the operation works in
// (arena.h); where that is much, in portions, for each charge is also where an end that the host asks for is heard.
// Memory is what blocks hold, whoever asked for them and whatever is still in use in them.
#ifndef PETRI_BASE_BUDGET_H
#define PETRI_BASE_BUDGET_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Budget {
    uint64_t work;       // done since budget_begin
    uint64_t next_check; // when to look next whether to go on
    uint64_t work_limit;
    size_t memory; // bytes held
    size_t memory_limit;
    bool memory_refused;                       // since budget_begin
    atomic_bool *interrupt;                    // true: the host wants an end; NULL: nobody can ask for one
    bool (*should_interrupt)(void *user_data); // asked for such a wish, by the thread that charges; NULL: nobody
    void *user_data;
    bool retains;   // the host still looks at what is to be freed (arena_retire)
    void *retained; // … which is here: ArenaBlock
} Budget;

// What an array of so many bytes costs that is filled or looked at in a simple loop.
enum { BUDGET_BYTES = 128, BUDGET_NUMBERS = BUDGET_BYTES / sizeof(double) };
// A portion of an array: little enough to be done at once, enough for the charge not to be felt.
enum { BUDGET_CHUNK = 1 << 14 };

typedef enum BudgetOutcome { BUDGET_OK, BUDGET_EXCEEDED, BUDGET_INTERRUPTED } BudgetOutcome;

// Begins a piece of work with a budget of its own.
void budget_begin(Budget *budget, uint64_t work_limit, atomic_bool *interrupt);
// What comes of a charge that went past `pause`.
BudgetOutcome budget_check(Budget *budget);

// Charges `units`, and tells whether to go on; NULL is free of charge.
static inline BudgetOutcome budget_charge(Budget *budget, uint64_t units) {
    if (!budget)
        return BUDGET_OK;
    budget->work = units < budget->work_limit - budget->work ? budget->work + units : budget->work_limit + 1;
    return budget->work <= budget->next_check ? BUDGET_OK : budget_check(budget);
}

// Takes bytes from the budget, if they are left; gives them back.
bool budget_reserve(Budget *budget, size_t bytes);
void budget_release(Budget *budget, size_t bytes);

#endif
