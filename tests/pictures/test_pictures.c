// test_pictures.c: draws each script of tests/pictures and compares it with the PNG file of the same name.
// usage: test_pictures FOLDER [--update | --write FOLDER]
//
// Scripts may have these comments at their top. `-- tolerance N` allows each channel of each pixel to differ by N of
// 255. The default of 2 allows for rounding in versions of Cairo; text needs more, because versions of FreeType and
// fonts differ. `-- frames N` is the number of frames to draw (default: 1).
// `-- unstable` expects reports that the script's systems are unstable.
// Scripts that need OpenGL are skipped where it is not available. --update stores the drawn pictures; --write stores
// them elsewhere. The scripts of the folder with gallery.fl must use all nodes.
#include "petri-draw.h"
#include "petri-edit.h"
#include "petri-inspect.h"

#include <cairo.h>
#include <dirent.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_SCRIPTS = 200, MAX_SEEN = 4000, AUTO_SIZE = 160, USUAL_TOLERANCE = 2 };

// Nodes and attributes that occur in the scripts, as lines `kind attribute`.
static char *seen[MAX_SEEN];
static size_t seen_count;

static void note_seen(const char *kind, size_t kind_length, const char *attribute, size_t length) {
    char text[200];
    snprintf(text, sizeof text, "%.*s %.*s", (int)kind_length, kind, (int)length, attribute);
    for (size_t i = 0; i < seen_count; i++)
        if (strcmp(seen[i], text) == 0)
            return;
    if (seen_count < MAX_SEEN)
        seen[seen_count++] = strdup(text);
}

static bool was_seen(const char *kind, const char *attribute) {
    char text[200];
    snprintf(text, sizeof text, "%s %s", kind, attribute);
    for (size_t i = 0; i < seen_count; i++)
        if (strcmp(seen[i], text) == 0)
            return true;
    return false;
}

typedef struct Notes {
    char *text;
    size_t length;
} Notes;

static bool collect_bytes(void *host, const char *text, size_t length) {
    Notes *notes = host;
    notes->text = realloc(notes->text, notes->length + length + 1);
    memcpy(notes->text + notes->length, text, length);
    notes->length += length;
    notes->text[notes->length] = 0;
    return true;
}

// Reads the `!kind … name=value …` lines of a printed tree. Values that look like an attribute do no harm here.
static void note_tree(PetriSession *session) {
    Notes notes = {0};
    petri_print(session, PETRI_PRINT_TREE, collect_bytes, &notes);
    for (char *line = strtok(notes.text, "\n"); line; line = strtok(NULL, "\n")) {
        const char *kind = line + strspn(line, " ");
        if (*kind++ != '!')
            continue;
        size_t kind_length = strcspn(kind, " ");
        note_seen(kind, kind_length, "", 0);
        for (const char *at = kind + kind_length; *at; at += strcspn(at, " ")) {
            at += strspn(at, " ");
            size_t length = strcspn(at, "= ");
            if (at[length] == '=')
                note_seen(kind, kind_length, at, length);
        }
    }
    free(notes.text);
}

static bool without_gpu;        // true if the script needs OpenGL, which is not available
static uint64_t unstable_count; // number of reports that a system of the script is unstable
static size_t skipped;

static void on_diagnostic(void *host, const PetriDiagnostic *diagnostic) {
    without_gpu |= diagnostic->code && strcmp(diagnostic->code, "needs-gpu") == 0;
    if (diagnostic->code &&
        (strcmp(diagnostic->code, "unstable-force") == 0 || strcmp(diagnostic->code, "divergence") == 0))
        unstable_count++;
    printf("%s: %s", (const char *)host, diagnostic->rendered);
}

typedef struct Options {
    int tolerance;
    bool unstable;
    int frames;
} Options;

static Options read_options(const char *script) {
    Options options = {.tolerance = USUAL_TOLERANCE, .frames = 1};
    char line[400];
    FILE *file = fopen(script, "r");
    while (file && fgets(line, sizeof line, file) && strncmp(line, "--", 2) == 0) {
        sscanf(line, "-- tolerance %d", &options.tolerance);
        sscanf(line, "-- frames %d", &options.frames);
        options.unstable = options.unstable || strncmp(line, "-- unstable", 11) == 0;
    }
    if (file)
        fclose(file);
    return options;
}

static PetriPicture *make_picture(PetriSession *session, PetriPainter *painter, const char *script, int frames) {
    PetriPictureOptions options = petri_default_picture_options();
    PetriPicture *picture = NULL;
    if (petri_load(session, script) != PETRI_OK)
        return NULL;
    if (strstr(script, "/automatic_"))
        options.width = options.height = AUTO_SIZE;
    for (int i = 0; i < frames; i++) {
        petri_picture_free(&picture);
        if (petri_step(session) != PETRI_OK)
            return NULL;
        if ((i == frames - 1 || petri_needs_history(session)) &&
            petri_picture(session, &options, &picture) == PETRI_OK && petri_needs_history(session))
            petri_picture_render(picture, painter);
    }
    note_tree(session);
    return picture;
}

