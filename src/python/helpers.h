// helpers.h: functions for the Python module that combine several calls of libpetri. They run without the GIL.
#pragma once

#include "petri-archive.h"
#include "petri-draw.h"
#include "petri-edit.h"
#include "petri-inspect.h"
#include "petri-live.h"
#include "petri-ranks.h"

// Computes `count` frames, or fewer if a frame fails or a Python function sets *stop. `stop` is NULL if the session has
// no functions. If `interruptible` is true, Ctrl-C interrupts the step and is then passed to Python's handler.
// `interruptible` must be false in threads other than the main thread.
PetriStatus petri_python_step(PetriSession *session, size_t count, bool interruptible, const bool *stop);
// Call petri_trust and petri_archive_replay. Ctrl-C interrupts them in the same way.
PetriStatus petri_python_run_trust(PetriSession *session, const PetriTrustOptions *options, bool interruptible);
PetriStatus petri_python_replay(PetriArchive *archive, PetriSession *session, int64_t frame, bool interruptible);

// Finds the system called `name` and sets *system. Tries the index `number` first, and tries no other index if `name`
// is NULL. Returns the index of the system, or -1 if there is none.
int petri_python_system(PetriSession *session, int number, const char *name, PetriSystem *system);

// Memory layout of a column of a system.
typedef struct PetriPythonView {
    uintptr_t address; // 0: the system has no such column
    size_t count;      // number of particles
    size_t width;      // doubles per particle
    size_t stride;     // doubles from one particle to the next
} PetriPythonView;
// Sets *view to the layout of a column of the system that petri_python_system would find. `which` is the first letter
// of the attribute: p, v, f, r, m or c. Returns false if there is no such system.
bool petri_python_view(PetriSession *session, int number, const char *name, char which, PetriPythonView *view);

// Sets *value to the value of the state key that consists of the numbers key[0] to key[length - 1]. Returns false if
// the value is not numeric.
bool petri_python_state(PetriSession *session, const double *key, uint32_t length, PetriValue *value);
// Like petri_python_state, for a key that consists of a symbol and a number.
bool petri_python_pair(PetriSession *session, double symbol, double number, PetriValue *value);

// The PetriFunctionCall of Python functions; `user_data` is the handle of the function.
PetriValue petri_python_call(PetriCall *call, void *user_data, const PetriValue *arguments, uint32_t count);

// Finalisers that take the object itself instead of its address, and a wrapper of an inline function, which cffi cannot
// call.
void petri_python_close(PetriSession *session);
void petri_python_painter_close(PetriPainter *painter);
void petri_python_picture_free(PetriPicture *picture);
void petri_python_picture_options(PetriPictureOptions *options);
