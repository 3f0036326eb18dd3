// reader_internal.h: functions shared by reader.c, drawing_reader.c and reports.c.
#pragma once

#include "schema/reader.h"

// Reports an attribute that the kind does not have.
void reader_report_unknown(const Reader *reader, const Symbol *name);
// Reports "attribute should be …, not …".
void reader_report_shape(const Reader *reader, const SchemaRow *row, Value found);
// Reports an attribute of a drawing node that petri accepts but ignores. Does nothing for other attributes.
void reader_report_ignored(const Reader *reader, const SchemaRow *row);
// Reports "attribute=value …" for a value that is valid but unlikely to be intended.
void reader_report_lint(const Reader *reader, const char *code, const SchemaRow *row, Value v, const char *text);

static inline bool is_in_window(PlaceKind place) {
    return place >= PLACE_TOP;
}

// Returns the slot of an attribute, or `end` if there is none. Searches from `guess`, the slot after that of the
// previous attribute, and then from `first`.
static inline const SchemaSlot *reader_find_slot(const SchemaSlot *first, const SchemaSlot *end,
                                                 const SchemaSlot *guess, const Symbol *name) {
    for (const SchemaSlot *slot = guess; slot < end; slot++)
        if (slot->name == name)
            return slot;
    for (const SchemaSlot *slot = first; slot < guess; slot++)
        if (slot->name == name)
            return slot;
    return end;
}
