// words.c: see words.h.
#include "cli/words.h"

#include "petri-archive.h"

#include <string.h>
#include <unistd.h>

bool word_is_option(const char *word, const char *name) {
    size_t length = strlen(name);
    return strncmp(word, "--", 2) == 0 && strncmp(word + 2, name, length) == 0 && strchr("=", word[2 + length]);
}

bool words_have_option(char *const *words, const char *name) {
    while (*words && !word_is_option(*words, name))
        words++;
    return *words;
}

bool words_name_archive(char *const *words) {
    for (char *const *word = words; *word; word++)
        if (petri_archive_is(*word))
            return true;
    return words_have_option(words, "archive");
}

bool words_name_link(char *const *words) {
    for (; *words; words++)
        if ((**words == '#' || (strstr(*words, "://") && strchr(*words, '#'))) && access(*words, F_OK) != 0)
            return true;
    return false;
}
