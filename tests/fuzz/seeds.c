// seeds.c: writes the first inputs of the fuzzers, made from petri's tables. usage: fuzz_seeds FOLDER
// FOLDER/dictionary is libFuzzer's dictionary; FOLDER/NAME contains inputs for harness NAME.
#include "cli/args.h"
#include "cli/cells.h"
#include "cli/hdf5.h"
#include "petri-draw.h"
#include "petri-edit.h"
#include "prompt/prompt.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// The commands of the harness `arguments`.
static const Command *const COMMANDS[] = {&RUN_COMMAND, &RENDER_COMMAND, &VIEW_COMMAND, &REPL_COMMAND};

static const char *const TOPICS[] = {
#define TOPIC(word, usage, help) word,
#include "cli/topic_list.h"
};
static const char *const SIGNS[] = {
    "\n    ", "\n        ", "..",     "<<",     "//",       "**",        "==",
    "!=",     "<=",         ">=",     "--",     "%pragma ", "%include ", "1e308",
    "0/0",    "1/0",        "5e-324", "\"\"\"", "\\u00e9",  "1:00",      "9007199254740993"};

static const char *root;

static void make_folder(const char *name) {
    char path[600];
    snprintf(path, sizeof path, "%s/%s", root, name);
    if (mkdir(path, 0777) != 0 && errno != EEXIST) {
        perror(path);
        exit(1);
    }
}

static FILE *open_seed(const char *folder, const char *name) {
    char path[900];
    snprintf(path, sizeof path, "%s/%s%s%s", root, folder, folder[0] ? "/" : "", name);
    FILE *file = fopen(path, "wb");
    if (!file) {
        perror(path);
        exit(1);
    }
    return file;
}

static void write_seed(const char *folder, const char *name, const void *bytes, size_t size) {
    FILE *file = open_seed(folder, name);
    fwrite(bytes, 1, size, file);
    fclose(file);
}

__attribute__((format(printf, 3, 4))) static void seed(const char *folder, const char *name, const char *format, ...) {
    char text[4000];
    va_list list;
    va_start(list, format);
    int size = vsnprintf(text, sizeof text, format, list);
    va_end(list);
    write_seed(folder, name, text, (size_t)size);
}

static void add_word(FILE *file, const char *word) {
    fputc('"', file);
    for (; *word; word++)
        if (*word == '"' || *word == '\\' || *word < ' ')
            fprintf(file, "\\x%02x", (unsigned char)*word);
        else
            fputc(*word, file);
    fputs("\"\n", file);
}

static void write_dictionary(void) {
    FILE *file = open_seed("", "dictionary");
    PetriBuiltin builtin;
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++)
        add_word(file, builtin.name);
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        fprintf(file, "\"!%s\"\n", kind.name);
        for (size_t j = 0; petri_node_attribute(i, j, &attribute, sizeof attribute); j++)
            fprintf(file, "\" %s=\"\n", attribute.name);
    }
    for (size_t i = 0; i < sizeof TOPICS / sizeof TOPICS[0]; i++)
        add_word(file, TOPICS[i]);
    for (size_t i = 0; i < sizeof SIGNS / sizeof SIGNS[0]; i++)
        add_word(file, SIGNS[i]);
    for (size_t i = 0; prompt_command_at(i); i++)
        fprintf(file, "\"%s \"\n", prompt_command_at(i)->name);
    for (size_t i = 0; i < sizeof COMMANDS / sizeof COMMANDS[0]; i++)
        for (const OptionSpec *option = command_options(COMMANDS[i]); option->name; option++)
            fprintf(file, "\"--%s\"\n", option->name);
    fclose(file);
}

static void write_builtins(void) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin, sizeof builtin); i++)
        seed("script", builtin.name,
             "let v=3;1;2\n!a x=%s(frame/7) y=%s(v, 0.5) z=%s('a b', 2) w=%s(v, v, 1;2;3) n=%s()\n", builtin.name,
             builtin.name, builtin.name, builtin.name, builtin.name);
}

// An area of node kinds (PetriNodeKind.area), and the harness and script of its seeds. The script ends with the
// indentation of the first node. Nodes of the area "canvas" are also seeds of another harness, as nodes of a window.
typedef struct NodeArea {
    const char *name;
    const char *harness;
    const char *script;
    const char *indentation; // of a second node
} NodeArea;

