// expression.h: evaluates simple expressions, so that tests can contain the examples of the specification unchanged:
// literals, operators, ranges, indexing and calls of built-ins.
#pragma once

#include "nodes.h"
#include "value/ops.h"
#include "value/stream.h"
#include "world.h"

#include <ctype.h>
#include <stdlib.h>

typedef struct Reader {
    World *world;
    const char *at;
} Reader;

static Value read_composition(Reader *r);

static bool accept_token(Reader *r, const char *token) {
    while (*r->at == ' ')
        r->at++;
    if (strncmp(r->at, token, strlen(token)) != 0)
        return false;
    r->at += strlen(token);
    return true;
}

static void expect_token(Reader *r, const char *token) {
    if (!accept_token(r, token))
        fail_msg("expected %s at: %s", token, r->at);
}

static Str read_name(Reader *r) {
    const char *start = r->at;
    while (isalnum((unsigned char)*r->at) || *r->at == '_' || (unsigned char)*r->at >= 0x80)
        r->at++;
    return (Str){start, (size_t)(r->at - start)};
}

static Value read_string(Reader *r, char quote) {
    Text text = text_new(&r->world->frame);
    while (*r->at && *r->at != quote) {
        char c = *r->at++;
        if (c == '\\') {
            c = *r->at++;
            c = c == 'n' ? '\n' : c;
        }
        text_add_char(&text, c);
    }
    r->at++;
    return value_string(&r->world->frame, text_str(&text));
}

static Value read_call(Reader *r, const Builtin *builtin) {
    Value args[16], named[16];
    const Symbol *names[16];
    uint32_t count = 0, named_count = 0;
    while (!accept_token(r, ")")) {
        if (count + named_count)
            expect_token(r, ",");
        while (*r->at == ' ')
            r->at++;
        const char *start = r->at;
        Str name = read_name(r);
        if (name.len && *r->at == '=' && r->at[1] != '=') {
            r->at++;
            names[named_count] = symbol_intern(&r->world->symbols, name);
            named[named_count++] = read_composition(r);
        } else {
            r->at = start;
            args[count++] = read_composition(r);
        }
    }
    return builtin_call(&r->world->context, builtin, args, count, names, named, named_count);
}

static Value read_atom(Reader *r) {
    Arena *arena = &r->world->frame;
    if (accept_token(r, "(")) {
        Value v = read_composition(r);
        expect_token(r, ")");
        return v;
    }
    if (accept_token(r, "'"))
        return read_string(r, '\'');
    if (accept_token(r, "\""))
        return read_string(r, '"');
    if (accept_token(r, ":"))
        return value_number(symbol_register(&r->world->symbols, read_name(r))->number);
    if (accept_token(r, "!"))
        return value_node(arena, node_new(arena, symbol_intern(&r->world->symbols, read_name(r))));
    if (isdigit((unsigned char)*r->at)) {
        // strtod cannot be used: a number followed by ".." is the start of a range.
        const char *start = r->at;
        while (isdigit((unsigned char)*r->at) || (*r->at == '.' && r->at[1] != '.'))
            r->at++;
        if (*r->at == 'e')
            for (r->at += 2; isdigit((unsigned char)*r->at);)
                r->at++;
        return value_number(number_parse((Str){start, (size_t)(r->at - start)}));
    }
    Str name = read_name(r);
    Value v;
    if (builtin_constant(name, &v))
        return v;
    const Builtin *builtin = builtin_find(name);
    if (!builtin)
        fail_msg("unknown name at: %s", name.bytes);
    if (accept_token(r, "("))
        return read_call(r, builtin);
    Function *function = arena_alloc(&r->world->frame, sizeof *function);
    *function = (Function){.name = name, .builtin = builtin};
    return value_function(arena, function);
}

static Value index_value(Arena *arena, Value v, Value index) {
    if (v.kind != VALUE_STREAM)
        return value_index(arena, v, index);
    Vector vector = vector_new(arena);
    for (uint32_t i = 0; value_is_numeric(index) && i < index.len; i++)
        vector_add_number(&vector, value_stream_item(v, value_stream_position(value_numbers(&index)[i])));
    return vector_finish(&vector);
}

static Value read_postfix(Reader *r) {
    Value v = read_atom(r);
    while (accept_token(r, "[")) {
        v = index_value(&r->world->frame, v, read_composition(r));
        expect_token(r, "]");
    }
    return v;
}

static Value read_unary(Reader *r) {
    if (accept_token(r, "-"))
        return op_negate(&r->world->frame, read_unary(r));
    Value v = read_postfix(r);
    return accept_token(r, "**") ? op_arith(&r->world->frame, ARITH_POW, v, read_unary(r)) : v;
}

static Value read_product(Reader *r) {
    Value v = read_unary(r);
    for (;;)
        if (accept_token(r, "*"))
            v = op_arith(&r->world->frame, ARITH_MUL, v, read_unary(r));
        else if (accept_token(r, "/"))
            v = op_arith(&r->world->frame, ARITH_DIV, v, read_unary(r));
        else
            return v;
}

static Value read_sum(Reader *r) {
    Value v = read_product(r);
    for (;;)
        if (accept_token(r, "+"))
            v = op_arith(&r->world->frame, ARITH_ADD, v, read_product(r));
        else if (accept_token(r, "-"))
            v = op_arith(&r->world->frame, ARITH_SUB, v, read_product(r));
        else
            return v;
}

static Value read_range(Reader *r) {
    bool too_long = false;
    Value start = VALUE_NULL, step = VALUE_NULL;
    if (!accept_token(r, "..")) {
        start = read_sum(r);
        if (!accept_token(r, ".."))
            return start;
    }
    Value stop = read_sum(r);
    if (accept_token(r, "|"))
        step = read_sum(r);
    return op_range(&r->world->frame, start, stop, step, &too_long);
}

static Value read_comparison(Reader *r) {
    Value v = read_range(r);
    if (accept_token(r, "=="))
        return value_number(value_equal(NULL, v, read_range(r)));
    if (accept_token(r, "<"))
        return value_number(value_compare(NULL, v, read_range(r)) == -1);
    if (accept_token(r, ">"))
        return value_number(value_compare(NULL, v, read_range(r)) == 1);
    return v;
}

static Value read_composition(Reader *r) {
    Vector vector = vector_new(&r->world->frame);
    do
        vector_add(&vector, read_comparison(r));
    while (accept_token(r, ";"));
    return vector_finish(&vector);
}

static Value evaluate(World *world, const char *text) {
    Reader reader = {world, text};
    Value v = read_composition(&reader);
    if (*reader.at && strncmp(reader.at, "=>", 2) != 0)
        fail_msg("stopped at: %s", reader.at);
    return v;
}

// Checks `EXPRESSION => VALUE` bit for bit, including the sign of zero. The check blocks of the specification have this
// format.
static bool check(World *world, const char *line) {
    Value actual = evaluate(world, line);
    Value expected = evaluate(world, strstr(line, " => ") + 4);
    assert_well_formed(actual);
    bool good = same_value(actual, expected);
    if (!good) {
        fprintf(stderr, "%s\n  gives ", line);
        print_value(actual);
    }
    arena_reset(&world->frame);
    return good;
}

static void check_all(World *world, const char *const *lines, size_t count) {
    size_t good = 0;
    for (size_t i = 0; i < count; i++)
        good += check(world, lines[i]);
    assert_int_equal(good, count);
}

#define CHECK_ALL(world, lines) check_all(world, lines, sizeof(lines) / sizeof((lines)[0]))
