// machine.h: a description of the machine and the build for reports.
#pragma once

#include <stddef.h>

// Writes one line: processor, vector level, threads, compiler, load.
void machine_describe(char *text, size_t size, int threads);
