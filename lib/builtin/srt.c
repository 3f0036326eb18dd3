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

// Parses [[hh:]mm:]ss[,mmm] to seconds, adding in this order: mmm/1000, ss, 60*mm, 3600*hh. The comma can be a point.
// Returns false if the text is invalid.
static bool read_time(Str text, double *time) {
    Str rest = str_trim(text), clock, part;
    double milliseconds = 0, parts[3];
    bool has_comma = memchr(rest.bytes, ',', rest.len) != NULL;
    if (split_part(&rest, has_comma ? STR(",") : STR("."), &clock) && !read_digits(rest, &milliseconds))
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

static uint32_t count_text_lines(Str text) {
    if (text.len == 0)
        return 0;
    uint32_t lines = 1;
    for (size_t i = 0; i < text.len; i++)
        lines += text.bytes[i] == '\n';
    return lines;
}

// What a line of the file is.
typedef enum LineKind { LINE_EMPTY, LINE_NUMBER, LINE_TIMES, LINE_DAMAGED, LINE_TEXT } LineKind;

// Classifies a line, and sets the times of a LINE_TIMES. After the times, there can be a position (X1:40 X2:600 ...).
static LineKind read_subtitle_line(Str line, Subtitle *subtitle) {
    Str times = str_trim(line), start, end;
    if (times.len == 0)
        return LINE_EMPTY;
    if (builtin_is_integer(times))
        return LINE_NUMBER;
    bool begins = times.bytes[0] >= '0' && times.bytes[0] <= '9';
    if (!begins || !split_part(&times, STR("-->"), &start))
        return LINE_TEXT;
    times = str_trim(times);
    size_t len = 0;
    while (len < times.len && times.bytes[len] != ' ' && times.bytes[len] != '\t')
        len++;
    end = (Str){times.bytes, len};
    return read_time(start, &subtitle->start) && read_time(end, &subtitle->end) ? LINE_TIMES : LINE_DAMAGED;
}

// Sets the text of a subtitle to the lines between two places, without the empty lines around them.
static void set_text(Subtitle *subtitle, const char *begin, const char *end) {
    Str text = {begin, (size_t)(end - begin)}, line;
    for (Str rest = text; rest.len > 0 && split_part(&rest, STR("\n"), &line) && str_trim(line).len == 0;)
        text = rest;
    size_t used = text.len;
    while (used > 0 && (unsigned char)text.bytes[used - 1] <= ' ')
        used--;
    while (used > 0 && used < text.len && text.bytes[used] != '\n')
        used++;
    text.len = used;
    subtitle->text = text;
    subtitle->line_count = count_text_lines(text);
}

// Finds the subtitles of a file. A subtitle begins with a line of times, before which there can be a line with a
// number. `subtitles`: NULL to count only. Returns their number; on failure, sets *bad to the number of the first
// invalid line.
static uint32_t find_subtitles(Str all, Subtitle *subtitles, uint32_t *bad) {
    Subtitle next = {0}, last = {0};
    const char *text = NULL,
               *number = NULL; // text: text of the last subtitle; number: line before this one, if a number
    uint32_t count = 0, lines = 0;
    for (Str rest = all, line; rest.len > 0;) {
        split_part(&rest, STR("\n"), &line);
        lines++;
        LineKind kind = read_subtitle_line(line, &next);
        if (kind == LINE_DAMAGED || (kind == LINE_TEXT && count == 0)) {
            *bad = lines;
            return 0;
        }
        if (kind == LINE_TIMES) {
            if (count > 0 && subtitles) {
                set_text(&last, text, number ? number : line.bytes);
                subtitles[count - 1] = last;
            }
            last = next;
            text = rest.bytes;
            count++;
        }
        number = kind == LINE_NUMBER ? line.bytes : NULL;
    }
    if (count > 0 && subtitles) {
        set_text(&last, text, all.bytes + all.len);
        subtitles[count - 1] = last;
    }
    *bad = count ? 0 : lines;
    return count;
}

static const void *parse_srt(Arena *arena, char *bytes, size_t len, const char **problem) {
    if (!file_is_text(bytes, len, problem))
        return NULL;
    Str all = {bytes, source_unify_lines(bytes, len)};
    if (str_starts_with(all, STR("\xEF\xBB\xBF")))
        all = (Str){all.bytes + 3, all.len - 3};
    uint32_t bad, count = find_subtitles(all, NULL, &bad);
    if (count == 0) {
        *problem = str_format(arena, "it is not a subtitle file: line %u is not START --> END", bad).bytes;
        return NULL;
    }
    SrtFile *file = arena_alloc(arena, sizeof *file);
    Subtitle *subtitles = arena_alloc_array(arena, count, sizeof *subtitles);
    find_subtitles(all, subtitles, &bad);
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
