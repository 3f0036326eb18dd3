#!/usr/bin/env python3
"""generate_tables.py: computes the constants of lib/maths with integer arithmetic and prints maths_tables.h.

usage: generate_tables.py >maths_tables.h

Needs only Python. Real numbers are integers in units of 2^-BITS. Every series is summed until its terms are 0. Each
constant is the double nearest to the exact value or, if fixed-point, truncated. The function nearest() asserts that a
value is far enough from a midpoint to be rounded. This script also asserts what the fast paths' error bounds assume.
"""
from fractions import Fraction

BITS = 2400
GUARD = 64
ONE = 1 << BITS


def fixed(value):
    """Returns a Fraction as a fixed-point number."""
    return (value.numerator << BITS) // value.denominator


def times(a, b):
    return a * b >> BITS


def atanh_inverse(n):
    """Returns atanh(1/n) for an integer n."""
    term, total, k = ONE // n, 0, 1
    while term:
        total += term // k
        term //= n * n
        k += 2
    return total


def atan_inverse(n):
    term, total, k = ONE // n, 0, 1
    while term:
        total += term // k if k % 4 == 1 else -(term // k)
        term //= n * n
        k += 2
    return total


LN2 = 2 * atanh_inverse(3)
LN10 = 3 * LN2 + 2 * atanh_inverse(9)  # 10 = 8 * 5/4
PI = 4 * (4 * atan_inverse(5) - atan_inverse(239))


def exponential(x):
    term, total, k = ONE, 0, 1
    while term not in (0, -1):
        total += term
        term = times(term, x) // k
        k += 1
    return total


def logarithm(value):
    """Returns ln of a Fraction near 1."""
    x = (value - 1) / (value + 1)
    term, total, k = fixed(x), 0, 1
    square = fixed(x * x)
    while term not in (0, -1):
        total += term // k
        term = times(term, square)
        k += 2
    return 2 * total


def sine_cosine(x):
    sums, term, k = [0, 0, 0, 0], ONE, 0
    while term not in (0, -1):
        sums[k % 4] += term
        k += 1
        term = times(term, x) // k
    return sums[1] - sums[3], sums[0] - sums[2]


def nearest(x, unit=None):
    """Returns the double nearest to a fixed-point number, or the nearest multiple of 2^-unit, as a Fraction."""
    if x == 0:
        return Fraction(0)
    shift = abs(x).bit_length() - 53 if unit is None else BITS - unit
    half = 1 << (shift - 1)
    assert unit is not None or abs((abs(x) & ((1 << shift) - 1)) - half) > 1 << (shift - GUARD), 'too near to a tie'
    mantissa = (abs(x) + half) >> shift
    value = Fraction(mantissa << shift, ONE)
    assert float(value) == value
    return -value if x < 0 else value


def double(value):
    """Returns a double in C's hexadecimal form."""
    return float(value).hex()


def parts(x, unit=None):
    """Returns x as high + low. The high part is a multiple of 2^-unit if a unit is given, else the nearest double."""
    high = nearest(x, unit)
    return [high, nearest(x - fixed(high))]


def show(kind, name, sizes, rows, comment):
    print(f'\n// {comment}\nstatic const {kind} {name}{sizes} = {{')
    for row in rows:
        print('    ' + (row if isinstance(row, str) else '{' + ', '.join(double(v) for v in row) + '}') + ',')
    print('};')


def show_number(name, values):
    text = ', '.join(double(v) for v in values)
    print(f'#define {name} {text}' if len(values) == 1 else f'#define {name} {{{text}}}')


def show_fixed_point(name, value, limbs, comment):
    """Prints the fraction of a number below 2^64 in limbs, lowest first, followed by its integer part."""
    words = value >> (BITS - 64 * limbs)
    rows = [f'UINT64_C(0x{words >> 64 * i & (2**64 - 1):016x})' for i in range(limbs + 1)]
    show('uint64_t', name, f'[{limbs + 1}]', [', '.join(rows[i:i + 4]) for i in range(0, limbs + 1, 4)], comment)


WIDE = 12  # FIXED_MAX_LIMBS of fixed.h
FACTORIALS = 80  # more than the series of fixed_functions.c need; fixed_series asserts this
print('// maths_tables.h: the constants of lib/maths. Written by generate_tables.py; do not edit.')
print('//')
print('// clang-format off')
print('#pragma once\n\n#include <stdint.h>\n')

