// test_schema_reader.c: the table of nodes is consistent, and the reader follows it: defaults, limits, aliases,
// messages.
#include "schema.h"
#include "schema/help.h"

#include <math.h>
#include <stdlib.h>

typedef struct Given {
    const char *name;
    double x;
} Given;

// Reads a node with these attributes in two dimensions. f->reported receives the messages.
static void read_node(Fixture *f, NodeKind kind, const Given *given, uint32_t count, void *record) {
    Attr attrs[8];
    for (uint32_t i = 0; i < count; i++)
        attrs[i] = (Attr){symbol_intern(&f->symbols, str_from(given[i].name)), value_number(given[i].x)};
    const Symbol *name = symbol_intern(&f->symbols, str_from(schema_kinds[kind].name));
    const Node *node = node_set_attrs(&f->arena, node_new(&f->arena, name), attrs, count);
    const Reader reader = {&f->schema, &f->arena, node, kind, 2};
    f->reported[0] = 0;
    schema_defaults(kind, record);
    reader_fill(&reader, record);
}
#define READ(f, kind, record, ...)                                                                                     \
    read_node(f, kind, (const Given[]){__VA_ARGS__}, sizeof((const Given[]){__VA_ARGS__}) / sizeof(Given), record)

// The defaults in the help texts equal the actual defaults.
static void test_help_shows_defaults(void **state) {
    (void)state;
    for (int i = 0; i < ROW_COUNT; i++) {
        const SchemaRow *row = &schema_rows[i];
        const char *text = schema_help[i].default_text, *inherited = "inherited, initially ";
        if (row->default_value.inherited) {
            assert_memory_equal(text, inherited, strlen(inherited));
            text += strlen(inherited);
        }
        char *last;
        double x = strtod(text, &last);
        if (last > text && *last == 0)
            assert_number(schema_names[row->name], row->default_value.value, x);
        bool known = text[0] != ':';
        for (int w = 0; !known && w < WORD_COUNT; w++)
            known = schema_words[w].type == row->type && str_equal(schema_words[w].text, str_from(text + 1)) &&
                    schema_words[w].value == row->default_value.value;
        assert_true(known);
    }
}

static void test_rows_are_consistent(void **state) {
    (void)state;
    bool window = false;
    for (int kind = 0; kind < KIND_COUNT; kind++) {
        assert_true(schema_kinds[kind].place >= PLACE_TOP || !window); // kinds that occur only in windows come last
        window |= schema_kinds[kind].place >= PLACE_TOP;
    }
    for (int i = 0; i < ROW_COUNT; i++) {
        const SchemaRow *row = &schema_rows[i];
        assert_true(i == 0 || row->kind >= schema_rows[i - 1].kind); // schema_init needs this order
        assert_ptr_equal(schema_row(row->kind, row->name), row);
        if (!row->alias)
            continue;
        const SchemaRow *winner = schema_row(row->kind, row->alias);
        assert_true(winner && winner->field == row->field && winner->type == row->type);
    }
    assert_null(schema_row(KIND_GRAVITY, ATTR_POWER));
    for (int force = 0; force < PHYS_FORCE_KINDS; force++)
        assert_int_equal(schema_force(schema_kind_of_force(force)), force);
    assert_int_equal(schema_force(KIND_GROUP), PHYS_FORCE_KINDS);
}

static void test_values_are_limited(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    BodyAttrs body;
    ForceAttrs force;
    READ(&f, KIND_PARTICLE, &body, {"charge", -2}, {"radius", -1});
    assert_true(body.numbers.mass == 1 && body.numbers.radius == 0 && body.numbers.charge == -2);
    READ(&f, KIND_ADHESION, &force, {"overlap", 3}, {"strength", INFINITY});
    assert_true(force.force.overlap == 1 && force.force.strength == INFINITY && force.force.ease == 0);
    assert_string_equal(f.reported, "");
    READ(&f, KIND_ADHESION, &force, {"overlap", NAN});
    assert_true(force.force.overlap == 0.25);
    assert_string_equal(f.reported, "!adhesion overlap should be one number, not nan [bad-attribute]\n");
    f.schema.lint = true;
    READ(&f, KIND_PARTICLE, &body, {"mass", -1});
    assert_true(body.numbers.mass == 0);
    assert_string_equal(f.reported, "!particle mass=-1 is below 0 and counts as 0 [negative-value]\n");
    end(&f);
}

static void test_vectors_match_dimensions(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    ForceAttrs force;
    READ(&f, KIND_BUOYANCY, &force, {"density", 2});
    assert_true(force.force.vector[0] == 0 && force.force.vector[1] == -1);
    READ(&f, KIND_BUOYANCY, &force, {"gravity", 3});
    assert_true(force.force.vector[0] == 3 && force.force.vector[1] == 3);
    READ(&f, KIND_DRAG, &force, {"strength", 3});
    assert_null(force.force.vector);
    READ(&f, KIND_BARRIER, &force, {"normal", 4});
    assert_true(force.force.vector2[0] == 4 / sqrt(32));
    READ(&f, KIND_BARRIER, &force, {"normal", 0});
    assert_null(force.force.vector2);
    end(&f);
}

// An alias only has an effect if the main name is missing. The order of attributes does not matter.
static void test_main_names_override_aliases(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    ForceAttrs force;
    READ(&f, KIND_DISTANCE, &force, {"min", 2});
    assert_true(force.force.minimum == 2 && isnan(force.force.maximum));
    READ(&f, KIND_DISTANCE, &force, {"min", 2}, {"minimum", 3});
    assert_true(force.force.minimum == 3);
    READ(&f, KIND_DISTANCE, &force, {"minimum", 3}, {"min", 2});
    assert_true(force.force.minimum == 3);
    assert_string_equal(f.reported, "");
    READ(&f, KIND_DISTANCE, &force, {"minimum", NAN}, {"min", 2});
    assert_true(force.force.minimum == 2);
    assert_non_null(strstr(f.reported, "minimum should be one number"));
    end(&f);
}

static void test_mistakes_are_reported(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    BodyAttrs body = {0}; // anchors have no velocity attribute
    CounterAttrs counter;
    READ(&f, KIND_ANCHOR, &body, {"id", 7}, {"velocity", 1}, {"mss", 1});
    assert_string_equal(f.reported, "!anchor id=7 unknown attribute 'mss'; did you mean 'mass'? [unknown-attribute]\n");
    assert_null(body.numbers.velocity);
    READ(&f, KIND_COUNTER, &counter, {"qqqqqq", 1});
    assert_string_equal(f.reported, "!counter unknown attribute 'qqqqqq' [unknown-attribute]\n");
    assert_true(counter.rate.as.number == 0 && counter.minimum.len == 0 && counter.state.len == 0);
    assert_int_equal(f.schema.report_count, 2);
    end(&f);
}

TEST_GROUP(schema_reader) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_help_shows_defaults),         cmocka_unit_test(test_rows_are_consistent),
        cmocka_unit_test(test_values_are_limited),          cmocka_unit_test(test_vectors_match_dimensions),
        cmocka_unit_test(test_main_names_override_aliases), cmocka_unit_test(test_mistakes_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
