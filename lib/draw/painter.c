// painter.c: pictures into pixels and files.
#include "draw/picture.h"

#include "base/file.h"

#include <errno.h>
#include <string.h>

PetriStatus petri_picture_draw(PetriPicture *picture, PetriPainter *painter, uint32_t *pixels, int width, int height,
                               size_t stride) {
    if (!picture || !painter || !pixels || !picture_is_good_size(width, height) || stride % sizeof *pixels ||
        stride < (size_t)width * sizeof *pixels)
        return PETRI_INVALID;
    return draw_pixels(painter, &picture->picture, pixels, width, height, stride, &picture->faults);
}

static bool find_format(const char *file, CanvasFormat *format) {
    static const char *const suffixes[CANVAS_FORMAT_COUNT] = {
        [CANVAS_PNG] = ".png", [CANVAS_SVG] = ".svg", [CANVAS_PDF] = ".pdf"};
    for (int i = 0; i < CANVAS_FORMAT_COUNT; i++)
        if (str_ends_with(str_from(file), str_from(suffixes[i]))) {
            *format = (CanvasFormat)i;
            return true;
        }
    return false;
}

bool petri_picture_format(const char *file) {
    if (!file)
        return false;
    CanvasFormat format;
    return find_format(file, &format);
}

static void report_file(PetriPicture *picture, const char *file, const char *problem) {
    Str text = str_format(&picture->arena, "cannot write '%s': %s", file, problem);
    diag_report(&picture->faults, &(Diag){.level = DIAG_ERROR, .text = text, .code = "cannot-write"});
}

// A picture being written to a file.
typedef struct Saving {
    PetriPicture *picture;
    PetriPainter *painter;
    CanvasFormat format;
    const char *file;
    const Reach *reach; // NULL: any file
    Arena arena;        // the file's bytes, apart from the picture's data and its faults
    PetriStatus status;
} Saving;

static void save(void *context) {
    Saving *saving = context;
    PetriPicture *picture = saving->picture;
    Str bytes;
    saving->status = draw_encode(saving->painter, &picture->picture, saving->format, picture->width, picture->height,
                                 &saving->arena, &bytes, &picture->faults);
    if (saving->status != PETRI_OK)
        return;
    Replacement file;
    bool begun = reach_replace(saving->reach, saving->file, &file);
    bool refused = !begun && saving->reach && errno == EXDEV; // which was told when the picture was taken
    const char *problem = begun ? file_finish(&file, bytes) : strerror(errno);
    if (refused) {
        saving->status = PETRI_INVALID;
    } else if (problem) {
        report_file(picture, saving->file, problem);
        saving->status = PETRI_INVALID;
    }
}

static void report_name(void *context) {
    const Saving *saving = context;
    report_file(saving->picture, saving->file, "a picture's name ends in .png, .svg or .pdf");
}

static PetriStatus save_picture(Saving *saving) {
    if (!saving->picture || !saving->painter || !saving->file)
        return PETRI_INVALID;
    Arena *arenas[] = {&saving->arena, &saving->picture->arena};
    arena_init(&saving->arena, "file", SIZE_MAX);
    ArenaEnd end = arena_protect(arenas, 2, find_format(saving->file, &saving->format) ? save : report_name, saving);
    arena_free(&saving->arena);
    return end == ARENA_DONE ? saving->status : PETRI_MEMORY;
}

PetriStatus petri_picture_save(PetriPicture *picture, PetriPainter *painter, const char *file) {
    return save_picture(
        &(Saving){.picture = picture, .painter = painter, .format = CANVAS_PNG, .file = file, .status = PETRI_INVALID});
}

PetriStatus petri_picture_save_record(PetriPicture *picture, PetriPainter *painter, size_t index) {
    if (!picture || index >= picture->record_count)
        return PETRI_INVALID;
    return save_picture(&(Saving){.picture = picture,
                                  .painter = painter,
                                  .format = CANVAS_PNG,
                                  .file = picture->records[index],
                                  .reach = &picture->picture.reach,
                                  .status = PETRI_INVALID});
}
