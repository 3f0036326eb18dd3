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

// Returns true for `#DATA`, and for a URL that ends so. DATA is base64url. The value of an option such as `#1` is
// shorter.
static bool is_link(const char *word) {
    enum { MIN_DATA = 8 };
    static const char base64url[] = "0123456789_-abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    const char *letters = base64url + strlen("0123456789_-");
    const char *mark = strchr(word, '#');
    if (!mark || (mark != word && strncmp(word + strspn(word, letters), "://", 3) != 0))
        return false;
    const char *data = mark + 1;
    size_t length = strspn(data, base64url);
    return data[length] == '\0' && length >= MIN_DATA && access(word, F_OK) != 0;
}

bool words_name_link(char *const *words) {
    while (*words && !is_link(*words))
        words++;
    return *words;
}
