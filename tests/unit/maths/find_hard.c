// find_hard.c: searches for arguments whose results are almost midpoints between two doubles. Its output is in
// hard_cases.h.
//
// usage: find_hard NAME SECONDS LOW HIGH [BITS]: x is a random double with an exponent in [LOW, HIGH)
//
// Lefèvre's method: for the 2 REACH + 1 doubles around x, the function is linear to within 2^-28 ulp. So the phase of
// double number i (see phase()) is about p + slope i. Euclid's algorithm finds each i for which this is close to an
// integer. Each hit is printed with the distance of its result from the midpoint, as a power of two in ulps.
#include "model.h"

#include <stdlib.h>
#include <time.h>

#define REACH 4096
#define MODULUS (INT64_C(1) << 62)

__extension__ typedef __int128 Long;

// Returns the smallest x ≥ 0 with l ≤ a x mod m ≤ r, or -1. Requires 0 ≤ a < m and 0 ≤ l ≤ r < m.
static int64_t first_in(int64_t a, int64_t m, int64_t l, int64_t r) {
    if (l == 0)
        return 0;
    if (a == 0)
        return -1;
    int64_t first = (l + a - 1) / a;
    if ((Long)first * a <= r)
        return first;
    int64_t from = (a - r % a) % a, to = (a - l % a) % a;
    int64_t y = first_in(m % a, a, from, to);
    return y < 0 ? -1 : (int64_t)(((Long)l + (Long)m * y + a - 1) / a);
}

static mpfr_t at[3], line, best;

// Computes f = f(x, y). Returns f / ulp + 1/2, modulo 1, as a multiple of 2^-62. The result is 0 if f is the midpoint
// between two doubles. `unit`: the ulp is 2^unit; 0: the ulp of f.
static int64_t phase(const Subject *subject, double x, double y, mpfr_t f, mpfr_exp_t unit) {
    model_value(subject, f, x, y);
    if (unit == 0)
        unit = mpfr_get_exp(f) - 53;
    mpfr_mul_2si(line, f, -(long)unit, MPFR_RNDN);
    mpfr_add_d(line, line, 0.5, MPFR_RNDN);
    mpfr_frac(line, line, MPFR_RNDN);
    mpfr_mul_2si(line, line, 62, MPFR_RNDN);
    int64_t p = mpfr_get_sj(line, MPFR_RNDN);
    return (p % MODULUS + MODULUS) % MODULUS;
}

int main(int count, char **words) {
    if (count < 5)
        return 2;
    const Subject *subject = NULL;
    for (size_t i = 0; i < COUNT_OF(subjects); i++)
        if (!strcmp(words[1], subjects[i].name))
            subject = &subjects[i];
    if (!subject)
        return 2;
    int bits = count > 5 ? atoi(words[5]) : 30, low = atoi(words[3]), high = atoi(words[4]);
    mpfr_inits2(160, at[0], at[1], at[2], line, best, (mpfr_ptr)0);
    uint64_t seed = (uint64_t)time(NULL);
    double searched = 0;
    int64_t window = MODULUS >> 26;
    for (time_t end = time(NULL) + atoi(words[2]); time(NULL) < end;) {
        for (int round = 0; round < 1000; round++) {
            uint64_t r = next_bits(&seed);
            double x = ldexp(1 + (double)(r >> 12) * 0x1p-52, low + (int)(next_bits(&seed) % (unsigned)(high - low)));
            double y = ldexp(1 + (double)(next_bits(&seed) >> 12) * 0x1p-52, (int)(next_bits(&seed) % 12) - 6);
            if (subject->model1 && (r & 1) && x < 700)
                x = -x;
            double step = nextafter(x, INFINITY) - x, left = x - REACH * step, right = x + REACH * step;
            mpfr_exp_t unit;
            phase(subject, x, y, at[1], 0);
            if (!mpfr_regular_p(at[1]))
                continue;
            unit = mpfr_get_exp(at[1]) - 53;
            if (unit == 0 || unit < -1074)
                continue;
            int64_t p = phase(subject, left, y, at[0], unit);
            phase(subject, right, y, at[2], unit);
            mpfr_sub(line, at[2], at[0], MPFR_RNDN);
            mpfr_mul_2si(line, line, -(long)unit - 13, MPFR_RNDN); // multiplies by 2^-13, because 2 REACH is 2^13
            mpfr_frac(line, line, MPFR_RNDN);
            mpfr_mul_2si(line, line, 62, MPFR_RNDN);
            int64_t slope = (mpfr_get_sj(line, MPFR_RNDN) % MODULUS + MODULUS) % MODULUS;
            searched += 2 * REACH;
            // The phase p + slope i is within `window` of 0 if slope i is in [-p - window, -p + window].
            for (int64_t i = 0; i <= 2 * REACH;) {
                Long now = ((Long)p + (Long)slope * i) % MODULUS;
                int64_t l = (int64_t)((2 * (Long)MODULUS - now - window) % MODULUS), h = (l + 2 * window) % MODULUS;
                int64_t hit = l > h ? 0 : first_in(slope, MODULUS, l, h);
                if (hit < 0 || i + hit > 2 * REACH)
                    break;
                i += hit;
                double candidate = left + (double)i * step;
                int64_t q = phase(subject, candidate, y, at[1], unit), off = q < MODULUS / 2 ? q : MODULUS - q;
                if (off < MODULUS >> bits)
                    printf("{\"%s\", %a, %a}, // 2^-%.1f\n", subject->name, candidate, subject->model1 ? 0 : y,
                           62 - log2((double)off + 1));
                i++;
            }
        }
    }
    fprintf(stderr, "%s: 2^%.1f arguments\n", words[1], log2(searched));
    return 0;
}
