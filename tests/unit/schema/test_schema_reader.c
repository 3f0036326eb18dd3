// The table of nodes agrees with itself, and the one reader follows its rows: defaults, limits, aliases, complaints.
#include "schema.h"

#include <math.h>
#include <stdlib.h>

typedef struct Given {
    const char *name;
    double x;
} Given;

// Reads a node with these attributes in two dimensions; `told` is what was said.
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

// What help says of defaults is what is taken.
static void test_texts(void **state) {
    (void)state;
    for (int i = 0; i < ROW_COUNT; i++) {
        const SchemaRow *row = &schema_rows[i];
        const char *text = row->default_value.text, *inherited = "inherited, at first ";
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

static void test_rows(void **state) {
    (void)state;
    bool window = false;
    for (int kind = 0; kind < KIND_COUNT; kind++) {
        assert_true(schema_kinds[kind].place >= PLACE_TOP || !window); // those of windows come last
        window |= schema_kinds[kind].place >= PLACE_TOP;
    }
    for (int i = 0; i < ROW_COUNT; i++) {
        const SchemaRow *row = &schema_rows[i];
        assert_true(i == 0 || row->kind >= schema_rows[i - 1].kind); // as schema_init takes them
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

static void test_limits(void **state) {
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

static void test_vectors(void **state) {
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

// The other name counts only where the first is not given, in whatever order.
static void test_aliases(void **state) {
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

static void test_complaints(void **state) {
    (void)state;
    Fixture f;
    begin(&f);
    BodyAttrs body = {0}; // no row of an anchor names its velocity
    CounterAttrs counter;
    READ(&f, KIND_ANCHOR, &body, {"id", 7}, {"velocity", 1}, {"mss", 1});
    assert_string_equal(f.reported, "!anchor id=7 unknown attribute 'mss', did you mean 'mass'? [unknown-attribute]\n");
    assert_null(body.numbers.velocity);
    READ(&f, KIND_COUNTER, &counter, {"qqqqqq", 1});
    assert_string_equal(f.reported, "!counter unknown attribute 'qqqqqq' [unknown-attribute]\n");
    assert_true(counter.rate.as.number == 0 && counter.minimum.len == 0 && counter.state.len == 0);
    assert_int_equal(f.schema.report_count, 2);
    end(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_texts),   cmocka_unit_test(test_rows),    cmocka_unit_test(test_limits),
        cmocka_unit_test(test_vectors), cmocka_unit_test(test_aliases), cmocka_unit_test(test_complaints),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
