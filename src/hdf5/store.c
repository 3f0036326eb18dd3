// store.c: see store.h. No time stamps are stored, so that equal runs give identical files.
#include "hdf5/store.h"

#include "base/file.h"
#include "base/os.h"
#include "cli/cli.h"
#include "cli/hdf5.h"
#include "cli/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// Finds errno in the text of an error. libhdf5 reports it in no other way.
static herr_t find_cause(unsigned depth, const H5E_error2_t *error, void *context) {
    (void)depth;
    Store *store = context;
    const char *place = !error->desc ? NULL : strstr(error->desc, "errno = ");
    if (place && store->cause == 0)
        store->cause = atoi(place + strlen("errno = "));
    return 0;
}

void store_check(Store *store, int64_t result) {
    if (result < 0 && !store->failed) {
        store->failed = true;
        H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, find_cause, store);
    }
}

static hid_t check_id(Store *store, hid_t id) {
    store_check(store, id);
    return id;
}

static bool report_error(const Store *store, const char *why) {
    message("cannot write %s: %s", store->path, why);
    return false;
}

// Copies the existing file, if there is one, to the new file. Returns false and sets errno on failure.
static bool copy_existing(Store *store) {
    enum { COPY_BYTES = 1 << 20 };
    int old = file_open_at(store->replacement.folder, store->replacement.name, O_RDONLY, 0);
    if (old < 0)
        return errno == ENOENT;
    SCOPED_STRING bytes = memory_calloc(COPY_BYTES);
    ssize_t count;
    while ((count = file_read_some(old, bytes, COPY_BYTES)) > 0)
        if (!file_write(store->replacement.file, bytes, (size_t)count))
            break;
    int cause = errno;
    close(old);
    errno = cause;
    store->existing = true;
    return count == 0;
}

bool store_begin(Store *store, const char *path, bool continues) {
    *store = (Store){.path = path, .file = H5I_INVALID_HID};
    // libhdf5 needs a path, so the temporary file must have a name.
    if (!replace_begin(&store->replacement, path, REPLACE_NAMED))
        return report_error(store, strerror(errno));
    if (store->replacement.direct) {
        replace_abort(&store->replacement);
        return report_error(store, "not a regular file");
    }
    if (continues && !copy_existing(store)) {
        int cause = errno;
        replace_abort(&store->replacement);
        return report_error(store, strerror(cause));
    }
    // libhdf5 must not lock the file, because replace_begin already holds a lock on it.
    setenv("HDF5_USE_FILE_LOCKING", "FALSE", 1);
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    H5Lunregister(H5L_TYPE_EXTERNAL); // a file of a stranger must not refer to other files, which would be modified
    hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fclose_degree(access, H5F_CLOSE_STRONG); // H5Fclose also closes all open objects of the file
    SCOPED_TEXT name = {0};
    char folder[PATH_MAX];
    if (!os_folder_path(store->replacement.folder, folder)) {
        replace_abort(&store->replacement);
        return report_error(store, strerror(errno));
    }
    text_add_format(&name, "%s/%s", folder, store->replacement.temporary_name);
    store->file = store->existing ? H5Fopen(name.bytes, H5F_ACC_RDWR, access)
                                  : check_id(store, H5Fcreate(name.bytes, H5F_ACC_TRUNC, H5P_DEFAULT, access));
    H5Pclose(access);
    if (store->file < 0 && store->existing) {
        replace_abort(&store->replacement);
        message("cannot continue %s: %s", path, TRAJECTORY_FILE_UNKNOWN);
        return false;
    }
    return !store->failed || store_end(store, false);
}

bool store_end(Store *store, bool keep) {
    if (store->file >= 0)
        store_check(store, H5Fclose(store->file));
    if (keep && !store->failed)
        return replace_commit(&store->replacement) || report_error(store, strerror(errno));
    replace_abort(&store->replacement);
    return !store->failed ||
           (!store->reported && report_error(store, store->cause != 0 ? strerror(store->cause) : "libhdf5 failed"));
}

hid_t store_group(Store *store, hid_t parent, const char *name) {
    return check_id(store, H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
}

void store_attribute(Store *store, hid_t object, const char *name, hid_t type, hid_t space, const void *value) {
    hid_t attribute = check_id(store, H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT));
    store_check(store, H5Awrite(attribute, type, value));
    H5Aclose(attribute);
    H5Sclose(space);
}

