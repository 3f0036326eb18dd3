// words.c: see words.h.
#include "repl/words.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

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

// What the text stands for, which need not be finite. False after a message.
static bool evaluate(Repl *repl, const char *text, double *number) {
    PetriResult result;
    if (petri_read_number(text, number) && isfinite(*number)) {
        return true;
    }
    repl_busy(repl);
    PetriStatus status = petri_evaluate(repl->session, text, PETRI_Z, &result, NULL, NULL);
    repl_idle(repl);
    if (!repl_status(repl, status)) {
        return false;
    }
    *number = result.number;
    return true;
}

bool word_number(Repl *repl, const char *text, double *number) {
    return evaluate(repl, text, number) && (isfinite(*number) || repl_fail(repl, "'%.40s' is no number", text));
}

bool word_count(Repl *repl, const char *text, int64_t least, int64_t *count) {
    static const double most = 9007199254740992; // beyond it not all whole numbers are there
    double value = 0;
    if (text[0] == '\0' || (read_count(text, count) && *count >= least)) {
        return true;
    }
    if (!evaluate(repl, text, &value)) {
        return false;
    }
    if (!(value == floor(value) && value >= (double)least && value <= most)) {
        return repl_fail(repl, "'%.40s' is no whole number from %" PRId64, text, least);
    }
    *count = (int64_t)value;
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

static size_t screen_lines(const Repl *repl, size_t around) {
    enum { FEWEST = 5, USUAL = 24 };
    struct winsize size = {0};
    if (!repl->terminal) {
        return SIZE_MAX;
    }
    size_t rows = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_row > 0 ? size.ws_row : USUAL;
    return rows > around + FEWEST ? rows - around : FEWEST;
}

size_t word_lines(const Repl *repl, char *text, size_t around) {
    char *last = text + strlen(text);
    while (last > text && !is_blank(last[-1])) {
        last--;
    }
    char *before = last;
    while (before > text && is_blank(before[-1])) {
        before--;
    }
    int64_t count = 0;
    bool all = strcmp(last, "all") == 0, open = before > text && before[-1] == ';'; // what goes on with a key
    if (open || (!all && !(read_count(last, &count) && count > 0))) {
        return screen_lines(repl, around);
    }
    *before = '\0';
    return all ? SIZE_MAX : (size_t)count;
}
