// shader_test.h: tests the shaders of scripts in a separate process, so that a crash of the driver, or a shader that
// takes too much time or memory to compile, becomes a diagnostic.
#pragma once

#include <stdbool.h>

struct PetriPainter;

// What happens if a signal arrives during a test.
typedef struct ShaderTester {
    int (*pending_signal)(void); // returns the number of a signal that ends the command, or 0; NULL: no function
    bool never_returns;          // true: drawing then sleeps until the process ends; false: the shader is left out
} ShaderTester;

// Like petri_painter_open, for a painter that tests shaders. The tester must outlive the painter.
struct PetriPainter *painter_open_tested(ShaderTester *tester);
// Returns true if a signal has ended a test, so that a picture may lack a shader.
bool shader_test_interrupted(void);
