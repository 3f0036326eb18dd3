// definitions.c: checks of the definitions (-D) that set the parameters of the loaded script.
#include "session/definitions.h"

#include "ast/literal.h"
#include "base/number.h"
#include "session/session.h"
#include "value/format.h"

#include <math.h>
#include <string.h>

static bool has_module(const ModuleList *list, const Program *module) {
    for (uint32_t i = 0; i < list->count; i++)
        if (list->items[i] == module)
            return true;
    return false;
}

void session_collect_modules(PetriSession *session, const Program *program, ModuleList *list) {
    for (uint32_t i = 0; i < program->import_count; i++) {
        Str reason;
        const Program *module = session_module(session, program->imports[i], &reason);
        if (!module || has_module(list, module) || list->count == MAX_MODULES)
            continue;
        list->items[list->count++] = module;
        session_collect_modules(session, module, list);
    }
}

static const Parameter *find_in_modules(const ModuleList *list, const Symbol *name) {
    for (uint32_t i = 0; i < list->count; i++) {
        const Parameter *parameter = program_find_parameter(list->items[i], name);
        if (parameter)
            return parameter;
    }
    return NULL;
}

// Returns true for a number that is not a symbol.
static bool is_plain_constant(const PetriSession *session, Item item) {
    return item.type == ITEM_NUMBER && !symbol_of_number(&session->symbols, item.as.number);
}

static bool all_numbers(const PetriSession *session, Value v) {
    bool all = v.kind != VALUE_STREAM && v.len > 0;
    for (uint32_t i = 0; all && i < v.len; i++)
        all = is_plain_constant(session, value_at(&v, i));
    return all;
}

double session_one_number(const PetriSession *session, Value v) {
    return v.len == 1 && all_numbers(session, v) ? value_at(&v, 0).as.number : NAN;
}

static bool is_within(const Parameter *parameter, double x) {
    return x >= parameter->min && x <= parameter->max;
}

// Returns the range as `MIN..MAX`. An end that the range does not have is left out, as in `0..`.
static Str range_text(Arena *arena, const Parameter *parameter) {
    char min[NUMBER_TEXT] = "", max[NUMBER_TEXT] = "";
    size_t before = isinf(parameter->min) ? 0 : number_format(parameter->min, min);
    size_t after = isinf(parameter->max) ? 0 : number_format(parameter->max, max);
    return str_format(arena, "%.*s..%.*s", (int)before, min, (int)after, max);
}

// A definition that is being checked.
typedef struct Check {
    PetriSession *session;
    Unit *unit;
    const Define *define;
    const DefineUse *use;
} Check;

static void report_definition(const Check *check, DiagLevel level, const char *code, Origin at, Str text, Str hint) {
    session_report(check->session, &(Diag){level, at, text, .hint = hint, .code = code});
}

static Origin origin_of(const Parameter *parameter) {
    return (Origin){parameter->source, parameter->span};
}

// Returns how to write a value that is not a number. `quoted` is it as text of the language.
static Str number_hint(Arena *arena, Str quoted) {
    if (str_equal(quoted, STR("'true'")) || str_equal(quoted, STR("'false'")))
        return STR("write 1 for true and 0 for false");
    const char *slash = memchr(quoted.bytes, '/', quoted.len);
    double a, b;
    char quotient[NUMBER_TEXT];
    if (!slash || quoted.bytes[0] != '\'')
        return (Str){0};
    Str before = {quoted.bytes + 1, (size_t)(slash - quoted.bytes) - 1};
    Str after = {slash + 1, quoted.len - before.len - 3};
    if (!literal_parse_number(before, &a) || !literal_parse_number(after, &b) || !isfinite(a / b))
        return (Str){0};
    size_t length = number_format(a / b, quotient);
    return str_format(arena, "write %.*s for %.*s", (int)length, quotient, (int)(quoted.len - 2), quoted.bytes + 1);
}

// Reports an error and returns false if the default consists of numbers, but the definition does not.
static bool check_numbers(const Check *check, const Parameter *parameter) {
    Value v = check->define->value;
    Arena *arena = &check->unit->arena;
    if (!parameter->is_static || !all_numbers(check->session, parameter->value) || all_numbers(check->session, v))
        return true;
    uint32_t at = 0;
    while (is_plain_constant(check->session, value_at(&v, at)))
        at++;
    Str wrong = format_text(arena, &check->session->symbols, value_element(v, at));
    report_definition(check, DIAG_ERROR, "bad-definition", origin_of(parameter),
                      str_format(arena, "%.*s is not a number; '%.*s' takes numbers, such as its default %.*s",
                                 STR_ARGS(wrong), STR_ARGS(parameter->name->name), STR_ARGS(parameter->default_text)),
                      number_hint(arena, wrong));
    return false;
}

static void check_range(const Check *check, const Parameter *parameter) {
    Value v = check->define->value;
    Arena *arena = &check->unit->arena;
    for (uint32_t i = 0; all_numbers(check->session, v) && i < v.len; i++) {
        double x = value_at(&v, i).as.number;
        if (is_within(parameter, x))
            continue;
        Str problem = isnan(x) ? STR("not a number")
                               : str_format(arena, "outside the range %.*s", STR_ARGS(range_text(arena, parameter)));
        Str printed = format_text(arena, &check->session->symbols, v);
        report_definition(check, DIAG_WARNING, "out-of-range", origin_of(parameter),
                          str_format(arena, "%.*s=%.*s is %.*s", STR_ARGS(parameter->name->name), STR_ARGS(printed),
                                     STR_ARGS(problem)),
                          (Str){0});
        return;
    }
}

