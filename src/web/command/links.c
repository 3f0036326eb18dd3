// links.c: compression for links, see zlib.h. src/web/engine/links.mjs has the imports.
#include "cli/wasm_host.h"

#include <zlib.h>

// Return the number of bytes written to `out`, or -1: damaged or trailing data, -2: more than `capacity` bytes.
HOST(deflate) int host_deflate(const unsigned char *in, unsigned length, unsigned char *out, unsigned capacity);
HOST(inflate) int host_inflate(const unsigned char *in, unsigned length, unsigned char *out, unsigned capacity);

unsigned long deflateBound(z_stream *stream, unsigned long length) {
    (void)stream;
    return length + length / 8 + 64;
}

int deflate(z_stream *stream, int flush) {
    (void)flush;
    int length = host_deflate(stream->next_in, stream->avail_in, stream->next_out, stream->avail_out);
    if (length < 0)
        return Z_DATA_ERROR;
    stream->avail_out -= (unsigned)length;
    return Z_STREAM_END;
}

int inflate(z_stream *stream, int flush) {
    (void)flush;
    int length = host_inflate(stream->next_in, stream->avail_in, stream->next_out, stream->avail_out);
    if (length == -2)
        stream->avail_out = 0;
    if (length < 0)
        return Z_DATA_ERROR;
    stream->avail_in = 0;
    stream->avail_out -= (unsigned)length;
    return Z_STREAM_END;
}
