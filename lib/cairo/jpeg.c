// jpeg.c: reads JPEG files.
#include "base/heap.h"
#include "cairo/canvas.h"

#include <jerror.h>
#include <limits.h>
#include <setjmp.h>
#include <stdio.h>

#include <jpeglib.h>

enum { MAX_SIDE = IMAGE_MAX_SIDE, MAX_PIXELS = IMAGE_MAX_PIXELS, MAX_SCANS = 100 };

static const char EXCEEDS_MEMORY[] = "it exceeds the memory limit (--memory)";

typedef struct JpegError {
    struct jpeg_error_mgr manager;
    jmp_buf escape;
    bool too_many_scans;
} JpegError;

static _Noreturn void abort_decode(j_common_ptr info) {
    longjmp(((JpegError *)(void *)info->err)->escape, 1);
}

// Truncated files are rejected; other warnings are ignored.
static void on_warning(j_common_ptr info, int level) {
    if (level < 0 && info->err->msg_code == JWRN_JPEG_EOF)
        abort_decode(info);
}

static void ignore_message(j_common_ptr info) {
    (void)info;
}

// Stops at a file with very many scans. A scan needs few bytes, but decoding it visits all pixels.
static void limit_scans(j_common_ptr info) {
    if (((j_decompress_ptr)info)->input_scan_number > MAX_SCANS) {
        ((JpegError *)(void *)info->err)->too_many_scans = true;
        abort_decode(info);
    }
}

static const char *explain_failure(const JpegError *trouble) {
    if (trouble->too_many_scans)
        return "the JPEG file has more than 100 scans";
    switch (trouble->manager.msg_code) {
    case JERR_OUT_OF_MEMORY:
        return NULL;
    case JERR_NO_BACKING_STORE:
        return EXCEEDS_MEMORY; // libjpeg's error if decoding needs more than max_memory_to_use
    default:
        return "the JPEG file is damaged or of an unsupported kind";
    }
}

static void read_rows(struct jpeg_decompress_struct *jpeg, cairo_surface_t *surface, unsigned char *line) {
    unsigned char *pixels = cairo_image_surface_get_data(surface);
    int stride = cairo_image_surface_get_stride(surface);
    while (jpeg->output_scanline < jpeg->output_height) {
        uint32_t *row = (uint32_t *)(void *)(pixels + (size_t)stride * jpeg->output_scanline);
        jpeg_read_scanlines(jpeg, &line, 1);
        for (unsigned x = 0; x < jpeg->output_width; x++)
            row[x] = 0xff000000u | (uint32_t)line[3 * x] << 16 | (uint32_t)line[3 * x + 1] << 8 | line[3 * x + 2];
    }
    cairo_surface_mark_dirty(surface);
}

cairo_surface_t *draw_read_jpeg(Str bytes, size_t memory, const char **problem) {
    JpegError trouble = {.too_many_scans = false};
    struct jpeg_progress_mgr progress = {.progress_monitor = limit_scans};
    struct jpeg_decompress_struct jpeg = {0};
    cairo_surface_t *volatile surface = NULL;
    unsigned char *volatile line = NULL;
    volatile bool done = false;
    *problem = NULL;
    jpeg.err = jpeg_std_error(&trouble.manager);
    trouble.manager.error_exit = abort_decode;
    trouble.manager.emit_message = on_warning;
    trouble.manager.output_message = ignore_message;
    if (setjmp(trouble.escape) == 0) {
        jpeg_create_decompress(&jpeg);
        jpeg.progress = &progress;
        jpeg_mem_src(&jpeg, (const unsigned char *)bytes.bytes, bytes.len);
        jpeg_read_header(&jpeg, TRUE);
        jpeg.out_color_space = JCS_RGB;
        uint64_t pixels = (uint64_t)jpeg.image_width * jpeg.image_height;
        if (jpeg.image_width > MAX_SIDE || jpeg.image_height > MAX_SIDE || pixels > MAX_PIXELS) {
            *problem = "the picture is too large";
        } else if (pixels * sizeof(uint32_t) > memory) {
            *problem = EXCEEDS_MEMORY;
        } else {
            size_t left = memory - (size_t)pixels * sizeof(uint32_t);
            jpeg.mem->max_memory_to_use = left < LONG_MAX ? (long)left : LONG_MAX;
            jpeg_start_decompress(&jpeg);
            surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)jpeg.output_width, (int)jpeg.output_height);
            line = heap_alloc((size_t)jpeg.output_width * 3);
            if (line && cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS) {
                read_rows(&jpeg, surface, line);
                done = true;
            }
        }
    } else {
        *problem = explain_failure(&trouble);
    }
    jpeg_destroy_decompress(&jpeg);
    heap_free(line);
    if (done)
        return surface;
    if (surface)
        cairo_surface_destroy(surface);
    return NULL;
}
