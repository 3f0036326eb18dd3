// info.c: functions that do not depend on a session: allocator, version, texts of statuses, built-ins, and kinds of
// nodes with their attributes.
#include "ast/literal.h"
#include "base/heap.h"
#include "session/session.h"

PetriStatus petri_set_allocator(const PetriAllocator *given) {
    PetriAllocator allocator = {0};
    if (!given)
        return heap_set_allocator(NULL) ? PETRI_OK : PETRI_INVALID;
    if (!host_struct_read(&allocator, sizeof allocator, given) || !allocator.allocate || !allocator.resize ||
        !allocator.release)
        return PETRI_INVALID;
    HeapAllocator source = {allocator.allocate, allocator.resize, allocator.release, allocator.user_data};
    return heap_set_allocator(&source) ? PETRI_OK : PETRI_INVALID;
}

bool petri_builtin(size_t index, PetriBuiltin *builtin, size_t size) {
    if (index >= builtin_table_count)
        return false;
    const Builtin *row = &builtin_table[index];
    const PetriBuiltin found = {row->name, row->parameters, row->help};
    return host_struct_write(builtin, size, &found, sizeof found);
}

bool petri_parse_number(const char *text, double *x) {
    return text && x && (literal_parse_number(str_from(text), x) || literal_parse_timecode(str_from(text), x));
}

#define TEXT(x) #x
#define VERSION_TEXT(major, minor, patch) TEXT(major) "." TEXT(minor) "." TEXT(patch)

const char *petri_version(void) {
    return VERSION_TEXT(PETRI_VERSION_MAJOR, PETRI_VERSION_MINOR, PETRI_VERSION_PATCH);
}

int petri_version_number(void) {
    return PETRI_VERSION_NUMBER;
}

const char *petri_status_text(PetriStatus status) {
    static const char *const texts[] = {
        [PETRI_OK] = "success",
        [PETRI_INVALID] = "invalid argument",
        [PETRI_LIMIT_EXCEEDED] = "limit exceeded",
        [PETRI_OUT_OF_MEMORY] = "out of memory",
        [PETRI_UNSUPPORTED] = "not supported by this build",
        [PETRI_INTERRUPTED] = "interrupted",
    };
    return (unsigned)status < sizeof texts / sizeof texts[0] ? texts[status] : "unknown status";
}

bool petri_node_kind(size_t number, PetriNodeKind *out, size_t size) {
    if (number >= KIND_COUNT)
        return false;
    const KindRow *kind = &schema_kinds[number];
    bool solid = number == KIND_CANVAS3D || kind->place == PLACE_SCENE3D;
    const PetriNodeKind found = {kind->name,
                                 kind->place < PLACE_TOP ? "physics"
                                 : solid                 ? "canvas3d"
                                                         : "canvas",
                                 kind->help, schema_formula((NodeKind)number)};
    return host_struct_write(out, size, &found, sizeof found);
}

bool petri_node_attribute(size_t kind, size_t number, PetriNodeAttribute *out, size_t size) {
    for (size_t i = 0; i < ROW_COUNT; i++) {
        const SchemaRow *row = &schema_rows[i];
        if (row->kind != kind || number-- > 0)
            continue;
        const PetriNodeAttribute found = {schema_names[row->name], schema_types[row->type].text,
                                          row->default_value.text, row->help, row->unit};
        return host_struct_write(out, size, &found, sizeof found);
    }
    return false;
}
