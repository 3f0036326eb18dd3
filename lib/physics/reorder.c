// reorder.c: spatial reordering of the particle columns.
//
// A neighbour list sorts particles by grid cell. If phys_can_reorder allows it, the columns are permuted into that
// order whenever the list is rebuilt. Then kernels read neighbours from nearby memory and need not look up columns.
// system->order maps columns to handles. As all particles are in one group, forces are summed in ascending order of
// handles.
#include "physics/neighbour_list.h"
#include "physics/threads.h"

#include <assert.h>
#include <string.h>

// Columns to permute: the components of a vector attribute, or one number per particle.
typedef struct Attribute {
    double *numbers;
    size_t parts; // number of components, which may be any number of dimensions
} Attribute;

enum { MAX_ATTRIBUTES = 10 }; // 4 vectors and 6 numbers (Columns)

typedef struct Reordering {
    PhysSystem *system;
    const NeighbourList *list;
    Attribute attributes[MAX_ATTRIBUTES]; // phys_reorder copies positions from the list instead
    size_t count;                         // length of `attributes`
    size_t arrays;                        // sum of all `parts`
    size_t next;                          // first array of the current batch
} Reordering;

static void add_attribute(Reordering *reordering, double *numbers, size_t parts) {
    assert(reordering->count < MAX_ATTRIBUTES);
    reordering->attributes[reordering->count++] = (Attribute){numbers, parts};
    reordering->arrays += parts;
}

// Collects the columns to permute, including positions if `positions` is set. Attributes that all particles share
// (record_stride 0) are not moved.
static void add_attributes(Reordering *reordering, bool positions) {
    const PhysSystem *system = reordering->system;
    const Columns *columns = &system->columns;
    if (positions)
        add_attribute(reordering, columns->position, columns->dimensions);
    add_attribute(reordering, columns->velocity, columns->dimensions);
    bool own = system->own_forces != OWN_FORCES_NONE;
    if (own) {
        add_attribute(reordering, columns->own_force, columns->dimensions);
        add_attribute(reordering, columns->ease, 1);
    }
    if (own || positions || system->options.add_forces)
        add_attribute(reordering, columns->force, columns->dimensions); // in other cases, all forces are still 0
    if (!system->record_stride)
        return;
    double *numbers[] = {columns->radius, columns->mass, columns->charge, columns->section, columns->volume};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        add_attribute(reordering, numbers[i], 1);
}

// Returns array number `a` of all components of all attributes.
static double *array_at(const Reordering *reordering, size_t a) {
    const Attribute *attribute = reordering->attributes;
    for (; a >= attribute->parts; attribute++)
        a -= attribute->parts;
    return attribute->numbers + a * reordering->system->columns.stride;
}

// Returns how many of the remaining arrays fit into ListView.packed at once. Until the list is refreshed, only the
// dummy in `packed` is in use, and the rest of it is scratch memory.
static size_t arrays_at_once(const Reordering *reordering) {
    size_t left = reordering->arrays - reordering->next, room = reordering->list->view.width;
    return left < room ? left : room;
}

static void gather_chunk(void *context, int chunk, int chunks) {
    const Reordering *reordering = context;
    const NeighbourList *list = reordering->list;
    const uint32_t *column = list->view.column;
    size_t first = phys_chunk_begin(list->total, chunk, chunks), end = phys_chunk_begin(list->total, chunk + 1, chunks);
    for (size_t a = 0; a < arrays_at_once(reordering); a++) {
        const double *from = array_at(reordering, reordering->next + a);
        double *to = list->view.packed + a * list->total;
        for (size_t i = first; i < end; i++)
            to[i] = from[column[i]];
    }
}

static void copy_chunk(void *context, int chunk, int chunks) {
    const Reordering *reordering = context;
    const NeighbourList *list = reordering->list;
    size_t first = phys_chunk_begin(list->total, chunk, chunks),
           count = phys_chunk_begin(list->total, chunk + 1, chunks) - first;
    for (size_t a = 0; a < arrays_at_once(reordering) && count; a++)
        memcpy(array_at(reordering, reordering->next + a) + first, list->view.packed + a * list->total + first,
               count * sizeof(double));
}

static void move_arrays(Reordering *reordering, int chunks) {
    for (reordering->next = 0; reordering->next < reordering->arrays; reordering->next += arrays_at_once(reordering)) {
        phys_parallel(reordering->system, chunks, gather_chunk, reordering);
        phys_parallel(reordering->system, chunks, copy_chunk, reordering);
    }
}

