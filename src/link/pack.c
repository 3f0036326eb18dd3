// pack.c: see pack.h.
//
// A link can be from a stranger. So its length, its size after decompression, the depth of its JSON, its frames and its
// changes are limited. Its name must be printable.
#include "link/pack.h"

#include "base/spec.h"
#include "cli/cli.h"
#include "cli/json.h"

#include <stdlib.h>
#include <string.h>

void link_free(Linked *linked) {
    for (size_t i = 0; i < linked->change_count; i++) {
        free(linked->changes[i].name);
        free(linked->changes[i].value);
    }
    free(linked->changes);
    free(linked->name);
    free(linked->digest);
    free(linked->spec);
    free(linked->hash);
    text_free(&linked->text);
    *linked = (Linked){0};
}

static const char DIGITS[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

void link_add_base64(Text *out, const char *text, size_t length) {
    const unsigned char *bytes = (const unsigned char *)text;
    for (size_t i = 0; i < length; i += 3) {
        size_t here = length - i < 3 ? length - i : 3;
        uint32_t bits =
            (uint32_t)bytes[i] << 16 | (here > 1 ? (uint32_t)bytes[i + 1] << 8 : 0) | (here > 2 ? bytes[i + 2] : 0);
        for (size_t k = 0; k <= here; k++)
            text_add_char(out, DIGITS[bits >> (18 - 6 * k) & 63]);
    }
}

#ifdef HAVE_LINKS
#include <zlib.h>

enum { VERSION = 1, MAX_TEXT = 4 << 20, MAX_FRAME = 1000000, MAX_CHANGES = 10000, MAX_DEPTH = 7, RAW = -MAX_WBITS };

bool link_possible(void) {
    return true;
}

static bool report_error(const char *text) {
    message("%s", text);
    return false;
}

// Decodes base64url. Ignores white space, because mail programs break long lines. Also accepts `+` and `/`, the digits
// of plain base64.
static bool read_base64(Text *out, const char *text, size_t length) {
    uint32_t bits = 0;
    unsigned count = 0;
    for (size_t i = 0; i < length; i++) {
        char c = text[i] == '+' ? '-' : text[i] == '/' ? '_' : text[i];
        const char *digit = c == '\0' ? NULL : strchr(DIGITS, c);
        if (!digit && strchr(" \t\r\n=", c) && c != '\0')
            continue;
        if (!digit)
            return false;
        bits = bits << 6 | (uint32_t)(digit - DIGITS);
        count += 6;
        if (count >= 8) {
            count -= 8;
            char byte = (char)(bits >> count & 255);
            text_add_char(out, byte);
        }
    }
    return count < 6;
}

static void add_json(Text *out, const Linked *linked) {
    JsonWriter json = {.out = out};
    json_open(&json, NULL, "{");
    json_put_integer(&json, "v", VERSION);
    JSON_PUT_TEXTS(&json, "t", linked->text.bytes, "n", linked->name);
    json_open(&json, "c", "[");
    for (size_t i = 0; i < linked->change_count; i++) {
        json_open(&json, NULL, "[");
        json_put_integer(&json, NULL, linked->changes[i].frame);
        json_put_text(&json, NULL, linked->changes[i].name);
        json_put_text(&json, NULL, linked->changes[i].value);
        json_close(&json, "]");
    }
    json_close(&json, "]");
    if (linked->digest) {
        json_put_integer(&json, "f", linked->frame);
        json_put_text(&json, "d", linked->digest);
        json_put_text(&json, "s", SPEC_VERSION);
    }
    json_close(&json, "}");
}

bool link_pack(Text *out, const Linked *linked, size_t max_length) {
    SCOPED_TEXT json = {0};
    add_json(&json, linked);
    z_stream stream = {0};
    if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, RAW, MAX_MEM_LEVEL, Z_DEFAULT_STRATEGY) != Z_OK)
        return report_error("out of memory");
    unsigned long bound = deflateBound(&stream, json.len);
    unsigned char *packed = memory_calloc(bound);
    stream.next_in = (unsigned char *)json.bytes;
    stream.avail_in = (unsigned)json.len;
    stream.next_out = packed;
    stream.avail_out = (unsigned)bound;
    deflate(&stream, Z_FINISH); // cannot fail: the output has deflateBound bytes
    deflateEnd(&stream);
    size_t start = out->len;
    text_add_c(out, "#");
    link_add_base64(out, (const char *)packed, bound - stream.avail_out);
    free(packed);
    if (out->len - start > max_length) {
        message(
            "the script is too long for a link: %zu characters when compressed, at most %zu; share the file instead",
            out->len - start, max_length);
        return false;
    }
    return true;
}

// Decompresses a link. Returns false if it is damaged or too long.
static bool unpack(Text *json, const Text *packed, bool *too_long) {
    z_stream stream = {.next_in = (unsigned char *)packed->bytes, .avail_in = (unsigned)packed->len};
    if (inflateInit2(&stream, RAW) != Z_OK)
        return false;
    unsigned char *text = memory_calloc(MAX_TEXT + 1);
    stream.next_out = text;
    stream.avail_out = MAX_TEXT + 1;
    bool whole = inflate(&stream, Z_FINISH) == Z_STREAM_END && stream.avail_in == 0;
    *too_long = stream.avail_out == 0;
    text_add(json, (Str){(char *)text, MAX_TEXT + 1 - stream.avail_out});
    inflateEnd(&stream);
    free(text);
    return whole && !*too_long;
}

