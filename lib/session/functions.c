// functions.c: built-in functions of the host's own (petri_add_function).
#include "session/session.h"

#include <stdio.h>
#include <string.h>

typedef struct HostFunction {
    Builtin row; // first: the row of a call leads here
    PetriFunctionCall *call;
    void *host;
} HostFunction;

struct PetriCall {
    BuiltinContext *context;
    double *numbers; // for the result
    char fault[200];
};

double *petri_call_numbers(PetriCall *call, uint32_t count) {
    if (!call || count > VALUE_MAX_LEN)
        return NULL;
    call->numbers = arena_try_alloc(call->context->arena, (count + 1) * sizeof *call->numbers);
    return call->numbers;
}

void petri_call_fault(PetriCall *call, const char *text) {
    if (call && text)
        snprintf(call->fault, sizeof call->fault, "%.*s", STR_ARGS(str_cut(str_from(text), sizeof call->fault - 1)));
}

// Nothing may leave through the host's function: what takes memory is done before and after it.
static Value call_host(BuiltinContext *context, const Value *args, uint32_t count) {
    const HostFunction *function = (const HostFunction *)(const void *)context->called;
    PetriCall call = {.context = context};
    PetriValue *shown = arena_alloc_array(context->arena, count, sizeof *shown);
    for (uint32_t i = 0; i < count; i++)
        shown[i] = session_show(&args[i]);
    PetriValue result = function->call(&call, function->host, shown, count);
    Value taken;
    if (call.fault[0])
        return builtin_fault(context, function->row.name, "%s", call.fault);
    if (!session_take(context->arena, result, &taken))
        return builtin_fault(context, function->row.name, "the host's function gave no value");
    return result.numbers && result.numbers == call.numbers ? taken : value_copy(context->arena, taken);
}

// Reads "x, y=0, ..." into a row; false if it is none.
static bool read_parameters(Builtin *row) {
    enum { MOST = 8 };
    const char *at = row->parameters;
    while (*at && !row->variadic) {
        size_t name = strcspn(at, "=,"), whole = strcspn(at, ",");
        row->variadic = str_equal((Str){at, whole}, STR("..."));
        row->fixed += !row->variadic;
        if (!row->variadic && (!session_is_name((Str){at, name}) || row->fixed > MOST))
            return false;
        if (!row->variadic && name == whole && ++row->required < row->fixed)
            return false; // after one with a default
        at += whole;
        if (*at && (at[1] != ' ' || !at[2]))
            return false;
        at += *at ? 2 : 0;
    }
    row->named = row->fixed > 0;
    return !*at;
}

typedef struct Adding {
    const PetriFunction *given;
    bool good;
} Adding;

static void add_function(PetriSession *session, void *context) {
    Adding *adding = context;
    const PetriFunction *given = adding->given;
    HostFunctions *functions = &session->functions;
    Arena *arena = &session->arena;
    HostFunction *added = arena_alloc(arena, sizeof *added);
    const Builtin **rows = arena_alloc_array(arena, functions->count + 1, sizeof *rows);
    for (uint32_t i = 0; i < functions->count; i++) {
        rows[i] = functions->rows[i];
        if (strcmp(rows[i]->name, given->name) == 0)
            return;
    }
    *added = (HostFunction){.row = {.name = str_to_c(arena, str_from(given->name)),
                                    .call = call_host,
                                    .parameters = str_to_c(arena, str_from(given->parameters)),
                                    .pure = given->pure,
                                    .help = str_to_c(arena, str_from(given->help ? given->help : ""))},
                            .call = given->call,
                            .host = given->host};
    if (!read_parameters(&added->row))
        return;
    rows[functions->count] = &added->row;
    *functions = (HostFunctions){rows, functions->count + 1};
    adding->good = true;
}

PetriStatus petri_add_function(PetriSession *session, const PetriFunction *function) {
    Value constant;
    if (!session || session->calls > 0 || !function || function->size != sizeof *function || !function->name ||
        !function->parameters || !function->call)
        return PETRI_INVALID;
    Str name = str_from(function->name);
    if (!session_is_name(name) || engine_name_exists(name) || builtin_find(name) || builtin_constant(name, &constant))
        return PETRI_INVALID;
    Adding adding = {function, false};
    PetriStatus status = session_protect(session, NULL, add_function, &adding);
    return status == PETRI_OK && !adding.good ? PETRI_INVALID : status;
}

bool petri_function(const PetriSession *session, size_t number, PetriBuiltin *function) {
    if (!session || !function || number >= session->functions.count)
        return false;
    const Builtin *row = session->functions.rows[number];
    *function = (PetriBuiltin){row->name, row->parameters, row->help};
    return true;
}
