// input_bind.c: reads `!pointer` and `!key` nodes and writes their input to the state (input_bind.h).
#include "scene/input_bind.h"

#include "value/format.h"
#include "value/node_batch.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Names of keys with more than one character.
static const char long_names[] =
    "space apostrophe comma minus period slash semicolon equal left_bracket backslash right_bracket "
    "grave_accent escape enter tab backspace insert delete right left down up page_up page_down home end "
    "caps_lock scroll_lock num_lock print_screen pause f1 f2 f3 f4 f5 f6 f7 f8 f9 f10 f11 f12 kp_0 kp_1 kp_2 "
    "kp_3 kp_4 kp_5 kp_6 kp_7 kp_8 kp_9 kp_decimal kp_divide kp_multiply kp_subtract kp_add kp_enter kp_equal "
    "left_shift left_control left_alt left_super right_shift right_control right_alt right_super menu";
static const char short_names[] = "abcdefghijklmnopqrstuvwxyz0123456789";
enum { LONG_KEYS = INPUT_KEYS - (sizeof short_names - 1) }; // number of long names

static const char *const button_names[INPUT_BUTTONS] = {"left",     "middle",   "right",    "button_4",
                                                        "button_5", "button_6", "button_7", "button_8"};
// Numbers of the buttons in Flitter, which are those of GLFW.
static const double button_numbers[INPUT_BUTTONS] = {0, 2, 1, 3, 4, 5, 6, 7};
enum { USUAL_BUTTONS = 3 }; // the first buttons, which are written to the state even if they have never been pressed

int input_key_number(Str name) {
    if (name.len == 1) {
        const char *at = memchr(short_names, name.bytes[0], sizeof short_names - 1);
        return at ? LONG_KEYS + (int)(at - short_names) : INPUT_KEY_NONE;
    }
    return str_word_number(name, long_names); // INPUT_KEY_NONE if not found
}

static const InputSwitch NEVER_PRESSED = {.pushed = NAN, .released = NAN};

void input_reset(InputState *input_state, InputBindings *bindings) {
    *input_state = (InputState){.has_reports = false};
    *bindings = (InputBindings){.count = 0};
    arena_init(&bindings->arena, "input", SIZE_MAX);
    for (int i = 0; i < INPUT_KEYS; i++)
        input_state->keys[i] = NEVER_PRESSED;
    for (int i = 0; i < INPUT_BUTTONS; i++)
        input_state->buttons[i] = NEVER_PRESSED;
}

void input_init(Input *input, SymbolTable *symbols) {
    input_reset(&input->state, &input->bindings);
    for (int i = 0; i < INPUT_BUTTONS; i++)
        input->button_words[i] = symbol_register(symbols, str_from(button_names[i]));
    input->pushed = symbol_register(symbols, STR("pushed"));
    input->released = symbol_register(symbols, STR("released"));
    input->toggled = symbol_register(symbols, STR("toggled"));
    input->beat = symbol_register(symbols, STR("beat"));
}

void input_free(Input *input) {
    arena_free(&input->bindings.arena);
}

bool input_key_is_bound(const Input *input, int key) {
    for (uint32_t i = 0; i < input->bindings.count; i++)
        if (input->bindings.items[i].key == key)
            return key != INPUT_KEY_NONE;
    return false;
}

static void update_switch(InputSwitch *item, bool pressed) {
    item->pushes += pressed && !item->down;
    item->down = pressed;
}

void input_report_key(Input *input, int key, bool pressed) {
    input->state.has_reports = true;
    update_switch(&input->state.keys[key], pressed);
}

void input_report_pointer(Input *input, const double *position, uint32_t buttons) {
    InputState *input_state = &input->state;
    input_state->has_reports = true;
    input_state->inside = position;
    if (position)
        memcpy(input_state->position, position, sizeof input_state->position);
    for (int i = 0; i < INPUT_BUTTONS; i++)
        update_switch(&input_state->buttons[i], buttons >> i & 1);
}

void input_release_all(Input *input) {
    for (int i = 0; i < INPUT_KEYS; i++)
        update_switch(&input->state.keys[i], false);
    input_report_pointer(input, NULL, 0);
}

// Returns the number of the key that a `!key` names with a symbol or a string.
static int named_key(const SymbolTable *symbols, Value name) {
    const Symbol *symbol = value_is_number(name) ? symbol_of_number(symbols, name.as.number) : NULL;
    Str word = {0};
    if (symbol)
        word = symbol->name;
    else if (name.kind == VALUE_MIXED && name.len == 1 && name.as.items[0].type == ITEM_STRING)
        word = name.as.items[0].as.string->text;
    return input_key_number(word);
}

static void report_key(const Reader *reader, Value name) {
    Text out = text_new(reader->arena);
    if (name.len > 1) {
        text_add_c(&out, "attribute 'name' must be the name of one key");
    } else if (name.len) {
        text_add_c(&out, "no key has the name ");
        format_value(&out, reader->schema->symbols, name);
    } else {
        text_add_c(&out, "attribute 'name' is missing or null");
    }
    text_add_c(&out, "; the node is skipped");
    reader_report(reader, "invalid-input-node", "name", text_str(&out));
}

void input_add_binding(InputBindings *bindings, Value state, int key) {
    InputBinding binding = {value_copy(&bindings->arena, state), key};
    bindings->items =
        arena_grow_array(&bindings->arena, bindings->items, bindings->count, &bindings->capacity, sizeof binding);
    bindings->items[bindings->count++] = binding;
}

