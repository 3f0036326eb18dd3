// encode.c: see encode.h.
#include "draw/encode.h"

#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

bool encode_add(Encoded *out, const void *bytes, size_t length) {
    if (length > out->room - out->length) {
        size_t room = out->length + length > 2 * out->room ? out->length + length : 2 * out->room;
        unsigned char *grown = realloc(out->bytes, room);
        if (!grown)
            return false;
        out->bytes = grown;
        out->room = room;
    }
    if (length > 0)
        memcpy(out->bytes + out->length, bytes, length);
    out->length += length;
    return true;
}

// r, g, b and perhaps a as bytes; to be freed.
static unsigned char *spread(const uint32_t *pixels, int width, int height, bool alpha) {
    size_t count = (size_t)width * (size_t)height, channels = alpha ? 4 : 3;
    unsigned char *bytes = malloc(count * channels), *byte = bytes;
    for (size_t i = 0; bytes && i < count; i++, byte += channels) {
        byte[0] = (unsigned char)(pixels[i] >> 16);
        byte[1] = (unsigned char)(pixels[i] >> 8);
        byte[2] = (unsigned char)pixels[i];
        if (alpha)
            byte[3] = (unsigned char)(pixels[i] >> 24);
    }
    return bytes;
}

bool encode_png_pixels(Encoded *out, const uint32_t *pixels, int width, int height, bool alpha) {
    png_image image = {.version = PNG_IMAGE_VERSION,
                       .width = (png_uint_32)width,
                       .height = (png_uint_32)height,
                       .format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB};
    unsigned char *bytes = spread(pixels, width, height, alpha);
    png_alloc_size_t room = PNG_IMAGE_PNG_SIZE_MAX(image);
    void *file = bytes ? malloc(room) : NULL;
    bool good =
        file && png_image_write_to_memory(&image, file, &room, 0, bytes, 0, NULL) && encode_add(out, file, room);
    free(file);
    free(bytes);
    return good;
}

typedef struct Trouble {
    struct jpeg_error_mgr manager;
    jmp_buf escape;
} Trouble;

static _Noreturn void give_up(j_common_ptr info) {
    longjmp(((Trouble *)(void *)info->err)->escape, 1);
}

static void be_quiet(j_common_ptr info) {
    (void)info;
}

// To be freed by the caller even after a failure.
typedef struct JpegFile {
    struct jpeg_compress_struct jpeg;
    Trouble trouble;
    unsigned char *bytes;
    unsigned long length;
} JpegFile;

static bool compress(JpegFile *file, unsigned char *rows, int width, int height, int quality) {
    struct jpeg_compress_struct *jpeg = &file->jpeg;
    jpeg->err = jpeg_std_error(&file->trouble.manager);
    file->trouble.manager.error_exit = give_up;
    file->trouble.manager.output_message = be_quiet;
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
    unsigned char *rows = spread(pixels, width, height, false);
    bool good = rows && compress(&file, rows, width, height, quality < 1 ? 1 : quality > 100 ? 100 : quality);
    jpeg_destroy_compress(&file.jpeg);
    good = good && encode_add(out, file.bytes, file.length);
    free(file.bytes);
    free(rows);
    return good;
}
