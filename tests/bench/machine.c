// machine.c: see machine.h.
#include "machine.h"

#include "base/cpu.h"
#include "base/os.h"
#include "petri.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifdef __clang__
#define COMPILER "clang "
#else
#define COMPILER "gcc "
#endif

// Reads the value of a line of /proc/cpuinfo, such as "model name".
static void processor_line(const char *name, char *value, size_t size) {
    FILE *file = fopen("/proc/cpuinfo", "r");
    char line[512];
    snprintf(value, size, "unknown");
    while (file && fgets(line, sizeof line, file)) {
        char *colon = strchr(line, ':');
        size_t length = strlen(name);
        if (colon && !strncmp(line, name, length) && strspn(line + length, " \t") == (size_t)(colon - line) - length) {
            line[strcspn(line, "\n")] = '\0';
            snprintf(value, size, "%s", colon + 1 + strspn(colon + 1, " "));
            break;
        }
    }
    if (file)
        fclose(file);
}

void machine_describe(char *text, size_t size, int threads) {
    char name[128], family[16], model[16];
    processor_line("model name", name, sizeof name);
    processor_line("cpu family", family, sizeof family);
    processor_line("model", model, sizeof model);
    CpuLevel level;
    cpu_choose(getenv("PETRI_CPU"), &level);
    double load = 0;
    getloadavg(&load, 1);
    snprintf(text, size, "%s (family %s, model %s), %d processors, %s; petri %s on 1 and %d threads; %s%s; load %.1f",
             name, family, model, os_processor_count(), cpu_name(level), petri_version(), threads, COMPILER,
             __VERSION__, load);
}