// Compares two files. Returns the number of pixels that differ by more than the tolerance, or -1 if the sizes differ.
static long compare_surfaces(cairo_surface_t *stored, cairo_surface_t *drawn, int tolerance, int *worst) {
    int width = cairo_image_surface_get_width(drawn), height = cairo_image_surface_get_height(drawn);
    if (cairo_surface_status(stored) != CAIRO_STATUS_SUCCESS || cairo_surface_status(drawn) != CAIRO_STATUS_SUCCESS ||
        cairo_image_surface_get_width(stored) != width || cairo_image_surface_get_height(stored) != height)
        return -1;
    const unsigned char *one = cairo_image_surface_get_data(stored), *two = cairo_image_surface_get_data(drawn);
    int stride = cairo_image_surface_get_stride(stored);
    // The fourth byte of a pixel is undefined in images without transparency.
    int channels = cairo_image_surface_get_format(stored) == CAIRO_FORMAT_RGB24 ? 3 : 4;
    long count = 0;
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++) {
            bool differs = false;
            for (int k = 0; k < channels; k++) {
                int difference = abs(one[y * stride + 4 * x + k] - two[y * stride + 4 * x + k]);
                *worst = difference > *worst ? difference : *worst;
                differs |= difference > tolerance;
            }
            count += differs;
        }
    return count;
}

// Checks that drawn pixels equal those of the file. Transparent pixels lose some precision when they are stored.
static bool same_as_drawn(PetriPicture *picture, PetriPainter *painter, cairo_surface_t *saved) {
    int width, height;
    petri_picture_size(picture, &width, &height);
    int stride = cairo_image_surface_get_stride(saved);
    if (cairo_image_surface_get_format(saved) != CAIRO_FORMAT_RGB24)
        return true;
    unsigned char *pixels = malloc((size_t)stride * (size_t)height);
    const unsigned char *wanted = cairo_image_surface_get_data(saved);
    bool same =
        petri_picture_draw(picture, painter, (uint32_t *)(void *)pixels, width, height, (size_t)stride) == PETRI_OK;
    for (int y = 0; y < height && same; y++)
        for (int x = 0; x < width && same; x++)
            same = memcmp(pixels + y * stride + 4 * x, wanted + y * stride + 4 * x, 3) == 0;
    free(pixels);
    return same;
}

static bool check_picture(PetriPicture *picture, PetriPainter *painter, const char *name, const char *file,
                          int tolerance) {
    char beside[] = "/tmp/petri-picture-XXXXXX.png";
    int worst = 0, handle = mkstemps(beside, 4);
    bool saved = handle >= 0 && petri_picture_save(picture, painter, beside) == PETRI_OK;
    cairo_surface_t *drawn = cairo_image_surface_create_from_png(beside);
    cairo_surface_t *stored = cairo_image_surface_create_from_png(file);
    long count = saved ? compare_surfaces(stored, drawn, tolerance, &worst) : -1;
    bool same = saved && same_as_drawn(picture, painter, drawn);
    cairo_surface_destroy(drawn);
    cairo_surface_destroy(stored);
    if (handle >= 0) {
        close(handle);
        unlink(beside);
    }
    if (!saved)
        printf("FAIL %s: cannot be drawn\n", name);
    else if (count < 0)
        printf("FAIL %s: no stored picture of this size\n", name);
    else if (count > 0)
        printf("FAIL %s: %ld pixels differ by up to %d of 255, %d is tolerated\n", name, count, worst, tolerance);
    else if (!same)
        printf("FAIL %s: the pixels and the file differ\n", name);
    return saved && count == 0 && same;
}

static bool check_script(const char *folder, const char *name, const char *write) {
    char script[1000], file[1100];
    snprintf(script, sizeof script, "%s/%s.fl", folder, name);
    snprintf(file, sizeof file, "%s/%s.png", write ? write : folder, name);
    PetriOptions options = petri_default_options();
    options.on_diagnostic = on_diagnostic;
    options.user_data = (void *)(uintptr_t)name;
    PetriSession *session = petri_open(&options);
    PetriPainter *painter = petri_painter_open();
    Options wanted = read_options(script);
    without_gpu = false;
    unstable_count = 0;
    PetriPicture *picture = make_picture(session, painter, script, wanted.frames);
    bool good = picture != NULL;
    if (picture) {
        petri_picture_render(picture, painter);
        petri_picture_report(session, picture);
    }
    if (picture && without_gpu)
        skipped++;
    else if (picture && write)
        good = petri_picture_save(picture, painter, file) == PETRI_OK;
    else if (picture)
        good = check_picture(picture, painter, name, file, wanted.tolerance);
    else
        printf("FAIL %s: no picture\n", name);
    if (picture)
        petri_picture_report(session, picture);
    // All scripts are valid, so each other diagnostic is a failure.
    good =
        good && (unstable_count > 0) == wanted.unstable &&
        petri_diagnostic_count(session, PETRI_ERROR) + petri_diagnostic_count(session, PETRI_WARNING) == unstable_count;
    petri_picture_free(&picture);
    petri_painter_close(&painter);
    petri_close(&session);
    return good || without_gpu;
}

