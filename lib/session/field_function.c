// field_function.c: calls functions of the script that describe distance fields (`!sdf function=`).
#include "session/session.h"
#include "value/format.h"

#include <math.h>

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
