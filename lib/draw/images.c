// images.c: pictures from files, kept by the painter until the file changes.
#include "draw/draw.h"

#include "base/file.h"
#include "base/source.h"
#include "draw/resize.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BYTES = 64 << 20, MOST_SIDE = 16384, MOST_PIXELS = 1 << 26, MOST_KEPT = 64 };

struct Picture {
    Picture *next;
    char *path;
    char *version;            // changes when the file does
    cairo_surface_t *surface; // NULL: cannot be read
    char *problem;            // then why
};

static void picture_free(Picture *picture) {
    if (picture->surface)
        cairo_surface_destroy(picture->surface);
    free(picture->path);
    free(picture->version);
    free(picture->problem);
    free(picture);
}

void draw_images_close(PetriPainter *painter) {
    for (Picture *picture = painter->images, *next; picture; picture = next) {
        next = picture->next;
        picture_free(picture);
    }
    painter->images = NULL;
}

// Forgets an image, and the oldest if there are many.
static void forget(PetriPainter *painter, const char *path) {
    int count = 0;
    for (Picture **at = &painter->images; *at;) {
        Picture *picture = *at;
        if (strcmp(picture->path, path) == 0 || ++count >= MOST_KEPT) {
            *at = picture->next;
            picture_free(picture);
        } else {
            at = &picture->next;
        }
    }
}

static cairo_status_t read_bytes(void *closure, unsigned char *out, unsigned length) {
    Str *left = closure;
    if (length > left->len)
        return CAIRO_STATUS_READ_ERROR;
    memcpy(out, left->bytes, length);
    *left = (Str){left->bytes + length, left->len - length};
    return CAIRO_STATUS_SUCCESS;
}

