// zlib.h: the functions of zlib that src/link calls, implemented by node:zlib (links.c). Each stream is one block.
#pragma once

typedef struct z_stream {
    unsigned char *next_in;
    unsigned avail_in;
    unsigned char *next_out;
    unsigned avail_out;
} z_stream;

enum { Z_OK = 0, Z_STREAM_END = 1, Z_DATA_ERROR = -3, Z_FINISH = 4 };
enum { MAX_WBITS = 15, Z_BEST_COMPRESSION = 9, Z_DEFLATED = 8, MAX_MEM_LEVEL = 9, Z_DEFAULT_STRATEGY = 0 };

#define deflateInit2(stream, level, method, bits, memory, strategy) ((void)(stream), Z_OK)
#define inflateInit2(stream, bits) ((void)(stream), Z_OK)
#define deflateEnd(stream) ((void)(stream))
#define inflateEnd(stream) ((void)(stream))

unsigned long deflateBound(z_stream *stream, unsigned long length);
int deflate(z_stream *stream, int flush);
int inflate(z_stream *stream, int flush);
