// test_display_lists.c: compares the display list of each script of tests/pictures with stored hashes.
// usage: test_display_lists FOLDER [--update | --print SCRIPT]
//
// display_lists.txt has a line `script count hash` for each script, for the first frame; the hash is over the numbers
// as text. --print prints the numbers of one script, one per line, so that two versions can be compared with diff.
// Unlike pictures, display lists must not differ at all. They need neither Cairo nor OpenGL. Lists for hosts must
// consist of rows of petri-display-list.inc, without path effects.
#include "display_rows.h"

#include <dirent.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LINE = 200 };

// Writes the numbers of the display list to `print`, if it is not NULL, and returns their hash (FNV-1a).
static uint64_t hash_numbers(const double *numbers, size_t count, FILE *print) {
    uint64_t hash = 14695981039346656037u;
    for (size_t i = 0; i < count; i++) {
        char text[40];
        snprintf(text, sizeof text, "%.17g\n", numbers[i]);
        if (print)
            fputs(text, print);
        for (const char *at = text; *at; at++)
            hash = (hash ^ (unsigned char)*at) * 1099511628211u;
    }
    return hash;
}

// Returns true if a list consists of commands that hosts know.
static bool has_rows(const double *numbers, size_t count) {
    size_t at = 3, size = 1;
    for (; at < count && size > 0 && numbers[at] != PETRI_DRAW_EFFECT; at += size)
        size = display_row_size(numbers + at);
    return at == count;
}

// Stores the line of a script in `line`. Returns false if the script has no display list.
static bool describe(const char *folder, const char *name, FILE *print, char line[LINE]) {
    char script[1000];
    snprintf(script, sizeof script, "%s/%s", folder, name);
    PetriOptions options = petri_default_options();
    PetriPictureOptions picture_options = petri_default_picture_options();
    PetriSession *session = petri_open(&options);
    PetriPicture *picture = NULL;
    const double *numbers = NULL;
    size_t count = 0;
    bool done = petri_load(session, script) == PETRI_OK && petri_step(session) == PETRI_OK &&
                petri_picture(session, &picture_options, &picture) == PETRI_OK &&
                petri_picture_display_list(picture, &numbers, &count) == PETRI_OK && has_rows(numbers, count);
    if (done)
        snprintf(line, LINE, "%s %zu %016" PRIx64 "\n", name, count, hash_numbers(numbers, count, print));
    petri_picture_free(&picture);
    petri_close(&session);
    return done;
}

static int is_script(const struct dirent *entry) {
    size_t length = strlen(entry->d_name);
    return length > 3 && strcmp(entry->d_name + length - 3, ".fl") == 0 && strcmp(entry->d_name, "gallery.fl") != 0;
}

// Compares a line with the next line of the stored file. Returns the number of failures.
static int compare_line(FILE *stored, const char *line) {
    char wanted[LINE] = "";
    if (fgets(wanted, sizeof wanted, stored) && strcmp(wanted, line) == 0)
        return 0;
    printf("FAIL %.*s: the display list differs; to see it, run test_display_lists with --print\n",
           (int)strcspn(line, " "), line);
    return 1;
}

int main(int argc, char **argv) {
    char line[LINE], path[1000];
    if (argc < 2)
        return 2;
    if (argc > 3)
        return describe(argv[1], argv[3], stdout, line) ? 0 : 1;
    struct dirent **entries;
    int count = scandir(argv[1], &entries, is_script, alphasort), failed = 0;
    snprintf(path, sizeof path, "%s/display_lists.txt", argv[1]);
    FILE *stored = fopen(path, argc > 2 ? "w" : "r");
    for (int i = 0; stored && i < count; i++) {
        if (!describe(argv[1], entries[i]->d_name, NULL, line)) {
            printf("FAIL %s: no display list\n", entries[i]->d_name);
            failed++;
        } else if (argc > 2) {
            fputs(line, stored);
        } else {
            failed += compare_line(stored, line);
        }
    }
    bool extra = stored && argc == 2 && fgets(line, sizeof line, stored);
    if (!stored || extra)
        printf("FAIL: %s\n", stored ? "display_lists.txt has more scripts" : "display_lists.txt is missing");
    failed += !stored || extra;
    if (stored)
        fclose(stored);
    for (int i = 0; i < count; i++)
        free(entries[i]);
    if (count > 0)
        free(entries);
    printf("%d display lists, %d failures\n", count, failed);
    return failed > 0 || count <= 0;
}
