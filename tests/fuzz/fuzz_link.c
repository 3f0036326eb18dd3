// fuzz_link.c: fuzzes links. If the first byte of the input is '#', the input is a link. Otherwise, the input is the
// JSON of a link, which is compressed and encoded here. Packing and reading an accepted link again must not change it.
#include "fuzz.h"
#include "link/pack.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

// Appends the link whose JSON is `json`.
static void encode_json(Text *out, const uint8_t *json, size_t length) {
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    z_stream stream = {.next_in = (unsigned char *)json, .avail_in = (unsigned)length};
    if (deflateInit2(&stream, Z_BEST_SPEED, Z_DEFLATED, -MAX_WBITS, 1, Z_DEFAULT_STRATEGY) != Z_OK)
        fuzz_fail("cannot compress");
    unsigned long capacity = deflateBound(&stream, length);
    unsigned char *packed = calloc(1, capacity + 2);
    stream.next_out = packed;
    stream.avail_out = (unsigned)capacity;
    deflate(&stream, Z_FINISH);
    size_t count = capacity - stream.avail_out;
    deflateEnd(&stream);
    text_add_c(out, "#");
    for (size_t bit = 0; bit < 8 * count; bit += 6) {
        unsigned pair = (unsigned)packed[bit / 8] << 8 | packed[bit / 8 + 1];
        text_add_char(out, digits[pair >> (10 - bit % 8) & 63]);
    }
    free(packed);
}

static bool same_text(const char *a, const char *b) {
    return a && b ? strcmp(a, b) == 0 : a == b;
}

// The hash of an older link is not packed, and its frame only with a digest.
static bool same_link(const Linked *a, const Linked *b) {
    bool same = a->text.len == b->text.len && memcmp(a->text.bytes, b->text.bytes, a->text.len) == 0 &&
                same_text(a->name, b->name) && same_text(a->digest, b->digest) && a->change_count == b->change_count &&
                (!a->digest || a->frame == b->frame);
    for (size_t i = 0; same && i < a->change_count; i++)
        same = a->changes[i].frame == b->changes[i].frame && same_text(a->changes[i].name, b->changes[i].name) &&
               same_text(a->changes[i].value, b->changes[i].value);
    return same;
}

static void check_round_trip(const Linked *linked) {
    SCOPED_TEXT packed = {0};
    Linked again = {0};
    if (link_pack(&packed, linked, LINK_MAX_LENGTH) && (!link_read(&again, &packed) || !same_link(linked, &again)))
        fuzz_fail("packing changes a link");
    link_free(&again);
}

FUZZ_HARNESS(link) {
    SCOPED_TEXT link = {0};
    Linked linked = {0};
    text_add_c(&link, "");
    if (size > 0 && data[0] == '#')
        text_add(&link, (Str){(const char *)data, size});
    else
        encode_json(&link, data, size);
    if (link_read(&linked, &link))
        check_round_trip(&linked);
    link_free(&linked);
    return 0;
}
