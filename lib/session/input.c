// input.c: pointer and key input reported by the host.
#include "session/session.h"

#include <math.h>

static PetriStatus report_pointer(PetriSession *session, const PetriPointer *given) {
    PetriPointer pointer = {0};
    if (!session)
        return PETRI_INVALID;
    Input *input = scene_input(session->scene);
    if (!given) {
        input_release_all(input);
        return PETRI_OK;
    }
    if (!host_struct_read(&pointer, sizeof pointer, given))
        return PETRI_INVALID;
    if (!pointer.inside) {
        input_report_pointer(input, NULL, pointer.buttons);
        return PETRI_OK;
    }
    if (!isfinite(pointer.x) || !isfinite(pointer.y))
        return PETRI_INVALID;
    input_report_pointer(input, (double[]){fmin(1, fmax(0, pointer.x)), fmin(1, fmax(0, pointer.y))}, pointer.buttons);
    return PETRI_OK;
}

PetriStatus petri_report_pointer(PetriSession *session, const PetriPointer *pointer) {
    if (session && session->recorder.ignores_input)
        return PETRI_OK;
    PetriStatus status = report_pointer(session, pointer);
    if (status == PETRI_OK)
        recorder_pointer(session, pointer);
    return status;
}

PetriStatus petri_report_key(PetriSession *session, const char *name, bool pressed) {
    if (!session || !name)
        return PETRI_INVALID;
    int key = input_key_number(str_from(name));
    if (key == INPUT_KEY_NONE)
        return PETRI_INVALID;
    if (session->recorder.ignores_input)
        return PETRI_OK;
    input_report_key(scene_input(session->scene), key, pressed);
    recorder_key(session, name, pressed);
    return PETRI_OK;
}

bool petri_key_is_bound(PetriSession *session, const char *name) {
    return session && name && input_key_is_bound(scene_input(session->scene), input_key_number(str_from(name)));
}
