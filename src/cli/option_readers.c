// option_readers.c: the readers of option_groups.h.
#include "cli/option_groups.h"
#include "cli/progress.h"
#include "petri-edit.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

bool option_invalid(const Args *args, const char *expected) {
    message("option '--%s' expects %s, not '%s'", args->option->name, expected, args->value);
    return false;
}

bool option_flag(const Args *args, void *field) {
    (void)args;
    *(bool *)field = true;
    return true;
}

bool option_unset(const Args *args, void *field) {
    (void)args;
    *(bool *)field = false;
    return true;
}

bool option_verbosity(const Args *args, void *field) {
    *(Verbosity *)field = (Verbosity)args->option->min;
    return true;
}

bool option_text(const Args *args, void *field) {
    *(const char **)field = args->value;
    return true;
}

bool option_integer(const Args *args, void *field) {
    const OptionSpec *option = args->option;
    char *end = NULL;
    errno = 0;
    intmax_t value = strtoimax(args->value, &end, 10);
    bool is_number = args->value[0] >= '-' && end != args->value && *end == '\0';
    if (!is_number || errno != 0 || value < option->min || value > option->max) {
        SCOPED_TEXT expected = {0};
        if (option->max < INT64_MAX - 1)
            text_add_format(&expected, "an integer from %" PRId64 " to %" PRId64, option->min, option->max);
        else
            text_add_format(&expected, "an integer >= %" PRId64, option->min);
        return option_invalid(args, expected.bytes);
    }
    *(int64_t *)field = value;
    return true;
}

bool option_positive(const Args *args, void *field) {
    double value = 0;
    bool good = petri_parse_number(args->value, &value) && isfinite(value) && value > 0;
    *(double *)field = value;
    return good || option_invalid(args, "a positive number");
}

bool option_amount(const Args *args, void *field) {
    static const char suffixes[] = "KMGT";
    char *end = NULL;
    double amount = strtod(args->value, &end);
    const char *suffix = end == args->value || *end == '\0' ? NULL : strchr(suffixes, *end & ~0x20);
    if (suffix) {
        amount = ldexp(amount, 10 * (int)(suffix - suffixes + 1));
        end++;
    }
    *(uint64_t *)field = amount >= 1 && amount <= 0x1p62 ? (uint64_t)amount : 0;
    bool good = end != args->value && *end == '\0' && *(uint64_t *)field > 0;
    return good || option_invalid(args, "a number >= 1, such as 500M or 2G");
}

bool option_fps(const Args *args, void *field) {
    args->options->fps_given = true;
    return option_positive(args, field);
}

bool option_time(const Args *args, void *field) {
    double seconds = 0;
    bool good = petri_parse_number(args->value, &seconds) && isfinite(seconds) && seconds >= 0;
    *(double *)field = seconds;
    return good || option_invalid(args, "seconds or a time code such as 1:30");
}

int option_find_word(const char *const *words, const char *word) {
    int i = 0;
    while (words[i] && strcmp(words[i], word) != 0)
        i++;
    return words[i] ? i : -1;
}

bool option_choice(const Args *args, void *field) {
    const char *const *words = args->option->words;
    int choice = *(int *)field = option_find_word(words, args->value);
    if (choice < 0) {
        SCOPED_TEXT expected = {0};
        for (int i = 0; words[i]; i++)
            text_add_format(&expected, "%s %s", i == 0 ? "one of" : ",", words[i]);
        return option_invalid(args, expected.bytes);
    }
    return true;
}

bool option_no_colour(void) {
    const char *refused = getenv("NO_COLOR");
    return refused && refused[0] != '\0';
}

bool option_default_colour(void) {
    return progress_possible() && !option_no_colour();
}

bool option_colour(const Args *args, void *field) {
    int choice = 0;
    bool good = option_choice(args, &choice);
    args->options->monochrome = choice == 2;
    *(bool *)field = choice == 0 ? option_default_colour() : choice == 1;
    return good;
}

bool option_definition(const Args *args, void *field) {
    const char *equals = strchr(args->value, '=');
    if (!equals || equals == args->value)
        return option_invalid(args, args->option->value);
    texts_add(field, args->value);
    return true;
}

bool option_folder(const Args *args, void *field) {
    const char *folder = strcmp(args->value, "all") == 0 ? "/" : args->value;
    struct stat info;
    if (stat(folder, &info) != 0 || !S_ISDIR(info.st_mode))
        return option_invalid(args, "an existing folder");
    texts_add(field, folder);
    return true;
}
