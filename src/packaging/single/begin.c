// petri.c: petri @VERSION@ as one file: the language and the particle engine, without drawing, archives and ranks.
//
//     cc -O2 -ffp-contract=off petri.c host.c -lm -lpthread
//
// The interface is petri.h; petri-edit.h, petri-inspect.h and petri-live.h have more. All other names are static,
// except a few tables of the kernels. The file must keep its name, because it includes itself. Do not edit it:
// `./dev dist --single` makes it from the sources of petri, whose names are in the comments between the parts.
#ifndef PETRI_PASS // otherwise this file includes itself; see its end

#if defined(__FAST_MATH__)
#error "petri.c needs exact arithmetic: compile it without -ffast-math and -Ofast"
#endif
#if defined(__FLT_EVAL_METHOD__) && (__FLT_EVAL_METHOD__ < 0 || __FLT_EVAL_METHOD__ > 1)
#error "petri.c needs arithmetic without extra precision: on 32-bit x86, compile it with -msse2 -mfpmath=sse"
#endif
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#elif defined(__OPTIMIZE__) && !defined(__OPTIMIZE_SIZE__)
// At -O2, gcc would not unroll the loops of the kernels. All functions have the same level, because gcc does not inline
// functions of a lower one.
#pragma GCC optimize("O3", "fp-contract=off")
// At -O3, gcc warns of limbs that are copied with others but not used (maths/fixed.c).
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#elif defined(__GNUC__)
#pragma GCC optimize("fp-contract=off")
#endif

// All built-in functions have the same parameters.
#pragma GCC diagnostic ignored "-Wunused-parameter"
// Headers declare names that not all files need.
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-const-variable"

#if defined(__APPLE__)
#define _DARWIN_C_SOURCE
#elif defined(__linux__)
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#else
#define PETRI_PLAIN_POSIX
#endif
#ifndef _FILE_OFFSET_BITS
#define _FILE_OFFSET_BITS 64
#endif
#if defined(__x86_64__)
#define PETRI_X86
#define SHA256_INSTRUCTIONS
#endif
#define PETRI_SINGLE_FILE
#define LANES 1
#define MATHS_ISA plain
#define MATHS_ISA_NEAR
#define DIGEST_UPDATE digest_update_plain
