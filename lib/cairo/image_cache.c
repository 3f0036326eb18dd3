// image_cache.c: decoded image files, and rendered pictures of other nodes. A painter caches an image until its file
// changes.
#include "base/file.h"
#include "base/heap.h"
#include "base/source.h"
#include "cairo/canvas.h"

#include <string.h>

enum { MAX_BYTES = 64 << 20, MAX_SIDE = IMAGE_MAX_SIDE, MAX_PIXELS = IMAGE_MAX_PIXELS, MAX_CACHED = 64 };

struct CachedImage {
    CachedImage *next;
    char *path;
    char *version;            // version of the file when it was read
    cairo_surface_t *surface; // NULL: the file cannot be read
    char *problem;            // why the file cannot be read
    Budget *budget;           // charged for the pixels
    size_t charged;
};

static void cached_image_free(CachedImage *picture) {
    if (picture->surface)
        cairo_surface_destroy(picture->surface);
    budget_release(picture->budget, picture->charged);
    heap_free(picture->path);
    heap_free(picture->version);
    heap_free(picture->problem);
    heap_free(picture);
}

void draw_images_close(PetriPainter *painter) {
    for (CachedImage *picture = painter->images, *next; picture; picture = next) {
        next = picture->next;
        cached_image_free(picture);
    }
    painter->images = NULL;
}

