// store.h: an HDF5 file that is being written.
//
// The file gets its name when it is complete (base/replace.h). Functions do not return errors: the first error is
// recorded and reported by store_end.
#pragma once

#include "base/replace.h"
#include "cli/memory.h"

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Store {
    const char *path;
    Replacement replacement;
    hid_t file;
    bool existing; // true if an existing file is extended
    bool failed;   // true if an error has occurred
    bool reported; // true if a message about the error was printed
    int cause;     // errno of the error; 0: unknown
} Store;

enum { STORE_RANKS = 3 }; // maximum number of dimensions of a column

// A data set of eight-byte values that grows in all dimensions. The first dimension counts rows.
typedef struct StoreColumn {
    hid_t parent;
    const char *name;
    hid_t type;       // type in memory and in the file
    const void *fill; // value of elements that were not written
    hid_t set;
    int rank;
    hsize_t sizes[STORE_RANKS];
    hsize_t chunk[STORE_RANKS]; // chunk sizes in the file
} StoreColumn;

// Starts writing the file `path`. If `continues` is true and the file exists, the new file starts with the contents of
// the existing file, and store->existing is set.
// Returns false after a message.
bool store_begin(Store *store, const char *path, bool continues);
// Gives the file its name if `keep` is true, else removes it. Returns false after a message if an error has occurred.
bool store_end(Store *store, bool keep);
// Records an error if `result`, the return value of a libhdf5 function, is negative.
void store_check(Store *store, int64_t result);

// Creates a group. It stays open until store_end.
hid_t store_group(Store *store, hid_t parent, const char *name);
// Adds an attribute. Closes `space`.
void store_attribute(Store *store, hid_t object, const char *name, hid_t type, hid_t space, const void *value);
// Adds a string attribute.
void store_text(Store *store, hid_t object, const char *name, const char *text);
// Adds an attribute: an array of `count` copies of a string.
void store_texts(Store *store, hid_t object, const char *name, const char *text, hsize_t count);
// Adds an integer attribute: an array or, if `count` is 1, a scalar.
void store_numbers(Store *store, hid_t object, const char *name, const int *numbers, hsize_t count);
// Creates an empty column. `sizes` are the expected sizes of a row; sizes[0] is ignored. The column keeps the pointers
// `name` and `fill`.
StoreColumn store_column(Store *store, hid_t parent, const char *name, hid_t type, int rank,
                         const hsize_t sizes[STORE_RANKS], const void *fill);
// Opens a column that store_column created. `parent` must stay open until store_end.
StoreColumn store_open_column(Store *store, hid_t parent, const char *name, hid_t type, int rank, const void *fill);
// Reduces a column to `sizes`.
void store_truncate(Store *store, StoreColumn *column, const hsize_t sizes[STORE_RANKS]);
// Reads the first elements of a row into `numbers`. `sizes` is the number of elements to read in each dimension.
void store_read_row(Store *store, const StoreColumn *column, hsize_t row, const hsize_t sizes[STORE_RANKS],
                    void *numbers);
// Extends a column to at least `sizes`.
void store_grow(Store *store, StoreColumn *column, const hsize_t sizes[STORE_RANKS]);
// Writes `numbers` to the first elements of a row and extends the column if necessary.
void store_write_row(Store *store, StoreColumn *column, hsize_t row, const hsize_t sizes[STORE_RANKS],
                     const void *numbers);
// Returns a string type for up to `length` bytes.
hid_t store_text_type(size_t length);
// Writes an array with `rank` dimensions as a data set, which stays open until store_end.
hid_t store_array(Store *store, hid_t parent, const char *name, hid_t type, int rank, const hsize_t *sizes,
                  const void *array);
// Writes an array with one dimension as a data set. Closes `type`.
void store_list(Store *store, hid_t parent, const char *name, hid_t type, hsize_t count, const void *list);
// Writes an array of strings as a data set. `texts` contains the NUL-terminated strings one after the other.
void store_text_list(Store *store, hid_t parent, const char *name, const char *texts, hsize_t count);
// Opens a group. It stays open until store_end.
hid_t store_open(Store *store, hid_t parent, const char *name);
// Returns the value of a string attribute. The caller frees it.
char *store_read_text(Store *store, hid_t object, const char *name);
// Returns the value of an integer attribute.
int store_read_number(Store *store, hid_t object, const char *name);
// Sets `name` to the name of the group's member `number`, from 0. Returns false if there is no such member.
bool store_name_at(Store *store, hid_t group, hsize_t number, Text *name);
// Reads a data set of strings. Returns an array of *count strings of *bytes bytes each. The caller frees it.
char *store_read_texts(Store *store, hid_t parent, const char *name, size_t *count, size_t *bytes);
// Gives the object called `old` in the group `from` the additional name `name` in the group `to` (a hard link).
void store_link(Store *store, hid_t from, const char *old, hid_t to, const char *name);
