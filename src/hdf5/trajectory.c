// trajectory.c: see trajectory.h.
//
// Each system is an HDF5 group with its own list of frame numbers (steps), because a system can be absent from frames.
// The number of particles in a system can change from frame to frame. All rows therefore have the length of the longest
// row, and unused elements at the end of a row have the id -1.
#include "hdf5/trajectory.h"

#include "cli/hdf5.h"
#include "hdf5/scale.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// The energies are in the group `observables`, the edges in the group `box`, the others in the group of the system.
typedef enum Kind { POSITION, VELOCITY, RADIUS, MASS, CHARGE, ID, ANCHOR, EDGES, KINETIC, POTENTIAL, KINDS } Kind;
static const char *const NAMES[] = {"position", "velocity", "radius", "mass",           "charge",
                                    "id",       "anchor",   "edges",  "kinetic_energy", "potential_energy"};

struct Group {
    char *system_name; // name in the script
    uint64_t dimensions;
    hid_t group;
    Kind kinds;       // KINDS; KINETIC: the group has no energies
    StoreColumn step; // frame numbers
    StoreColumn time; // seconds
    StoreColumn columns[KINDS];
    hsize_t frames;        // number of frames
    hsize_t max_particles; // largest number of particles in a frame
};

// Fill values. Static, because columns keep pointers to them.
static const int64_t NO_ID = -1, NO_ANCHOR;
static const double NO_NUMBER = NAN;

static bool is_number(Kind kind) {
    return kind != ID && kind != ANCHOR;
}

static hid_t type_of(Kind kind) {
    return is_number(kind) ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64;
}

static const void *fill_of(Kind kind) {
    return is_number(kind) ? (const void *)&NO_NUMBER : kind == ID ? (const void *)&NO_ID : &NO_ANCHOR;
}

static int rank_of(Kind kind) {
    return kind == POSITION || kind == VELOCITY ? 3 : kind >= KINETIC ? 1 : 2;
}

static void add_author(TrajectoryFile *file) {
    static const int version[] = {1, 1};
    hid_t about = store_group(file->store, file->store->file, "h5md");
    store_numbers(file->store, about, "version", version, 2);
    store_text(file->store, store_group(file->store, about, "author"), "name", "unknown");
    hid_t creator = store_group(file->store, about, "creator");
    store_text(file->store, creator, "name", "petri");
    store_text(file->store, creator, "version", VERSION);
}

void trajectory_file_begin(TrajectoryFile *file, Store *store) {
    *file = (TrajectoryFile){.store = store, .last = -1};
    add_author(file);
    file->particles = store_group(store, store->file, "particles");
}

static bool is_name_used(const TrajectoryFile *file, const char *name) {
    return H5Lexists(file->particles, name, H5P_DEFAULT) > 0;
}

// Chooses the name of a group: `:cells` becomes cells, slashes become `|`, and a number is added if the name is in use.
static void choose_name(const TrajectoryFile *file, const char *called, Text *name) {
    text_add_c(name, called + (called[0] == ':' && called[1] != '\0'));
    for (char *c = name->bytes; *c != '\0'; c++)
        *c = *c == '/' ? '|' : *c;
    size_t length = name->len;
    for (int number = 2; is_name_used(file, name->bytes); number++) {
        name->len = length;
        text_add_format(name, "-%d", number);
    }
}

static hid_t parent_of(Kind kind, hid_t group, hid_t box, hid_t observables) {
    return kind < EDGES ? group : kind == EDGES ? box : observables;
}

// Adds an H5MD element, a quantity that changes with time. All elements of a group share the step and time data sets.
static void add_element(TrajectoryFile *file, Group *group, hid_t parent, Kind kind, hsize_t particles) {
    Store *store = file->store;
    hid_t element = store_group(store, parent, NAMES[kind]);
    hsize_t rows[STORE_RANKS] = {0, particles, group->dimensions};
    hsize_t edges[STORE_RANKS] = {0, group->dimensions};
    group->columns[kind] = store_column(store, element, "value", type_of(kind), rank_of(kind),
                                        kind == EDGES ? edges : rows, fill_of(kind));
    if (kind == POSITION) {
        group->step = store_column(store, element, "step", H5T_NATIVE_INT64, 1, edges, &NO_ANCHOR);
        group->time = store_column(store, element, "time", H5T_NATIVE_DOUBLE, 1, edges, &NO_NUMBER);
    } else {
        store_link(store, group->group, "position/step", element, "step");
        store_link(store, group->group, "position/time", element, "time");
    }
}