hid_t store_text_type(size_t length) {
    hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, length + 1);
    H5Tset_cset(type, H5T_CSET_UTF8);
    return type;
}

void store_text(Store *store, hid_t object, const char *name, const char *text) {
    hid_t type = store_text_type(strlen(text));
    store_attribute(store, object, name, type, H5Screate(H5S_SCALAR), text);
    H5Tclose(type);
}

void store_texts(Store *store, hid_t object, const char *name, const char *text, hsize_t count) {
    size_t bytes = strlen(text) + 1;
    char *texts = memory_calloc(count * bytes);
    for (size_t i = 0; i < count; i++)
        memcpy(texts + i * bytes, text, bytes);
    hid_t type = store_text_type(bytes - 1);
    store_attribute(store, object, name, type, H5Screate_simple(1, &count, NULL), texts);
    H5Tclose(type);
    free(texts);
}

void store_numbers(Store *store, hid_t object, const char *name, const int *numbers, hsize_t count) {
    hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, NULL);
    store_attribute(store, object, name, H5T_NATIVE_INT, space, numbers);
}

// Chooses the chunk size: a chunk contains many short rows, or a part of a long row. Unfilled large chunks waste space,
// and many small chunks waste time.
static void choose_chunk(int rank, const hsize_t sizes[STORE_RANKS], hsize_t chunk[STORE_RANKS]) {
    enum { SHORT = 1024, LONG = 65536 }; // approximate minimum and exact maximum number of values in a chunk
    hsize_t row = 1;
    for (int k = rank - 1; k > 0; k--) {
        hsize_t size = sizes[k] > LONG / row ? LONG / row : sizes[k];
        chunk[k] = size > 0 ? size : 1;
        row *= chunk[k];
    }
    chunk[0] = row < SHORT ? SHORT / row : 1;
}

