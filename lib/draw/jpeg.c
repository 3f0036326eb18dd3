// jpeg.c: reads JPEG files.
#include "base/heap.h"
#include "draw/draw.h"

#include <jerror.h>
#include <setjmp.h>
#include <stdio.h>

#include <jpeglib.h>

enum { MAX_SIDE = 16384, MAX_PIXELS = 1 << 26 };

typedef struct JpegError {
    struct jpeg_error_mgr manager;
    jmp_buf escape;
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

cairo_surface_t *draw_read_jpeg(Str bytes, const char **problem) {
    JpegError trouble;
    struct jpeg_decompress_struct jpeg = {0};
    cairo_surface_t *volatile surface = NULL;
    unsigned char *volatile line = NULL;
    volatile bool done = false;
    *problem = "damaged, or an unsupported kind of JPEG";
    jpeg.err = jpeg_std_error(&trouble.manager);
    trouble.manager.error_exit = abort_decode;
    trouble.manager.emit_message = on_warning;
    trouble.manager.output_message = ignore_message;
    if (setjmp(trouble.escape) == 0) {
        jpeg_create_decompress(&jpeg);
        jpeg_mem_src(&jpeg, (const unsigned char *)bytes.bytes, bytes.len);
        jpeg_read_header(&jpeg, TRUE);
        jpeg.out_color_space = JCS_RGB;
        if (jpeg.image_width > MAX_SIDE || jpeg.image_height > MAX_SIDE ||
            (uint64_t)jpeg.image_width * jpeg.image_height > MAX_PIXELS) {
            *problem = "too large";
        } else {
            jpeg_start_decompress(&jpeg);
            surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)jpeg.output_width, (int)jpeg.output_height);
            line = heap_alloc((size_t)jpeg.output_width * 3);
            if (line && cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS) {
                read_rows(&jpeg, surface, line);
                done = true;
            } else {
                *problem = NULL;
            }
        }
    }
    if (trouble.manager.msg_code == JERR_OUT_OF_MEMORY)
        *problem = NULL;
    jpeg_destroy_decompress(&jpeg);
    heap_free(line);
    if (done)
        return surface;
    if (surface)
        cairo_surface_destroy(surface);
    return NULL;
}
