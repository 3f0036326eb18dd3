// move_command.c: the command .move, which sets the position and the velocity of a particle between two frames.
#include "petri-inspect.h"
#include "prompt/prompt.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { VECTORS = 2 };
static const char *const names[VECTORS] = {"position", "velocity"};

// A part of the operands, in bytes from their start. `end` is 0 if the part is missing.
typedef struct Part {
    size_t start;
    size_t end;
} Part;

// The operands: `ID position=EXPR velocity=EXPR`.
typedef struct Operands {
    const char *text;
    Part id;
    Part vectors[VECTORS];
    Part *open;     // the part that is being read
    Part word;      // the token before, if it is a name
    int depth;      // open brackets
    bool has_where; // a `where` was read, after which NAME= is a binding
    Part twice;     // an attribute that occurs twice, or that .move does not have
    Part unknown;
} Operands;

// Begins the part that an attribute `NAME=` introduces.
static void begin_attribute(Operands *operands, const PetriToken *equals) {
    Part word = operands->word;
    Str name = {operands->text + word.start, word.end - word.start};
    for (int i = 0; i < VECTORS; i++) {
        if (!str_equal(name, str_from(names[i])))
            continue;
        if (operands->vectors[i].end > 0)
            operands->twice = word;
        operands->open->end = word.start;
        operands->open = &operands->vectors[i];
        *operands->open = (Part){equals->end, equals->end};
        return;
    }
    if (!operands->has_where && operands->unknown.end == 0)
        operands->unknown = word;
}

static void see_token(void *user_data, const PetriToken *token) {
    Operands *operands = user_data;
    Str word = {operands->text + token->start, token->end - token->start};
    char c = word.len == 1 ? word.bytes[0] : '\0';
    operands->depth += (c != '\0' && strchr("([{", c)) - (c != '\0' && strchr(")]}", c));
    operands->has_where = operands->has_where || str_equal(word, STR("where"));
    if (c == '=' && operands->depth == 0 && operands->word.end > 0)
        begin_attribute(operands, token);
    operands->word = token->kind == PETRI_TOKEN_NAME ? (Part){token->start, token->end} : (Part){0};
    if (token->end > operands->open->end)
        operands->open->end = token->end;
}

// Splits the operands. Returns false after a message.
static bool split(Prompt *prompt, const char *text, Operands *operands) {
    *operands = (Operands){.text = text};
    operands->open = &operands->id;
    petri_tokenise(prompt->session, text, strlen(text), see_token, operands);
    const Part *bad = operands->twice.end > 0 ? &operands->twice : &operands->unknown;
    if (bad->end > 0)
        return prompt_fail(prompt, "%s '%.*s': .move expects ID position=X;Y velocity=X;Y",
                           bad == &operands->twice ? "repeated" : "no such attribute:", (int)(bad->end - bad->start),
                           text + bad->start);
    return true;
}

static char *part_text(const Operands *operands, const Part *part) {
    SCOPED_STRING text = memory_strndup(operands->text + part->start, part->end - part->start);
    return argument_trimmed(text);
}

// Reads the numbers of a printed vector, of which there are at most `count`. Returns false if it has other elements.
static bool read_numbers(const char *text, double *numbers, uint32_t count) {
    for (uint32_t i = 0; i < count && *text != '\0'; i++) {
        size_t length = strcspn(text, ";");
        SCOPED_STRING number = memory_strndup(text, length);
        if (!petri_parse_number(number, &numbers[i]))
            return false;
        text += length + (text[length] == ';');
    }
    return true;
}

// Evaluates an attribute: a vector as long as the system has dimensions, or one number for all of them, as in scripts.
// Returns false after a message.
static bool read_vector(Prompt *prompt, const char *name, const char *text, uint32_t dimensions, double *vector) {
    PetriEvaluation result = {0};
    SCOPED_TEXT value = {0};
    if (text[0] == '\0')
        return prompt_fail(prompt, "%s= needs a vector", name);
    prompt_busy(prompt);
    PetriStatus status =
        petri_evaluate(prompt->session, text, PETRI_NUL_TERMINATED, &result, sizeof result, text_collect, &value);
    prompt_idle(prompt);
    if (!prompt_status(prompt, status))
        return false;
    if (result.length != dimensions && result.length != 1)
        return prompt_fail(prompt, "%s should be one number or a vector of %u, not %.60s", name, dimensions,
                           result.length == 0 ? "null" : value.bytes);
    bool good = read_numbers(value.bytes, vector, result.length);
    for (uint32_t i = 0; i < result.length && good; i++)
        good = isfinite(vector[i]);
    for (uint32_t i = 1; result.length == 1 && i < dimensions; i++)
        vector[i] = vector[0];
    return good || prompt_fail(prompt, "%s should consist of finite numbers, not %.60s", name, value.bytes);
}

