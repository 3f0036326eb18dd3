// scale.c: see scale.h.
//
// Written without the library libhdf5_hl, whose name and location differ between systems. Data sets and scales refer to
// each other. scale_attach writes the references to the scales and collects those from the scales, which scale_end
// writes.
#include "hdf5/scale.h"

#include <stdlib.h>
#include <string.h>

static const char LIST[] = "DIMENSION_LIST", USES[] = "REFERENCE_LIST", CLASS[] = "CLASS", NAME[] = "NAME";

Scale scale_begin(Store *store, hid_t set, const char *name) {
    store_text(store, set, CLASS, "DIMENSION_SCALE");
    store_text(store, set, NAME, name);
    return (Scale){.set = set};
}

Scale scale_count(Store *store, hid_t parent, const char *name, hsize_t count) {
    int64_t *numbers = memory_calloc((count + 1) * sizeof *numbers);
    for (hsize_t i = 0; i < count; i++)
        numbers[i] = (int64_t)i;
    hid_t set = store_array(store, parent, name, H5T_NATIVE_INT64, 1, &count, numbers);
    free(numbers);
    return scale_begin(store, set, name);
}

// Adds an attribute that is an array. Closes `type`.
static void add_list(Store *store, hid_t object, const char *name, hid_t type, hsize_t count, const void *list) {
    store_attribute(store, object, name, type, H5Screate_simple(1, &count, NULL), list);
    H5Tclose(type);
}

void scale_attach(Store *store, hid_t set, int rank, Scale *const scales[]) {
    hobj_ref_t references[H5S_MAX_RANK];
    hvl_t lists[H5S_MAX_RANK];
    for (int k = 0; k < rank; k++) {
        Scale *scale = scales[k];
        scale->uses = memory_realloc(scale->uses, (scale->use_count + 1) * sizeof *scale->uses);
        ScaleUse *use = &scale->uses[scale->use_count++];
        memset(use, 0, sizeof *use); // the file contains the padding
        use->dimension = k;
        store_check(store, H5Rcreate(&use->set, set, ".", H5R_OBJECT, -1));
        store_check(store, H5Rcreate(&references[k], scale->set, ".", H5R_OBJECT, -1));
        lists[k] = (hvl_t){.len = 1, .p = &references[k]};
    }
    add_list(store, set, LIST, H5Tvlen_create(H5T_STD_REF_OBJ), (hsize_t)rank, lists);
}

void scale_end(Store *store, Scale *scale) {
    hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(ScaleUse));
    H5Tinsert(type, "dataset", HOFFSET(ScaleUse, set), H5T_STD_REF_OBJ);
    H5Tinsert(type, "dimension", HOFFSET(ScaleUse, dimension), H5T_NATIVE_INT);
    add_list(store, scale->set, USES, type, scale->use_count, scale->uses);
    free(scale->uses);
}

void scale_remove(Store *store, hid_t set) {
    const char *const names[] = {LIST, USES, CLASS, NAME};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (H5Aexists(set, names[i]) > 0)
            store_check(store, H5Adelete(set, names[i]));
}
