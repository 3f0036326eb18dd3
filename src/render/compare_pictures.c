// compare_pictures.c: the command `petri --compare-pictures OLD.png NEW.png TOLERANCE [OUT.png]`, which petri test
// executes. Exits with 0 if no channel of a pixel differs by more than TOLERANCE of 255. Otherwise prints the number of
// such pixels, writes both pictures and their difference side by side to OUT.png, and exits with 1; after an error,
// with 2.
//
// A script with !image nodes reads the files and draws the result, so the formats are those that scripts can read.
#include "cli/memory.h"
#include "cli/options.h"
#include "cli/output.h"
#include "petri-draw.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SAME = 0, DIFFERS = 1, TROUBLE = 2, GAP = 8 };

typedef struct PngFile {
    const char *path;
    int width;
    int height;
} PngFile;

// Reads the size from the header of a PNG file. Returns false after a message.
static bool read_size(PngFile *png, const char *path) {
    unsigned char head[24] = {0};
    FILE *file = fopen(path, "rb");
    bool good = file && fread(head, 1, sizeof head, file) == sizeof head && memcmp(head, "\x89PNG", 4) == 0;
    if (file)
        fclose(file);
    png->path = path;
    png->width = head[18] << 8 | head[19];
    png->height = head[22] << 8 | head[23];
    good = good && head[16] + head[17] + head[20] + head[21] == 0 && png->width > 0 && png->height > 0;
    if (!good)
        message("cannot read %s: it is not a PNG file of at most 65535x65535 pixels", path);
    return good;
}

static void add_image(Text *script, int indent, const PngFile *png, int x) {
    text_add_format(script, "%*s!image point=%d;0 filename='", indent, "", x);
    for (const char *c = png->path; *c != '\0'; c++)
        text_add_format(script, *c == '\'' || *c == '\\' ? "\\%c" : *c == '\n' ? "\\n" : "%c", *c);
    text_add_c(script, "'\n");
}

static void print_problem(void *context, const PetriDiagnostic *diagnostic) {
    (void)context;
    fputs(diagnostic->rendered, stderr);
}

// A drawn script.
typedef struct Drawing {
    PetriSession *session;
    PetriPainter *painter;
    PetriPicture *picture;
} Drawing;

static void close_drawing(Drawing *drawing) {
    petri_picture_free(&drawing->picture);
    petri_painter_close(&drawing->painter);
    petri_close(&drawing->session);
}

// Returns false after a message.
static bool draw(Drawing *drawing, const CommandContext *host, const Text *script) {
    PetriOptions wanted = petri_default_options();
    PetriPictureOptions options = petri_default_picture_options();
    wanted.stack_limit = host->stack_bytes;
    wanted.read_folders = (const char *const[]){"/", NULL};
    wanted.on_diagnostic = print_problem;
    drawing->session = petri_open(&wanted);
    drawing->painter = petri_painter_open();
    return drawing->session && drawing->painter &&
           petri_load_text(drawing->session, "pictures", script->bytes, script->len) == PETRI_OK &&
           petri_step(drawing->session) == PETRI_OK &&
           petri_picture(drawing->session, &options, &drawing->picture) == PETRI_OK;
}

// Reads the pixels of a file. The caller frees them. Returns NULL after a message.
static uint32_t *read_pixels(const CommandContext *host, const PngFile *png) {
    Drawing drawing = {0};
    SCOPED_TEXT script = {0};
    uint32_t *pixels = memory_calloc((size_t)png->width * (size_t)png->height * sizeof *pixels);
    text_add_format(&script, "!offscreen size=%d;%d\n    !canvas\n", png->width, png->height);
    add_image(&script, 8, png, 0);
    if (!draw(&drawing, host, &script) ||
        petri_picture_draw(drawing.picture, drawing.painter, pixels, png->width, png->height,
                           (size_t)png->width * sizeof *pixels) != PETRI_OK) {
        free(pixels);
        pixels = NULL;
    }
    close_drawing(&drawing);
    return pixels;
}

