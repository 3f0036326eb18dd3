// fuzz_h5md.c: fuzzes H5MD files that a run continues. The input is a list of changes to a valid file, each of four
// bytes: kind, object, and two operands. libhdf5 itself makes the changes, so that the file is always valid HDF5 and
// libhdf5's own parser is not fuzzed. petri-hdf5 then continues the file.
#include "base/file.h"
#include "cli/cli.h"
#include "cli/hdf5.h"
#include "fuzz.h"
#include "hdf5/trajectory.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const OBJECTS[] = {
    "particles",
    "particles/s",
    "particles/s/box",
    "particles/s/box/edges",
    "particles/s/box/edges/value",
    "particles/s/position",
    "particles/s/position/value",
    "particles/s/position/step",
    "particles/s/position/time",
    "particles/s/id",
    "particles/s/id/value",
    "particles/s/anchor/value",
    "particles/s/species",
    "parameters",
    "parameters/id_texts",
    "particles/new",
};
enum { OBJECT_COUNT = sizeof OBJECTS / sizeof *OBJECTS };
static const hsize_t SIZES[] = {0, 1, 2, 3, 5, 100, 70000, (hsize_t)1 << 31, (hsize_t)1 << 40, (hsize_t)1 << 60};

static hsize_t size_of(unsigned operand) {
    return SIZES[operand % (sizeof SIZES / sizeof *SIZES)];
}

// Returns a type that the caller closes.
static hid_t make_type(unsigned operand) {
    const hid_t types[] = {H5T_NATIVE_INT64, H5T_NATIVE_DOUBLE, H5T_NATIVE_INT, H5T_NATIVE_FLOAT, H5T_NATIVE_UCHAR};
    hid_t type;
    switch (operand % 8) {
    case 5:
        return store_text_type(operand / 8);
    case 6:
        type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, H5T_VARIABLE);
        return type;
    case 7:
        type = H5Tcreate(H5T_COMPOUND, 8);
        H5Tinsert(type, "x", 0, H5T_NATIVE_INT64);
        return type;
    default:
        return H5Tcopy(types[operand % 8]);
    }
}

// Returns a space with up to four dimensions.
static hid_t make_space(unsigned operand, bool growing) {
    const hsize_t size = size_of(operand / 5), limits[4] = {H5S_UNLIMITED, H5S_UNLIMITED, H5S_UNLIMITED, H5S_UNLIMITED};
    const hsize_t sizes[4] = {size, size < 4 ? size : 3, 2, 1};
    int rank = (int)(operand % 5);
    return rank == 0 ? H5Screate(H5S_SCALAR) : H5Screate_simple(rank, sizes, growing ? limits : NULL);
}

static void replace_data(hid_t file, const char *name, unsigned first, unsigned second) {
    static const hsize_t chunk[4] = {16, 2, 2, 1};
    int rank = (int)(second % 5);
    hid_t type = make_type(first), space = make_space(second, rank > 0), how = H5Pcreate(H5P_DATASET_CREATE);
    if (rank > 0)
        H5Pset_chunk(how, rank, chunk);
    H5Ldelete(file, name, H5P_DEFAULT);
    hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, how, H5P_DEFAULT);
    H5Dclose(set);
    H5Pclose(how);
    H5Sclose(space);
    H5Tclose(type);
}

static void replace_attribute(hid_t file, const char *name, unsigned first, unsigned second) {
    static const char zeros[1 << 16];
    const char *attribute = first & 128 ? "system" : "dimension";
    hid_t object = H5Oopen(file, name, H5P_DEFAULT);
    hid_t type = make_type(first & 127), space = make_space(second, false);
    H5Adelete(object, attribute);
    hid_t attribute_id = H5Acreate2(object, attribute, type, space, H5P_DEFAULT, H5P_DEFAULT);
    if (attribute_id >= 0 && (first & 7) < 6 &&
        (size_t)H5Sget_simple_extent_npoints(space) < sizeof zeros / H5Tget_size(type))
        H5Awrite(attribute_id, type, zeros);
    H5Aclose(attribute_id);
    H5Sclose(space);
    H5Tclose(type);
    H5Oclose(object);
}

// Returns true if libhdf5 can change the set in a short time. It takes hours to shrink larger ones, and it may read
// from a null pointer when it writes to them (1.10.8).
static bool is_small(hid_t space) {
    hsize_t sizes[H5S_MAX_RANK] = {0};
    bool small = H5Sget_simple_extent_dims(space, sizes, NULL) >= 0;
    hsize_t count = 1;
    for (int k = 0; k < 4 && small; k++) {
        count *= sizes[k] > 0 ? sizes[k] : 1;
        small = sizes[k] < 1 << 20 && count < 1 << 20;
    }
    return small;
}

