// builtin.c: the table of built-ins, argument matching, and predefined constants; see builtin.h.
//
// The table is sorted by name. Arguments in the order of the parameters are passed on as they are; only named or
// missing arguments are matched and copied (call_matched).
#include "builtin/builtin.h"

#include "builtin/family.h"

#include <math.h>
#include <string.h>

// The flags of builtin_list.h.
enum { PLAIN = 0, NAMED = 1, VARIADIC = 2, IMPURE = 4 };

const Builtin builtin_table[] = {
#define BUILTIN(name, parameters, required, fixed, flags, each, help)                                                  \
    {#name,                                                                                                            \
     builtin_##name,                                                                                                   \
     parameters,                                                                                                       \
     required,                                                                                                         \
     fixed,                                                                                                            \
     ((flags)&VARIADIC) != 0,                                                                                          \
     ((flags)&NAMED) != 0,                                                                                             \
     ((flags)&IMPURE) == 0,                                                                                            \
     each,                                                                                                             \
     help},
#include "builtin/builtin_list.h"
#undef BUILTIN
};
const uint32_t builtin_table_count = sizeof builtin_table / sizeof builtin_table[0];

// Maximum number of parameters before "..." in builtin_list.h; a test checks it.
enum { MAX_FIXED = 8 };

const Builtin *builtin_find(Str name) {
    uint32_t low = 0, high = builtin_table_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        int order = str_compare(str_from(builtin_table[middle].name), name);
        if (order == 0)
            return &builtin_table[middle];
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return NULL;
}

// Returns the name of parameter i, which must exist, from a string such as "xs, ys=0".
static Str parameter_name(const Builtin *builtin, uint32_t i) {
    const char *at = builtin->parameters;
    while (i-- > 0)
        at = strchr(at, ',') + 2;
    return (Str){at, strcspn(at, ",=")};
}

// Returns the index of the parameter called `name`, or builtin->fixed if there is none.
static uint32_t parameter_find(const Builtin *builtin, Str name) {
    uint32_t i = 0;
    while (i < builtin->fixed && !str_equal(parameter_name(builtin, i), name))
        i++;
    return i;
}

static Value bad_count(BuiltinContext *context, const Builtin *builtin, uint32_t count) {
    return builtin_error(context, builtin->name, "%s arguments: %u given to %s(%s)",
                         count < builtin->required ? "too few" : "too many", count, builtin->name, builtin->parameters);
}

static Value bad_name(BuiltinContext *context, const Builtin *builtin, const char *what, Str name) {
    return builtin_error(context, builtin->name, "%s '%.*s' for %s(%s)", what, name.len < 100 ? (int)name.len : 100,
                         name.bytes, builtin->name, builtin->parameters);
}

// Calls a built-in with named or missing arguments: first stores the arguments in the order of the parameters.
static Value call_matched(BuiltinContext *context, const Builtin *builtin, const Value *args, uint32_t count,
                          const Symbol *const *names, const Value *named, uint32_t named_count) {
    Value all[MAX_FIXED];
    for (uint32_t i = 0; i < builtin->fixed; i++)
        all[i] = i < count ? args[i] : (Value){.kind = VALUE_ABSENT};
    for (uint32_t k = 0; k < named_count; k++) {
        uint32_t i = builtin->named ? parameter_find(builtin, names[k]->name) : builtin->fixed;
        if (i == builtin->fixed)
            return bad_name(context, builtin, "unknown argument", names[k]->name);
        if (!is_absent(all[i]))
            return bad_name(context, builtin, "repeated argument", names[k]->name);
        all[i] = named[k];
    }
    for (uint32_t i = 0; i < builtin->required; i++)
        if (is_absent(all[i]))
            return named_count ? bad_name(context, builtin, "missing argument", parameter_name(builtin, i))
                               : bad_count(context, builtin, count);
    return builtin->call(context, all, builtin->fixed);
}

Value builtin_call(BuiltinContext *context, const Builtin *builtin, const Value *args, uint32_t count,
                   const Symbol *const *names, const Value *named, uint32_t named_count) {
    context->called = builtin;
    if (count > builtin->fixed && !builtin->variadic)
        return bad_count(context, builtin, count);
    if (count >= builtin->fixed && named_count == 0)
        return builtin->call(context, args, count);
    return call_matched(context, builtin, args, count, names, named, named_count);
}

bool builtin_constant(Str name, Value *value) {
    const struct {
        const char *name;
        Value value;
    } constants[] = {
        {"false", value_number(0)}, {"inf", value_number(INFINITY)},      {"nan", value_number(NAN)},
        {"null", VALUE_NULL},       {"pi", value_number(BUILTIN_PI)},     {"tau", value_number(BUILTIN_TAU)},
        {"true", value_number(1)},  {"\u03c0", value_number(BUILTIN_PI)}, {"\U0001d70f", value_number(BUILTIN_TAU)},
    };
    for (size_t i = 0; i < sizeof constants / sizeof constants[0]; i++)
        if (str_equal(name, str_from(constants[i].name))) {
            *value = constants[i].value;
            return true;
        }
    return false;
}