// Returns the contents of a JSON string, or NULL if the value is not a string or contains NUL.
static const char *string_value(const Json *value) {
    return json_is(value, JSON_STRING) && strlen(value->text) == value->length ? value->text : NULL;
}

// Returns true if a name has no control characters. With a line break, a name could forge a message about the link.
static bool is_printable(const char *name) {
    bool good = true;
    for (const char *c = name; *c != '\0'; c++)
        good = good && (unsigned char)*c >= ' ' && *c != 0x7f;
    return good;
}

// Orders changes by frame, and changes of the same frame by their index in the link. For qsort.
static int by_frame(const void *a, const void *b) {
    const LinkedChange *first = a, *second = b;
    if (first->frame != second->frame)
        return first->frame < second->frame ? -1 : 1;
    return first->number < second->number ? -1 : 1;
}

static bool frame_value(const Json *value, int64_t *number) {
    return json_integer(value, number) && *number >= -1 && *number <= MAX_FRAME;
}

static const char NOT_A_LINK[] = "not a petri link";
static const char NEWER[] = "the link is from a newer petri; update petri to open it";

static bool parse_change(LinkedChange *change, const Json *items) {
    if (json_length(items) != 3)
        return false;
    const Json *frame = json_next(items, NULL), *second = json_next(items, frame);
    const char *name = string_value(second), *value = string_value(json_next(items, second));
    if (!frame_value(frame, &change->frame) || !name || !value)
        return false;
    change->name = memory_strdup(name);
    change->value = memory_strdup(value);
    return true;
}

// Returns NULL, or the reason why the changes are invalid.
static const char *parse_changes(Linked *linked, const Json *changes) {
    if (!changes)
        return NULL;
    size_t count = json_length(changes);
    if (!json_is(changes, JSON_ARRAY) || count > MAX_CHANGES)
        return count > MAX_CHANGES ? "the link has more than 10000 changes of parameters" : NOT_A_LINK;
    linked->changes = memory_calloc((count + 1) * sizeof *linked->changes);
    for (const Json *change = NULL; (change = json_next(changes, change)); linked->change_count++) {
        linked->changes[linked->change_count].number = linked->change_count;
        if (!parse_change(&linked->changes[linked->change_count], change))
            return NOT_A_LINK;
    }
    qsort(linked->changes, count, sizeof *linked->changes, by_frame);
    return NULL;
}

// Returns NULL, or the reason why the link is invalid.
static const char *parse_link(Linked *linked, const Json *all) {
    const Json *frame = json_get(all, "f"), *name = json_get(all, "n");
    const Json *digest = json_get(all, "d"), *hash = json_get(all, "h"), *spec = json_get(all, "s");
    const char *text = string_value(json_get(all, "t"));
    if (!text || (name && (!string_value(name) || !is_printable(string_value(name)))) ||
        (digest && !string_value(digest)) || (hash && !string_value(hash)) || (spec && !string_value(spec)) ||
        (frame && !frame_value(frame, &linked->frame)))
        return NOT_A_LINK;
    text_add_c(&linked->text, text);
    linked->name = memory_strdup(!name || string_value(name)[0] == '\0' ? "script.fl" : string_value(name));
    linked->digest = !digest ? NULL : memory_strdup(string_value(digest));
    linked->spec = memory_strdup(spec ? string_value(spec) : SPEC_FIRST);
    linked->hash = !hash ? NULL : memory_strdup(string_value(hash));
    unsigned old_rules;
    return spec_find(linked->spec, &old_rules) ? parse_changes(linked, json_get(all, "c")) : NEWER;
}

static bool read_json(Linked *linked, const Text *text) {
    SCOPED_JSON document = {0};
    const Json *all = json_read(&document, text_str(text), MAX_DEPTH);
    bool newer = json_integer_or(all, "v", VERSION) > VERSION;
    const char *problem = newer ? NEWER : !json_is(all, JSON_OBJECT) ? NOT_A_LINK : parse_link(linked, all);
    return !problem || report_error(problem);
}

bool link_read(Linked *linked, const Text *link) {
    const char *mark = link->len == 0 ? NULL : memchr(link->bytes, '#', link->len);
    const char *start = !mark ? link->bytes : mark + 1;
    size_t length = !mark ? link->len : link->len - (size_t)(start - link->bytes);
    SCOPED_TEXT packed = {0}, json = {0};
    bool too_long = length > LINK_MAX_LENGTH;
    if (too_long) {
        message("the link is too long: %zu characters, at most %d", length, LINK_MAX_LENGTH);
        return false;
    }
    if (!read_base64(&packed, start, length) || !unpack(&json, &packed, &too_long)) {
        return report_error(too_long ? "the link unpacks to more than 4 MiB"
                                     : "the link is damaged; check that it was copied completely");
    }
    return read_json(linked, &json);
}

#else

bool link_possible(void) {
    message("cannot use links: petri was built without zlib; on Debian, install zlib1g-dev and build petri again");
    return false;
}

bool link_pack(Text *out, const Linked *linked, size_t max_length) {
    (void)out;
    (void)linked;
    (void)max_length;
    return link_possible();
}

bool link_read(Linked *linked, const Text *link) {
    (void)linked;
    (void)link;
    return link_possible();
}

#endif