static void bind_node(InputBindings *bindings, const Reader *reader) {
    InputAttrs attrs;
    schema_defaults(reader->kind, &attrs);
    reader_fill(reader, &attrs);
    bool names_key = reader->kind == KIND_KEY;
    int key = names_key ? named_key(reader->schema->symbols, attrs.name) : INPUT_KEY_NONE;
    if (attrs.state.len == 0 || !state_key_valid(attrs.state))
        reader_report(reader, "invalid-input-node", "state",
                      STR("attribute 'state' must be numbers, symbols or strings, such as :x; the node is skipped"));
    else if (names_key && key == INPUT_KEY_NONE)
        report_key(reader, attrs.name);
    else
        input_add_binding(bindings, attrs.state, key);
}

void input_bind(Input *input, Schema *schema, Value tree, Arena *arena) {
    InputBindings *bindings = &input->bindings;
    arena_reset(&bindings->arena);
    bindings->arena.escape = arena->escape;
    bindings->items = NULL;
    bindings->count = bindings->capacity = 0;
    for (uint32_t i = 0; tree.kind == VALUE_MIXED && i < tree.len; i++) {
        const Node *window = tree.as.items[i].type == ITEM_NODE ? tree.as.items[i].as.node : NULL;
        if (!window || window->kind != schema->kinds[KIND_WINDOW])
            continue;
        uint32_t count;
        const Node *const *children = node_children(arena, window, &count);
        for (uint32_t j = 0; j < count; j++) {
            NodeKind kind = schema_window_kind(schema, children[j]);
            Reader reader = {schema, arena, children[j], kind, 1};
            if (kind == KIND_POINTER || kind == KIND_KEY)
                bind_node(bindings, &reader);
        }
    }
    bindings->arena.escape = NULL;
}

// Updates what the frame at `beat` sees of a switch, from the reports since the previous frame.
static void advance_switch(InputSwitch *item, double beat) {
    bool down = item->down || item->pushes > 0;
    if (item->pushes > 0)
        item->pushed = beat;
    if (item->frame_down && !down)
        item->released = beat;
    item->toggled ^= item->pushes & 1;
    item->pushes = 0;
    item->frame_down = down;
}

typedef struct Writer {
    State *state;
    Arena *arena;
    InputUndo *undo;
} Writer;

struct InputChange {
    const InputChange *previous;
    Value key;
    Value old_value;
};

// Writes a value under the key prefix;first;second. If `first` or `second` is NaN, the key is shorter. A null value
// removes the entry.
static void write_number(const Writer *writer, Value prefix, double first, double second, Value value) {
    Vector key = vector_new(writer->arena);
    vector_add(&key, prefix);
    if (!isnan(first))
        vector_add_number(&key, first);
    if (!isnan(second))
        vector_add_number(&key, second);
    InputChange *change = arena_alloc(writer->arena, sizeof *change);
    *change = (InputChange){writer->undo->last, vector_finish(&key), VALUE_NULL};
    change->old_value = value_copy(writer->arena, state_get(writer->state, change->key));
    writer->undo->last = change;
    state_set(writer->state, change->key, value);
}

// Like write_number, but with symbols. NULL: none.
static void write_input_word(const Writer *writer, Value prefix, const Symbol *first, const Symbol *second,
                             Value value) {
    write_number(writer, prefix, first ? first->number : NAN, second ? second->number : NAN, value);
}

static void write_pointer(const Writer *writer, const Input *input, Value prefix) {
    const InputState *input_state = &input->state;
    Value position = input_state->inside ? value_numbers_view(input_state->position, 2) : VALUE_NULL;
    write_input_word(writer, prefix, NULL, NULL, position);
    for (int i = 0; i < INPUT_BUTTONS; i++) {
        const InputSwitch *button = &input_state->buttons[i];
        if (i < USUAL_BUTTONS || !isnan(button->pushed)) {
            write_input_word(writer, prefix, input->button_words[i], NULL, value_number(button->frame_down));
            write_number(writer, prefix, button_numbers[i], NAN, value_number(button->frame_down));
        }
    }
}

static Value beat_value(double beat) {
    return isnan(beat) ? VALUE_NULL : value_number(beat);
}

static void write_key(const Writer *writer, const Input *input, Value prefix, const InputSwitch *key) {
    write_input_word(writer, prefix, NULL, NULL, value_number(key->frame_down));
    write_input_word(writer, prefix, input->pushed, NULL, value_number(key->frame_down));
    write_input_word(writer, prefix, input->released, NULL, value_number(!key->frame_down));
    write_input_word(writer, prefix, input->toggled, NULL, value_number(key->toggled));
    write_input_word(writer, prefix, input->pushed, input->beat, beat_value(key->pushed));
    write_input_word(writer, prefix, input->released, input->beat, beat_value(key->released));
}

void input_write(Input *input, State *state, Arena *arena, double beat, InputUndo *undo) {
    const Writer writer = {state, arena, undo};
    InputState *input_state = &input->state;
    undo->last = NULL;
    undo->has_reports = input_state->has_reports;
    if (!input_state->has_reports)
        return;
    undo->state = *input_state;
    for (int i = 0; i < INPUT_KEYS; i++)
        advance_switch(&input_state->keys[i], beat);
    for (int i = 0; i < INPUT_BUTTONS; i++)
        advance_switch(&input_state->buttons[i], beat);
    for (uint32_t i = 0; i < input->bindings.count; i++) {
        const InputBinding *binding = &input->bindings.items[i];
        if (binding->key == INPUT_KEY_NONE)
            write_pointer(&writer, input, binding->state);
        else
            write_key(&writer, input, binding->state, &input_state->keys[binding->key]);
    }
}

void input_undo_write(Input *input, State *state, const InputUndo *undo) {
    for (const InputChange *change = undo->last; change; change = change->previous)
        state_set(state, change->key, change->old_value);
    if (undo->has_reports)
        input->state = undo->state;
}
