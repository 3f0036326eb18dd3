// image_files.c: see image_files.h.
#include "link/image_files.h"

#include "base/str.h"
#include "cli/memory.h"

#include <string.h>

// A display list that is read from its start. All positions are at most `count`.
typedef struct Reader {
    const double *numbers;
    size_t count;
    size_t at;
    ImageFileCallback *found;
    void *user_data;
} Reader;

static void skip(Reader *reader, size_t numbers) {
    reader->at += numbers < reader->count - reader->at ? numbers : reader->count - reader->at;
}

static size_t next(Reader *reader) {
    return reader->at < reader->count ? (size_t)reader->numbers[reader->at++] : 0;
}

static void skip_list(Reader *reader) {
    skip(reader, next(reader));
}

static void skip_stops(Reader *reader) {
    skip(reader, 5 * next(reader));
}

static void skip_pixels(Reader *reader) {
    size_t width = next(reader);
    skip(reader, width * next(reader));
}

// Reads a string, which is the name of a file if the operand has the name `file`.
static void read_string(Reader *reader, const char *operand) {
    SCOPED_TEXT name = {0};
    for (size_t left = next(reader); left > 0 && reader->at < reader->count; left--) {
        char bytes[UTF8_MAX];
        text_add(&name, (Str){bytes, utf8_encode((uint32_t)next(reader), bytes)});
    }
    if (name.len > 0 && strcmp(operand, "file") == 0)
        reader->found(reader->user_data, name.bytes);
}

// A function for each command, which reads its operands. The operand PAINT is a command, which is read next.
#define PETRI_COMMAND(name, operands, text)                                                                            \
    static void read_##name(Reader *reader) {                                                                          \
        (void)reader;                                                                                                  \
        operands                                                                                                       \
    }
#define NUMBER(name) skip(reader, 1);
#define FLAG(name) skip(reader, 1);
#define ALPHA(name) skip(reader, 1);
#define WORD(name, words) skip(reader, 1);
#define PAIR(name) skip(reader, 2);
#define NUMBERS(name, count) skip(reader, count);
#define MATRIX(name) skip(reader, 6);
#define COLOUR(name) skip(reader, 4);
#define PATH(name) skip_list(reader);
#define LIST(name) skip_list(reader);
#define FILTER(name) skip_list(reader);
#define EFFECT(name) skip_list(reader);
#define STOPS(name) skip_stops(reader);
#define PIXELS(name) skip_pixels(reader);
#define STRING(name) read_string(reader, #name);
#define PAINT(name)
#include "petri-display-list.inc"
static void (*const READERS[])(Reader *) = {
#define PETRI_COMMAND(name, operands, text) [PETRI_DRAW_##name] = read_##name,
#include "petri-display-list.inc"
};

void image_files_find(PetriPicture *picture, ImageFileCallback *found, void *user_data) {
    Reader reader = {.found = found, .user_data = user_data};
    if (petri_picture_display_list(picture, &reader.numbers, &reader.count) != PETRI_OK)
        return;
    skip(&reader, 3); // width, height and a flag
    while (reader.at < reader.count) {
        size_t command = next(&reader);
        if (command >= sizeof READERS / sizeof READERS[0] || !READERS[command])
            return;
        READERS[command](&reader);
    }
}