// A particle, and where it is.
typedef struct Target {
    size_t number; // of the system
    PetriSystem system;
    uint32_t particle;
    Text key;
} Target;

// Finds the only particle with a name. Returns false after a message.
static bool find_target(Prompt *prompt, const ParticleName *name, Target *target) {
    PetriSystem system;
    SCOPED_TEXT keys = {0};
    size_t count = 0, found = 0;
    for (; petri_system(prompt->session, count, &system, sizeof system); count++) {
        uint32_t particle;
        if (!particle_find(prompt, name, count, &system, &particle))
            continue;
        *target = (Target){.number = count, .system = system, .particle = particle};
        text_add_c(&keys, found++ == 0 ? "" : ", ");
        particle_add_key(prompt, count, &system, particle, &keys);
    }
    if (count == 0)
        return prompt_fail(prompt, "%s", particle_none(prompt));
    if (found == 0)
        return particle_unknown(prompt, name);
    if (found > 1)
        return prompt_fail(prompt, "%zu particles have the id '%.40s': %.200s", found, name->typed, keys.bytes);
    if (target->system.anchor[target->particle * target->system.anchor_stride])
        return prompt_fail(prompt, "%s is an anchor, which only the script moves", keys.bytes);
    text_add(&target->key, text_str(&keys));
    return true;
}

static const double *vector_of(const Target *target, int vector) {
    PetriColumn column = vector == 0 ? target->system.position : target->system.velocity;
    return column.data + column.stride * target->particle;
}

static void add_vector(Prompt *prompt, const Target *target, const double *vector, Text *text) {
    const char *value =
        petri_format_value(prompt->session, (PetriValue){.length = target->system.dimensions, .numbers = vector});
    text_add_c(text, value ? value : "");
}

static void show_target(Prompt *prompt, const Target *target) {
    SCOPED_TEXT line = {0};
    text_add(&line, text_str(&target->key));
    for (int i = 0; i < VECTORS; i++) {
        text_add_format(&line, " %s=", names[i]);
        add_vector(prompt, target, vector_of(target, i), &line);
    }
    output_format(prompt->output, "%s\n", line.bytes);
}

// Moves the particle and shows what has changed.
static bool move(Prompt *prompt, const Target *target, const double *const vectors[VECTORS]) {
    SCOPED_TEXT before = {0};
    for (int i = 0; i < VECTORS; i++) {
        if (!vectors[i])
            continue;
        text_add_format(&before, " %s=", names[i]);
        add_vector(prompt, target, vector_of(target, i), &before);
    }
    PetriStatus status =
        prompt->host->move
            ? prompt->host->move(prompt, target->number, target->particle, vectors[0], vectors[1])
            : petri_history_move_particle(prompt->history, target->number, target->particle, vectors[0], vectors[1]);
    if (!prompt_status(prompt, status))
        return false;
    prompt_note(prompt, "%s had%s", target->key.bytes, before.bytes);
    return true;
}

static bool move_target(Prompt *prompt, const Operands *operands, const Target *target) {
    const double *vectors[VECTORS] = {NULL};
    uint32_t dimensions = target->system.dimensions;
    double *numbers = memory_calloc(VECTORS * (size_t)dimensions * sizeof *numbers);
    bool good = true, any = false;
    for (int i = 0; i < VECTORS && good; i++) {
        if (operands->vectors[i].end == 0)
            continue;
        SCOPED_STRING text = part_text(operands, &operands->vectors[i]);
        double *vector = numbers + (size_t)i * dimensions;
        good = read_vector(prompt, names[i], text, dimensions, vector);
        vectors[i] = vector;
        any = true;
    }
    if (good && any)
        good = move(prompt, target, vectors);
    else if (good)
        show_target(prompt, target);
    free(numbers);
    return good;
}

static bool run_move(Prompt *prompt, const char *rest) {
    Operands operands;
    ParticleName name = {0};
    Target target = {0};
    SCOPED_TEXT expanded = {0};
    if (!expression_expand(prompt, rest, &expanded) ||
        !split(prompt, expanded.len > 0 ? expanded.bytes : rest, &operands))
        return false;
    SCOPED_STRING id = part_text(&operands, &operands.id);
    if (id[0] == '\0')
        return prompt_fail(prompt, ".move needs the id of a particle");
    bool good = particle_read(prompt, id, &name) && find_target(prompt, &name, &target) &&
                move_target(prompt, &operands, &target);
    text_free(&name.value);
    text_free(&target.key);
    return good;
}

const PromptCommand MOVE_COMMANDS[] = {
    {".move", "ID [position=X ...]", "the id of a particle",
     "set position= and velocity= of a particle in this frame, or show them", run_move, COMPLETE_MOVE},
    {0},
};