static const NodeArea AREAS[] = {
    {"physics", "script",
     "!physics state=:s dimensions=2\n    !particle id=0\n    !particle id=1 position=1;0 mass=2\n    ", ""},
    {"canvas3d", "scene", "!window size=8\n    !canvas3d\n        !light color=1\n        !box\n        ", "        "},
    {"canvas", "draw", "!window size=60;40\n    !canvas\n        !path\n            !move_to point=1;2\n        ",
     "        "},
    {"canvas", "effects", "!window size=8\n    !canvas id='c'\n        !rect size=5 fill=true color=1;0;0\n    ",
     "    "},
};

// Writes a script for each kind of node with each attribute, at a place in the tree where such a node is valid.
static void write_nodes(void) {
    static const char *const values[] = {"1;2", ":a", "frame/3", "'x'", "0.5", "1e308;0", "0"};
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        char name[80], text[2000];
        int size = 0;
        snprintf(name, sizeof name, "node-%s-%s", kind.area, kind.name);
        for (size_t j = 0; petri_node_attribute(i, j, &attribute, sizeof attribute) && size < 1500; j++)
            size += snprintf(text + size, sizeof text - (size_t)size, " %s=%s", attribute.name,
                             values[(i + j) % (sizeof values / sizeof values[0])]);
        text[size] = 0;
        for (size_t j = 0; j < sizeof AREAS / sizeof AREAS[0]; j++)
            if (strcmp(AREAS[j].name, kind.area) == 0)
                seed(AREAS[j].harness, name, "%s!%s%s\n%s!%s state=:t%s\n", AREAS[j].script, kind.name, text,
                     AREAS[j].indentation, kind.name, text);
    }
}

static void write_commands(void) {
    for (size_t i = 0; prompt_command_at(i); i++) {
        const char *name = prompt_command_at(i)->name;
        if (strcmp(name, ".quit") != 0)
            seed("repl", name + 1, ".step 3\n%s\n%s 2\n%s :cells\n%s SIZE 3\n.step\n%s x.out\n", name, name, name, name,
                 name);
    }
    seed("repl", "moves",
         ".step 3\n.move 1 position=2;3 velocity=prev($(:cells;1))\n.step 2\n.move (:cells;0) velocity=_\n.set SIZE 1\n"
         ".back 3\n.step 4\n.goto 2\n.move 0 position=$(:cells;0)*1e200\n.step\n.reset\n");
    for (size_t i = 0; i < sizeof COMMANDS / sizeof COMMANDS[0]; i++) {
        for (const OptionSpec *option = command_options(COMMANDS[i]); option->name; option++) {
            FILE *file = open_seed("arguments", option->name);
            fprintf(file, "--%s%c%s%c%s%c--frames%c2", option->name, 0, option->value ? "3" : "x.fl", 0, "x.fl", 0, 0);
            fclose(file);
        }
    }
}

static void write_clock(void) {
    static const double values[] = {1e-300, 1e300, 60, 0.5, 2147483648.0, 9007199254740992.0, 1e17, 5e-324, 1e9, 1};
    for (int what = 0; what < 16; what++) {
        char name[20], text[200];
        size_t size = 0;
        for (size_t i = 0; i < sizeof values / sizeof values[0]; i++, size += sizeof(double)) {
            text[size++] = (char)((i % 2 ? what >> 1 : what) | (what & 8 ? 128 : 0));
            memcpy(text + size, &values[i], sizeof(double));
        }
        snprintf(name, sizeof name, "clock-%d", what);
        write_seed("clock", name, text, size);
    }
}

// Writes systems that change from frame to frame (fuzz_physics.c).
static void write_systems(void) {
    for (int what = 0; what < 16; what++) {
        char name[20];
        uint8_t text[8 * 6];
        for (int i = 0; i < 48; i += 6) {
            int frame = i / 6;
            text[i] = (uint8_t)(frame < 4 ? 1 + what % 2 : 224 + (what * 7 + frame * 11) % 32);       // dimensions
            text[i + 1] = (uint8_t)(what % 4 == 3 ? 5 + 9 * frame : what < 2 ? 255 : 20);             // particles
            text[i + 2] = (uint8_t)(what % 8 < 6 ? 0 : 130 + frame);                                  // in a group
            text[i + 3] = (uint8_t)(frame % 4 < 3 || what % 4 < 2 ? 1 : 1 << (what + frame) % 8 | 1); // forces
            text[i + 4] = (uint8_t)(what < 8 ? 0 : what * 29 + frame * 3);                            // more forces
            text[i + 5] = (uint8_t)(what * 17 + frame / 2);                                           // attributes
        }
        snprintf(name, sizeof name, "system-%d", what);
        write_seed("physics", name, text, sizeof text);
    }
}

