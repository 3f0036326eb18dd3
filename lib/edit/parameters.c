// parameters.c: parameters of the loaded script and of its modules, with their ranges and values (petri_parameter).
#include "base/host_struct.h"
#include "session/definitions.h"
#include "session/session.h"
#include "value/format.h"

#include <math.h>

// Returns a part of a script as one line, without control characters.
static const char *to_one_line(Arena *arena, Str source) {
    Text text = text_new(arena);
    for (size_t at = 0; at < source.len;) {
        int32_t c = utf8_next(source, &at);
        bool blank = c < 0x20 || (c >= 0x7f && c < 0xa0);
        if (!blank)
            text_add_code_point(&text, (uint32_t)c);
        else if (text.len && text.bytes[text.len - 1] != ' ')
            text_add_char(&text, ' ');
        while (c == '\n' && at < source.len && source.bytes[at] == ' ')
            at++;
    }
    text_add_c(&text, ""); // makes text.bytes a string even if it is empty
    return text.bytes;
}

static void describe_parameter(PetriSession *session, const Parameter *parameter, bool settable, PetriParameter *out) {
    Arena *arena = &session->text_arena;
    const Define *define = settable ? session_find_define(session, parameter->name) : NULL;
    bool defined = define && session_uses_define(parameter, define->value);
    Value value = defined ? define->value : parameter->value;
    SourcePosition place = source_locate(parameter->source, parameter->span.start);
    *out = (PetriParameter){
        .name = str_to_c(arena, parameter->name->name),
        .default_value = to_one_line(arena, parameter->default_text),
        .value = defined || parameter->is_static ? format_text(arena, &session->symbols, value).bytes
                                                 : to_one_line(arena, parameter->default_text),
        .comment = to_one_line(arena, parameter->comment),
        .number = defined || parameter->is_static ? session_one_number(session, value) : NAN,
        .default_number = parameter->is_static ? session_one_number(session, parameter->value) : NAN,
        .min = parameter->min,
        .max = parameter->max,
        .step = parameter->step,
        .accepts_false = parameter->keeps_false,
        .defined = defined,
        .settable = settable,
        .file = str_to_c(arena, parameter->source->name),
        .line = place.line,
        .column = place.column,
    };
}

typedef struct ParameterRequest {
    size_t number;
    PetriParameter *out;
} ParameterRequest;

static PetriStatus find_parameter(PetriSession *session, void *context) {
    ParameterRequest *request = context;
    const Program *program = session->config.program->program;
    size_t number = request->number;
    ModuleList modules = {.count = 0};
    arena_reset(&session->text_arena);
    if (number < program->parameter_count) {
        describe_parameter(session, &program->parameters[number], true, request->out);
        return PETRI_OK;
    }
    number -= program->parameter_count;
    session_collect_modules(session, program, &modules);
    for (uint32_t i = 0; i < modules.count; i++) {
        const Program *module = modules.items[i];
        if (number < module->parameter_count) {
            describe_parameter(session, &module->parameters[number], false, request->out);
            return PETRI_OK;
        }
        number -= module->parameter_count;
    }
    return PETRI_INVALID;
}

bool petri_parameter(PetriSession *session, size_t number, PetriParameter *parameter, size_t size) {
    PetriParameter found;
    ParameterRequest request = {number, &found};
    return session && parameter && session->config.program && session_query(session, find_parameter, &request) &&
           host_struct_write(parameter, size, &found, sizeof found);
}
