// save.c: state files (petri_save, petri_restore).
#include "base/file.h"
#include "base/spec.h"
#include "session/image_text.h"
#include "session/session.h"

#define MAX_STATE_BYTES (SIZE_MAX > UINT32_MAX ? (size_t)(UINT64_C(8) << 30) : (size_t)1 << 30)

static void report_state_error(PetriSession *session, const char *what, const char *file, const char *reason) {
    session_report_text(session, DIAG_ERROR, "state-file",
                        str_format(&session->text_arena, "%s '%s': %s", what, file, reason));
}

static PetriStatus save_state(PetriSession *session, void *context) {
    const char *file = context, *problem = file_replace(file, image_state_text(session), 0);
    if (problem)
        report_state_error(session, "cannot write the state to", file, problem);
    return problem ? PETRI_INVALID : PETRI_OK;
}

PetriStatus petri_save(PetriSession *session, const char *file) {
    if (!session || !file)
        return PETRI_INVALID;
    ArenaMark mark = arena_mark(&session->text_arena);
    PetriStatus status = session_protect(session, NULL, save_state, (void *)file);
    arena_rewind(&session->text_arena, mark);
    return status;
}

static PetriStatus read_state_file(PetriSession *session, Incoming *incoming, void *context) {
    const char *file = context, *reason = NULL;
    int64_t frame = 0;
    Str text;
    if (file_read(&incoming->arena, NULL, file, true, MAX_STATE_BYTES, &text, NULL, &reason))
        reason = image_read_state(session, incoming, text, &frame);
    if (reason)
        report_state_error(session, "cannot load the state from", file, reason);
    else
        clock_resume(&incoming->clock, frame);
    if (!reason && incoming->old_rules != session->old_rules)
        session_report_text(session, DIAG_WARNING, "state-spec",
                            str_format(&session->text_arena,
                                       "'%s' was computed by version %s of the specification; the run continues by %s",
                                       file, spec_version(incoming->old_rules), spec_version(session->old_rules)));
    return reason ? PETRI_INVALID : PETRI_OK;
}

PetriStatus petri_restore(PetriSession *session, const char *file) {
    if (!session || !file)
        return PETRI_INVALID;
    if (!file_exists(file))
        return PETRI_OK;
    PetriStatus status = checkpoint_replace(session, read_state_file, (void *)file);
    if (status == PETRI_OK) {
        session_change_config(session, false);
        recorder_jump(session);
    }
    return status;
}
