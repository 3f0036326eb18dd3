// helpers.h: what Python would otherwise ask libpetri for in several calls; all without the interpreter's lock.
#ifndef PETRI_SRC_PYTHON_HELPERS_H
#define PETRI_SRC_PYTHON_HELPERS_H

#include "petri-draw.h"

// Makes so many frames, until one fails, or a function of Python's sets `stop` (NULL: there are none). `interruptible`:
// Ctrl-C interrupts them; for the main thread only, whose handler then tells Python.
PetriStatus petri_python_step(PetriSession *session, size_t count, bool interruptible, const bool *stop);

// The system of this name, looked for first where it was; -1 if there is none. NULL stands for any name.
int petri_python_system(PetriSession *session, int number, const char *name, PetriSystem *system);

// A column of a system.
typedef struct PetriPythonView {
    uintptr_t address; // 0 if there are no such numbers
    size_t count;      // of particles
    size_t width;      // doubles of each
    size_t stride;     // in doubles
} PetriPythonView;
// False if there is no such system. `which` is one of the letters of Python's attribute: p, v, f, r, m, c.
bool petri_python_view(PetriSession *session, int number, const char *name, char which, PetriPythonView *view);

// The value under a key of so many numbers; false if it has other elements than numbers.
bool petri_python_state(PetriSession *session, const double *key, uint32_t length, PetriValue *value);
// The same of a symbol and a number.
bool petri_python_pair(PetriSession *session, double symbol, double number, PetriValue *value);

// The PetriFunctionCall of a function of Python's, whose handle `host` is.
PetriValue petri_python_call(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count);

// What takes a handle by its address, for finalizers; and what Python cannot call, since it is inline.
void petri_python_close(PetriSession *session);
void petri_python_painter_close(PetriPainter *painter);
void petri_python_picture_free(PetriPicture *picture);
void petri_python_picture_options(PetriPictureOptions *options);

#endif