// All effect nodes read their attributes with the same code, so one node is enough.
static bool in_common(const char *attribute) {
    static const char *const names[] = {
        "size",    "id",     "hidden",     "composite",         "blend",  "alpha",   "colorbits", "border", "repeat",
        "nearest", "passes", "downsample", "downsample_passes", "vertex", "fragment"};
    static const char *const programs[] = {"window", "offscreen", "record", "canvas", "image", "shader"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        for (size_t k = 0; strcmp(attribute, names[i]) == 0 && k < sizeof programs / sizeof programs[0]; k++)
            if (was_seen(programs[k], attribute))
                return true;
    return false;
}

// Checks that each node and attribute that affects drawing occurs in at least one script.
static int check_complete(void) {
    // Nodes that draw nothing are tested elsewhere: record in tests/cli, pointer and key in tests of the window.
    static const char *const others[] = {"record", "pointer", "key"};
    int missing = 0;
    PetriNodeKind kind;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        bool other = strcmp(kind.area, "canvas") != 0;
        for (size_t k = 0; k < sizeof others / sizeof others[0]; k++)
            other |= strcmp(kind.name, others[k]) == 0;
        PetriNodeAttribute attribute;
        for (size_t k = 0; !other && petri_node_attribute(i, k, &attribute, sizeof attribute); k++)
            if (strncmp(attribute.help, "ignored", 7) != 0 && !was_seen(kind.name, attribute.name) &&
                !in_common(attribute.name)) {
                printf("FAIL: no script has !%s with %s\n", kind.name, attribute.name);
                missing++;
            }
        if (!other && !was_seen(kind.name, "")) {
            printf("FAIL: no script has !%s\n", kind.name);
            missing++;
        }
    }
    return missing;
}

// All nodes of scenes read their attributes with the same code, so one node is enough.
static int check_scenes(void) {
    int missing = 0;
    PetriNodeKind kind, other;
    PetriNodeAttribute attribute;
    for (size_t i = 0; petri_node_kind(i, &kind, sizeof kind); i++) {
        if (strcmp(kind.area, "canvas3d") != 0)
            continue;
        for (size_t k = 0; petri_node_attribute(i, k, &attribute, sizeof attribute); k++) {
            // Every node has the attribute `hidden`.
            bool found = strcmp(attribute.name, "hidden") == 0 || strncmp(attribute.help, "ignored", 7) == 0;
            for (size_t o = 0; !found && petri_node_kind(o, &other, sizeof other); o++)
                found = strcmp(other.area, "canvas3d") == 0 && was_seen(other.name, attribute.name);
            if (!found)
                printf("FAIL: no scene has !%s with %s\n", kind.name, attribute.name);
            missing += !found;
        }
        if (!was_seen(kind.name, ""))
            printf("FAIL: no scene has !%s\n", kind.name);
        missing += !was_seen(kind.name, "");
    }
    return missing;
}

static int compare_names(const void *a, const void *b) {
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static size_t list_scripts(const char *folder, char **names) {
    DIR *directory = opendir(folder);
    size_t count = 0;
    for (struct dirent *entry; directory && (entry = readdir(directory)) && count < MAX_SCRIPTS;) {
        size_t length = strlen(entry->d_name);
        if (length > 3 && strcmp(entry->d_name + length - 3, ".fl") == 0 && strcmp(entry->d_name, "gallery.fl") != 0)
            names[count++] = strndup(entry->d_name, length - 3);
    }
    if (directory)
        closedir(directory);
    qsort(names, count, sizeof *names, compare_names);
    return count;
}

int main(int argc, char **argv) {
    if (argc < 2)
        return 2;
    const char *write = argc > 3 && strcmp(argv[2], "--write") == 0    ? argv[3]
                        : argc > 2 && strcmp(argv[2], "--update") == 0 ? argv[1]
                                                                       : NULL;
    char *names[MAX_SCRIPTS];
    size_t count = list_scripts(argv[1], names);
    int failed = 0;
    for (size_t i = 0; i < count; i++) {
        failed += !check_script(argv[1], names[i], write);
        free(names[i]);
    }
    char gallery[1000];
    snprintf(gallery, sizeof gallery, "%s/gallery.fl", argv[1]);
    if (access(gallery, F_OK) == 0)
        failed += check_complete();
    else if (strstr(argv[1], "/scenes"))
        failed += check_scenes();
    for (size_t i = 0; i < seen_count; i++)
        free(seen[i]);
    enum { SKIP = 77 };
    printf("%zu pictures, %d failures, %zu skipped\n", count, failed, skipped);
    return failed > 0 || count == 0 ? 1 : skipped == count ? SKIP : 0;
}
