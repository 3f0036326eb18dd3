// hard_roots.h: squares whose roots are the hardest to round, from `tests/proofs/roots.py --list`, in [1, 4).
#pragma once

#include <stdint.h>

static const double hard_squares[] = {
    0x1.0000000000001p+0, 0x1.0000000000003p+0, 0x1.0000000000005p+0, 0x1.0000000000007p+0, 0x1.0000000000009p+0,
    0x1.000000000000bp+0, 0x1.000000000000dp+0, 0x1.069b76ca13a5bp+0, 0x1.0d6162a2e302ap+0, 0x1.14aace83292f6p+0,
    0x1.1ac50220dc67dp+0, 0x1.1d28988281f17p+0, 0x1.1dad9cfe3d12ap+0, 0x1.256565cadcbf4p+0, 0x1.270ac7cec9d2ap+0,
    0x1.283741a1bef08p+0, 0x1.2a3c89ed8ed8cp+0, 0x1.2b035c1197f48p+0, 0x1.2d98b6194283ep+0, 0x1.2f23454fece4ep+0,
    0x1.311846fe43cc9p+0, 0x1.5b05ee452229ep+0, 0x1.6320957d038e3p+0, 0x1.673ef2a3f7190p+0, 0x1.732b9a374ddcep+0,
    0x1.77d560b29421ep+0, 0x1.7e835e386e8acp+0, 0x1.80b07a7182913p+0, 0x1.842ccddb2e775p+0, 0x1.893a4fca50165p+0,
    0x1.8b0e0d64fdc72p+0, 0x1.955d8279a3c0fp+0, 0x1.a881d1831fabdp+0, 0x1.b9031abd6ad9cp+0, 0x1.ba44c2a0737a2p+0,
    0x1.bd3b47d3244afp+0, 0x1.d407bb3641da5p+0, 0x1.df76819ec4fcfp+0, 0x1.e99893042c2cbp+0, 0x1.ed8815e50aeb2p+0,
    0x1.004c704e61a6bp+1, 0x1.0d4cef742baf7p+1, 0x1.0f4057e306261p+1, 0x1.1ac9955fd90d2p+1, 0x1.202a5c6165a5ep+1,
    0x1.2e22e3ec9f181p+1, 0x1.3ac226a62efabp+1, 0x1.4eb5f85e783a9p+1, 0x1.54b1521487230p+1, 0x1.5b95344972fe2p+1,
    0x1.69ca8fa07c526p+1, 0x1.77483d37ce205p+1, 0x1.8444088dbdcb5p+1, 0x1.8cc6767d8db65p+1, 0x1.906249f1ac465p+1,
    0x1.92e58e3597929p+1, 0x1.a903217634cb4p+1, 0x1.d2221598a924ap+1, 0x1.e4054716ef6a0p+1, 0x1.e63a86a12a838p+1,
    0x1.f974b2f9b9fd3p+1, 0x1.ffffffffffff3p+1, 0x1.ffffffffffff5p+1, 0x1.ffffffffffff7p+1, 0x1.ffffffffffff9p+1,
    0x1.ffffffffffffbp+1, 0x1.ffffffffffffdp+1, 0x1.fffffffffffffp+1,
};

// Mantissas of roots whose inverses are so close to the middle between two doubles that one step of Newton's iteration
// from an approximation with an error of two units in the last place rounds them wrongly: B so that 2^106 - B M is 1,
// 2, 4 or 9 for an odd M.
static const uint64_t hard_roots[] = {
    0x1fffffffffffff, 0x1ffffff8000001, 0x1024a3bd98da02, 0x10699d36aec84e, 0x109107683ee29e, 0x110af85de838ce,
    0x11d3799c32581e, 0x11f98ea5d9b262, 0x12bf5907e316d2, 0x12e93952a2ed6e, 0x130a0dd90e13a2, 0x134d8fe343ef42,
    0x13a324a526d5ee, 0x14a6fb45f5d782, 0x14cad5a5fa03ee, 0x155f2490c86132, 0x163baaac17d1e2, 0x163dd0554d0122,
    0x17641c46f799ee, 0x178cb7d5d6e322, 0x17f52093014f0e, 0x184a12efef626e, 0x199e1b447e99c2, 0x19f142d24e1352,
    0x1a0b8ffffcbe8e, 0x1a6f41dab98cb2, 0x1b227794e85702, 0x1bea3278b789d2, 0x1d5b9032f086be, 0x1da210daeb138e,
    0x1de441d5331432, 0x1e20adbc4078a2, 0x1e756f08df1792, 0x1ef7930608393e, 0x10aadc6f562fdc, 0x12d2d2d2d2d2d4,
    0x1ffffffffffffd,
};
