// record.c: stores attributes in the records of their kinds; see reader.h.
#include "schema/reader.h"

#include <math.h>
#include <string.h>

void schema_store(const AttrValue *attr, void *record) {
    // Size of the field for each shape that a record of a drawing node can have, or a number of a system.
    static const uint8_t sizes[] = {
        [SHAPE_NUMBER] = sizeof(double),
        [SHAPE_INTEGER] = sizeof(double),
        [SHAPE_TIME] = sizeof(double),
        [SHAPE_FINITE] = sizeof(double),
        [SHAPE_TRIPLE] = 3 * sizeof(double),
        [SHAPE_COLOR] = 4 * sizeof(double),
        [SHAPE_FLAG] = sizeof(bool),
        [SHAPE_TEXT] = sizeof(const char *),
        [SHAPE_WEIGHT] = sizeof(double),
        [SHAPE_WORD] = sizeof(int),
        [SHAPE_OTHER] = 0,
    };
    const SchemaRow *row = &schema_rows[attr->row];
    if (row->field != FIELD_NOWHERE)
        memcpy((char *)record + row->field, &attr->as, sizes[schema_types[row->type].shape]);
}

static void store_default(const SchemaRow *row, char *record) {
    const AttrDefault *attr_default = &row->default_value;
    void *field = record + row->field;
    AttrShape shape = schema_types[row->type].shape;
    double x = attr_default->value;
    AttrValue attr = {.row = (uint16_t)(row - schema_rows), .as.numbers = {x, x, x, 1}};
    if (shape == SHAPE_VALUE || shape == SHAPE_NUMBERS)
        *(Value *)field = isnan(x) ? VALUE_NULL : value_number(x);
    else if (shape == SHAPE_VECTOR || shape == SHAPE_NORMAL)
        *(PhysVector *)field = NULL;
    else if (shape == SHAPE_TEXT)
        attr.as.text = str_from(attr_default->string ? attr_default->string : "");
    else if (shape == SHAPE_WORD)
        attr.as.word = (int)x;
    else if (shape == SHAPE_FLAG)
        attr.as.flag = x != 0;
    schema_store(&attr, record);
}

void schema_defaults(NodeKind kind, void *record) {
    for (int i = 0; i < ROW_COUNT; i++)
        if (schema_rows[i].kind == kind && schema_rows[i].field != FIELD_NOWHERE)
            store_default(&schema_rows[i], record);
}
