// seeds.c: writes the first inputs of the fuzzers, made from petri's tables. usage: fuzz_seeds FOLDER
// FOLDER/dictionary is libFuzzer's dictionary; FOLDER/NAME contains inputs for harness NAME.
#include "cli/cli.h"
#include "petri-draw.h"
#include "petri.h"
#include "repl/repl.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

const Command *const COMMANDS[] = {&RUN_COMMAND, NULL};

const Command *command_find(const char *name) {
    (void)name;
    return NULL;
}

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
    for (size_t i = 0; petri_builtin(i, &builtin); i++)
        add_word(file, builtin.name);
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        fprintf(file, "\"!%s\"\n", kind.name);
        for (size_t j = 0; petri_node_attribute(i, j, &attribute); j++)
            fprintf(file, "\" %s=\"\n", attribute.name);
    }
    for (size_t i = 0; i < sizeof TOPICS / sizeof TOPICS[0]; i++)
        add_word(file, TOPICS[i]);
    for (size_t i = 0; i < sizeof SIGNS / sizeof SIGNS[0]; i++)
        add_word(file, SIGNS[i]);
    for (size_t i = 0; repl_command_at(i); i++)
        fprintf(file, "\"%s \"\n", repl_command_at(i)->name);
    for (const OptionSpec *option = OPTIONS; option->name; option++)
        fprintf(file, "\"--%s\"\n", option->name);
    fclose(file);
}

static void write_builtins(void) {
    PetriBuiltin builtin;
    for (size_t i = 0; petri_builtin(i, &builtin); i++)
        seed("script", builtin.name,
             "let v=3;1;2\n!a x=%s(frame/7) y=%s(v, 0.5) z=%s('a b', 2) w=%s(v, v, 1;2;3) n=%s()\n", builtin.name,
             builtin.name, builtin.name, builtin.name, builtin.name);
}

// Writes a script for each kind of node with each attribute, at a place in the tree where such a node is valid.
static void write_nodes(void) {
    static const char *const values[] = {"1;2", ":a", "frame/3", "'x'", "0.5", "1e308;0", "0"};
    PetriNodeKind kind;
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_kind(i, &kind); i++) {
        char name[80], text[2000];
        int size = 0;
        bool physics = strcmp(kind.area, "physics") == 0;
        snprintf(name, sizeof name, "node-%s-%s", kind.area, kind.name);
        for (size_t j = 0; petri_node_attribute(i, j, &attribute) && size < 1500; j++)
            size += snprintf(text + size, sizeof text - (size_t)size, " %s=%s", attribute.name,
                             values[(i + j) % (sizeof values / sizeof values[0])]);
        text[size] = 0;
        seed(physics ? "script" : "draw", name, "%s    !%s%s\n%s!%s state=:t%s\n",
             physics ? "!physics state=:s dimensions=2\n    !particle id=0\n    !particle id=1 position=1;0 mass=2\n"
                     : "!window size=60;40\n    !canvas\n        !path\n            !move_to point=1;2\n    ",
             kind.name, text, physics ? "" : "        ", kind.name, text);
    }
}

static void write_commands(void) {
    for (size_t i = 0; repl_command_at(i); i++) {
        const char *name = repl_command_at(i)->name;
        if (strcmp(name, ".quit") != 0)
            seed("repl", name + 1, ".step 3\n%s\n%s 2\n%s :cells\n%s SIZE 3\n.step\n%s x.out\n", name, name, name, name,
                 name);
    }
    for (const OptionSpec *option = OPTIONS; option->name; option++) {
        FILE *file = open_seed("arguments", option->name);
        fprintf(file, "--%s%c%s%c%s%c--frames%c2", option->name, 0, option->value ? "3" : "x.fl", 0, "x.fl", 0, 0);
        fclose(file);
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
    static const char *const folders[] = {"",      "script", "simplify", "draw",   "prompt",    "clock",
                                          "state", "files",  "image",    "golden", "arguments", "repl"};
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
    write_others();
    write_image();
    return 0;
}
