// fuzz_schema.c: fuzzes scripts that the input describes in terms of the schema: nodes of all kinds in the places where
// they are allowed (sometimes elsewhere), with their attributes, and nodes that several parents share. Values mostly
// have the type of the attribute. Three frames must be the same with the simplifier and one thread, and without it and
// with three threads. A frame is drawn with OpenGL if the length of the input is divisible by 8. If the variable
// PETRI_FUZZ_PRINT is set, the script is printed.
#include "petri-inspect.h"
#include "pictures.h"
#include "schema/table.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_NODES = 60, MAX_DEPTH = 5, MAX_SHARED = 4, FRAMES = 3 };

typedef struct Writer {
    FuzzText script;
    const uint8_t *data;
    size_t size;
    size_t at;
    int nodes;
    int shared; // number of names s0, s1… that are bound to nodes
} Writer;

// Returns the next byte of the input, or 0 at its end, modulo `count`.
static unsigned pick(Writer *writer, unsigned count) {
    return writer->at < writer->size ? writer->data[writer->at++] % count : 0;
}

static void add(Writer *writer, const char *text) {
    fuzz_append(&writer->script, text, strlen(text));
}

#define CHOOSE(writer, list) (list)[pick(writer, sizeof(list) / sizeof *(list))]

static const char *const NUMBERS[] = {"1",   "0",    "2",   "frame",  "-1",          "0.5",  "3",      "10",   "i",
                                      "0.1", "time", "7",   "-0",     "uniform(:u)", "1e9",  "-0.25",  "1e-9", "beat",
                                      "100", "1/0",  "0/0", "-1e300", "5e-324",      "1e18", "frame/3"};
static const char *const OTHERS[] = {"null", "''",    "'x'",        ":over",      "'../a.png'",  "(func(x) x)",
                                     "true", "1;'a'", "'\xc3\xa9'", "1..9",       "(0..0)",      "!node",
                                     "$:k",  "'s0'",  "50**3",      "hypot(1;2)", "(null;null)", "wave(beat)[..3]"};
static const char *const TEXTS[] = {"'a'", "'x.png'", "'b'", "'A b'", "''", "'../../x'", "'.'", "'s.obj'", "'100%\\n'"};
static const char *const FUNCTIONS[] = {"(func(x) hypot(x)-1)", "(func(x, y) x+y)", "(func(x) f(x))", "f",
                                        "(func(x) 'a')"};
static const char *const KEYS[] = {":k", ":k;1", "'t'", "7", ":m", "(:k;:velocity)", "i;:a"};
static const char *const IDS[] = {"i", "1", ":a", "'n'", "i;2", "frame", "i/2", "-0", "0"};

static void add_numbers(Writer *writer, unsigned count) {
    for (unsigned i = 0; i < count; i++) {
        add(writer, i ? ";" : "");
        add(writer, CHOOSE(writer, NUMBERS));
    }
    if (count == 0)
        add(writer, "null");
}

static void add_word(Writer *writer, AttrType type) {
    int count = 0, chosen;
    for (int i = 0; i < WORD_COUNT; i++)
        count += schema_words[i].type == type;
    chosen = count ? (int)pick(writer, (unsigned)count) : -1;
    for (int i = 0; i < WORD_COUNT && chosen >= 0; i++)
        if (schema_words[i].type == type && chosen-- == 0) {
            add(writer, ":");
            add(writer, schema_words[i].text.bytes);
            return;
        }
    add(writer, ":unknown");
}

