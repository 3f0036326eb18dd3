// profile.c: output of the time spent per source line (petri_profile).
#include "vm/profile.h"

#include "session/session.h"

#include <stdlib.h>

typedef struct ProfileRow {
    double seconds;
    double times;         // number of evaluations
    const Source *source; // source file of the line; NULL: the row is not for a line and has the label `what`
    uint32_t line;
    const char *what;
} ProfileRow;

// Orders rows by time, longest first, then by line.
static int compare_rows(const void *left, const void *right) {
    const ProfileRow *a = left, *b = right;
    if (a->seconds != b->seconds)
        return a->seconds < b->seconds ? 1 : -1;
    return a->line < b->line ? -1 : a->line > b->line;
}

static uint32_t line_count(const Profile *profile) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < profile->file_count; i++)
        count += profile->files[i].source->line_count;
    return count;
}

static uint32_t add_lines(ProfileRow *rows, const Profile *profile) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < profile->file_count; i++)
        for (uint32_t k = 0; k < profile->files[i].source->line_count; k++) {
            const ProfileLine *line = &profile->files[i].lines[k];
            if (line->hits)
                rows[count++] = (ProfileRow){.seconds = (double)line->nanoseconds * 1e-9,
                                             .times = (double)line->hits,
                                             .source = profile->files[i].source,
                                             .line = k + 1};
        }
    return count;
}

static void add_row(Text *out, const ProfileRow *row, double total, double frames) {
    double percent = total > 0 ? 100 * row->seconds / total : 0;
    text_add_format(out, "%6.1f %% %10.4f ", percent, 1e3 * row->seconds / frames);
    if (!row->source) {
        text_add_format(out, "%12s  %s\n", "", row->what);
        return;
    }
    Str text = str_trim(source_locate(row->source, row->source->line_starts[row->line - 1]).text);
    text_add_format(out, "%12.6g  %.*s:%u: %.*s\n", row->times / frames, STR_ARGS(row->source->name), row->line,
                    STR_ARGS(text));
}

typedef struct ProfileRequest {
    double output_seconds;
    PetriWriteCallback *write;
    void *host;
} ProfileRequest;

static PetriStatus print_profile(PetriSession *session, void *context) {
    const ProfileRequest *request = context;
    const Profile *profile = session->vm.profile;
    const SessionFrame *frame = &session->frame;
    arena_reset(&session->text_arena);
    Text out = text_new(&session->text_arena);
    ProfileRow *rows = arena_alloc_array(&session->text_arena, line_count(profile) + 2, sizeof *rows);
    uint32_t count = add_lines(rows, profile);
    rows[count++] = (ProfileRow){.seconds = frame->profiled_physics, .what = "physics"};
    rows[count++] = (ProfileRow){.seconds = request->output_seconds, .what = "output"};
    qsort(rows, count, sizeof *rows, compare_rows);
    double total = 0, frames = frame->profiled_frames ? (double)frame->profiled_frames : 1;
    for (uint32_t i = 0; i < count; i++)
        total += rows[i].seconds;
    text_add_format(&out, "   share   ms/frame   evals/frame; total: %.4f ms per frame, %.0f frames\n",
                    1e3 * total / frames, (double)frame->profiled_frames);
    for (uint32_t i = 0; i < count; i++)
        add_row(&out, &rows[i], total, frames);
    return request->write(request->host, out.bytes, out.len) ? PETRI_OK : PETRI_INVALID;
}

PetriStatus petri_profile(PetriSession *session, double output_seconds, PetriWriteCallback *write, void *host) {
    if (!session || !write || !session->vm.profile)
        return PETRI_INVALID;
    ProfileRequest request = {output_seconds, write, host};
    return session_protect(session, NULL, print_profile, &request);
}
