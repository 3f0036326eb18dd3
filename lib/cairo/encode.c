// encode.c: see encode.h.
#include "cairo/encode.h"

#include "base/heap.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>
#include <zlib.h>

#include <jpeglib.h>

bool encode_add(Encoded *out, const void *bytes, size_t length) {
    if (length > out->capacity - out->length) {
        size_t capacity = out->length + length > 2 * out->capacity ? out->length + length : 2 * out->capacity;
        unsigned char *grown = heap_resize(out->bytes, capacity);
        if (!grown)
            return false;
        out->bytes = grown;
        out->capacity = capacity;
    }
    if (length > 0)
        memcpy(out->bytes + out->length, bytes, length);
    out->length += length;
    return true;
}

// Writes pixels as bytes: r, g, b and, with `alpha`, a.
static void unpack_rows(const uint32_t *pixels, size_t count, bool alpha, unsigned char *byte) {
    for (size_t i = 0; i < count; i++, byte += alpha ? 4 : 3) {
        byte[0] = (unsigned char)(pixels[i] >> 16);
        byte[1] = (unsigned char)(pixels[i] >> 8);
        byte[2] = (unsigned char)pixels[i];
        if (alpha)
            byte[3] = (unsigned char)(pixels[i] >> 24);
    }
}

static void add_bytes(png_structp png, png_bytep bytes, size_t length) {
    if (!encode_add(png_get_io_ptr(png), bytes, length))
        png_error(png, "memory");
}

static void ignore_flush(png_structp png) {
    (void)png;
}

static _Noreturn void abort_png(png_structp png, const char *text) {
    (void)text;
    png_longjmp(png, 1);
}

static void ignore_warning(png_structp png, const char *text) {
    (void)png;
    (void)text;
}

typedef struct PngFile {
    png_structp png;
    png_infop info;
    unsigned char *row;
} PngFile;

// The filter and strategy are the fastest that do not make files larger (tests/bench/README.md, "Pictures").
static bool write_png(PngFile *file, const uint32_t *pixels, int width, int height, bool alpha) {
    if (!file->info || !file->row || setjmp(png_jmpbuf(file->png)))
        return false;
    png_set_IHDR(file->png, file->info, (png_uint_32)width, (png_uint_32)height, 8,
                 alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(file->png, file->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_compression_strategy(file->png, Z_RLE);
    png_set_filter(file->png, PNG_FILTER_TYPE_BASE, PNG_FILTER_PAETH);
    png_write_info(file->png, file->info);
    for (int y = 0; y < height; y++) {
        unpack_rows(pixels + (size_t)y * (size_t)width, (size_t)width, alpha, file->row);
        png_write_row(file->png, file->row);
    }
    png_write_end(file->png, file->info);
    return true;
}

bool encode_png_pixels(Encoded *out, const uint32_t *pixels, int width, int height, bool alpha) {
    PngFile file = {.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, abort_png, ignore_warning)};
    if (!file.png)
        return false;
    file.info = png_create_info_struct(file.png);
    file.row = heap_alloc((size_t)width * 4);
    png_set_write_fn(file.png, out, add_bytes, ignore_flush);
    bool good = write_png(&file, pixels, width, height, alpha);
    png_destroy_write_struct(&file.png, &file.info);
    heap_free(file.row);
    return good;
}

typedef struct JpegError {
    struct jpeg_error_mgr manager;
    jmp_buf escape;
} JpegError;

static _Noreturn void abort_jpeg(j_common_ptr info) {
    longjmp(((JpegError *)(void *)info->err)->escape, 1);
}

static void ignore_message(j_common_ptr info) {
    (void)info;
}

// State of the encoder. The caller frees it, even after a failure.
typedef struct JpegFile {
    struct jpeg_compress_struct jpeg;
    JpegError trouble;
    unsigned char *bytes;
    unsigned long length;
} JpegFile;

static bool compress_jpeg(JpegFile *file, unsigned char *rows, int width, int height, int quality) {
    struct jpeg_compress_struct *jpeg = &file->jpeg;
    jpeg->err = jpeg_std_error(&file->trouble.manager);
    file->trouble.manager.error_exit = abort_jpeg;
    file->trouble.manager.output_message = ignore_message;
    if (setjmp(file->trouble.escape))
        return false;
    jpeg_create_compress(jpeg);
    jpeg_mem_dest(jpeg, &file->bytes, &file->length);
    jpeg->image_width = (JDIMENSION)width;
    jpeg->image_height = (JDIMENSION)height;
    jpeg->input_components = 3;
    jpeg->in_color_space = JCS_RGB;
    jpeg_set_defaults(jpeg);
    jpeg_set_quality(jpeg, quality, TRUE);
    jpeg_start_compress(jpeg, TRUE);
    while (jpeg->next_scanline < jpeg->image_height) {
        JSAMPROW row = rows + (size_t)jpeg->next_scanline * 3 * (size_t)width;
        jpeg_write_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_compress(jpeg);
    return true;
}

bool encode_jpeg_pixels(Encoded *out, const uint32_t *pixels, int width, int height, int quality) {
    JpegFile file = {.bytes = NULL};
    size_t count = (size_t)width * (size_t)height;
    unsigned char *rows = heap_alloc(count * 3);
    if (rows)
        unpack_rows(pixels, count, false, rows);
    bool good = rows && compress_jpeg(&file, rows, width, height, quality < 1 ? 1 : quality > 100 ? 100 : quality);
    jpeg_destroy_compress(&file.jpeg);
    good = good && encode_add(out, file.bytes, file.length);
    heap_free(file.bytes);
    heap_free(rows);
    return good;
}