# --- exponential: 2^(i/128), and ln 2 / 128 in two parts; the product of the first part and an 18-bit k is exact
step = parts(LN2 // 128, 42)
assert (step[0] * 2**42).numerator.bit_length() <= 35
show_number('EXP_STEPS_PER_ONE', [nearest(128 * ONE * ONE // LN2)])
show_number('EXP_STEP_HIGH', [step[0]])
show_number('EXP_STEP_LOW', [step[1]])
show_number('LOG_2_HIGH', [parts(LN2, 42)[0]])
show_number('LOG_2_LOW', [parts(LN2, 42)[1]])
for name, value in (('LOG_2E', ONE * ONE // LN2), ('LOG_10E', ONE * ONE // LN10)):
    show_number(name + '_HIGH', [parts(value)[0]])
    show_number(name + '_LOW', [parts(value)[1]])
# --- turns: pi / 512 in three parts; the products of the first two parts and a 24-bit k are exact
first = nearest(PI // 512, 36)
second = nearest(PI // 512 - fixed(first), 65)
third = nearest(PI // 512 - fixed(first) - fixed(second))
for part, unit in ((first, 36), (second, 65)):
    assert abs(part * 2**unit).numerator.bit_length() <= 29
show_number('SINCOS_STEPS_PER_ONE', [nearest(512 * ONE * ONE // PI)])
show_number('SINCOS_STEP_1', [first])
show_number('SINCOS_STEP_2', [second])
show_number('SINCOS_STEP_3', [third])
for name, value in (('PI', PI), ('HALF_PI', PI // 2)):
    show_number(name + '_HIGH', [parts(value)[0]])
    show_number(name + '_LOW', [parts(value)[1]])

show('double', 'exp_table', '[128][2]', [parts(exponential(LN2 * i // 128)) for i in range(128)],
     '2^(i/128) as high + low')

# --- logarithm of m in [0.6875, 1.375): the upper 8 bits of the mantissa, counted from 0.6875, select row i
rows = []
for i in range(256):
    bits = 0x3fe6000000000000 + (i << 44)
    mantissa, below = 2**52 + (bits & (2**52 - 1)), bits >> 52 == 0x3fe
    low, width = Fraction(mantissa, 2**(53 if below else 52)), Fraction(1, 2**(9 if below else 8))
    # The rows on both sides of 1 use r = 1, for relative accuracy. For m below 1, a shorter r keeps r m - 1 within 53
    # bits.
    unit = 8 if below else 9
    r = Fraction(round(2**unit / (low + width / 2)), 2**unit)
    if low == 1 or low + width == 1:
        r = Fraction(1)
    largest = max(abs(r * low - 1), abs(r * (low + width) - 1))
    assert largest <= Fraction(1, 2**8), (i, float(largest))
    assert largest <= Fraction(2**53, 2**((53 if below else 52) + unit)), i  # r m - 1 is a double
    log = -logarithm(r)
    assert r == 1 or abs(log) > fixed(largest)  # fast_two_sum of log + z needs this order
    # bounds |z|^3 relative to the smallest |ln x| of the row, which has k = 0
    ends = [low, low + width]
    smallest = min(abs(1 - m) for m in ends if m != 1) if r != 1 else 0
    assert r == 1 or largest**3 <= smallest * Fraction(1, 2**16), i
    rows.append([r] + parts(log, 42) + [Fraction(0)])
show('double', 'log_table', '[256][4]', rows, 'r, then -ln r as high + low; r m - 1 is exact for each m of the row')

sines = [parts(sine_cosine(PI * i // 512)[0] if i % 256 else ONE * (i // 256)) for i in range(257)]
rows = [sines[i] + sines[256 - i] for i in range(257)]
show('double', 'sincos_table', '[257][4]', rows, 'sine and cosine of i pi/512, each as high + low')


def taylor_atan(c, degree):
    a = [Fraction(0), 1 / (1 + c * c)]
    for k in range(1, degree):
        a.append((-2 * c * k * a[k] - (k - 1) * a[k - 1]) / ((1 + c * c) * (k + 1)))
    return a


def root(value):
    from math import isqrt
    return isqrt(fixed(value) << BITS)


def taylor_asin(c, degree):
    """Returns the Taylor coefficients of asin at c, divided by sqrt(1 - c^2), which makes them rational."""
    a = [Fraction(0), 1 / (1 - c * c)]
    for k in range(0, degree - 1):
        a.append((c * (k + 1) * (2 * k + 1) * a[k + 1] + k * k * (a[k] if k else 0)) / ((1 - c * c) * (k + 1) * (k + 2)))
    return a


def arctangent(value):
    """Returns atan of a Fraction in [0, 1]. Halves the angle until the series is short."""
    x, halvings = fixed(value), 0
    while x > ONE >> 6:
        from math import isqrt
        x = (x << BITS) // (ONE + isqrt((ONE << BITS) + x * x))
        halvings += 1
    term, total, k, square = x, 0, 1, times(x, x)
    while term:
        total += term // k if k % 4 == 1 else -(term // k)
        term = times(term, square)
        k += 2
    return total << halvings


rows = []
for i in range(129):
    c = Fraction(i, 128)
    a = taylor_atan(c, 8)
    rows.append(parts(arctangent(c)) + parts(fixed(a[1])) + [nearest(fixed(v)) for v in a[2:]])
show('double', 'atan_table', '[129][11]', rows, 'Taylor coefficients of atan at i/128: two as high + low, seven more')

rows = []
for i in range(9):
    c = Fraction(i, 128)
    cosine = root(1 - c * c)
    a = [times(fixed(v), cosine) for v in taylor_asin(c, 8)]
    angle = arctangent(Fraction((i << BITS) // 128, cosine)) if i else 0
    rows.append(parts(angle) + parts(a[1] if i else ONE) + [nearest(v if i or k % 2 else 0) for k, v in enumerate(a[2:])])
rows[0] = parts(0) + parts(ONE) + [nearest(fixed(v)) for v in taylor_asin(Fraction(0), 8)[2:]]
show('double', 'asin_table', '[9][11]', rows, 'Taylor coefficients of asin at i/128: two as high + low, seven more')

# For larger x the rows become narrower, in proportion to 1 - x. The exponent and the upper 6 mantissa bits
# of 1 - x select the row.
# Row 0 starts at 1 - x = 1/16.
rows = []
for i in range(256):
    unit = Fraction(1, 16) * 2**(i // 64)
    c = 1 - unit * Fraction(2 * (64 + i % 64) + 1, 128)
    cosine = root(1 - c * c)
    a = [times(fixed(v), cosine) for v in taylor_asin(c, 9)]
    angle = arctangent(Fraction(c.numerator * ONE, c.denominator * cosine)) if c < Fraction(7, 10) else \
        PI // 2 - arctangent(Fraction(c.denominator * cosine, c.numerator * ONE))
    assert abs(a[2]) * (unit / 128)**2 < angle * Fraction(1, 2**16), i
    rows.append([c] + parts(angle) + parts(a[1]) + [nearest(v) for v in a[2:]])
show('double', 'steep_asin_table', '[256][13]', rows, 'c, then Taylor coefficients of asin at c: two as high + low, eight more; for 1 - c from 1/16 to 1')

# acos x / sqrt(1 - x) has no singularity at 1. With t = 1 - x, it is sqrt 2 times the sum of binomial(2 k, k) / (2 k + 1)
# (t/8)^k. Around c = i/128, t = 1 - c - d. 400 terms give 300 bits, because the coefficients decrease like 2^-k or faster.
from math import comb

UNIT = 300
series = [(comb(2 * k, k) << UNIT) // ((2 * k + 1) * 8**k) for k in range(400)]
root_two = root(Fraction(2))
rows = []
for i in range(120, 129):
    t, row = Fraction(128 - i, 128), []
    powers = [1 << UNIT]
    for k in range(1, 400):
        powers.append(powers[-1] * (128 - i) // 128)
    for n in range(9):
        total = sum(comb(k, n) * (series[k] * powers[k - n] >> UNIT) for k in range(n, 400))
        row.append(times((-1)**n * total << (BITS - UNIT), root_two))
    rows.append(parts(row[0]) + parts(row[1]) + [nearest(v) for v in row[2:]])
show('double', 'acos_table', '[9][11]', rows, 'Taylor coefficients of acos x / sqrt(1 - x) at i/128, for x from 15/16 to 1')

show_fixed_point('fixed_half_pi', PI // 2, WIDE, 'pi/2: fraction, lowest limb first, then the integer part')
show_fixed_point('fixed_log_2', LN2, WIDE, 'ln 2')
show_fixed_point('fixed_log2_e', ONE * ONE // LN2, WIDE, '1 / ln 2')
show_fixed_point('fixed_log10_e', ONE * ONE // LN10, WIDE, '1 / ln 10')
rows, factorial = [], ONE
for n in range(FACTORIALS):
    words = factorial >> (BITS - 64 * WIDE)
    rows.append('{' + ', '.join(f'UINT64_C(0x{words >> 64 * i & (2**64 - 1):x})' for i in range(WIDE + 1)) + '}')
    factorial //= n + 1
show('uint64_t', 'fixed_inverse_factorial', f'[{FACTORIALS}][{WIDE + 1}]', rows, '1 / n!')
show_fixed_point('fixed_two_over_pi', 2 * ONE * ONE // PI, 1024 // 64 + WIDE + 2, '2/pi')
print('\n// clang-format on')