// Adds a value of the type that the attribute expects.
static void add_typed(Writer *writer, const SchemaRow *row) {
    const TypeRow *type = &schema_types[row->type];
    const char *name = schema_names[row->name];
    switch (type->shape) {
    case SHAPE_VALUE:
        if (strcmp(name, "state") == 0)
            add(writer, CHOOSE(writer, KEYS));
        else
            add(writer, CHOOSE(writer, IDS));
        return;
    case SHAPE_PAIR:
        add_numbers(writer, 1 + pick(writer, 2));
        return;
    case SHAPE_TRIPLE:
        add_numbers(writer, pick(writer, 2) ? 3 : 1);
        return;
    case SHAPE_QUAD:
        add_numbers(writer, pick(writer, 2) ? 4 : 1);
        return;
    case SHAPE_NUMBERS:
    case SHAPE_VECTOR:
    case SHAPE_NORMAL:
    case SHAPE_COLOR:
        add_numbers(writer, 1 + pick(writer, 4));
        return;
    case SHAPE_POINTS:
    case SHAPE_LIST:
        add_numbers(writer, pick(writer, 2) && type->low > 0 ? (unsigned)type->low : pick(writer, 13));
        return;
    case SHAPE_TEXT:
        add(writer, CHOOSE(writer, TEXTS));
        return;
    case SHAPE_WORD:
    case SHAPE_WEIGHT:
        add_word(writer, (AttrType)row->type);
        return;
    case SHAPE_FUNCTION:
        add(writer, CHOOSE(writer, FUNCTIONS));
        return;
    default:
        add(writer, CHOOSE(writer, NUMBERS));
    }
}

static void add_attribute(Writer *writer, const SchemaRow *row) {
    unsigned kind = pick(writer, 16);
    add(writer, " ");
    add(writer, schema_names[row->name]);
    add(writer, "=");
    if (kind == 15) {
        add(writer, CHOOSE(writer, OTHERS));
    } else if (kind == 14) {
        add_numbers(writer, pick(writer, 20));
    } else if (kind == 13) {
        add(writer, "(");
        add_typed(writer, row);
        add(writer, " if frame > 1 else ");
        add_typed(writer, row);
        add(writer, ")");
    } else {
        add_typed(writer, row);
    }
}

// Adds `!kind` and some of its attributes. Those without which nodes are ignored are nearly always there.
static void add_head(Writer *writer, NodeKind kind) {
    add(writer, "!");
    add(writer, schema_kinds[kind].name);
    unsigned density = pick(writer, 8);
    for (int i = 0; i < ROW_COUNT; i++) {
        const SchemaRow *row = &schema_rows[i];
        bool usual = row->name == ATTR_STATE || row->name == ATTR_ID || row->name == ATTR_DIMENSIONS;
        if (row->kind == kind && (usual ? pick(writer, 16) < 15 : pick(writer, 8) > 7 - density))
            add_attribute(writer, row);
    }
}

static void add_indent(Writer *writer, int depth) {
    for (int i = 0; i < depth; i++)
        add(writer, "    ");
}

// Chooses a kind that is allowed in `children`, or sometimes any kind.
static NodeKind choose_kind(Writer *writer, PlaceKind children) {
    unsigned allowed[KIND_COUNT], count = 0;
    bool any = pick(writer, 32) == 31;
    for (unsigned i = 0; i < KIND_COUNT; i++)
        if (any || schema_can_contain((NodeKind)i, children) ||
            (children == PLACE_NOTHING && (schema_kinds[i].place == PLACE_SCENE || schema_kinds[i].place == PLACE_TOP)))
            allowed[count++] = i;
    return (NodeKind)allowed[count > 1 ? pick(writer, count) : 0];
}

static void add_nodes(Writer *writer, PlaceKind children, int depth);

static void add_children(Writer *writer, NodeKind kind, int depth) {
    if (depth < MAX_DEPTH && schema_kinds[kind].children != PLACE_NOTHING)
        add_nodes(writer, schema_kinds[kind].children, depth);
}

// Adds a node, a loop or a condition with a node, or a shared node.
static void add_node(Writer *writer, PlaceKind children, int depth) {
    static const char *const loops[] = {"for i in ..3", "for i in ..40", "for i in ..frame", "if frame % 2 == 0",
                                        "for i in 2;:a;-1"};
    unsigned form = pick(writer, 12);
    writer->nodes++;
    add_indent(writer, depth);
    if (form == 11 && writer->shared > 0) {
        char name[20];
        snprintf(name, sizeof name, "s%u\n", pick(writer, (unsigned)writer->shared));
        add(writer, name);
        return;
    }
    if (form >= 8) {
        add(writer, CHOOSE(writer, loops));
        add(writer, "\n");
        add_indent(writer, ++depth);
    }
    NodeKind kind = choose_kind(writer, children);
    add_head(writer, kind);
    add(writer, "\n");
    add_children(writer, kind, depth + 1);
}

