// picture_files.c: the public functions that write pictures and records to files.
#include "base/file.h"
#include "base/heap.h"
#include "picture/painter.h"
#include "picture/picture.h"

#include <errno.h>
#include <string.h>

static bool find_format(const char *file, bool recorded, CanvasFormat *format) {
    static const struct {
        const char *suffix;
        CanvasFormat format;
    } suffixes[] = {{".png", CANVAS_PNG},
                    {".svg", CANVAS_SVG},
                    {".pdf", CANVAS_PDF},
                    {".jpg", CANVAS_JPEG},
                    {".jpeg", CANVAS_JPEG}};
    for (size_t i = 0; i < sizeof suffixes / sizeof suffixes[0]; i++)
        if (str_ends_with(str_from(file), str_from(suffixes[i].suffix))) {
            *format = suffixes[i].format;
            return recorded || *format != CANVAS_JPEG;
        }
    return false;
}

bool petri_picture_can_save(const char *file) {
    if (!file)
        return false;
    CanvasFormat format;
    return find_format(file, false, &format);
}

static void report_file(PetriPicture *picture, const char *file, const char *problem) {
    Str text = str_format(&picture->arena, "cannot write '%s': %s", file, problem);
    diag_report(&picture->diags, &(Diag){.level = DIAG_ERROR, .text = text, .code = "cannot-write"});
}

// A picture that is being written to a file.
typedef struct Saving {
    PetriPicture *picture;
    PetriPainter *painter;
    CanvasFormat format;
    const char *file;
    PetriWriteCallback *write; // receives the bytes; NULL: write the file
    void *user_data;           // passed to `write`
    const Recorded *record;    // the record to write; NULL: the picture itself
    const FileAccess *reach;   // where writing is allowed; NULL: anywhere
    Encoded bytes;
    PetriStatus status;
} Saving;

static PetriStatus encode_picture(Saving *saving) {
    PetriPicture *picture = saving->picture;
    PetriPainter *painter = saving->painter;
    const CanvasBackend *backend = painter->backend;
    DiagSink *diags = &picture->diags;
    if (!backend->encode || !backend->encode_record)
        return painter_report_no_backend(diags);
    if (saving->record)
        return backend->encode_record(painter, &picture->picture, saving->record, saving->format, &saving->bytes,
                                      diags);
    PetriStatus status = painter_render_pixels(painter, &picture->picture, diags);
    return status != PETRI_OK ? status
                              : backend->encode(painter, &picture->picture, saving->format, picture->width,
                                                picture->height, &saving->bytes, diags);
}

static void save_protected(void *context) {
    Saving *saving = context;
    PetriPicture *picture = saving->picture;
    saving->status = encode_picture(saving);
    if (saving->status != PETRI_OK)
        return;
    if (saving->write) {
        bool accepted = saving->write(saving->user_data, (const char *)saving->bytes.bytes, saving->bytes.length);
        saving->status = accepted ? PETRI_OK : PETRI_INVALID;
        return;
    }
    Replacement file;
    bool begun = file_access_replace(saving->reach, saving->file, &file);
    // A refusal was already reported when the picture was created.
    bool refused = !begun && saving->reach && errno == EXDEV;
    const char *problem =
        begun ? file_finish(&file, (Str){(const char *)saving->bytes.bytes, saving->bytes.length}) : strerror(errno);
    if (refused) {
        saving->status = PETRI_INVALID;
    } else if (problem) {
        report_file(picture, saving->file, problem);
        saving->status = PETRI_INVALID;
    }
}

static void report_name(void *context) {
    const Saving *saving = context;
    report_file(saving->picture, saving->file,
                saving->record
                    ? "the filename of !record must end in .png, .jpg, .svg or .pdf, or, for a video, in .mp4, .m4v, "
                      ".mov, .mkv, .webm, .ogg or .gif"
                    : "the name of a picture must end in .png, .svg or .pdf");
}