static void write_value(hid_t file, const char *name, unsigned first, unsigned second) {
    static const int64_t values[] = {0, 1, -1, -2, -3, -4, INT64_MIN, INT64_MAX};
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
    hsize_t start[4] = {first % 4, first / 4 % 4}, count[4] = {1, 1, 1, 1};
    hid_t memory = H5Screate(H5S_SCALAR);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, NULL, count, NULL);
    if (is_small(space))
        H5Dwrite(set, H5T_NATIVE_INT64, memory, space, H5P_DEFAULT, &values[second % 8]);
    H5Sclose(memory);
    H5Sclose(space);
    H5Dclose(set);
}

static void resize_data(hid_t file, const char *name, unsigned first, unsigned second) {
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
    const hsize_t sizes[4] = {size_of(first), size_of(second), size_of(second / 16), 1};
    if (is_small(space))
        H5Dset_extent(set, sizes);
    H5Sclose(space);
    H5Dclose(set);
}

static void change_file(hid_t file, const uint8_t *change) {
    const char *name = OBJECTS[change[1] % OBJECT_COUNT], *other = OBJECTS[change[2] % OBJECT_COUNT];
    switch (change[0] % 8) {
    case 0:
        H5Ldelete(file, name, H5P_DEFAULT);
        break;
    case 1:
        H5Ldelete(file, name, H5P_DEFAULT);
        H5Gclose(H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        break;
    case 2:
        replace_data(file, name, change[2], change[3]);
        break;
    case 3:
        replace_attribute(file, name, change[2], change[3]);
        break;
    case 4:
        write_value(file, name, change[2], change[3]);
        break;
    case 5:
        resize_data(file, name, change[2], change[3]);
        break;
    case 6:
        H5Ldelete(file, name, H5P_DEFAULT);
        H5Lcreate_hard(file, other, file, name, H5P_DEFAULT, H5P_DEFAULT);
        break;
    default:
        H5Ldelete(file, name, H5P_DEFAULT);
        H5Lcreate_soft(other, file, name, H5P_DEFAULT, H5P_DEFAULT);
    }
}

// A frame with two particles, one of which has a string as its id.
typedef struct SmallFrame {
    Hdf5Frame frame;
    char texts[8];
    Hdf5System system;
    char name[8];
    double numbers[2 * (2 + 2 + 3)];
    int64_t ids[2];
    int64_t anchors[2];
} SmallFrame;

static void add_frame(TrajectoryFile *file, int64_t number) {
    SmallFrame frame = {
        .frame = {number, 0.5, 8, number == 0, 1}, .texts = "a", .system = {2, 2, 8, 1.5, -2}, .name = ":s"};
    frame.ids[1] = -2;
    trajectory_file_add(file, (char *)&frame);
}

static void continue_file(const char *path, int64_t after) {
    Store store;
    TrajectoryFile file;
    if (!store_begin(&store, path, after >= 0))
        return;
    if (after < 0)
        trajectory_file_begin(&file, &store);
    if (after < 0 || trajectory_file_resume(&file, &store, after)) {
        trajectory_file_begin_run(&file);
        for (int64_t frame = 0; frame < 3; frame++)
            add_frame(&file, frame);
    }
    trajectory_file_end(&file);
    store_end(&store, true);
}

FUZZ_HARNESS(h5md) {
    static FuzzText base; // the valid file
    enum { CHANGE = 4, MAX_CHANGES = 16 };
    const char *path = fuzz_file("t.h5");
    if (base.length == 0) {
        SCOPED_TEXT bytes = {0};
        continue_file(path, -1);
        if (text_read_file(&bytes, path, SIZE_MAX))
            fuzz_fail("cannot read the valid file");
        fuzz_append(&base, bytes.bytes, bytes.len);
    }
    fuzz_put("t.h5", base.bytes, base.length);
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, H5P_DEFAULT);
    if (file < 0)
        fuzz_fail("cannot open the valid file");
    for (int i = 0; i < MAX_CHANGES && size >= CHANGE; i++, data += CHANGE, size -= CHANGE)
        change_file(file, data);
    H5Fclose(file);
    continue_file(path, size > 0 ? data[0] % 4 : 1);
    return 0;
}