static void write_others(void) {
    seed("prompt", "all",
         "1+A\x1e\x01\x1e\x02\x1elet x=frame\x1e!s v=x\x1e\x01\x1e\x03\x1e\x06x*2\x1e\x07\x1e\x08\x1e\x0c<\x02\x1e"
         "\x0f\x1e\x10"
         "22\x01\x1e\x11"
         "7\x1e\x01\x1e\x04\x1e\x05\x1e\x0b\x1e\x01\x1e\x0e!b x=$:n\n");
    seed("state", "state",
         " petri-state 1\nframe 9\n$(:c) = 0\n$(:c;0) = 1.5;-2\n$(:c;0;:velocity) = 0;1e300\n$('k';3) = 'x';:a\n"
         "$(:n) = 2\n$(:n;:time) = 0.5\nsystem 0 $(:c)\nparticle $(:c;0)\n");
    seed("files", "csv", "%ca,b,\"c \"\"d\"\"\"\n1,2.5,-3e7\n\n:x,inf,\n", 0);
    seed("files", "srt", "%c1\n00:00:01,000 --> 00:00:02,500\none\ntwo\n\n2\n00:00:03,000 --> 00:00:04,000\nthree\n",
         1);
    seed("files", "text", "%cone two\n\xc3\xa9\n", 2);
    seed("files", "bytes", "%c\x01\xff\x80", 3);
    seed("files", "module", "%clet x=2*frame\nfunc f(a)\n    a*2\n", 4);
    seed("golden", "golden",
         "# run --frames 2 --print state\n# tolerance 1e-9\n# horizon 40 strict 25\n@0 time=0 beat=0\n$:a = 1;2\n"
         "\x1e@0 time=0 beat=0\n$:a = 1;2.0000001\n");
}