// Writes both pictures and the absolute difference of their colours.
static bool write_comparison(const CommandContext *host, const PngFile *pictures, const char *file) {
    Drawing drawing = {0};
    SCOPED_TEXT script = {0};
    int width = pictures[0].width > pictures[1].width ? pictures[0].width : pictures[1].width;
    int height = pictures[0].height > pictures[1].height ? pictures[0].height : pictures[1].height;
    text_add_format(&script, "!window size=%d;%d\n    !canvas\n", 3 * width + 2 * GAP, height);
    text_add_format(&script, "        !rect size=%d;%d fill=true color=0.5\n", 3 * width + 2 * GAP, height);
    add_image(&script, 8, &pictures[0], 0);
    add_image(&script, 8, &pictures[1], width + GAP);
    text_add_format(&script, "        !group translate=%d;0\n", 2 * (width + GAP));
    text_add_format(&script, "            !layer size=%d;%d\n", width, height);
    add_image(&script, 16, &pictures[0], 0);
    text_add_c(&script, "                !paint composite=:difference\n");
    add_image(&script, 20, &pictures[1], 0);
    bool good = 3 * width + 2 * GAP <= PETRI_MAX_PICTURE_SIDE && draw(&drawing, host, &script) &&
                petri_picture_save(drawing.picture, drawing.painter, file) == PETRI_OK;
    close_drawing(&drawing);
    return good;
}

// Returns the largest difference of a channel.
static int pixel_distance(uint32_t a, uint32_t b) {
    int largest = 0;
    for (int shift = 0; shift < 32; shift += 8) {
        int distance = abs((int)(a >> shift & 0xFF) - (int)(b >> shift & 0xFF));
        largest = distance > largest ? distance : largest;
    }
    return largest;
}

// Adds a description of the difference. Returns SAME, DIFFERS or TROUBLE.
static int compare(const CommandContext *host, const PngFile *pictures, int tolerance, Text *found) {
    if (pictures[0].width != pictures[1].width || pictures[0].height != pictures[1].height) {
        text_add_format(found, "expected %dx%d pixels, got %dx%d\n", pictures[0].width, pictures[0].height,
                        pictures[1].width, pictures[1].height);
        return DIFFERS;
    }
    size_t count = (size_t)pictures[0].width * (size_t)pictures[0].height, differing = 0;
    uint32_t *pixels[] = {read_pixels(host, &pictures[0]), read_pixels(host, &pictures[1])};
    bool good = pixels[0] && pixels[1];
    int largest = 0;
    for (size_t i = 0; good && i < count; i++) {
        int distance = pixel_distance(pixels[0][i], pixels[1][i]);
        differing += distance > tolerance ? 1 : 0;
        largest = distance > largest ? distance : largest;
    }
    free(pixels[0]);
    free(pixels[1]);
    if (differing > 0)
        text_add_format(found, "%zu of %zu pixels differ, by at most %d of 255\n", differing, count, largest);
    return !good ? TROUBLE : differing > 0 ? DIFFERS : SAME;
}

static int compare_run(const CommandContext *host, Options *options) {
    PngFile pictures[2];
    SCOPED_TEXT found = {0};
    if (options->argc < 3 || options->argc > 4) {
        message("expected two pictures and a tolerance");
        return TROUBLE;
    }
    if (!read_size(&pictures[0], options->argv[0]) || !read_size(&pictures[1], options->argv[1]))
        return TROUBLE;
    int status = compare(host, pictures, (int)strtol(options->argv[2], NULL, 10), &found);
    if (status == DIFFERS && options->argc == 4 && !write_comparison(host, pictures, options->argv[3]))
        status = TROUBLE;
    return output_text(found.len > 0 ? found.bytes : "", found.len, status);
}

const Command COMPARE_PICTURES_COMMAND = {.name = "--compare-pictures", .parses_arguments = true, .run = compare_run};
