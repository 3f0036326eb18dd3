// html.c: see html.h.
//
// `./dev web` makes the page without a script (src/web/page/standalone.html). This file inserts the script.
#include "link/html.h"

#include "base/file.h"
#include "base/os.h"
#include "cli/json.h"
#include "cli/output.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char PAGE_NAME[] = "standalone.html";

// Sets `path` to the page: the file named by PETRI_STANDALONE, or one at its place in a build or an installation.
// Returns false if there is none.
static bool find_page(char path[PATH_MAX + 64]) {
    static const char *const folders[] = {"../web/", "../share/petri/"}; // relative to the folder of the program
    const char *named = getenv("PETRI_STANDALONE");
    if (named) {
        snprintf(path, PATH_MAX, "%s", named);
        return file_exists(path);
    }
    if (!os_program_path(path))
        return false;
    char *base_name = strrchr(path, '/') + 1;
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        snprintf(base_name, 64, "%s%s", folders[i], PAGE_NAME);
        if (file_exists(path))
            return true;
    }
    return false;
}

// Adds JSON in which `<` is escaped, so that it cannot end its element.
static void add_escaped(Text *out, const Text *json) {
    for (size_t i = 0; i < json->len; i++)
        if (json->bytes[i] == '<')
            text_add_c(out, "\\u003c");
        else
            text_add_char(out, json->bytes[i]);
}

static bool add_data(Text *out, const LinkSession *link_session, const char *page) {
    SCOPED_TEXT text = {0};
    SCOPED_TEXT link = {0};
    if (!link_pack(&link, &link_session->linked, SIZE_MAX))
        return false;
    JsonWriter json = {.out = &text, .spaced = true};
    json_open(&json, NULL, "{");
    JSON_PUT_TEXTS(&json, "link", link.bytes, "page", page ? page : "http://127.0.0.1:8080/");
    json.spaced = false;
    json_open(&json, "files", "{");
    for (size_t i = 0; i < link_session->file_count; i++) {
        const LinkedFile *file = &link_session->files[i];
        SCOPED_TEXT bytes = {0};
        text_add_c(&bytes, "");
        link_add_base64(&bytes, file->bytes.bytes, file->bytes.len);
        json_put_text(&json, file->name, bytes.bytes);
    }
    json_close(&json, "}}");
    add_escaped(out, &text);
    return true;
}

int html_write(const LinkSession *link_session, const char *page, const char *file) {
    static const char place[] = "id=\"petri-data\">";
    static const size_t max_bytes = (size_t)64 << 20;
    char path[PATH_MAX + 64];
    SCOPED_TEXT empty = {0};
    SCOPED_TEXT whole = {0};
    if (!find_page(path)) {
        message(
            "cannot write '%s': the page of the playground, %s, is not installed; copy it from petri-%s-page.tar.xz "
            "of the release, or from build/web after './dev web', and set PETRI_STANDALONE to its name",
            file, PAGE_NAME, petri_version());
        return STATUS_FAILED;
    }
    const char *problem = text_read_file(&empty, path, max_bytes);
    const char *start = problem ? NULL : strstr(empty.bytes, place);
    if (!start) {
        message("cannot read '%s': %s", path, problem ? problem : "not a page of petri");
        return STATUS_FAILED;
    }
    start += strlen(place);
    text_add(&whole, (Str){empty.bytes, (size_t)(start - empty.bytes)});
    if (!add_data(&whole, link_session, page))
        return STATUS_FAILED;
    text_add_c(&whole, start + strlen("null"));
    return output_file(file, text_str(&whole)) ? STATUS_DONE : STATUS_FAILED;
}