static void add_nodes(Writer *writer, PlaceKind children, int depth) {
    for (unsigned i = 1 + pick(writer, 5); i > 0 && writer->nodes < MAX_NODES && writer->at < writer->size; i--)
        add_node(writer, children, depth);
}

// Binds names to nodes that contain each other several times, so that a tree of n nodes has up to 3^n paths.
static void add_shared(Writer *writer) {
    static const PlaceKind places[] = {PLACE_DRAWING, PLACE_PHYSICS, PLACE_SCENE3D, PLACE_PICTURES, PLACE_FILTER};
    PlaceKind place = CHOOSE(writer, places);
    for (unsigned i = pick(writer, MAX_SHARED + 1); i > 0; i--) {
        char name[40];
        snprintf(name, sizeof name, "let s%d=(", writer->shared);
        add(writer, name);
        add_head(writer, choose_kind(writer, place));
        if (writer->shared > 0) {
            snprintf(name, sizeof name, " << (s%d;s%d;s%d))\n", writer->shared - 1,
                     (int)pick(writer, (unsigned)writer->shared), writer->shared - 1);
            add(writer, name);
        } else {
            add(writer, ")\n");
        }
        writer->shared++;
    }
}

static void write_script(Writer *writer) {
    add(writer, "let i=4\nfunc f(x)\n    x*x\n");
    add_shared(writer);
    while (writer->at < writer->size && writer->nodes < MAX_NODES)
        add_node(writer, PLACE_NOTHING, 0);
}

typedef struct Run {
    FuzzText frames;
    uint8_t digest[16];
    bool aborted; // true if a limit was exceeded, which can happen in only one of the runs
} Run;

static Run run_script(const FuzzText *script, bool plain) {
    Run run = {0};
    PetriOptions options = fuzz_options();
    options.work_limit = 1 << 22; // about 40 ms without sanitizers
    options.profile = plain;
    options.threads = plain ? 3 : 1;
    options.tuning = &(PetriTuning){.size = sizeof(PetriTuning),
                                    .no_simplify = plain,
                                    .neighbours = plain ? PETRI_NEIGHBOURS_ALWAYS : PETRI_NEIGHBOURS_NEVER};
    PetriSession *session = fuzz_open(&options);
    PetriStatus loaded = petri_load_text(session, fuzz_file("fuzz.fl"), script->bytes, script->length);
    if (loaded == PETRI_INVALID)
        fuzz_fail("the script does not load:\n%.*s", (int)script->length, script->bytes);
    run.aborted = loaded != PETRI_OK;
    for (int i = 0; i < FRAMES && !run.aborted; i++) {
        run.aborted = petri_step(session) != PETRI_OK ||
                      petri_print(session, PETRI_PRINT_TREE | PETRI_PRINT_STATE | PETRI_PRINT_LOG, fuzz_append,
                                  &run.frames) != PETRI_OK;
        fuzz_check_frame(session);
        fuzz_check_state(session);
    }
    run.aborted |= fuzz_end_watch() || petri_digest(session, run.digest) != PETRI_OK;
    fuzz_close(&session);
    return run;
}

static void compare_runs(const FuzzText *script) {
    Run one = run_script(script, false), other = run_script(script, true);
    bool same =
        fuzz_texts_equal(&one.frames, &other.frames) && memcmp(one.digest, other.digest, sizeof one.digest) == 0;
    if (!same && !one.aborted && !other.aborted)
        fuzz_fail("frames differ without the simplifier and with threads:\n%.*s\n--- with the simplifier\n%.3000s\n--- "
                  "without\n%.3000s",
                  (int)script->length, script->bytes, one.frames.bytes ? one.frames.bytes : "",
                  other.frames.bytes ? other.frames.bytes : "");
    free(one.frames.bytes);
    free(other.frames.bytes);
}

FUZZ_HARNESS(schema) {
    static PetriPainter *painter; // reused for all inputs, because finding fonts takes long
    Writer writer = {.data = data, .size = size};
    write_script(&writer);
    if (getenv("PETRI_FUZZ_PRINT"))
        printf("%.*s", (int)writer.script.length, writer.script.bytes);
    compare_runs(&writer.script);
    if (size % 8 == 0) {
        painter = painter ? painter : petri_painter_open();
        pictures_draw(painter, writer.script.bytes, writer.script.length, true);
    }
    free(writer.script.bytes);
    return 0;
}