// Opens the group of a system in `observables`, and creates it if necessary.
static hid_t observables_group(const TrajectoryFile *file, const char *name) {
    bool exists = H5Lexists(file->store->file, "observables", H5P_DEFAULT) > 0;
    hid_t all = exists ? store_open(file->store, file->store->file, "observables")
                       : store_group(file->store, file->store->file, "observables");
    return exists && H5Lexists(all, name, H5P_DEFAULT) > 0 ? store_open(file->store, all, name)
                                                           : store_group(file->store, all, name);
}

static void add_group(TrajectoryFile *file, const char *called, const Hdf5System *system) {
    Store *store = file->store;
    SCOPED_TEXT name = {0};
    choose_name(file, called, &name);
    file->groups = memory_realloc(file->groups, (file->group_count + 1) * sizeof *file->groups);
    Group *group = &file->groups[file->group_count++];
    *group = (Group){.system_name = memory_strdup(called), .dimensions = system->dimensions};
    group->group = store_group(store, file->particles, name.bytes);
    store_text(store, group->group, "system", called);
    hid_t box = store_group(store, group->group, "box");
    int dimensions = (int)system->dimensions;
    store_numbers(store, box, "dimension", &dimensions, 1);
    store_texts(store, box, "boundary", "none", system->dimensions);
    group->kinds = isnan(system->kinetic_energy) ? KINETIC : KINDS;
    hid_t observables = group->kinds == KINDS ? observables_group(file, name.bytes) : -1;
    for (Kind kind = POSITION; kind < group->kinds; kind++)
        add_element(file, group, parent_of(kind, group->group, box, observables), kind, system->particles);
}

static Group *find_group(TrajectoryFile *file, const char *called, const Hdf5System *system) {
    for (size_t i = 0; i < file->group_count; i++) {
        Group *group = &file->groups[i];
        if (strcmp(group->system_name, called) == 0 && group->dimensions == system->dimensions)
            return group;
    }
    add_group(file, called, system);
    return &file->groups[file->group_count - 1];
}

// Computes the edges of the smallest box that contains all particle centres, because H5MD requires a box.
static void compute_extent(const double *position, const Hdf5System *system, double *edges) {
    for (uint64_t k = 0; k < system->dimensions; k++) {
        double min = INFINITY, max = -INFINITY;
        for (uint64_t i = 0; i < system->particles; i++) {
            double x = position[i * system->dimensions + k];
            min = isfinite(x) && x < min ? x : min;
            max = isfinite(x) && x > max ? x : max;
        }
        edges[k] = max >= min ? max - min : 0;
    }
}

static void number_ids(const TrajectoryFile *file, int64_t *ids, uint64_t count) {
    for (uint64_t i = 0; i < count; i++)
        ids[i] = ids[i] <= -2 ? file->numbers[-2 - ids[i]] : ids[i];
}

// Adds the system whose data starts at `bytes` to the file, as part of a frame. Returns a pointer to the data after the
// system.
static char *add_system(TrajectoryFile *file, const Hdf5Frame *frame, char *bytes) {
    const Hdf5System *system = (const Hdf5System *)(const void *)bytes;
    char *called = bytes + sizeof *system, *at = called + system->name_bytes;
    Group *group = find_group(file, called, system);
    hsize_t row = group->frames++, sizes[STORE_RANKS] = {1, system->particles, system->dimensions};
    group->max_particles = system->particles > group->max_particles ? system->particles : group->max_particles;
    double *edges = memory_calloc(system->dimensions * sizeof *edges);
    compute_extent((const double *)(const void *)at, system, edges);
    store_write_row(file->store, &group->columns[EDGES], row, (hsize_t[STORE_RANKS]){1, system->dimensions}, edges);
    free(edges);
    for (Kind kind = POSITION; kind < EDGES; kind++) {
        if (kind == ID)
            number_ids(file, (int64_t *)(void *)at, system->particles);
        store_write_row(file->store, &group->columns[kind], row, sizes, at);
        at += system->particles * (kind <= VELOCITY ? system->dimensions : 1) * sizeof(double);
    }
    if (group->kinds == KINDS) {
        store_write_row(file->store, &group->columns[KINETIC], row, sizes, &system->kinetic_energy);
        store_write_row(file->store, &group->columns[POTENTIAL], row, sizes, &system->potential_energy);
    }
    store_write_row(file->store, &group->step, row, sizes, &frame->number);
    store_write_row(file->store, &group->time, row, sizes, &frame->time);
    return at;
}

static bool is_text(const void *owner, uint32_t entry, const void *key) {
    return strcmp(((const TrajectoryFile *)owner)->texts.items[entry], key) == 0;
}