static void move_marks(const Reordering *reordering, bool *marks) {
    const NeighbourList *list = reordering->list;
    bool *moved = (bool *)list->view.packed;
    for (uint32_t i = 0; i < list->total; i++)
        moved[i] = marks[list->view.column[i]];
    memcpy(marks, moved, list->total);
}

static void swap_numbers(const Reordering *reordering, uint32_t i, uint32_t j) {
    size_t stride = reordering->system->columns.stride;
    for (const Attribute *attribute = reordering->attributes; attribute < reordering->attributes + reordering->count;
         attribute++)
        for (size_t k = 0; k < attribute->parts; k++) {
            double *numbers = attribute->numbers + k * stride, number = numbers[i];
            numbers[i] = numbers[j];
            numbers[j] = number;
        }
}

static void swap_marks(bool *marks, uint32_t i, uint32_t j) {
    bool mark = marks[i];
    marks[i] = marks[j];
    marks[j] = mark;
}

// Copies the positions and the order from the list.
static void set_order_chunk(void *context, int chunk, int chunks) {
    const Reordering *reordering = context;
    const NeighbourList *list = reordering->list;
    PhysSystem *system = reordering->system;
    size_t first = phys_chunk_begin(list->total, chunk, chunks), end = phys_chunk_begin(list->total, chunk + 1, chunks);
    for (size_t k = 0; k < list->dimensions && first < end; k++)
        memcpy(system->columns.position + k * system->columns.stride + first, list->view.built[k] + first,
               (end - first) * sizeof(double));
    for (size_t i = first; i < end; i++) {
        system->order[i] = list->key[i];
        system->column_of[list->key[i]] = (uint32_t)i;
    }
}

bool phys_can_reorder(const PhysSystem *system) {
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

void phys_reorder(PhysSystem *system, NeighbourList *list) {
    if (list->view.listed > list->view.regular) // forces on large particles are summed in column order
        return;
    Reordering reordering = {.system = system, .list = list};
    int chunks = phys_chunk_count(system, list->total, PHYS_MIN_FOR_THREADS);
    add_attributes(&reordering, false);
    move_arrays(&reordering, chunks);
    if (system->record_stride || system->remote)
        move_marks(&reordering, system->columns.anchor);
    if (system->remote)
        move_marks(&reordering, system->remote);
    phys_parallel(system, chunks, set_order_chunk, &reordering);
    phys_lists_invalidate(system, list);
    list->view.direct = true;
    system->column_order = ORDER_BY_CELL;
}

void phys_forget_order(PhysSystem *system) {
    phys_lists_invalidate(system, NULL);
    if (system->column_order == ORDER_BY_CELL)
        system->column_order = ORDER_BY_HANDLE;
}

void phys_allow_reorder(PhysSystem *system, bool allowed) {
    if (!allowed && system->column_order == ORDER_BY_CELL)
        phys_restore_order(system);
    if (!allowed)
        system->column_order = ORDER_FIXED;
    else if (system->column_order == ORDER_FIXED)
        system->column_order = ORDER_BY_HANDLE;
}

// Permutes the columns in place by swaps, because there may be no memory left.
void phys_restore_order(PhysSystem *system) {
    Reordering reordering = {.system = system};
    uint32_t *order = system->order, *column_of = system->column_of, next = 0;
    add_attributes(&reordering, true);
    // In this loop, order[i] becomes the column to which the particle in column i belongs.
    for (uint32_t handle = 0; handle < system->handle_count; handle++)
        if (column_of[handle] != NO_COLUMN)
            order[column_of[handle]] = next++;
    for (uint32_t i = 0; i < system->columns.count; i++)
        for (uint32_t home = order[i]; home != i; home = order[i]) {
            swap_numbers(&reordering, i, home);
            swap_marks(system->columns.anchor, i, home);
            if (system->remote)
                swap_marks(system->remote, i, home);
            order[i] = order[home];
            order[home] = home;
        }
    next = 0;
    for (uint32_t handle = 0; handle < system->handle_count; handle++)
        if (column_of[handle] != NO_COLUMN) {
            order[next] = handle;
            column_of[handle] = next++;
        }
    phys_forget_order(system);
}