bool session_uses_define(const Parameter *parameter, Value defined) {
    return value_true(defined) || parameter->keeps_false;
}

// Checks a definition that is false, such as 0, so that `or` uses the default. Reports an error and returns false
// unless the default is false too.
static bool check_false(const Check *check, const Parameter *parameter) {
    Arena *arena = &check->unit->arena;
    if (parameter->is_static && !value_true(parameter->value))
        return true;
    Str printed = format_text(arena, &check->session->symbols, check->define->value);
    report_definition(check, DIAG_ERROR, "false-definition", origin_of(parameter),
                      str_format(arena, "%.*s=%.*s has no effect: %.*s is false, so `or` uses the default %.*s",
                                 STR_ARGS(parameter->name->name), STR_ARGS(printed), STR_ARGS(printed),
                                 STR_ARGS(parameter->default_text)),
                      program_null_test(arena, parameter));
    return false;
}

static bool check_parameter(const Check *check, const Parameter *parameter) {
    if (!check_numbers(check, parameter))
        return false;
    if (!session_uses_define(parameter, check->define->value))
        return check_false(check, parameter);
    check_range(check, parameter);
    return true;
}

// Returns the parameter with the most similar name, or NULL if none is similar.
static const Parameter *nearest_parameter(const Program *program, Str name) {
    const Parameter *found = NULL;
    StrNearest nearest = str_nearest(name);
    for (uint32_t i = 0; i < program->parameter_count; i++)
        if (str_try_nearest(&nearest, program->parameters[i].name->name))
            found = &program->parameters[i];
    return found;
}

// Returns `before` followed by the names of all parameters.
static Str with_parameters(Arena *arena, const Program *program, Str before) {
    Text text = text_new(arena);
    uint32_t count = program->parameter_count;
    text_add(&text, before);
    for (uint32_t i = 0; i < count; i++) {
        text_add_c(&text, i > 0       ? (i + 1 < count ? ", " : " and ")
                          : count > 1 ? "; the parameters of the script are "
                                      : "; the parameter of the script is ");
        text_add(&text, program->parameters[i].name->name);
    }
    return text_str(&text);
}

static void report_unused(const Check *check) {
    Arena *arena = &check->unit->arena;
    const Program *program = check->unit->program;
    Str name = check->define->name->name, script = check->unit->source->name;
    const Parameter *nearest = nearest_parameter(program, name);
    Str text = str_format(arena, "unused definition '%.*s': %.*s does not read it", STR_ARGS(name), STR_ARGS(script));
    if (nearest)
        report_definition(check, DIAG_WARNING, "unknown-parameter", origin_of(nearest), text,
                          str_format(arena, "did you mean '%.*s'?", STR_ARGS(nearest->name->name)));
    else
        report_definition(check, DIAG_WARNING, "unread-definition", (Origin){0}, with_parameters(arena, program, text),
                          (Str){0});
}

// Reports a definition that the script does not read, with the reason.
static void check_unused(const Check *check) {
    Arena *arena = &check->unit->arena;
    Str name = check->define->name->name, hint = {0};
    const char *reason = NULL;
    Origin at = {0};
    if (engine_name_exists(name)) {
        reason = "petri sets this name itself";
    } else if (check->use->bound.source) {
        reason = "the script binds this name itself";
        at = check->use->bound;
        if (check->use->by_let)
            hint =
                str_format(arena, "write `let %.*s=%.*s or …` to use the definition", STR_ARGS(name), STR_ARGS(name));
    } else {
        ModuleList modules = {.count = 0};
        session_collect_modules(check->session, check->unit->program, &modules);
        const Parameter *parameter = find_in_modules(&modules, check->define->name);
        if (!parameter) {
            report_unused(check);
            return;
        }
        reason = "it is a parameter of a module, and definitions do not apply to modules";
        at = origin_of(parameter);
    }
    report_definition(check, DIAG_WARNING, "unused-definition", at,
                      str_format(arena, "unused definition '%.*s': %s", STR_ARGS(name), reason), hint);
}

const Define *session_find_define(const PetriSession *session, const Symbol *name) {
    for (uint32_t i = 0; i < session->config.define_count; i++)
        if (session->config.defines[i].name == name)
            return &session->config.defines[i];
    return NULL;
}

static bool check_definition(const Check *check) {
    const Parameter *parameter = program_find_parameter(check->unit->program, check->define->name);
    if (parameter)
        return check_parameter(check, parameter);
    // In petri_check, unused definitions are not reported, because `petri check` defines names for many scripts at
    // once.
    if (!check->use->read && !check->session->loader.lint)
        check_unused(check);
    return true;
}

bool session_check_definitions(PetriSession *session, Unit *unit) {
    bool good = true, outer = diagnostics_repeat(&session->diagnostics, true);
    // When recompiling, only new definitions are checked. Their problems are reported even if the same diagnostic was
    // reported before.
    uint32_t first = session->recompiling ? session->reported_defines : 0;
    diagnostics_repeat(&session->diagnostics, outer || session->recompiling);
    for (uint32_t i = first; i < session->config.define_count && !unit->empty; i++)
        good &= check_definition(&(Check){session, unit, &session->config.defines[i], &unit->program->define_uses[i]});
    diagnostics_repeat(&session->diagnostics, outer);
    if (good)
        session->reported_defines = session->config.define_count;
    return good;
}
