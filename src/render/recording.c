// recording.c: see recording.h.
//
// Each file name has one entry until the end of the run. A video stays open until recording_end or until it has reached
// its length. A picture is not written twice.
#include "render/recording.h"

#include "cli/memory.h"
#include "cli/shader_test.h"
#include "render/video.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// A file that this run has written or started.
struct RecordedFile {
    RecordedFile *next;
    char *name;
    Video video; // open only while a video is written
    uint64_t frames;
    bool film; // true for a video, false for a picture
};

static RecordedFile *find_file(const Recording *recording, const char *name) {
    RecordedFile *file = recording->files;
    while (file && strcmp(file->name, name) != 0)
        file = file->next;
    return file;
}

static RecordedFile *add_file(Recording *recording, const char *name) {
    RecordedFile *file = memory_calloc(sizeof *file);
    *file = (RecordedFile){.next = recording->files, .video = {.frames = -1, .errors = -1, .cleanup_id = -1}};
    file->name = memory_strdup(name);
    file->film = video_has_suffix(name);
    recording->files = file;
    return file;
}

static bool close_film(Recording *recording, RecordedFile *file) {
    if (!file->video.open || video_close(&file->video))
        return true;
    recording->error_text = file->video.error_text;
    return false;
}

static bool add_frame(Recording *recording, RecordedFile *file, const PetriRecord *record) {
    bool over = record->max_seconds > 0 && (double)file->frames >= record->max_seconds * recording->fps;
    if (over)
        return close_film(recording, file);
    const VideoOptions options = {.codec = record->codec,
                                  .pixfmt = record->pixfmt,
                                  .preset = record->preset,
                                  .profile = record->profile,
                                  .crf = record->crf};
    bool good = file->frames > 0 ||
                video_open(&file->video, file->name, &options, record->width, record->height, recording->fps);
    // All frames of a video have the same size. Frames of another size are skipped.
    if (good && record->width == file->video.width && record->height == file->video.height) {
        good = video_add(&file->video, record->pixels);
        file->frames++;
    }
    if (!good)
        recording->error_text = file->video.error_text;
    return good;
}

// Writes a picture once per file name. Writes it again only if the file has been removed.
static bool save_picture(Recording *recording, PetriPicture *picture, PetriPainter *painter, size_t index,
                         const char *name) {
    RecordedFile *file = find_file(recording, name);
    if (file && access(name, F_OK) == 0)
        return true;
    if (!file)
        add_file(recording, name);
    PetriStatus status = petri_record_save(picture, painter, index);
    if (status == PETRI_OUT_OF_MEMORY)
        recording->error_text = "out of memory";
    return status == PETRI_OK;
}

bool recording_add(Recording *recording, PetriPicture *picture, PetriPainter *painter) {
    PetriRecord record;
    PetriStatus status = petri_picture_render(picture, painter);
    bool good = status == PETRI_OK && !shader_test_interrupted();
    if (status == PETRI_OUT_OF_MEMORY)
        recording->error_text = "out of memory";
    for (size_t i = 0; good && petri_picture_record(picture, painter, i, &record, sizeof record); i++) {
        if (record.denied)
            return false;
        if (!video_has_suffix(record.file)) {
            good = save_picture(recording, picture, painter, i, record.file);
            continue;
        }
        RecordedFile *file = find_file(recording, record.file);
        good = add_frame(recording, file ? file : add_file(recording, record.file), &record);
    }
    return good;
}

bool recording_end(Recording *recording, bool abandon) {
    bool good = true;
    for (RecordedFile *file = recording->files; file; file = file->next)
        if (abandon)
            video_abandon(&file->video);
        else
            good &= close_film(recording, file);
    return good;
}

void recording_free(Recording *recording) {
    for (RecordedFile *file = recording->files, *next; file; file = next) {
        next = file->next;
        video_abandon(&file->video);
        free(file->name);
        free(file);
    }
    recording->files = NULL;
}
