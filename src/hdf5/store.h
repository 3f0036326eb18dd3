// store.h: a file of HDF5 that is being written.
//
// It takes its name when it is complete (base/replace.h). Of what fails, the first is kept, and store_end tells it.
#ifndef PETRI_SRC_STORE_H
#define PETRI_SRC_STORE_H

#include "base/replace.h"
#include "cli/byte_buffer.h"

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct Store {
    const char *path;
    Replacement replacement;
    hid_t file;
    bool existing; // there was a file, and it is to be lengthened
    bool failed;
    bool reported; // why
    int cause;     // errno, if it is known; else 0
} Store;

enum { STORE_RANKS = 3 };

// Numbers of eight bytes in rows, which grows.
typedef struct StoreColumn {
    hid_t parent;
    const char *name;
    hid_t type; // in memory and in the file
    const void *fill;
    hid_t set;
    int rank;
    hsize_t sizes[STORE_RANKS];
    hsize_t chunk[STORE_RANKS]; // in which it lies in the file
} StoreColumn;

// With `goes_on` it begins with what the file holds, if there is one (`old`). False after a message.
bool store_begin(Store *store, const char *path, bool continues);
// Puts the file in its place, or drops it. False after a message if something has failed.
bool store_end(Store *store, bool keep);
// `result` is negative if something has failed.
void store_check(Store *store, int64_t result);

// What is made is open until the end.
hid_t store_group(Store *store, hid_t parent, const char *name);
// Attributes: a text; a list that has it `count` times; whole numbers, of which one is no list.
void store_text(Store *store, hid_t object, const char *name, const char *text);
void store_texts(Store *store, hid_t object, const char *name, const char *text, hsize_t count);
void store_numbers(Store *store, hid_t object, const char *name, const int *numbers, hsize_t count);
// An empty one whose rows will mostly have these sizes, the first of which is not looked at. Where nothing is written
// later, there is `fill`. It keeps `name` and `fill`.
StoreColumn store_column(Store *store, hid_t parent, const char *name, hid_t type, int rank,
                         const hsize_t sizes[STORE_RANKS], const void *fill);
// One that is there, made by store_column. `parent` is open until the end.
StoreColumn store_open_column(Store *store, hid_t parent, const char *name, hid_t type, int rank, const void *fill);
// Drops what is beyond these sizes.
void store_truncate(Store *store, StoreColumn *column, const hsize_t sizes[STORE_RANKS]);
// Reads the beginning of a row.
void store_read_row(Store *store, const StoreColumn *column, hsize_t row, const hsize_t sizes[STORE_RANKS],
                    void *numbers);
// Makes it at least as large.
void store_grow(Store *store, StoreColumn *column, const hsize_t sizes[STORE_RANKS]);
// Writes the beginning of a row; the column grows to hold it.
void store_write_row(Store *store, StoreColumn *column, hsize_t row, const hsize_t sizes[STORE_RANKS],
                     const void *numbers);
// The type of texts up to this length.
hid_t store_text_type(size_t length);
// A list that is there as a whole. Closes the type.
void store_list(Store *store, hid_t parent, const char *name, hid_t type, hsize_t count, const void *list);
// One of texts, which are one after the other, each ended by NUL.
void store_text_list(Store *store, hid_t parent, const char *name, const char *texts, hsize_t count);
// What is there: a group; a text, to be freed, or a whole number that is an attribute; the name of a member by number
// from 0, false beyond the last; a list of texts, each in so many bytes, to be freed.
hid_t store_open(Store *store, hid_t parent, const char *name);
char *store_read_text(Store *store, hid_t object, const char *name);
int store_read_number(Store *store, hid_t object, const char *name);
bool store_name_at(Store *store, hid_t group, hsize_t number, ByteBuffer *name);
char *store_read_texts(Store *store, hid_t parent, const char *name, size_t *count, size_t *bytes);
// A second name for what is there.
void store_link(Store *store, hid_t from, const char *old, hid_t to, const char *name);

#endif
