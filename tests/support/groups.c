// groups.c: runs the groups of a test program. usage: PROGRAM [GROUP [ARGUMENT...]]. Without arguments, it runs all
// groups. GROUPS, which meson.build defines, lists them: GROUP(NAME) GROUP(NAME)...
#include "groups.h"

#include <stdio.h>
#include <string.h>

enum { MISUSED = 2 };

#define GROUP(name) int group_##name(int argc, char **argv);
GROUPS
#undef GROUP

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} groups[] = {
#define GROUP(name) {#name, group_##name},
    GROUPS
#undef GROUP
};
enum { GROUP_COUNT = sizeof groups / sizeof groups[0] };

static int run_all(void) {
    int failed = 0;
    for (size_t i = 0; i < GROUP_COUNT; i++) {
        char name[100], *argv[] = {name, NULL};
        snprintf(name, sizeof name, "%s", groups[i].name);
        int status = groups[i].run(1, argv);
        failed += status != 0 && status != GROUP_SKIPPED;
        printf("%s: %s\n", name, status == 0 ? "passed" : status == GROUP_SKIPPED ? "skipped" : "FAILED");
    }
    return failed > 0;
}

int main(int argc, char **argv) {
    if (argc < 2)
        return run_all();
    for (size_t i = 0; i < GROUP_COUNT; i++)
        if (strcmp(groups[i].name, argv[1]) == 0)
            return groups[i].run(argc - 1, argv + 1);
    fprintf(stderr, "no group '%s'; this program has:\n", argv[1]);
    for (size_t i = 0; i < GROUP_COUNT; i++)
        fprintf(stderr, "  %s\n", groups[i].name);
    return MISUSED;
}
