// functions.c: functions of the host (petri_add_function), and calls of functions of the script that describe distance
// fields (`!sdf function=`).
#include "base/host_struct.h"
#include "session/session.h"
#include "value/format.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct HostFunction {
    Builtin row; // first member, so that a pointer to it can be cast to HostFunction
    PetriFunctionCall *call;
    void *user_data;
} HostFunction;

struct PetriCall {
    BuiltinContext *context;
    double *numbers; // memory that petri_call_alloc_numbers returned last; NULL: none
    char error[200];
};

double *petri_call_alloc_numbers(PetriCall *call, uint32_t count) {
    if (!call || count > VALUE_MAX_LEN)
        return NULL;
    call->numbers = arena_try_alloc(call->context->arena, (count + 1) * sizeof *call->numbers);
    return call->numbers;
}

void petri_call_error(PetriCall *call, const char *text) {
    if (call && text)
        snprintf(call->error, sizeof call->error, "%.*s",
                 STR_ARGS(str_truncate(str_from(text), sizeof call->error - 1)));
}

// Calls a host function. Memory is allocated before and after the host function runs, but not during it: a failed
// allocation escapes (longjmp), which must not skip over code of the host.
static Value call_host(BuiltinContext *context, const Value *args, uint32_t count) {
    const HostFunction *function = (const HostFunction *)(const void *)context->called;
    PetriCall call = {.context = context};
    PetriValue *arguments = arena_alloc_array(context->arena, count, sizeof *arguments);
    for (uint32_t i = 0; i < count; i++)
        arguments[i] = session_export_value(&args[i]);
    PetriValue result = function->call(&call, function->user_data, arguments, count);
    Value imported;
    if (call.error[0])
        return builtin_error(context, function->row.name, "%s", call.error);
    if (!session_import_value(context->arena, result, &imported))
        return builtin_error(context, function->row.name, "the host function returned an invalid value");
    return result.numbers && result.numbers == call.numbers ? imported : value_copy(context->arena, imported);
}

// Parses row->parameters, such as "x, y=0, ...", and sets the other fields of the row that describe them. Returns false
// if they are not valid.
static bool parse_parameters(Builtin *row) {
    enum { MAX_PARAMETERS = 8 };
    const char *at = row->parameters;
    while (*at && !row->variadic) {
        size_t name = strcspn(at, "=,"), whole = strcspn(at, ",");
        row->variadic = str_equal((Str){at, whole}, STR("..."));
        row->fixed += !row->variadic;
        if (!row->variadic && (!session_is_name((Str){at, name}) || row->fixed > MAX_PARAMETERS))
            return false;
        if (!row->variadic && name == whole && ++row->required < row->fixed)
            return false; // this parameter has no default, but an earlier one has
        at += whole;
        if (*at && (at[1] != ' ' || !at[2]))
            return false;
        at += *at ? 2 : 0;
    }
    row->named = row->fixed > 0;
    return !*at;
}

static PetriStatus add_function(PetriSession *session, void *context) {
    const PetriFunction *function = context;
    HostFunctions *functions = &session->functions;
    Arena *arena = &session->arena;
    HostFunction *added = arena_alloc(arena, sizeof *added);
    const Builtin **rows = arena_alloc_array(arena, functions->count + 1, sizeof *rows);
    for (uint32_t i = 0; i < functions->count; i++) {
        rows[i] = functions->rows[i];
        if (strcmp(rows[i]->name, function->name) == 0)
            return PETRI_INVALID;
    }
    *added = (HostFunction){.row = {.name = str_to_c(arena, str_from(function->name)),
                                    .call = call_host,
                                    .parameters = str_to_c(arena, str_from(function->parameters)),
                                    .pure = function->pure,
                                    .help = str_to_c(arena, str_from(function->help ? function->help : ""))},
                            .call = function->call,
                            .user_data = function->user_data};
    if (!parse_parameters(&added->row))
        return PETRI_INVALID;
    rows[functions->count] = &added->row;
    *functions = (HostFunctions){rows, functions->count + 1};
    return PETRI_OK;
}

PetriStatus petri_add_function(PetriSession *session, const PetriFunction *given) {
    PetriFunction function = {0};
    Value constant;
    if (!session || session->call_depth > 0 || !host_struct_read(&function, sizeof function, given) || !function.name ||
        !function.parameters || !function.call)
        return PETRI_INVALID;
    Str name = str_from(function.name);
    if (!session_is_name(name) || engine_name_exists(name) || builtin_find(name) || builtin_constant(name, &constant))
        return PETRI_INVALID;
    return session_protect(session, NULL, add_function, &function);
}

// --- functions of the script

// Reports a result that is not a finite number.
static void report_result(PetriSession *session, Arena *arena, const FunctionSamples *function, const double point[3],
                          Value result) {
    const SchemaSink *sink = &session->schema.sink;
    Text text = text_new(arena);
    text_add_c(&text, "the function must return a finite number, but for the point ");
    format_value(&text, &session->symbols, (Value){.len = 3, .as.numbers = point});
    text_add_c(&text, " it returns ");
    if (result.len <= 8)
        format_value(&text, &session->symbols, result);
    else
        text_add_format(&text, "%u elements", result.len);
    text_add_c(&text, "; such points are outside");
    sink->report(sink->user_data, DIAG_WARNING, "bad-function", &function->origin, STR("!sdf"), STR("function"),
                 text_str(&text));
}

bool session_sample_function(PetriSession *session, Arena *arena, FunctionSamples *function, const double (*points)[3],
                             uint32_t count, double *distances) {
    for (uint32_t i = 0; i < count; i++) {
        VmSamples samples = {.program = session->config.program->program,
                             .function = function->function,
                             .at = &function->origin,
                             .points = points + i,
                             .count = count - i,
                             .numbers = distances + i};
        ArenaMark mark = arena_mark(arena);
        i += vm_sample(&session->vm, arena, &samples);
        if (i == count)
            break;
        if (!function->reported)
            report_result(session, arena, function, points[i], samples.wrong);
        function->reported = true;
        distances[i] = INFINITY;
        arena_rewind(arena, mark);
        if (samples.failed)
            return false;
    }
    return true;
}