// Writes inputs of the harnesses that read files and messages of strangers. Inputs that are more than a few lines are
// in corpus/.
static void write_foreign(void) {
    seed(
        "link", "json",
        "{\"v\":1,\"t\":\"!a x=1\\n\",\"n\":\"a.fl\",\"c\":[[3,\"A\",\"2\"],[-1,\"B\",\"1;2\"]],\"f\":9,\"h\":\"ab\"}");
    seed("link", "text", "#q1bKU7JSKlHSUcpTslJKVIBTSUBWbmJSVl5icmoJlAIA");
    seed("plan", "plan",
         "script: a.fl\nframes: 3\ndefine:\n  A: 1..3\n  B: [0.5, (1;2), 3]\n  C: 0..1|0.25\nmetric:\n  x: $:n\n"
         "seeds: 2\nquiet: true\noutput: a.csv\nsummary: b.csv\nevery: 2\nuntil: x>3\nshard: 1/2\n");
    seed("plan", "json",
         "{\"script\": \"a.fl\", \"define\": {\"A\": \"0..1\", \"B\": 2}, \"sample\": \"latin:9:1\"}\n");
    seed("resume", "csv",
         "%cframe,time,system,id,anchor,x1,x2,v1,v2,radius,mass,charge\n0,0,:a,1,0,1,2,3,4,1,1,0\n1,0.1,:a,1,0,1,2,3,4,"
         "1,1,0\n",
         3);
    seed("resume", "xyz",
         "%c1\nProperties=species:S:1:pos:R:3:vel:R:3 Time=0 Frame=0\nX 1 2 3 0 0 0\n0\n"
         "Properties=species:S:1:pos:R:3: Time=0 Frame=1\n",
         4);
    seed("terminal", "keys",
         "aB1 \x1b[A\x1b[1;5C\x1bOP\x1b[15~\x1b[<0;12;7M\x1b[<0;12;7m\x1b[O\x1b[I\x1b[97;5u\xc3\xa9\x1b");
    seed("listen", "texts",
         "!b x=2\x1e.set SIZE 5\x1e.back 2\x1e.set SIZE\x1e.drop\x1e.reset\x1e"
         "1+SIZE\x1e.move 0 position=3;4\x1e.back\x1e.move :cells;1 velocity=1/0\x1elet x=\x1e.back x");
    seed("mesh", "obj",
         "%cv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 1\nvn 0 0 1\nf 1/1/1 2//1 3\nf -1 -2 1\nf 1 2 3 4\n", 2);
    seed("mesh", "stl",
         "%csolid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
         "0\nendloop\nendfacet\nendsolid a\n",
         10);
    seed("mesh", "off", "%cOFF\n3 1 0\n0 0 0\n1 0 0 # corner\n0 1 0\n3 0 1 2\n", 2);
    seed("mesh", "ply",
         "%cply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "property float nz\nproperty float s\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
         "0 0 0 1 0\n1 0 0 1 1\n0 1 0 1 0\n3 0 1 2\n",
         2);
    seed("mesh", "binary_ply",
         "%cply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty char x\nproperty short y\n"
         "property double z\nelement face 1\nproperty list uchar int8 vertex_index\nend_header\n"
         "a01aaaa1234b01aaaa1234c23aaaa123411",
         2);
    seed("mesh", "hull", "%c\x01\x01\x01\x05\x01\x02\x01\x07\x03\x09\x03\x04\x02\x02\x06\x08\x03\x05", 99);
    seed("h5md", "changes", "\x03\x02\x05\x01\x04\x0a\x01\x03\x05\x07\x02\x01\x02\x0e\x0d\x06");
    seed("effects", "uniforms",
         "!window size=24;16\n    !shader fragment=FRAGMENT a=1 b=1;2 c=1;2;3 d=4 e=1;0;0;1 f=1 g=time h=3 i=1;2;3 j=7 "
         "k=true "
         "l=1;0 m=1;2;3;4;5 n=1;2;3;4;5;6;7;8 shift=0.5;1 passes=3 downsample=2 downsample_passes=1\n"
         "        !canvas\n            !rect size=9 fill=true color=1;0;0\n");
    seed("effects", "rejected",
         "!window size=9\n    !shader fragment=\"\"\"${HEADER}\nvoid main() {\n    colour = blue;\n}\n\"\"\"\n\x1e"
         "0:3(5): error: `blue' undeclared\n");
}

// Writes frames of an H5MD trajectory, as petri sends them to petri-hdf5.
static void write_frames(void) {
    struct {
        Hdf5Frame frame;
        char texts[8];
        Hdf5System system;
        char name[8];
        double numbers[7];
        int64_t id, anchor;
    } frame = {
        .frame = {0, 0.5, 8, 1, 1}, .texts = "a", .system = {1, 2, 8, 0, 0}, .name = ":s", .numbers = {1, 2}, .id = -2};
    char all[2 * sizeof frame + 1];
    memcpy(all, &frame, sizeof frame);
    all[sizeof frame] = 30;
    frame.frame.number = 1;
    frame.frame.text_count = 0;
    memcpy(all + sizeof frame + 1, &frame, sizeof frame);
    write_seed("spool", "frames", all, sizeof all);
}

// Writes results of two runs of a sweep (fuzz_journal.c).
static void write_results(void) {
    SCOPED_TEXT text = {0};
    for (int run = 1; run <= 2; run++) {
        text_add_format(&text, run == 1 ? "\x01\x03" : "\x1e\x02\x05");
        cell_add(&text, (Cell){CELL_INTEGER, {.integer = run}});
        cell_add(&text, (Cell){CELL_NUMBER, {.number = 1.5}});
        cell_add(&text, run == 1 ? (Cell){.kind = CELL_NONE} : (Cell){CELL_TEXT, {.text = "1;2"}});
        cell_add(&text, run == 1 ? (Cell){.kind = CELL_NONE} : (Cell){CELL_TEXT, {.text = "an error"}});
    }
    write_seed("journal", "results", text.bytes, text.len);
}

