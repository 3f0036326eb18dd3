// kept.c: violated cases of earlier tests, one per line in NAME.cases; see property.h.
#include "base/file.h"
#include "base/source.h"
#include "property/property.h"

#include <string.h>

static Text cases_path(const Properties *properties) {
    Text path = {0};
    size_t length = strlen(properties->script) - strlen(".fl");
    text_add_format(&path, "%.*s.cases", (int)length, properties->script);
    return path;
}

void kept_read(Properties *properties) {
    SCOPED_TEXT path = cases_path(properties), text = {0};
    if (text_read_file(&text, path.bytes, SIZE_MAX) || text.len == 0)
        return;
    text.len = source_unify_lines(text.bytes, text.len);
    size_t at = 0;
    for (Str line; text_next_line(&text, &at, &line);) {
        SCOPED_STRING words = memory_strndup(line.bytes, line.len);
        if (line.len > 0 && words[0] != '#')
            texts_add(&properties->kept, words);
    }
}

bool kept_add(Properties *properties, const char *text) {
    SCOPED_TEXT path = cases_path(properties), whole = {0};
    if (texts_contain(&properties->kept, text))
        return true;
    if (properties->kept.count == 0)
        text_add_c(&whole, "# Cases that violated a property. petri test tries them first.\n");
    else
        text_read_file(&whole, path.bytes, SIZE_MAX);
    text_add_format(&whole, "%s\n", text);
    texts_add(&properties->kept, text);
    const char *problem = file_replace(path.bytes, text_str(&whole), 0);
    if (problem)
        message("cannot write %s: %s", path.bytes, problem);
    return !problem;
}
