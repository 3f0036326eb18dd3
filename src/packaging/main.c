// main.c: a program that writes manual pages, editor grammars and tables. Only the build uses it; it is not installed.
//
//   petri-manual tables.json              writes petri's tables to standard output
//   petri-manual --pages FOLDER PAGE...   writes manual pages
//   petri-manual --fill FOLDER FILE.in... fills templates (template.c) and writes each as FILE
#include "cli/help.h"
#include "packaging/packaging.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool write_page(Output *output, const char *name) {
    if (strcmp(name, "petri.1") == 0) {
        page_of_petri(output);
        return true;
    }
    if (strcmp(name, "petri.5") == 0) {
        page_of_language(output);
        return true;
    }
    for (const CommandRow *row = COMMANDS; row->listed; row++) {
        char page[32];
        snprintf(page, sizeof page, "petri-%s.1", row->name);
        if (strcmp(page, name) == 0) {
            page_of_command(output, row->command);
            return true;
        }
    }
    return false;
}

// Calls `write` for a source, with an output for the file of this name in the folder. A suffix ".in" is omitted.
static int write_file(const char *folder, const char *source, bool (*write)(Output *output, const char *source)) {
    const char *slash = strrchr(source, '/'), *name = slash ? slash + 1 : source;
    size_t length = strlen(name);
    if (length > 3 && strcmp(name + length - 3, ".in") == 0)
        length -= 3;
    char path[4096];
    snprintf(path, sizeof path, "%s/%.*s", folder, (int)length, name);
    int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (fd < 0) {
        perror(path);
        return STATUS_FAILED;
    }
    Output *output = memory_calloc(sizeof *output);
    output_start(output, fd);
    bool known = write(output, source);
    int status = output_finish(output, STATUS_DONE);
    free(output);
    close(fd);
    if (!known)
        fprintf(stderr, "petri-manual: cannot write '%s'\n", source);
    return known ? status : STATUS_USAGE;
}

int main(int argc, char **argv) {
    int status = STATUS_DONE;
    if (argc == 2 && strcmp(argv[1], "tables.json") == 0) {
        Output *output = help_begin();
        tables_as_json(output);
        return help_end(output);
    }
    bool pages = argc > 2 && strcmp(argv[1], "--pages") == 0;
    if (!pages && (argc < 3 || strcmp(argv[1], "--fill") != 0))
        return STATUS_USAGE;
    for (int i = 3; i < argc && status == STATUS_DONE; i++)
        status = write_file(argv[2], argv[i], pages ? write_page : template_fill);
    return status;
}
