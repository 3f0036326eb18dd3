// machine.h: which machine and which build the figures are from.
#ifndef TESTS_BENCH_MACHINE_H
#define TESTS_BENCH_MACHINE_H

#include <stddef.h>

// One line: processor, vector level, compiler, how busy the machine is.
void machine_describe(char *text, size_t size, int threads);

#endif