// Descriptions of nodes: each byte is a choice (fuzz_schema.c).
static void write_choices(void) {
    enum { SEEDS = 40, LENGTH = 256 };
    uint32_t number = 1;
    for (int i = 0; i < SEEDS; i++) {
        unsigned char bytes[LENGTH];
        char name[12];
        for (int j = 0; j < LENGTH; j++)
            bytes[j] = (unsigned char)((number = number * 1664525 + 1013904223) >> 24);
        snprintf(name, sizeof name, "%d", i);
        write_seed("schema", name, bytes, LENGTH - (size_t)(i % 3));
    }
}

// The messages that an editor sends, apart from those that open a document.
static const char *const METHODS[] = {
    "completion",        "hover",         "signatureHelp",     "definition",   "references",
    "documentHighlight", "prepareRename", "documentSymbol",    "foldingRange", "semanticTokens/full",
    "inlayHint",         "documentColor", "colorPresentation", "codeAction",   "formatting"};

// Each input opens a document, changes it, sends a request and closes the document.
static void write_editor_messages(void) {
    static const char document[] = "\"textDocument\":{\"uri\":\"file:///a.fl\"}";
    static const char range[] = "{\"start\":{\"line\":0,\"character\":0},\"end\":{\"line\":2,\"character\":3}}";
    for (size_t i = 0; i < sizeof METHODS / sizeof METHODS[0]; i++) {
        char name[40];
        snprintf(name, sizeof name, "%zu", i);
        seed(
            "lsp", name,
            "{\"method\":\"textDocument/didOpen\",\"params\":{\"textDocument\":{\"uri\":\"file:///a.fl\",\"version\":1,"
            "\"text\":\"import part from 'part.fl'\\nlet x=3 -- 1..9 how many\\nfunc f(a)\\n    a*x+part\\n"
            "!window size=2;1\\n    !canvas color=1;0;0\\n        !rect size=f(x)\\n\"}}}\x1e"
            "{\"method\":\"textDocument/didChange\",\"params\":{%s,\"contentChanges\":[{\"range\":%s,\"text\":\"let "
            "y=\"}]}}\x1e"
            "{\"id\":%zu,\"method\":\"textDocument/%s\",\"params\":{%s,\"position\":{\"line\":3,\"character\":7},"
            "\"range\":%s,\"context\":{\"includeDeclaration\":true,\"diagnostics\":[]},"
            "\"color\":{\"red\":1,\"green\":0,\"blue\":0.5,\"alpha\":1},\"newName\":\"z\",\"options\":{\"tabSize\":4}}}"
            "\x1e"
            "{\"method\":\"textDocument/didClose\",\"params\":{%s}}",
            document, range, i, METHODS[i], document, range, document);
    }
}

// Draws a PNG file, because the harness's input is an encoded image.
static void write_image(void) {
    PetriOptions options = petri_default_options();
    PetriPictureOptions how = petri_default_picture_options();
    PetriSession *session = petri_open(&options);
    PetriPainter *painter = petri_painter_open();
    PetriPicture *picture = NULL;
    char path[600];
    snprintf(path, sizeof path, "%s/image/picture.png", root);
    if (session && painter &&
        petri_load_text(session, "x",
                        "!window size=9\n    !canvas\n        !rect size=5\n        !fill color=1;0;0.5\n",
                        PETRI_NUL_TERMINATED) == PETRI_OK &&
        petri_step(session) == PETRI_OK && petri_picture(session, &how, &picture) == PETRI_OK)
        petri_picture_save(picture, painter, path);
    petri_picture_free(&picture);
    petri_painter_close(&painter);
    petri_close(&session);
}

int main(int argc, char **argv) {
    static const char *const folders[] = {"",          "script",   "simplify", "draw",  "effects", "scene", "mesh",
                                          "prompt",    "clock",    "physics",  "state", "files",   "image", "golden",
                                          "arguments", "repl",     "link",     "plan",  "journal", "lsp",   "resume",
                                          "fmt",       "terminal", "listen",   "spool", "h5md",    "schema"};
    if (argc != 2) {
        fputs("usage: fuzz_seeds FOLDER\n", stderr);
        return 2;
    }
    root = argv[1];
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++)
        make_folder(folders[i]);
    write_dictionary();
    write_builtins();
    write_nodes();
    write_commands();
    write_clock();
    write_systems();
    write_others();
    write_foreign();
    write_editor_messages();
    write_frames();
    write_results();
    write_choices();
    write_image();
    return 0;
}
