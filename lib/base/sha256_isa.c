// sha256_isa.c: the compression function of SHA-256 with the instructions of x86-64 (SHA extensions) or AArch64
// (cryptographic extension). Each step does four rounds, and computes the four words of the schedule that are needed
// four steps later.
#include "base/sha256_blocks.h"

enum { STEPS = 16 };

#ifdef __x86_64__
#include <immintrin.h>

// Rounds work on a, b, e and f in one register, and on c, d, g and h in another; f and h are in the lowest lanes.
static void compress_fast(__m128i *abef, __m128i *cdgh, const unsigned char *block) {
    const __m128i big_endian = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
    __m128i words[4], first = *abef, second = *cdgh;
    for (int i = 0; i < 4; i++)
        words[i] = _mm_shuffle_epi8(_mm_loadu_si128((const __m128i *)(const void *)(block + 16 * i)), big_endian);
#pragma GCC unroll 16
    for (int i = 0; i < STEPS; i++) {
        __m128i *word = &words[i % 4], next = words[(i + 1) % 4], last = words[(i + 3) % 4];
        __m128i constants = _mm_loadu_si128((const __m128i *)(const void *)(sha256_constants + 4 * i));
        __m128i sums = _mm_add_epi32(*word, constants);
        second = _mm_sha256rnds2_epu32(second, first, sums);
        first = _mm_sha256rnds2_epu32(first, second, _mm_shuffle_epi32(sums, 0x0e));
        __m128i middle = _mm_alignr_epi8(last, words[(i + 2) % 4], 4);
        *word = _mm_sha256msg2_epu32(_mm_add_epi32(_mm_sha256msg1_epu32(*word, next), middle), last);
    }
    *abef = _mm_add_epi32(*abef, first);
    *cdgh = _mm_add_epi32(*cdgh, second);
}

void sha256_blocks_fast(uint32_t state[8], const unsigned char *blocks, size_t count) {
    __m128i *low = (__m128i *)(void *)state, *high = (__m128i *)(void *)(state + 4);
    __m128i badc = _mm_shuffle_epi32(_mm_loadu_si128(low), 0xb1), hgfe = _mm_shuffle_epi32(_mm_loadu_si128(high), 0x1b);
    __m128i abef = _mm_alignr_epi8(badc, hgfe, 8), cdgh = _mm_blend_epi16(hgfe, badc, 0xf0);
    for (; count > 0; count--, blocks += SHA256_BLOCK)
        compress_fast(&abef, &cdgh, blocks);
    __m128i feba = _mm_shuffle_epi32(abef, 0x1b), dchg = _mm_shuffle_epi32(cdgh, 0xb1);
    _mm_storeu_si128(low, _mm_blend_epi16(feba, dchg, 0xf0));
    _mm_storeu_si128(high, _mm_alignr_epi8(dchg, feba, 8));
}

#else
#include <arm_neon.h>

static void compress_fast(uint32x4_t *abcd, uint32x4_t *efgh, const unsigned char *block) {
    uint32x4_t words[4], first = *abcd, second = *efgh;
    for (int i = 0; i < 4; i++)
        words[i] = vreinterpretq_u32_u8(vrev32q_u8(vld1q_u8(block + 16 * i)));
#pragma GCC unroll 16
    for (int i = 0; i < STEPS; i++) {
        uint32x4_t *word = &words[i % 4], before = first;
        uint32x4_t sums = vaddq_u32(*word, vld1q_u32(sha256_constants + 4 * i));
        first = vsha256hq_u32(first, second, sums);
        second = vsha256h2q_u32(second, before, sums);
        *word = vsha256su1q_u32(vsha256su0q_u32(*word, words[(i + 1) % 4]), words[(i + 2) % 4], words[(i + 3) % 4]);
    }
    *abcd = vaddq_u32(*abcd, first);
    *efgh = vaddq_u32(*efgh, second);
}

void sha256_blocks_fast(uint32_t state[8], const unsigned char *blocks, size_t count) {
    uint32x4_t abcd = vld1q_u32(state), efgh = vld1q_u32(state + 4);
    for (; count > 0; count--, blocks += SHA256_BLOCK)
        compress_fast(&abcd, &efgh, blocks);
    vst1q_u32(state, abcd);
    vst1q_u32(state + 4, efgh);
}
#endif
