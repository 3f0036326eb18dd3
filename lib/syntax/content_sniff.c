// content_sniff.c: see content_sniff.h.
//
// The errors of a text are replaced by one if at least half of its lines are invalid and nothing says that it is a
// script. A text with a NUL is always binary.
#include "syntax/content_sniff.h"

#include <string.h>

// Byte-order marks of encodings other than UTF-8. Longer marks come first.
static const struct {
    Str bytes;
    const char *encoding;
} signatures[] = {
    {{"\xff\xfe\0\0", 4}, "UTF-32"},
    {{"\0\0\xfe\xff", 4}, "UTF-32"},
    {{"\xff\xfe", 2}, "UTF-16"},
    {{"\xfe\xff", 2}, "UTF-16"},
};

// Returns true if every other byte at the start of the text is NUL, as in UTF-16 without a byte-order mark.
static bool alternates(Str text) {
    enum { MAX_SNIFFED = 32, MIN_LENGTH = 4 };
    size_t count[2] = {0}, len = text.len < MAX_SNIFFED ? text.len & ~(size_t)1 : MAX_SNIFFED;
    for (size_t i = 0; i < len; i++)
        count[i % 2] += text.bytes[i] == 0;
    return len >= MIN_LENGTH && count[0] + count[1] == len / 2 && (count[0] == 0 || count[1] == 0);
}

const char *content_sniff_encoding(const Source *source) {
    for (size_t i = 0; i < sizeof signatures / sizeof signatures[0]; i++)
        if (str_starts_with(source->text, signatures[i].bytes))
            return signatures[i].encoding;
    return alternates(source->text) ? "UTF-16" : NULL;
}

// Returns true if the source is certainly meant to be a script: its name ends with .fl or its hashbang line names
// petri. Also returns true if the source is neither a file nor a stream such as `<stdin>`. It then comes from the host,
// for example from a prompt.
static bool claims_to_be_script(const Source *source) {
    Str first = source_locate(source, 0).text, petri = STR("petri");
    bool read = str_starts_with(source->path, STR("/")) || str_starts_with(source->name, STR("<"));
    if (!read || str_ends_with(source->name, STR(".fl")))
        return true;
    for (size_t i = 0; str_starts_with(first, STR("#!")) && i + petri.len <= first.len; i++)
        if (memcmp(first.bytes + i, petri.bytes, petri.len) == 0)
            return true;
    return false;
}

static bool is_blank_byte(const Source *source, uint32_t line) {
    Str text = str_trim(source_locate(source, source->line_starts[line]).text);
    return text.len == 0 || str_starts_with(text, STR("--"));
}

typedef struct Tally {
    uint32_t lines; // number of lines up to the last error, without blank lines and comments
    uint32_t bad;   // number of lines with errors
} Tally;

static Tally count_lines(const Source *source, const DiagSink *diags) {
    Tally tally = {0};
    uint32_t last = 0;
    for (uint32_t i = 0; i < diags->count; i++) { // diagnostics are in source order
        uint32_t line = source_line(source, diags->items[i].at.span.start);
        tally.bad += line > last;
        last = line > last ? line : last;
    }
    for (uint32_t line = 0; line < last; line++)
        tally.lines += !is_blank_byte(source, line);
    return tally;
}

static void replace_diagnostics(DiagSink *diags, const Diag *diag) {
    diag_sink_free(diags);
    diag_report(diags, diag);
}

void content_sniff_report(const Source *source, DiagSink *diags) {
    enum { MIN_ERRORS = 3 };
    if (memchr(source->text.bytes, 0, source->text.len)) {
        replace_diagnostics(diags, &(Diag){.level = DIAG_ERROR,
                                           .text = str_format(diags->arena, "'%.*s' is a binary file, not a script",
                                                              STR_ARGS(source->name)),
                                           .code = "encoding"});
        return;
    }
    if (diags->count < MIN_ERRORS || claims_to_be_script(source))
        return;
    Tally tally = count_lines(source, diags);
    if (tally.bad < MIN_ERRORS || tally.bad * 2 < tally.lines)
        return;
    Diag first = diags->items[0];
    Str what = diag_text(&first);
    first.text =
        str_format(diags->arena, "is this a Flitter script? %u of %s%u lines are invalid; the first error: %.*s",
                   tally.bad, diags->dropped ? "the first " : "", tally.lines, STR_ARGS(what));
    first.hint = (Str){0};
    first.code = "not-a-script";
    replace_diagnostics(diags, &first);
}
