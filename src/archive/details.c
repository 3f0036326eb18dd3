// details.c: see details.h.
//
// The computed state is printed first, because loading the recorded state into the session replaces it.
#include "archive/details.h"

#include "cli/state_text.h"

#include <math.h>

// Returns true if the archive has a computed state of a frame.
static bool has_state(PetriArchive *archive, int64_t frame) {
    PetriArchiveKeyframe keyframe;
    for (size_t i = 0; petri_archive_keyframe(archive, i, &keyframe, sizeof keyframe); i++)
        if (keyframe.frame == frame)
            return !keyframe.given;
    return false;
}

static void add_report(int64_t frame, const Text *recorded, const Text *computed, Text *details) {
    static const char *const labels[] = {"archive", "computed"};
    StateText a = state_text_read(text_str(recorded)), b = state_text_read(text_str(computed));
    StateDifferences differences = state_text_compare(&a, &b);
    const StateDifference *first = state_first_difference(&differences);
    if (first)
        state_add_report(details, labels, frame, NAN, &differences, first);
    state_differences_free(&differences);
    state_text_free(&a);
    state_text_free(&b);
}

void details_add(PetriArchive *archive, PetriSession *session, int64_t end, Text *details) {
    SCOPED_TEXT computed = {0};
    SCOPED_TEXT recorded = {0};
    PetriStatus status = has_state(archive, end) ? PETRI_OK : PETRI_INVALID;
    while (status == PETRI_OK && petri_frame_number(session) < end)
        status = petri_step(session);
    if (status == PETRI_OK)
        status = petri_print(session, PETRI_PRINT_STATE, text_collect, &computed);
    if (status == PETRI_OK)
        status = petri_archive_load(archive, session, end);
    if (status == PETRI_OK)
        status = petri_print(session, PETRI_PRINT_STATE, text_collect, &recorded);
    if (status == PETRI_OK)
        add_report(end, &recorded, &computed, details);
}