static PetriStatus save_picture(Saving *saving) {
    if (!saving->picture || !saving->painter || !saving->file)
        return PETRI_INVALID;
    Arena *arenas[] = {&saving->picture->arena};
    bool known = find_format(saving->file, saving->record, &saving->format);
    ArenaOutcome end = arena_protect(arenas, 1, known ? save_protected : report_name, saving);
    heap_free(saving->bytes.bytes);
    return end == ARENA_OK ? saving->status : PETRI_OUT_OF_MEMORY;
}

PetriStatus petri_picture_save(PetriPicture *picture, PetriPainter *painter, const char *file) {
    return save_picture(
        &(Saving){.picture = picture, .painter = painter, .format = CANVAS_PNG, .file = file, .status = PETRI_INVALID});
}

PetriStatus petri_picture_encode(PetriPicture *picture, PetriPainter *painter, const char *suffix,
                                 PetriWriteCallback *write, void *user_data) {
    if (!write)
        return PETRI_INVALID;
    return save_picture(&(Saving){.picture = picture,
                                  .painter = painter,
                                  .format = CANVAS_PNG,
                                  .file = suffix,
                                  .write = write,
                                  .user_data = user_data,
                                  .status = PETRI_INVALID});
}

// Arguments of fill_record, which is called through arena_protect.
typedef struct RecordQuery {
    PetriPicture *picture;
    const Recorded *recorded;
    PetriRecord *record;
} RecordQuery;

static const char *word_of(const DrawNode *node, AttrName name) {
    const AttrValue *attr = draw_attr(node, name);
    return attr ? schema_word((AttrType)schema_rows[attr->row].type, attr->as.word) : "";
}

static void fill_record(void *context) {
    const RecordQuery *query = context;
    const DrawNode *node = query->recorded->node;
    const Texture *texture = query->recorded->texture;
    Arena *arena = &query->picture->arena;
    const FileAccess *reach = &query->picture->picture.reach;
    const char *file = str_to_c(arena, path_join(arena, reach->directory, draw_attr(node, ATTR_FILENAME)->as.text));
    *query->record = (PetriRecord){
        .file = file,
        .denied = !file_access_make_folders(reach, file),
        .width = texture->width,
        .height = texture->height,
        .pixels = texture->bytes,
        .keep_alpha = draw_flag(node, ATTR_KEEP_ALPHA),
        .codec = word_of(node, ATTR_CODEC),
        .pixfmt = word_of(node, ATTR_PIXFMT),
        .max_seconds = draw_number(node, ATTR_LIMIT),
        .crf = draw_number(node, ATTR_CRF),
        .preset = word_of(node, ATTR_PRESET),
        .profile = word_of(node, ATTR_PROFILE),
    };
}

static const Recorded *find_record(const PetriPicture *picture, const PetriPainter *painter, size_t index) {
    uint32_t count;
    const Recorded *records = painter_records(painter, &picture->picture, &count);
    return index < count ? &records[index] : NULL;
}

bool petri_picture_record(PetriPicture *picture, PetriPainter *painter, size_t index, PetriRecord *record,
                          size_t size) {
    if (!picture || !painter)
        return false;
    PetriRecord found;
    RecordQuery query = {picture, find_record(picture, painter, index), &found};
    Arena *arenas[] = {&picture->arena};
    return query.recorded && arena_protect(arenas, 1, fill_record, &query) == ARENA_OK &&
           host_struct_write(record, size, &found, sizeof found);
}

PetriStatus petri_record_save(PetriPicture *picture, PetriPainter *painter, size_t index) {
    PetriRecord record;
    if (!petri_picture_record(picture, painter, index, &record, sizeof record))
        return PETRI_INVALID;
    return save_picture(&(Saving){.picture = picture,
                                  .painter = painter,
                                  .format = CANVAS_PNG,
                                  .file = record.file,
                                  .record = find_record(picture, painter, index),
                                  .reach = &picture->picture.reach,
                                  .status = PETRI_INVALID});
}
