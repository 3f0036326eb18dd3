// none.c: paint.h in a build without Cairo.
#include "draw/paint.h"

#include "base/heap.h"

struct PetriPainter {
    char nothing;
};

PetriPainter *petri_painter_open(void) {
    return heap_zeroed(1, sizeof(PetriPainter));
}

void petri_painter_close(PetriPainter **handle) {
    if (!handle)
        return;
    heap_give(*handle);
    *handle = NULL;
}

static void report_missing(void *faults) {
    diag_report(faults, &(Diag){.level = DIAG_ERROR,
                                .code = "cannot-draw",
                                .text = STR("this build of petri cannot draw: it was made without Cairo, Pango and "
                                            "libjpeg (Debian: libcairo2-dev libpango1.0-dev libjpeg-dev)")});
}

static PetriStatus missing(DiagSink *faults) {
    Arena *arenas[] = {faults->arena};
    return arena_protect(arenas, 1, report_missing, faults) == ARENA_DONE ? PETRI_MISSING : PETRI_MEMORY;
}

PetriStatus draw_pixels(PetriPainter *painter, const CanvasPicture *picture, uint32_t *pixels, int width, int height,
                        size_t stride, DiagSink *faults) {
    (void)painter, (void)picture;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            pixels[(size_t)y * (stride / sizeof *pixels) + (size_t)x] = 0;
    return missing(faults);
}

PetriStatus draw_encode(PetriPainter *painter, const CanvasPicture *picture, CanvasFormat format, int width, int height,
                        Encoded *out, DiagSink *faults) {
    (void)painter, (void)picture, (void)format, (void)width, (void)height, (void)out;
    return missing(faults);
}

PetriStatus draw_make(PetriPainter *painter, const CanvasPicture *picture, DiagSink *faults) {
    (void)painter, (void)picture;
    return missing(faults);
}

const Recorded *draw_records(const PetriPainter *painter, const CanvasPicture *picture, uint32_t *count) {
    (void)painter, (void)picture;
    *count = 0;
    return NULL;
}

PetriStatus draw_encode_record(PetriPainter *painter, const CanvasPicture *picture, const Recorded *record,
                               CanvasFormat format, Encoded *out, DiagSink *faults) {
    (void)painter, (void)picture, (void)record, (void)format, (void)out;
    return missing(faults);
}

PetriStatus petri_painter_labels(PetriPainter *painter, const PetriLabel *labels, size_t count, double scale,
                                 uint32_t *pixels, int width, int height, size_t stride) {
    (void)painter, (void)labels, (void)count, (void)scale, (void)pixels, (void)width, (void)height, (void)stride;
    return PETRI_MISSING;
}

PetriStatus petri_painter_use_gl(PetriPainter *painter) {
    return painter ? PETRI_MISSING : PETRI_INVALID;
}

PetriStatus petri_painter_show(PetriPainter *painter, PetriPicture *picture, const PetriLabel *labels, size_t count,
                               double scale, int width, int height) {
    (void)painter, (void)picture, (void)labels, (void)count, (void)scale, (void)width, (void)height;
    return PETRI_INVALID;
}

uint64_t petri_painter_read_backs(const PetriPainter *painter) {
    (void)painter;
    return 0;
}
