// settle.c: columns in the order of the places of a neighbour list.
//
// A list sorts particles by the cells of a grid, so that neighbours lie near each other. As long as its system is one
// of those that can, the columns are brought into the same order whenever a list has been made: then the kernels need
// not look for the column of each place, and partners are near in memory. Which particle is in a column says
// system->order. As all particles are of one group, their handles count up in the order of the description, which is
// that of sums.
#include "physics/neighbours.h"
#include "physics/threads.h"

#include <string.h>

enum { MOST_MOVED = 4 * PHYS_VECTOR_DIMENSIONS + 6 }; // arrays

typedef struct Settling {
    PhysSystem *system;
    const Neighbours *list;
    double *arrays[MOST_MOVED]; // but for positions, which the list has in its order
    size_t count;
    size_t next; // those that are on their way
} Settling;

static void add(Settling *settling, double *vector, size_t parts) {
    for (size_t k = 0; k < parts; k++)
        settling->arrays[settling->count++] = vector + k * settling->system->columns.stride;
}

// What the particles of a system with one record share need not be moved.
static void add_arrays(Settling *settling, bool positions) {
    const PhysSystem *system = settling->system;
    const Columns *columns = &system->columns;
    if (positions)
        add(settling, columns->position, columns->dimensions);
    add(settling, columns->velocity, columns->dimensions);
    if (system->has_own_forces) {
        add(settling, columns->own_force, columns->dimensions);
        add(settling, columns->ease, 1);
    }
    if (system->has_own_forces || positions)
        add(settling, columns->force, columns->dimensions); // else they are 0 before the pairs
    if (!system->record_stride)
        return;
    double *numbers[] = {columns->radius, columns->mass, columns->charge, columns->section, columns->volume};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        add(settling, numbers[i], 1);
}

// Until a list is brought up to date its quads serve no purpose, but for the dummy behind them.
static size_t at_once(const Settling *settling) {
    size_t left = settling->count - settling->next, room = settling->list->view.width;
    return left < room ? left : room;
}

static void gather_share(void *context, int share, int shares) {
    const Settling *settling = context;
    const Neighbours *list = settling->list;
    const uint32_t *column = list->view.column;
    size_t first = phys_share(list->total, share, shares), end = phys_share(list->total, share + 1, shares);
    for (size_t a = 0; a < at_once(settling); a++) {
        const double *from = settling->arrays[settling->next + a];
        double *to = list->view.quads + a * list->total;
        for (size_t i = first; i < end; i++)
            to[i] = from[column[i]];
    }
}

static void copy_share(void *context, int share, int shares) {
    const Settling *settling = context;
    const Neighbours *list = settling->list;
    size_t first = phys_share(list->total, share, shares), count = phys_share(list->total, share + 1, shares) - first;
    for (size_t a = 0; a < at_once(settling) && count; a++)
        memcpy(settling->arrays[settling->next + a] + first, list->view.quads + a * list->total + first,
               count * sizeof(double));
}

static void move_arrays(Settling *settling, int shares) {
    for (settling->next = 0; settling->next < settling->count; settling->next += at_once(settling)) {
        phys_parallel(settling->system, shares, gather_share, settling);
        phys_parallel(settling->system, shares, copy_share, settling);
    }
}

static void move_marks(const Settling *settling, bool *marks) {
    const Neighbours *list = settling->list;
    bool *moved = (bool *)list->view.quads;
    for (uint32_t i = 0; i < list->total; i++)
        moved[i] = marks[list->view.column[i]];
    memcpy(marks, moved, list->total);
}

static void swap_marks(bool *marks, uint32_t i, uint32_t j) {
    bool mark = marks[i];
    marks[i] = marks[j];
    marks[j] = mark;
}

// Positions, and who is where, the list knows.
static void take_share(void *context, int share, int shares) {
    const Settling *settling = context;
    const Neighbours *list = settling->list;
    PhysSystem *system = settling->system;
    size_t first = phys_share(list->total, share, shares), end = phys_share(list->total, share + 1, shares);
    for (size_t k = 0; k < list->dimensions && first < end; k++)
        memcpy(system->columns.position + k * system->columns.stride + first, list->view.built[k] + first,
               (end - first) * sizeof(double));
    for (size_t i = first; i < end; i++) {
        system->order[i] = list->key[i];
        system->place[list->key[i]] = (uint32_t)i;
    }
}

bool phys_can_settle(const PhysSystem *system) {
    const Group *groups = system->groups.bytes;
    const Force *forces = system->forces.bytes;
    for (uint32_t f = 0; f < system->force_count; f++) {
        ForceRow row = phys_force_row(forces[f].given.kind);
        if (row.stage == STAGE_LINK || row.need == NEED_STREAM)
            return false;
    }
    for (uint32_t g = 0; g < system->group_count; g++)
        if (groups[g].count) {
            uint32_t level = groups[g].nearest[STAGE_PAIR];
            return groups[g].count == system->particle_count && level != NO_GROUP &&
                   system->dimensions <= PHYS_VECTOR_DIMENSIONS &&
                   phys_next_above(groups, level, STAGE_PAIR) == NO_GROUP;
        }
    return false;
}

void phys_settle(PhysSystem *system, Neighbours *list) {
    if (list->view.listed > list->view.regular) { // large ones meet all others in the order of the columns
        return;
    }
    Settling settling = {.system = system, .list = list};
    int shares = phys_shares(system, list->total, PHYS_MIN_FOR_THREADS);
    add_arrays(&settling, false);
    move_arrays(&settling, shares);
    if (system->record_stride || system->foreign)
        move_marks(&settling, system->columns.anchor);
    if (system->foreign)
        move_marks(&settling, system->foreign);
    phys_parallel(system, shares, take_share, &settling);
    for (int i = 0; i < PHYS_MOST_LISTS; i++)
        system->lists[i].built &= &system->lists[i] == list;
    list->view.direct = system->settled = true;
}

void phys_forget_order(PhysSystem *system) {
    for (int i = 0; i < PHYS_MOST_LISTS; i++)
        system->lists[i].built = false;
    system->settled = false;
}

// In place, as there may be no memory: a particle that is not where it belongs changes places with the one that is
// there.
void phys_unsettle(PhysSystem *system) {
    Settling settling = {.system = system};
    uint32_t *order = system->order, *place = system->place, next = 0;
    add_arrays(&settling, true);
    for (uint32_t handle = 0; handle < system->places; handle++) // what is to be in which column
        if (place[handle] != NO_PLACE)
            order[place[handle]] = next++;
    for (uint32_t i = 0; i < system->columns.count; i++)
        for (uint32_t home = order[i]; home != i; home = order[i]) {
            for (size_t a = 0; a < settling.count; a++) {
                double number = settling.arrays[a][i];
                settling.arrays[a][i] = settling.arrays[a][home];
                settling.arrays[a][home] = number;
            }
            swap_marks(system->columns.anchor, i, home);
            if (system->foreign)
                swap_marks(system->foreign, i, home);
            order[i] = order[home];
            order[home] = home;
        }
    next = 0;
    for (uint32_t handle = 0; handle < system->places; handle++)
        if (place[handle] != NO_PLACE) {
            order[next] = handle;
            place[handle] = next++;
        }
    phys_forget_order(system);
}