static uint32_t big_endian(const char *bytes) {
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

static cairo_surface_t *read_png(Str bytes, const char **problem) {
    // The size stands in the first piece of the file; to look before memory is taken for it.
    uint32_t width = bytes.len > 24 ? big_endian(bytes.bytes + 16) : 0;
    uint32_t height = bytes.len > 24 ? big_endian(bytes.bytes + 20) : 0;
    if (width > MOST_SIDE || height > MOST_SIDE || (uint64_t)width * height > MOST_PIXELS) {
        *problem = "it is too large";
        return NULL;
    }
    cairo_surface_t *surface = cairo_image_surface_create_from_png_stream(read_bytes, &bytes);
    if (cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS)
        return surface;
    *problem = "it is no PNG file, or damaged";
    cairo_surface_destroy(surface);
    return NULL;
}

static cairo_surface_t *decode(Str bytes, const char **problem) {
    if (str_starts_with(bytes, STR("\x89PNG\r\n\x1a\n")))
        return read_png(bytes, problem);
    if (str_starts_with(bytes, STR("\xff\xd8\xff")))
        return draw_read_jpeg(bytes, problem);
    *problem = "it is neither PNG nor JPEG";
    return NULL;
}

static Picture *load(PetriPainter *painter, const Reach *reach, const char *path, Str version) {
    Picture *picture = calloc(1, sizeof *picture);
    if (!picture)
        arena_exhausted(&painter->arena);
    picture->path = strdup(path);
    picture->version = strndup(version.bytes, version.len);
    if (!picture->path || !picture->version) {
        picture_free(picture);
        arena_exhausted(&painter->arena);
    }
    ArenaMark mark = arena_mark(&painter->arena);
    Str bytes;
    const char *problem = NULL;
    if (file_read(&painter->arena, reach, path, true, MOST_BYTES, &bytes, NULL, &problem))
        picture->surface = decode(bytes, &problem);
    picture->problem = strdup(problem ? problem : "");
    arena_rewind(&painter->arena, mark);
    return picture;
}

static const Picture *find(PetriPainter *painter, const Reach *reach, const char *path) {
    Str version = STR("");
    file_version(&painter->arena, reach, path, &version);
    for (Picture *picture = painter->images; picture; picture = picture->next)
        if (strcmp(picture->path, path) == 0 && str_equal(str_from(picture->version), version))
            return picture;
    forget(painter, path);
    Picture *picture = load(painter, reach, path, version);
    picture->next = painter->images;
    painter->images = picture;
    return picture;
}

// Where an image goes.
typedef struct Box {
    double x;
    double y;
    double scale_x;
    double scale_y;
    bool cut; // to width x height from x, y
    double width;
    double height;
} Box;

// False if it would be nothing.
static bool find_box(const DrawNode *node, double width, double height, Box *box) {
    double point[2], size[2];
    draw_pair(node, ATTR_POINT, point);
    *box = (Box){.x = point[0], .y = point[1], .scale_x = 1, .scale_y = 1};
    bool fill = draw_pair(node, ATTR_FILL, size);
    if (fill || draw_pair(node, ATTR_FIT, size)) {
        double wide = size[0] / width, high = size[1] / height, scale = fill ? fmax(wide, high) : fmin(wide, high);
        box->scale_x = box->scale_y = scale;
        box->x += (size[0] - width * scale) / 2;
        box->y += (size[1] - height * scale) / 2;
        box->cut = fill;
        box->width = size[0];
        box->height = size[1];
    } else if (draw_pair(node, ATTR_SIZE, size)) {
        box->scale_x = size[0] / width;
        box->scale_y = size[1] / height;
    }
    return box->scale_x > 0 && box->scale_y > 0 && isfinite(box->scale_x) && isfinite(box->scale_y);
}

static void paint_image(Canvas *canvas, cairo_surface_t *surface, const Box *box, const double point[2],
                        const Look *look) {
    cairo_t *cr = canvas->cr;
    double width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
    KeptPath kept = draw_keep_path(canvas);
    cairo_save(cr);
    draw_set_edges(canvas, look);
    if (box->cut) {
        double x1 = point[0], y1 = point[1], x2 = x1 + box->width, y2 = y1 + box->height;
        draw_tame(canvas, &x1, &y1);
        draw_tame(canvas, &x2, &y2);
        cairo_rectangle(cr, x1, y1, x2 - x1, y2 - y1);
        cairo_clip(cr);
    }
    cairo_matrix_t matrix, placed;
    cairo_get_matrix(cr, &matrix);
    cairo_matrix_init(&placed, box->scale_x, 0, 0, box->scale_y, box->x, box->y);
    cairo_matrix_multiply(&placed, &placed, &matrix);
    if (draw_is_invertible(&placed)) {
        cairo_set_matrix(cr, &placed);
        cairo_set_source_surface(cr, surface, 0, 0);
        cairo_pattern_set_extend(cairo_get_source(cr), CAIRO_EXTEND_PAD); // edges stay sharp when it is enlarged
        cairo_rectangle(cr, 0, 0, width, height);
        cairo_clip(cr);
        draw_paint(canvas, look->composite, 1);
    }
    cairo_restore(cr);
    draw_put_back_path(canvas, kept);
}

// The pixels of a file, or NULL after a report.
static cairo_surface_t *find_file(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node,
                                  DiagSink *faults) {
    const AttrValue *name = draw_attr(node, ATTR_FILENAME);
    if (!name || name->as.text.len == 0)
        return NULL;
    Arena *arena = &painter->arena;
    const Reach *reach = &picture->reach;
    const Picture *found = find(painter, reach, str_to_c(arena, path_join(arena, reach->directory, name->as.text)));
    if (!found->surface)
        draw_report(faults, DIAG_WARNING, "cannot-read", "!image: cannot read '%s': %s", name->as.text.bytes,
                    found->problem ? found->problem : "");
    return found->surface;
}

void draw_image(Canvas *canvas, const DrawNode *node, const Look *look) {
    cairo_surface_t *surface = find_file(canvas->painter, canvas->picture, node, canvas->faults);
    if (!surface)
        return;
    Box box;
    double point[2];
    draw_pair(node, ATTR_POINT, point);
    if (find_box(node, cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface), &box))
        paint_image(canvas, surface, &box, point, look);
}

Texture *draw_picture_image(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node,
                            DiagSink *faults) {
    cairo_surface_t *surface = find_file(painter, picture, node, faults);
    if (!surface)
        return NULL;
    int width = cairo_image_surface_get_width(surface), height = cairo_image_surface_get_height(surface);
    pictures_size(node, &width, &height);
    if (width < 1 || height < 1 || width > MOST_SIDE || height > MOST_SIDE || (int64_t)width * height > MOST_PIXELS) {
        draw_report(faults, DIAG_WARNING, "bad-size", "!image: a picture can have 1 to %d pixels in width and height",
                    MOST_SIDE);
        return NULL;
    }
    cairo_format_t format = cairo_image_surface_get_format(surface);
    Texture *texture = resize_pixels((const uint32_t *)(const void *)cairo_image_surface_get_data(surface),
                                     cairo_image_surface_get_width(surface), cairo_image_surface_get_height(surface),
                                     (size_t)cairo_image_surface_get_stride(surface), format == CAIRO_FORMAT_ARGB32,
                                     width, height, draw_word(node, ATTR_FLIP));
    if (!texture)
        arena_exhausted(&painter->arena);
    return texture;
}