// Returns the number that the file stores for an id that is a string.
static int64_t number_text(TrajectoryFile *file, const char *text) {
    uint64_t hash = hash_bytes(0, text, strlen(text));
    uint32_t entry = hash_index_find(&file->index, hash, is_text, file, text);
    if (entry == HASH_INDEX_NONE) {
        entry = (uint32_t)file->texts.count;
        if (!hash_index_add(&file->index, hash, entry)) {
            file->store->failed = true;
            file->store->cause = ENOMEM;
        }
        texts_add(&file->texts, text);
    }
    return -2 - (int64_t)entry;
}

void trajectory_file_begin_run(TrajectoryFile *file) {
    file->run_texts = 0;
}

// Reads the new id strings of a frame. Each run numbers its strings from 0. Therefore adds entries to file->numbers,
// which maps these numbers to the ids that the file stores.
static void read_id_texts(TrajectoryFile *file, const char *text, uint64_t count) {
    file->numbers = memory_realloc(file->numbers, (file->run_texts + count + 1) * sizeof *file->numbers);
    for (uint64_t i = 0; i < count; i++, text += strlen(text) + 1)
        file->numbers[file->run_texts++] = number_text(file, text);
}

void trajectory_file_add(TrajectoryFile *file, char *bytes) {
    const Hdf5Frame *frame = (const Hdf5Frame *)(const void *)bytes;
    char *texts = bytes + sizeof *frame, *at = texts + frame->text_bytes;
    read_id_texts(file, texts, frame->text_count);
    for (uint64_t s = 0; s < frame->system_count && frame->number > file->last; s++)
        at = add_system(file, frame, at);
    file->last = frame->number > file->last ? frame->number : file->last;
}

// Opens an existing group and counts its frames up to `after` and the particles in them. Lowers *min_id to the smallest
// id in these frames. Returns false if no frame is left.
static bool read_group(TrajectoryFile *file, Group *group, const char *name, int64_t after, int64_t *min_id) {
    Store *store = file->store;
    bool has_energies = H5Lexists(store->file, "observables", H5P_DEFAULT) > 0 &&
                        H5Lexists(store_open(store, store->file, "observables"), name, H5P_DEFAULT) > 0;
    hid_t observables = has_energies ? observables_group(file, name) : -1;
    group->kinds = has_energies ? KINDS : KINETIC;
    group->system_name = store_read_text(store, group->group, "system");
    hid_t box = store_open(store, group->group, "box");
    group->dimensions = (uint64_t)store_read_number(store, box, "dimension");
    for (Kind kind = POSITION; kind < group->kinds; kind++) {
        hid_t element = store_open(store, parent_of(kind, group->group, box, observables), NAMES[kind]);
        group->columns[kind] = store_open_column(store, element, "value", type_of(kind), rank_of(kind), fill_of(kind));
        if (kind == POSITION) {
            group->step = store_open_column(store, element, "step", H5T_NATIVE_INT64, 1, &NO_ANCHOR);
            group->time = store_open_column(store, element, "time", H5T_NATIVE_DOUBLE, 1, &NO_NUMBER);
        }
    }
    // Every frame has a row in each column. The file of a stranger can claim more rows.
    bool equal = group->time.sizes[0] == group->step.sizes[0];
    for (Kind kind = POSITION; kind < group->kinds; kind++)
        equal = equal && group->columns[kind].sizes[0] == group->step.sizes[0];
    store->failed = store->failed || !equal;
    hsize_t one[STORE_RANKS] = {1, group->columns[ID].sizes[1]};
    int64_t *ids = memory_calloc((one[1] + 1) * sizeof *ids);
    for (int64_t step = 0; !store->failed && group->frames < group->step.sizes[0]; group->frames++) {
        store_read_row(store, &group->step, group->frames, one, &step);
        if (step > after)
            break;
        file->last = step > file->last ? step : file->last;
        memset(ids, 0xff, one[1] * sizeof *ids); // fills with NO_ID, -1
        if (one[1] > 0)
            store_read_row(store, &group->columns[ID], group->frames, one, ids);
        for (hsize_t i = 0; i < one[1]; i++) {
            *min_id = ids[i] < *min_id ? ids[i] : *min_id;
            group->max_particles = ids[i] != NO_ID && i >= group->max_particles ? i + 1 : group->max_particles;
        }
    }
    free(ids);
    return group->frames > 0;
}

// Removes an object that trajectory_file_end writes again.
static void remove_object(Store *store, const Group *group, const char *name) {
    if (H5Lexists(group->group, name, H5P_DEFAULT) > 0)
        store_check(store, H5Ldelete(group->group, name, H5P_DEFAULT));
}