// Removes an image from the cache. If the cache contains too many images, also removes the oldest ones.
static void evict_image(PetriPainter *painter, const char *path) {
    int count = 0;
    for (CachedImage **at = &painter->images; *at;) {
        CachedImage *picture = *at;
        if (strcmp(picture->path, path) == 0 || ++count >= MAX_CACHED) {
            *at = picture->next;
            cached_image_free(picture);
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
    // Check the size in the first chunk of the file before allocating memory.
    uint32_t width = bytes.len > 24 ? big_endian(bytes.bytes + 16) : 0;
    uint32_t height = bytes.len > 24 ? big_endian(bytes.bytes + 20) : 0;
    if (width > MAX_SIDE || height > MAX_SIDE || (uint64_t)width * height > MAX_PIXELS) {
        *problem = "the picture is too large";
        return NULL;
    }
    cairo_surface_t *surface = cairo_image_surface_create_from_png_stream(read_bytes, &bytes);
    cairo_status_t status = cairo_surface_status(surface);
    if (status == CAIRO_STATUS_SUCCESS)
        return surface;
    *problem = status == CAIRO_STATUS_NO_MEMORY ? NULL : "the PNG file is damaged or of an unsupported kind";
    cairo_surface_destroy(surface);
    return NULL;
}

// If the image cannot be decoded, sets *problem to the reason and returns NULL. If out of memory, *problem becomes
// NULL.
static cairo_surface_t *decode_image(Str bytes, const Budget *budget, const char **problem) {
    if (str_starts_with(bytes, STR("\x89PNG\r\n\x1a\n")))
        return read_png(bytes, problem);
    if (str_starts_with(bytes, STR("\xff\xd8\xff")))
        return draw_read_jpeg(bytes, budget_memory_left(budget), problem);
    *problem = "it is neither PNG nor JPEG";
    return NULL;
}

static bool charge_image(CachedImage *picture) {
    size_t bytes = (size_t)cairo_image_surface_get_stride(picture->surface) *
                   (size_t)cairo_image_surface_get_height(picture->surface);
    if (!budget_reserve(picture->budget, bytes)) {
        picture->budget->memory_refused = false;
        return false;
    }
    picture->charged = bytes;
    return true;
}

static CachedImage *load_image(PetriPainter *painter, const FileAccess *reach, const char *path, Str version) {
    ArenaMark mark = arena_mark(&painter->arena);
    Str bytes;
    const char *problem = NULL;
    bool read = file_read(&painter->arena, reach, path, true, MAX_BYTES, &bytes, NULL, &problem);
    CachedImage *picture = heap_calloc(1, sizeof *picture); // every path below that calls longjmp frees `picture` first
    if (!picture)
        arena_exhausted(&painter->arena);
    picture->path = heap_strndup(path, strlen(path));
    picture->version = heap_strndup(version.bytes, version.len);
    picture->budget = &painter->budget;
    if (read)
        picture->surface = decode_image(bytes, picture->budget, &problem);
    if (picture->surface && !charge_image(picture)) {
        cairo_surface_destroy(picture->surface);
        picture->surface = NULL;
        problem = "it exceeds the memory limit (--memory)";
    }
    picture->problem = problem ? heap_strndup(problem, strlen(problem)) : NULL;
    if (!picture->path || !picture->version || (!picture->surface && !picture->problem)) {
        cached_image_free(picture);
        arena_exhausted(&painter->arena);
    }
    arena_rewind(&painter->arena, mark);
    return picture;
}

static const CachedImage *find_image(PetriPainter *painter, const FileAccess *reach, const char *path) {
    Str version = STR("");
    file_version(&painter->arena, reach, path, &version);
    for (CachedImage *picture = painter->images; picture; picture = picture->next)
        if (strcmp(picture->path, path) == 0 && str_equal(str_from(picture->version), version))
            return picture;
    evict_image(painter, path);
    CachedImage *picture = load_image(painter, reach, path, version);
    picture->next = painter->images;
    painter->images = picture;
    return picture;
}

// Returns the cached pixels of a file, which are borrowed. If the file cannot be read, reports this and returns NULL.
static cairo_surface_t *find_file(PetriPainter *painter, const CanvasPicture *picture, Str name, NodeKind kind,
                                  const Origin *place, DiagSink *diags) {
    Arena *arena = &painter->arena;
    const FileAccess *reach = &picture->reach;
    const CachedImage *found = find_image(painter, reach, str_to_c(arena, path_join(arena, reach->directory, name)));
    if (!found->surface)
        painter_report(diags, place, DIAG_WARNING, "cannot-read", "!%s: cannot read '%s': %s", schema_kinds[kind].name,
                       name.bytes, found->problem ? found->problem : "");
    return found->surface;
}

static bool can_copy(Canvas *canvas, int width, int height) {
    return draw_charge(canvas, NULL, 3.0 * width * height, draw_omitted);
}

// Returns the rendered picture of a node, downloaded from the GPU if necessary. Returns NULL if there is none.
static Texture *find_texture(Canvas *canvas, Str id) {
    PetriPainter *painter = canvas->painter;
    Texture *texture = render_graph_find(painter->render_graph, id);
    return texture && texture_download(painter->gl, texture) ? texture : NULL;
}

static cairo_surface_t *find_picture(Canvas *canvas, Str id) {
    Texture *texture = find_texture(canvas, id);
    if (!texture || !can_copy(canvas, texture->width, texture->height))
        return NULL;
    cairo_surface_t *surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, texture->width, texture->height);
    uint32_t *pixels = (uint32_t *)(void *)cairo_image_surface_get_data(surface);
    for (int y = 0; pixels && y < texture->height; y++)
        if (canvas->list->linear)
            texture_linear_row(texture, y, pixels + (size_t)y * (size_t)texture->width);
        else
            texture_row(texture, y, false, pixels + (size_t)y * (size_t)texture->width);
    cairo_surface_mark_dirty(surface);
    return surface;
}

// Returns a copy of a file's pixels in linear light, for linear canvases. Files are assumed to be sRGB.
static cairo_surface_t *linear_copy(Canvas *canvas, cairo_surface_t *file) {
    int width = cairo_image_surface_get_width(file), height = cairo_image_surface_get_height(file);
    if (!can_copy(canvas, width, height))
        return NULL;
    cairo_surface_t *copy = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    cairo_t *cr = cairo_create(copy);
    cairo_set_source_surface(cr, file, 0, 0);
    cairo_paint(cr);
    cairo_destroy(cr);
    cairo_surface_flush(copy);
    uint32_t *pixels = (uint32_t *)(void *)cairo_image_surface_get_data(copy);
    for (size_t i = 0; pixels && i < (size_t)width * (size_t)height; i++)
        pixels[i] = texture_linear_pixel(pixels[i]);
    cairo_surface_mark_dirty(copy);
    return copy;
}

DrawImage draw_image_at(Canvas *canvas, const double *at, const DisplayString *file) {
    DisplayNote note = display_list_note(canvas->list, at);
    return (DrawImage){.file = file ? draw_string(canvas, file) : (Str){0},
                       .id = note.id,
                       .kind = (int)*at == PETRI_DRAW_PATTERN ? KIND_PATTERN : KIND_IMAGE,
                       .place = note.place};
}

cairo_surface_t *draw_find_image(Canvas *canvas, const DrawImage *image) {
    if (image->file.len == 0)
        return find_picture(canvas, image->id);
    cairo_surface_t *surface =
        find_file(canvas->painter, canvas->picture, image->file, image->kind, &image->place, canvas->diags);
    return !surface ? NULL : canvas->list->linear ? linear_copy(canvas, surface) : cairo_surface_reference(surface);
}

bool draw_find_pixels(Canvas *canvas, const DrawImage *image, const Texture **texture, cairo_surface_t **file) {
    *texture = image->file.len == 0 ? find_texture(canvas, image->id) : NULL;
    *file = image->file.len == 0
                ? NULL
                : find_file(canvas->painter, canvas->picture, image->file, image->kind, &image->place, canvas->diags);
    return *texture || *file;
}

bool draw_find_file(PetriPainter *painter, const CanvasPicture *picture, const DrawNode *node, ImagePixels *image,
                    DiagSink *diags) {
    cairo_surface_t *surface =
        find_file(painter, picture, draw_attr(node, ATTR_FILENAME)->as.text, KIND_IMAGE, &node->origin, diags);
    if (!surface)
        return false;
    *image = (ImagePixels){.pixels = (const uint32_t *)(const void *)cairo_image_surface_get_data(surface),
                           .width = cairo_image_surface_get_width(surface),
                           .height = cairo_image_surface_get_height(surface),
                           .stride = (size_t)cairo_image_surface_get_stride(surface),
                           .alpha = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_ARGB32};
    return true;
}
