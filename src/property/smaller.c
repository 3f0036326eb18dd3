// smaller.c: finds the lines of a script that a violation needs; see property.h.
#include "base/clock.h"
#include "base/file.h"
#include "property/property.h"

#include <stdlib.h>
#include <string.h>

enum { MAX_LINES = 2000 };

typedef struct ScriptLines {
    Str lines[MAX_LINES];
    bool removed[MAX_LINES];
    size_t count;
} ScriptLines;

static size_t indentation(Str line) {
    size_t count = 0;
    while (count < line.len && strchr(" \t", line.bytes[count]))
        count++;
    return count;
}

static bool is_blank(Str line) {
    size_t start = indentation(line);
    return start == line.len || (line.len - start > 1 && memcmp(line.bytes + start, "--", 2) == 0);
}

// Returns the end of the block of a line: the line and those below it that are indented more.
static size_t end_of_block(const ScriptLines *script, size_t line) {
    size_t end = line + 1;
    while (end < script->count &&
           (is_blank(script->lines[end]) || indentation(script->lines[end]) > indentation(script->lines[line])))
        end++;
    return end;
}

static Text join(const ScriptLines *script) {
    Text text = {0};
    for (size_t i = 0; i < script->count; i++) {
        if (!script->removed[i])
            text_add(&text, script->lines[i]);
        text_add_c(&text, "\n");
    }
    return text;
}

// Removes a block if the property is violated without it, and without new problems.
static void try_block(Properties *properties, size_t property, double deadline, ScriptLines *script, size_t line,
                      uint64_t problems, Found *found) {
    size_t end = end_of_block(script, line);
    bool before[MAX_LINES];
    memcpy(before, script->removed, sizeof before);
    for (size_t i = line; i < end; i++)
        script->removed[i] = true;
    SCOPED_TEXT text = join(script);
    properties->override = text.bytes;
    uint64_t now = problems;
    bool violated = violation_refresh_counted(properties, property, deadline, found, &now);
    properties->override = NULL;
    if (!violated || now > problems)
        memcpy(script->removed, before, sizeof before);
}

static void add_lines(const ScriptLines *script, Text *text) {
    for (size_t i = 0; i < script->count; i++) {
        if (script->removed[i] || is_blank(script->lines[i]))
            continue;
        size_t last = i;
        for (size_t k = i; k < script->count && !script->removed[k]; k++)
            last = is_blank(script->lines[k]) ? last : k;
        text_add_format(text, last > i ? "%s%zu-%zu" : "%s%zu", text->len > 0 ? ", " : "", i + 1, last + 1);
        i = last;
    }
}

void smaller_script(Properties *properties, size_t property, double seconds, Found *found) {
    double deadline = clock_seconds() + seconds;
    SCOPED_TEXT text = {0};
    ScriptLines *script = memory_calloc(sizeof *script);
    size_t at = 0;
    if (!text_read_file(&text, properties->script, SIZE_MAX))
        for (Str line; script->count < MAX_LINES && text_next_line(&text, &at, &line);)
            script->lines[script->count++] = line;
    uint64_t problems = 0;
    if (script->count > 0 && script->count < MAX_LINES &&
        violation_refresh_counted(properties, property, deadline, found, &problems)) {
        for (size_t i = script->count; i-- > 0;)
            if (!script->removed[i] && !is_blank(script->lines[i]) && clock_seconds() < deadline)
                try_block(properties, property, deadline, script, i, problems, found);
        add_lines(script, &found->lines);
    }
    free(script);
}
