// main.c: a program that writes one manual page or editor grammar to standard output. Only the
// build uses it; it is not installed.
#include "cli/help.h"
#include "packaging/packaging.h"

#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    void (*write)(Output *output);
} products[] = {
    {"petri.1", page_of_petri},
    {"petri.5", page_of_language},
    {"tables.json", tables_as_json},
};

static bool write_product(Output *output, const char *name) {
    for (size_t i = 0; i < sizeof products / sizeof products[0]; i++) {
        if (strcmp(products[i].name, name) == 0) {
            products[i].write(output);
            return true;
        }
    }
    for (size_t i = 0; COMMANDS[i]; i++) {
        char page[32];
        snprintf(page, sizeof page, "petri-%s.1", COMMANDS[i]->name);
        if (strcmp(page, name) == 0) {
            page_of_command(output, COMMANDS[i]);
            return true;
        }
    }
    return false;
}

int main(int argc, char **argv) {
    Output *output = help_begin();
    bool known = argc == 3 ? strcmp(argv[1], "--fill") == 0 && template_fill(output, argv[2])
                           : argc == 2 && write_product(output, argv[1]);
    int status = help_end(output);
    return known ? status : STATUS_USAGE;
}