StoreColumn store_column(Store *store, hid_t parent, const char *name, hid_t type, int rank,
                         const hsize_t sizes[STORE_RANKS], const void *fill) {
    StoreColumn column = {.parent = parent, .name = name, .type = type, .fill = fill, .rank = rank};
    hsize_t max_sizes[STORE_RANKS] = {H5S_UNLIMITED, H5S_UNLIMITED, H5S_UNLIMITED};
    choose_chunk(rank, sizes, column.chunk);
    hid_t properties = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(rank, column.sizes, max_sizes);
    H5Pset_obj_track_times(properties, false);
    H5Pset_chunk(properties, rank, column.chunk);
    H5Pset_fill_value(properties, type, fill);
    column.set = check_id(store, H5Dcreate2(parent, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    H5Pclose(properties);
    H5Sclose(space);
    return column;
}

// Returns true if the sizes of an existing column are plausible, apart from the number of rows. The file of a stranger
// can claim any sizes, which would then be read. In petri's files, every frame has a step, and the longest row is
// stored.
static bool is_plausible(const StoreColumn *column, hid_t properties) {
    // Maxima: values in a chunk, components of a vector if there are no particles, compression ratio of deflate.
    enum { MAX_CHUNK = 1 << 22, MAX_EMPTY = 1 << 20, MAX_RATIO = 1032 };
    hsize_t stored = H5Dget_storage_size(column->set) / sizeof(double), chunk = 1;
    stored *= H5Pget_nfilters(properties) > 0 ? MAX_RATIO : 1;
    for (int k = 0; k < column->rank; k++) {
        bool rows = k == 0 && column->rank > 1, empty = k == 2 && column->sizes[1] == 0;
        if ((!rows && column->sizes[k] > (empty ? MAX_EMPTY : stored)) || column->chunk[k] > MAX_CHUNK / chunk)
            return false;
        chunk *= column->chunk[k];
    }
    return true;
}

StoreColumn store_open_column(Store *store, hid_t parent, const char *name, hid_t type, int rank, const void *fill) {
    StoreColumn column = {.parent = parent, .name = name, .type = type, .fill = fill, .rank = rank};
    column.set = check_id(store, H5Dopen2(parent, name, H5P_DEFAULT));
    hid_t space = check_id(store, H5Dget_space(column.set)),
          properties = check_id(store, H5Dget_create_plist(column.set));
    if (H5Sget_simple_extent_ndims(space) != rank || H5Pget_chunk(properties, rank, column.chunk) != rank)
        store->failed = true;
    else
        H5Sget_simple_extent_dims(space, column.sizes, NULL);
    if (store->failed || !is_plausible(&column, properties)) {
        memset(column.sizes, 0, sizeof column.sizes);
        store->failed = true;
    }
    H5Sclose(space);
    H5Pclose(properties);
    return column;
}

void store_truncate(Store *store, StoreColumn *column, const hsize_t sizes[STORE_RANKS]) {
    memcpy(column->sizes, sizes, sizeof column->sizes);
    store_check(store, H5Dset_extent(column->set, sizes));
}

void store_grow(Store *store, StoreColumn *column, const hsize_t sizes[STORE_RANKS]) {
    bool grows = false;
    for (int k = 0; k < column->rank; k++) {
        grows = grows || sizes[k] > column->sizes[k];
        column->sizes[k] = sizes[k] > column->sizes[k] ? sizes[k] : column->sizes[k];
    }
    if (grows)
        store_check(store, H5Dset_extent(column->set, column->sizes));
}

// Reads the first elements of a row into `out`. If `out` is NULL, writes the first elements from `in` to the row.
// `sizes` is the number of these elements in each dimension.
static void move_row(Store *store, const StoreColumn *column, hsize_t row, const hsize_t sizes[STORE_RANKS], void *out,
                     const void *in) {
    hsize_t start[STORE_RANKS] = {row}, count[STORE_RANKS] = {1};
    for (int k = 1; k < column->rank; k++)
        count[k] = sizes[k];
    hid_t file = H5Dget_space(column->set), memory = H5Screate_simple(column->rank, count, NULL);
    store_check(store, H5Sselect_hyperslab(file, H5S_SELECT_SET, start, NULL, count, NULL));
    store_check(store, !out ? H5Dwrite(column->set, column->type, memory, file, H5P_DEFAULT, in)
                            : H5Dread(column->set, column->type, memory, file, H5P_DEFAULT, out));
    H5Sclose(file);
    H5Sclose(memory);
}

void store_read_row(Store *store, const StoreColumn *column, hsize_t row, const hsize_t sizes[STORE_RANKS],
                    void *numbers) {
    move_row(store, column, row, sizes, numbers, NULL);
}

// Copies a column to a new column with larger chunks, because its rows have become much longer. With small chunks, each
// row would be split into too many chunks.
static void recreate_column(Store *store, StoreColumn *column, const hsize_t sizes[STORE_RANKS]) {
    StoreColumn old = *column;
    store_check(store, H5Ldelete(old.parent, old.name, H5P_DEFAULT)); // old.set stays readable until it is closed
    *column = store_column(store, old.parent, old.name, old.type, old.rank, sizes, old.fill);
    store_grow(store, column, old.sizes);
    hsize_t numbers = old.rank > 2 ? old.sizes[1] * old.sizes[2] : old.sizes[1];
    double *row = memory_calloc(numbers * sizeof *row);
    for (hsize_t i = 0; i < old.sizes[0] && numbers > 0; i++) {
        move_row(store, &old, i, old.sizes, row, NULL);
        move_row(store, column, i, old.sizes, NULL, row);
    }
    free(row);
    H5Dclose(old.set);
}

void store_write_row(Store *store, StoreColumn *column, hsize_t row, const hsize_t sizes[STORE_RANKS],
                     const void *numbers) {
    enum { MAX_CHUNKS = 8 };
    if (column->rank > 1 && column->chunk[0] > 1 && sizes[1] > MAX_CHUNKS * column->chunk[1])
        recreate_column(store, column, sizes);
    hsize_t whole[STORE_RANKS] = {row + 1};
    bool empty = false;
    for (int k = 1; k < column->rank; k++) {
        whole[k] = sizes[k];
        empty = empty || sizes[k] == 0;
    }
    store_grow(store, column, whole);
    if (!empty)
        move_row(store, column, row, sizes, NULL, numbers);
}

hid_t store_array(Store *store, hid_t parent, const char *name, hid_t type, int rank, const hsize_t *sizes,
                  const void *array) {
    hid_t space = H5Screate_simple(rank, sizes, NULL), properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_obj_track_times(properties, false);
    hid_t set = check_id(store, H5Dcreate2(parent, name, type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
    store_check(store, H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, array));
    H5Pclose(properties);
    H5Sclose(space);
    return set;
}

void store_list(Store *store, hid_t parent, const char *name, hid_t type, hsize_t count, const void *list) {
    H5Dclose(store_array(store, parent, name, type, 1, &count, list));
    H5Tclose(type);
}

void store_text_list(Store *store, hid_t parent, const char *name, const char *texts, hsize_t count) {
    size_t max_length = 0;
    const char *text = texts;
    for (hsize_t i = 0; i < count; i++, text += strlen(text) + 1)
        max_length = strlen(text) > max_length ? strlen(text) : max_length;
    char *all = memory_calloc(count * (max_length + 1));
    text = texts;
    for (hsize_t i = 0; i < count; i++, text += strlen(text) + 1)
        memcpy(all + i * (max_length + 1), text, strlen(text) + 1);
    store_list(store, parent, name, store_text_type(max_length), count, all);
    free(all);
}

void store_link(Store *store, hid_t from, const char *old, hid_t to, const char *name) {
    store_check(store, H5Lcreate_hard(from, old, to, name, H5P_DEFAULT, H5P_DEFAULT));
}

hid_t store_open(Store *store, hid_t parent, const char *name) {
    return check_id(store, H5Gopen2(parent, name, H5P_DEFAULT));
}

// Reads `count` strings of fixed length from a data set, or from an attribute if `set` is negative. Sets *bytes to the
// size of each string with its NUL. Closes `type`. After an error, returns an empty string.
static char *read_fixed(Store *store, hid_t type, size_t count, hid_t attribute, hid_t set, size_t *bytes) {
    *bytes = H5Tget_size(type) + 1;
    hid_t memory = store_text_type(*bytes - 1);
    bool good = !store->failed && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0 &&
                count < SIZE_MAX / *bytes;
    char *texts = memory_calloc(good ? count * *bytes + 1 : 1);
    if (!good) {
        store->failed = true;
    } else {
        store_check(store, set < 0 ? H5Aread(attribute, memory, texts)
                                   : H5Dread(set, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts));
    }
    H5Tclose(memory);
    H5Tclose(type);
    return texts;
}

// Opens an attribute, which must have one value.
static hid_t open_attribute(Store *store, hid_t object, const char *name) {
    hid_t attribute = check_id(store, H5Aopen(object, name, H5P_DEFAULT));
    hid_t space = check_id(store, H5Aget_space(attribute));
    store->failed = store->failed || H5Sget_simple_extent_npoints(space) != 1;
    H5Sclose(space);
    return attribute;
}

char *store_read_text(Store *store, hid_t object, const char *name) {
    size_t bytes = 0;
    hid_t attribute = open_attribute(store, object, name);
    char *text = read_fixed(store, H5Aget_type(attribute), 1, attribute, -1, &bytes);
    H5Aclose(attribute);
    return text;
}

int store_read_number(Store *store, hid_t object, const char *name) {
    int number = 0;
    hid_t attribute = open_attribute(store, object, name);
    if (!store->failed)
        store_check(store, H5Aread(attribute, H5T_NATIVE_INT, &number));
    H5Aclose(attribute);
    return number;
}

bool store_name_at(Store *store, hid_t group, hsize_t number, Text *name) {
    H5G_info_t info = {0};
    store_check(store, H5Gget_info(group, &info));
    if (store->failed || number >= info.nlinks)
        return false;
    ssize_t length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, number, NULL, 0, H5P_DEFAULT);
    store_check(store, length);
    if (length >= 0) {
        SCOPED_STRING text = memory_calloc((size_t)length + 1);
        H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, number, text, (size_t)length + 1, H5P_DEFAULT);
        name->len = 0;
        text_add(name, (Str){text, (size_t)length});
    }
    return length >= 0;
}

char *store_read_texts(Store *store, hid_t parent, const char *name, size_t *count, size_t *bytes) {
    hid_t set = check_id(store, H5Dopen2(parent, name, H5P_DEFAULT)), space = check_id(store, H5Dget_space(set));
    hid_t type = check_id(store, H5Dget_type(set));
    hssize_t found = H5Sget_simple_extent_npoints(space);
    *count = found < 0 ? 0 : (size_t)found;
    // Files of strangers can claim any number of strings.
    store->failed = store->failed || *count > H5Dget_storage_size(set) / H5Tget_size(type);
    char *texts = read_fixed(store, type, *count, -1, set, bytes);
    H5Sclose(space);
    H5Dclose(set);
    return texts;
}
