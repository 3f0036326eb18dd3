// repl_words.c: see repl_words.h.
#include "repl_words.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char BLANKS[] = " \t\r\n";

static bool is_blank(char c) {
    return c != '\0' && strchr(BLANKS, c) != NULL;
}

static void cut_end(char *text) {
    size_t length = strlen(text);
    while (length > 0 && is_blank(text[length - 1])) {
        length--;
    }
    text[length] = '\0';
}

char *word_trimmed(const char *text) {
    text += strspn(text, BLANKS);
    char *copy = memory_copied(text, strlen(text));
    cut_end(copy);
    return copy;
}

static bool read_count(const char *text, int64_t *count) {
    char *end = NULL;
    errno = 0;
    intmax_t value = strtoimax(text, &end, 10);
    *count = value;
    return end != text && *end == '\0' && errno == 0 && !is_blank(text[0]) && text[0] != '+';
}

bool word_count(Repl *repl, const char *text, int64_t least, int64_t *count) {
    int64_t value = 0;
    if (text[0] == '\0') {
        return true;
    }
    if (!read_count(text, &value) || value < least) {
        return repl_fail(repl, "'%.40s' is no whole number from %" PRId64, text, least);
    }
    *count = value;
    return true;
}

bool word_limit(Repl *repl, char *text, int64_t *limit) {
    static const char option[] = "--limit";
    char *at = text;
    while ((at = strstr(at, option)) != NULL) {
        char *word = at + sizeof option - 1 + strspn(at + sizeof option - 1, " \t=");
        char *end = word + strcspn(word, BLANKS);
        char *after = end + strspn(end, BLANKS);
        if ((at == text || is_blank(at[-1])) && (at == text || *after == '\0')) {
            char *number = memory_copied(word, (size_t)(end - word));
            bool good = number[0] != '\0' ? word_count(repl, number, 1, limit)
                                          : repl_fail(repl, "--limit needs a number of frames");
            free(number);
            memmove(at, after, strlen(after) + 1);
            cut_end(text);
            return good;
        }
        at++;
    }
    return true;
}

void word_last_count(char *text, int64_t *count) {
    char *last = text + strlen(text);
    while (last > text && !is_blank(last[-1])) {
        last--;
    }
    int64_t value = 0;
    if (last > text && read_count(last, &value) && value > 0) {
        *count = value;
        *last = '\0';
        cut_end(text);
    }
}
