// table.h: the functions of maths.h as a table, which libpetri.so exports under one name.
#pragma once

#include "base/private_api.h"
#include "maths/fast.h"

#define FIELD_ONE(name) double (*name)(double x);
#define FIELD_TWO(name) double (*name)(double x, double y);
typedef struct MathsTable {
    MATHS_FUNCTIONS(FIELD_ONE, FIELD_TWO)
    double (*hypot)(double x, double y);
} MathsTable;
#undef FIELD_ONE
#undef FIELD_TWO

extern const MathsTable maths_table PRIVATE_API(maths_table);
