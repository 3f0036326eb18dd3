// format.c: see format.h.
//
// There are two formats: format_value has all digits and only the kind of a node; format_debug has nine digits and
// whole nodes. Both charge the arena for each element, because a value can have millions.
#include "value/format.h"

#include "base/number.h"
#include "base/unicode.h"
#include "value/node_batch.h"

#include <math.h>
#include <string.h>

static void add_escape(Text *out, uint32_t c) {
    switch (c) {
    case '\n':
        text_add_c(out, "\\n");
        break;
    case '\r':
        text_add_c(out, "\\r");
        break;
    case '\t':
        text_add_c(out, "\\t");
        break;
    default:
        text_add_format(out, c < 0x100 ? "\\x%02x" : c < 0x10000 ? "\\u%04x" : "\\U%08x", c);
    }
}

static void format_string(Text *out, Str text) {
    char quote = text.len && memchr(text.bytes, '\'', text.len) && !memchr(text.bytes, '"', text.len) ? '"' : '\'';
    text_add_char(out, quote);
    for (size_t at = 0; at < text.len;) {
        int32_t c = utf8_next(text, &at);
        if (c == quote || c == '\\') {
            text_add_char(out, '\\');
            text_add_char(out, (char)c);
        } else if (c >= 0 && unicode_is_printable((uint32_t)c)) {
            text_add_code_point(out, (uint32_t)c);
        } else {
            add_escape(out, c < 0 ? 0xfffd : (uint32_t)c);
        }
    }
    text_add_char(out, quote);
}

// If x is a symbol, appends it with its colon and returns true.
static bool format_symbol(Text *out, const SymbolTable *symbols, double x) {
    const Symbol *symbol = symbol_of_number(symbols, x);
    if (!symbol)
        return false;
    text_add_char(out, ':');
    text_add(out, symbol->name);
    return true;
}

static void format_item(Text *out, const SymbolTable *symbols, Item item) {
    switch (item.type) {
    case ITEM_NUMBER:
        if (!format_symbol(out, symbols, item.as.number))
            text_add_number(out, item.as.number);
        break;
    case ITEM_STRING:
        format_string(out, item.as.string->text);
        break;
    case ITEM_NODE:
        text_add_c(out, "(!");
        text_add(out, item.as.node->kind->name);
        text_add_char(out, ')');
        break;
    case ITEM_FUNCTION:
        text_add_char(out, '(');
        text_add(out, item.as.function->name);
        text_add_char(out, ')');
        break;
    }
}

void format_value(Text *out, const SymbolTable *symbols, Value v) {
    if (v.len == 0)
        text_add_c(out, "null");
    for (uint32_t i = 0; i < v.len; i++) {
        arena_charge(out->arena, VALUE_TEXT_WORK);
        if (i)
            text_add_char(out, ';');
        format_item(out, symbols, value_at(&v, i));
    }
}

Str format_text(Arena *arena, const SymbolTable *symbols, Value v) {
    Text text = text_new(arena);
    format_value(&text, symbols, v);
    text_add_char(&text, 0);
    return (Str){text.bytes, text.len - 1};
}

typedef void FormatValue(Text *out, const SymbolTable *symbols, Value v);

// Appends `!kind #tags name=value …` without a newline.
static void format_head(Text *out, const SymbolTable *symbols, const Node *node, FormatValue *format) {
    text_add_char(out, '!');
    text_add(out, node->kind->name);
    for (uint32_t i = 0; i < node->tag_count; i++) {
        text_add_c(out, " #");
        text_add(out, node->tags[i]->name);
    }
    for (uint32_t i = 0; i < node->attr_count; i++) {
        text_add_char(out, ' ');
        text_add(out, node->attrs[i].name->name);
        text_add_char(out, '=');
        format(out, symbols, node->attrs[i].value);
    }
}

bool format_tree(Text *out, const SymbolTable *symbols, const Node *node, int depth, FormatLine *line,
                 void *user_data) {
    arena_charge(out->arena, 2 + (unsigned)depth / 8);
    for (int i = 0; i < depth; i++)
        text_add_c(out, "    ");
    format_head(out, symbols, node, format_value);
    text_add_char(out, '\n');
    bool continues = !line || line(user_data, out);
    uint32_t count;
    const Node *const *children = node_children(out->arena, node, &count);
    for (uint32_t i = 0; continues && i < count; i++)
        continues = format_tree(out, symbols, children[i], depth + 1, line, user_data);
    return continues;
}

static void format_debug_node(Text *out, const SymbolTable *symbols, const Node *node, int depth) {
    arena_charge(out->arena, 4 + (unsigned)depth / 4);
    for (int i = 0; i < depth; i++)
        text_add_char(out, ' ');
    format_head(out, symbols, node, format_debug);
    uint32_t count;
    const Node *const *children = node_children(out->arena, node, &count);
    for (uint32_t i = 0; i < count; i++) {
        text_add_char(out, '\n');
        format_debug_node(out, symbols, children[i], depth + 1);
    }
}

static void format_debug_number(Text *out, const SymbolTable *symbols, double x, bool numeric) {
    char digits[NUMBER_TEXT];
    if (format_symbol(out, symbols, x))
        return;
    if (numeric && x == 0)
        x = 0; // in a numeric vector, -0 is printed as 0
    text_add(out, (Str){digits, number_format_short(x, digits)});
}

void format_debug(Text *out, const SymbolTable *symbols, Value v) {
    if (v.len == 0)
        text_add_c(out, "null");
    for (uint32_t i = 0; i < v.len; i++) {
        Item item = value_at(&v, i);
        arena_charge(out->arena, VALUE_TEXT_WORK);
        if (i)
            text_add_char(out, ';');
        if (item.type == ITEM_NUMBER) {
            format_debug_number(out, symbols, item.as.number, v.kind == VALUE_NUMBERS);
        } else if (item.type == ITEM_NODE) {
            text_add_char(out, '(');
            format_debug_node(out, symbols, item.as.node, 0);
            text_add_char(out, ')');
        } else {
            format_item(out, symbols, item);
        }
    }
}

// Returns the rank of an element in the order of keys: 0 for symbols, 1 for other numbers, 2 for strings.
static int key_class(const SymbolTable *symbols, Item item) {
    if (item.type != ITEM_NUMBER)
        return 2;
    return symbols && symbol_of_number(symbols, item.as.number) ? 0 : 1;
}

static int key_item_compare(const SymbolTable *symbols, Item a, Item b) {
    // Most keys begin like the key before them.
    if (a.type == ITEM_NUMBER && b.type == ITEM_NUMBER && a.as.number == b.as.number &&
        !signbit(a.as.number) == !signbit(b.as.number))
        return 0;
    int class_a = key_class(symbols, a), class_b = key_class(symbols, b);
    if (class_a != class_b)
        return class_a < class_b ? -1 : 1;
    if (class_a == 0)
        return str_compare(symbol_of_number(symbols, a.as.number)->name, symbol_of_number(symbols, b.as.number)->name);
    if (class_a == 1 && a.as.number == b.as.number) // 0 and -0 are different keys, and -0 sorts first
        return !signbit(a.as.number) - !signbit(b.as.number);
    if (class_a == 1)
        return a.as.number > b.as.number ? 1 : -1;
    return str_compare(a.as.string->text, b.as.string->text);
}

int format_key_compare(const SymbolTable *symbols, Value a, Value b) {
    for (uint32_t i = 0; i < a.len && i < b.len; i++) {
        int order = key_item_compare(symbols, value_at(&a, i), value_at(&b, i));
        if (order)
            return order;
    }
    return (a.len > b.len) - (a.len < b.len);
}
