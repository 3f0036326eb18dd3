// trajectory.c: see trajectory.h.
//
// Each system is a group of particles, with an own list of steps, for it may be absent from frames. The number of its
// particles may change: a row is as long as the longest, and ends in particles whose id is the fill value, -1.
#include "hdf5/trajectory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/hdf5.h"

typedef enum Kind { POSITION, VELOCITY, RADIUS, MASS, CHARGE, ID, ANCHOR, EDGES, KINDS } Kind;
static const char *const NAMES[] = {"position", "velocity", "radius", "mass", "charge", "id", "anchor", "edges"};

struct Group {
    char *called; // as the script calls it
    uint64_t dimensions;
    hid_t group;
    StoreColumn step;
    StoreColumn time;
    StoreColumn columns[KINDS];
    hsize_t frames;
    hsize_t most; // particles
};

static void add_author(Way *way) {
    static const int version[] = {1, 1};
    hid_t about = store_group(way->store, way->store->file, "h5md");
    store_numbers(way->store, about, "version", version, 2);
    store_text(way->store, store_group(way->store, about, "author"), "name", "unknown");
    hid_t creator = store_group(way->store, about, "creator");
    store_text(way->store, creator, "name", "petri");
    store_text(way->store, creator, "version", VERSION);
}

void way_begin(Way *way, Store *store) {
    *way = (Way){.store = store};
    add_author(way);
    way->particles = store_group(store, store->file, "particles");
}

static bool is_taken(const Way *way, const char *name) {
    return H5Lexists(way->particles, name, H5P_DEFAULT) > 0;
}

// `:cells` is cells. Slashes part names, and another system may be called so.
static void choose_name(const Way *way, const char *called, Bytes *name) {
    bytes_add_text(name, called + (called[0] == ':' && called[1] != '\0'));
    for (char *c = name->data; *c != '\0'; c++) {
        *c = *c == '/' ? '|' : *c;
    }
    size_t length = name->length;
    for (int number = 2; is_taken(way, name->data); number++) {
        name->length = length;
        bytes_format(name, "-%d", number);
    }
}

// What changes with time: the steps of all are the same.
static void add_element(Way *way, Group *group, hid_t parent, Kind kind, hsize_t particles) {
    static const int64_t no_id = -1, no_anchor;
    static const double no_number = NAN;
    Store *store = way->store;
    hid_t element = store_group(store, parent, NAMES[kind]);
    bool numbers = kind != ID && kind != ANCHOR;
    hsize_t rows[STORE_RANKS] = {0, particles, group->dimensions};
    hsize_t edges[STORE_RANKS] = {0, group->dimensions};
    group->columns[kind] = store_column(store, element, "value", numbers ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64,
                                        kind == POSITION || kind == VELOCITY ? 3 : 2, kind == EDGES ? edges : rows,
                                        numbers      ? (const void *)&no_number
                                        : kind == ID ? (const void *)&no_id
                                                     : &no_anchor);
    if (kind == POSITION) {
        group->step = store_column(store, element, "step", H5T_NATIVE_INT64, 1, edges, &no_anchor);
        group->time = store_column(store, element, "time", H5T_NATIVE_DOUBLE, 1, edges, &no_number);
    } else {
        store_link(store, group->group, "position/step", element, "step");
        store_link(store, group->group, "position/time", element, "time");
    }
}

static void add_group(Way *way, const char *called, const Hdf5System *system) {
    Store *store = way->store;
    SCOPED_BYTES name = {0};
    choose_name(way, called, &name);
    way->groups = memory_resized(way->groups, (way->group_count + 1) * sizeof *way->groups);
    Group *group = &way->groups[way->group_count++];
    *group = (Group){.called = memory_text(called), .dimensions = system->dimensions};
    group->group = store_group(store, way->particles, name.data);
    store_text(store, group->group, "system", called);
    hid_t box = store_group(store, group->group, "box");
    int dimensions = (int)system->dimensions;
    store_numbers(store, box, "dimension", &dimensions, 1);
    store_texts(store, box, "boundary", "none", system->dimensions);
    for (Kind kind = POSITION; kind < KINDS; kind++) {
        add_element(way, group, kind == EDGES ? box : group->group, kind, system->particles);
    }
}

static Group *find_group(Way *way, const char *called, const Hdf5System *system) {
    for (size_t i = 0; i < way->group_count; i++) {
        Group *group = &way->groups[i];
        if (strcmp(group->called, called) == 0 && group->dimensions == system->dimensions) {
            return group;
        }
    }
    add_group(way, called, system);
    return &way->groups[way->group_count - 1];
}

// The smallest box that holds the middles of all: there is no other.
static void measure(const double *position, const Hdf5System *system, double *edges) {
    for (uint64_t k = 0; k < system->dimensions; k++) {
        double least = INFINITY, most = -INFINITY;
        for (uint64_t i = 0; i < system->particles; i++) {
            double x = position[i * system->dimensions + k];
            least = isfinite(x) && x < least ? x : least;
            most = isfinite(x) && x > most ? x : most;
        }
        edges[k] = most >= least ? most - least : 0;
    }
}

// Returns what follows the system.
static const char *add_system(Way *way, const Hdf5Frame *frame, const char *bytes) {
    const Hdf5System *system = (const Hdf5System *)(const void *)bytes;
    const char *called = bytes + sizeof *system, *at = called + system->name_bytes;
    Group *group = find_group(way, called, system);
    hsize_t row = group->frames++, sizes[STORE_RANKS] = {1, system->particles, system->dimensions};
    group->most = system->particles > group->most ? system->particles : group->most;
    double *edges = memory_zeroed(system->dimensions * sizeof *edges);
    measure((const double *)(const void *)at, system, edges);
    store_row(way->store, &group->columns[EDGES], row, (hsize_t[STORE_RANKS]){1, system->dimensions}, edges);
    free(edges);
    for (Kind kind = POSITION; kind < EDGES; kind++) {
        store_row(way->store, &group->columns[kind], row, sizes, at);
        at += system->particles * (kind <= VELOCITY ? system->dimensions : 1) * sizeof(double);
    }
    store_row(way->store, &group->step, row, sizes, &frame->number);
    store_row(way->store, &group->time, row, sizes, &frame->time);
    return at;
}

void way_add(Way *way, const char *bytes) {
    const Hdf5Frame *frame = (const Hdf5Frame *)(const void *)bytes;
    const char *texts = bytes + sizeof *frame, *text = texts, *at = texts + frame->text_bytes;
    for (uint64_t i = 0; i < frame->text_count; i++) {
        text += strlen(text) + 1;
    }
    bytes_add(&way->texts, texts, (size_t)(text - texts));
    way->text_count += frame->text_count;
    for (uint64_t s = 0; s < frame->system_count; s++) {
        at = add_system(way, frame, at);
    }
}

// All are of species 0, which stands for no element (X) in ASE.
static void add_species(Way *way, const Group *group) {
    static const int64_t none;
    hsize_t sizes[STORE_RANKS] = {group->most};
    StoreColumn species = store_column(way->store, group->group, "species", H5T_NATIVE_INT64, 1, sizes, &none);
    store_grow(way->store, &species, sizes);
}

void way_end(Way *way) {
    for (size_t i = 0; i < way->group_count; i++) {
        add_species(way, &way->groups[i]);
        free(way->groups[i].called);
    }
    if (way->text_count > 0) {
        hid_t parameters = store_group(way->store, way->store->file, "parameters");
        store_text_list(way->store, parameters, "id_texts", way->texts.data, way->text_count);
    }
    bytes_free(&way->texts);
    free(way->groups);
}