static void cut_group(Store *store, Group *group) {
    for (Kind kind = POSITION; kind < group->kinds; kind++) {
        scale_remove(store, group->columns[kind].set);
        hsize_t rows[STORE_RANKS] = {group->frames, group->max_particles, group->dimensions};
        hsize_t edges[STORE_RANKS] = {group->frames, group->dimensions};
        store_truncate(store, &group->columns[kind], kind == EDGES ? edges : rows);
    }
    hsize_t frames[STORE_RANKS] = {group->frames};
    store_truncate(store, &group->step, frames);
    store_truncate(store, &group->time, frames);
    scale_remove(store, group->step.set);
    scale_remove(store, group->time.set);
    remove_object(store, group, "species");
    remove_object(store, group, "particle");
    remove_object(store, group, "axis");
}

static void read_groups(TrajectoryFile *file, int64_t after, int64_t *min_id) {
    SCOPED_TEXT name = {0};
    for (hsize_t i = 0; store_name_at(file->store, file->particles, i, &name);) {
        Group group = {.group = store_open(file->store, file->particles, name.bytes)};
        bool any = read_group(file, &group, name.bytes, after, min_id);
        if (file->store->failed || !any) {
            free(group.system_name);
            if (file->store->failed)
                return;
            if (group.kinds == KINDS) {
                hid_t observables = store_open(file->store, file->store->file, "observables");
                store_check(file->store, H5Ldelete(observables, name.bytes, H5P_DEFAULT));
            }
            store_check(file->store, H5Ldelete(file->particles, name.bytes, H5P_DEFAULT));
            continue;
        }
        cut_group(file->store, &group);
        file->groups = memory_realloc(file->groups, (file->group_count + 1) * sizeof *file->groups);
        file->groups[file->group_count++] = group;
        i++;
    }
}

bool trajectory_file_resume(TrajectoryFile *file, Store *store, int64_t after) {
    int64_t min_id = NO_ID;
    *file = (TrajectoryFile){.store = store, .last = -1};
    file->particles = store_open(store, store->file, "particles");
    read_groups(file, after, &min_id);
    if (H5Lexists(store->file, "parameters", H5P_DEFAULT) > 0) {
        size_t count = 0, bytes = 0;
        char *texts = store_read_texts(store, store->file, "parameters/id_texts", &count, &bytes);
        for (size_t i = 0; !store->failed && i < count && (int64_t)i < NO_ID - min_id; i++)
            number_text(file, texts + i * bytes);
        free(texts);
        store_check(store, H5Ldelete(store->file, "parameters", H5P_DEFAULT));
    }
    return !store->failed;
}

// Adds the species of the particles, which is always 0: ASE reads it as no element (X). Names the dimensions of all
// data sets of the system.
static void end_group(Store *store, const Group *group) {
    static const int64_t none;
    hsize_t sizes[STORE_RANKS] = {group->max_particles};
    StoreColumn species = store_column(store, group->group, "species", H5T_NATIVE_INT64, 1, sizes, &none);
    store_grow(store, &species, sizes);
    Scale time = scale_begin(store, group->time.set, "time");
    Scale particle = scale_count(store, group->group, "particle", group->max_particles);
    Scale axis = scale_count(store, group->group, "axis", group->dimensions);
    scale_attach(store, group->step.set, 1, (Scale *[]){&time});
    scale_attach(store, species.set, 1, (Scale *[]){&particle});
    for (Kind kind = POSITION; kind < group->kinds; kind++)
        scale_attach(store, group->columns[kind].set, rank_of(kind),
                     kind == EDGES ? (Scale *[]){&time, &axis} : (Scale *[]){&time, &particle, &axis});
    scale_end(store, &time);
    scale_end(store, &particle);
    scale_end(store, &axis);
}

void trajectory_file_end(TrajectoryFile *file) {
    for (size_t i = 0; i < file->group_count; i++) {
        end_group(file->store, &file->groups[i]);
        free(file->groups[i].system_name);
    }
    if (file->texts.count > 0) {
        SCOPED_TEXT texts = {0};
        for (size_t i = 0; i < file->texts.count; i++)
            text_add(&texts, (Str){file->texts.items[i], strlen(file->texts.items[i]) + 1});
        hid_t parameters = store_group(file->store, file->store->file, "parameters");
        store_text_list(file->store, parameters, "id_texts", texts.bytes, file->texts.count);
    }
    texts_free(&file->texts);
    hash_index_free(&file->index);
    free(file->numbers);
    free(file->groups);
}
