// srt.c: subtitle files (spec builtins.md B13.6).
#include "base/number.h"
#include "base/source.h"
#include "builtin/family.h"
#include "builtin/files.h"

#include <string.h>

typedef struct Subtitle {
    double start, end; // seconds
    Str text;          // the lines, joined by LF
    uint32_t line_count;
} Subtitle;

typedef struct SrtFile {
    const Subtitle *subtitles;
    uint32_t count;
} SrtFile;

// Sets *part to the text before the first separator, and *text to the text after that separator. If there is no
// separator, sets *part to the whole text and *text to an empty string, and returns false.
static bool split_part(Str *text, Str separator, Str *part) {
    size_t at = 0;
    while (at + separator.len <= text->len && memcmp(text->bytes + at, separator.bytes, separator.len) != 0)
        at++;
    bool found = at + separator.len <= text->len;
    *part = (Str){text->bytes, found ? at : text->len};
    size_t used = part->len + (found ? separator.len : 0);
    *text = (Str){text->bytes + used, text->len - used};
    return found;
}

static bool read_digits(Str text, double *x) {
    for (size_t i = 0; i < text.len; i++)
        if (text.bytes[i] < '0' || text.bytes[i] > '9')
            return false;
    *x = text.len ? number_parse(text) : 0;
    return text.len > 0;
}

// Parses [[hh:]mm:]ss[,mmm] to seconds, adding in this order: mmm/1000, ss, 60*mm, 3600*hh. Returns false if the text
// is invalid.
static bool read_time(Str text, double *time) {
    Str rest = str_trim(text), clock, part;
    double milliseconds = 0, parts[3];
    if (split_part(&rest, STR(","), &clock) && !read_digits(rest, &milliseconds))
        return false;
    int count = 0;
    for (bool more = true; more; count++) {
        if (count == 3)
            return false;
        more = split_part(&clock, STR(":"), &part);
        if (!read_digits(part, &parts[count]))
            return false;
    }
    *time = milliseconds / 1000;
    static const double unit[3] = {1, 60, 3600};
    for (int i = 0; i < count; i++)
        *time = *time + unit[i] * parts[count - 1 - i];
    return true;
}

static uint32_t count_lines(Str text) {
    if (text.len == 0)
        return 0;
    uint32_t lines = 1;
    for (size_t i = 0; i < text.len; i++)
        lines += text.bytes[i] == '\n';
    return lines;
}

static bool read_section(Str section, Subtitle *subtitle) {
    Str number, times, start;
    if (section.len && section.bytes[section.len - 1] == '\n') // the newline at the end of the file
        section.len--;
    if (!split_part(&section, STR("\n"), &number) || !builtin_is_integer(number))
        return false;
    split_part(&section, STR("\n"), &times);
    if (!split_part(&times, STR("-->"), &start) || !read_time(start, &subtitle->start) ||
        !read_time(times, &subtitle->end))
        return false;
    subtitle->text = section;
    subtitle->line_count = count_lines(section);
    return true;
}

static const void *parse_srt(Arena *arena, char *bytes, size_t len, const char **problem) {
    if (!file_is_text(bytes, len, problem))
        return NULL;
    Str all = {bytes, source_unify_lines(bytes, len)}, rest = all, section;
    uint32_t count = 1;
    while (split_part(&rest, STR("\n\n"), &section))
        count++;
    SrtFile *file = arena_alloc(arena, sizeof *file);
    Subtitle *subtitles = arena_alloc_array(arena, count, sizeof *subtitles);
    rest = all;
    for (uint32_t i = 0; i < count; i++) {
        split_part(&rest, STR("\n\n"), &section);
        if (!read_section(section, &subtitles[i])) {
            *problem = "it is not a subtitle file";
            return NULL;
        }
    }
    *file = (SrtFile){subtitles, count};
    return file;
}

static bool is_shown(const Subtitle *subtitle, double time) {
    return subtitle->start <= time && time < subtitle->end;
}

Value builtin_srt(BuiltinContext *context, const Value *args, uint32_t count) {
    if (!value_is_number(args[1]))
        return VALUE_NULL;
    const SrtFile *file = file_cache_get(context, "srt", parse_srt, args[0]);
    if (!file)
        return VALUE_NULL;
    double time = args[1].as.number;
    uint64_t len = 0;
    for (uint32_t i = 0; i < file->count; i++)
        len += is_shown(&file->subtitles[i], time) ? file->subtitles[i].line_count : 0;
    if (len == 0)
        return VALUE_NULL;
    if (len > VALUE_MAX_LEN)
        return builtin_too_long(context, "srt");
    Str *lines = arena_alloc_array(context->arena, (size_t)len, sizeof *lines);
    uint32_t line = 0;
    for (uint32_t i = 0; i < file->count; i++) {
        Str text = file->subtitles[i].text, part;
        for (uint32_t k = 0; is_shown(&file->subtitles[i], time) && k < file->subtitles[i].line_count; k++, line++) {
            split_part(&text, STR("\n"), &part);
            lines[line] = str_copy(context->arena, part);
        }
    }
    return builtin_texts(context->arena, lines, line);
}
