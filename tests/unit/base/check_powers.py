#!/usr/bin/env python3
"""check_powers.py: proves what lib/base/shortest.c assumes about powers of ten.

usage: check_powers.py powers_of_ten.h

Compares each row of the header with integer arithmetic. Then finds, for each exponent of doubles, the numbers nearest to
integers among all that shortest.c rounds to odd. The method is that of Euclid's algorithm: multiples of a fraction come
nearest to an integer at its convergents and between them.
"""
import re
import sys
from fractions import Fraction

MIN_POWER, MAX_POWER = -292, 324
MIN_EXPONENT, MAX_EXPONENT = -1074, 971  # of doubles c * 2^q
ERROR = Fraction(1, 2**68)  # of a product of less than 2^60 with a power that is too large by less than 2^-128
LEAST_FRACTION = Fraction(1, 2**67)  # shortest.c takes smaller ones for 0


def floor_log(base, x):
    """Returns floor(log(x)) of a positive Fraction."""
    n = 0
    while Fraction(base) ** (n + 64) <= x:
        n += 64
    while Fraction(base) ** n > x:
        n -= 64
    while Fraction(base) ** (n + 1) <= x:
        n += 1
    return n


def check_header(path):
    with open(path, encoding='utf-8') as header:
        rows = re.findall(r'\{0x([0-9a-f]{16}), 0x([0-9a-f]{16})\}', header.read())
    assert len(rows) == MAX_POWER - MIN_POWER + 1, len(rows)
    for n, (high, low) in enumerate(rows, MIN_POWER):
        power = Fraction(10) ** n
        exact = power * Fraction(2) ** (127 - floor_log(2, power))
        assert int(high + low, 16) == exact.numerator // exact.denominator + 1, n


def extremes(a, m, count):
    """Returns the smallest residue above 0 and the largest of a * i mod m, for i from 1 to count; a and m are coprime."""
    low, high, low_at, high_at = a % m, m - a % m, 1, 1  # `high` is the distance of the largest residue to m
    if m <= count:
        return 1, m - 1
    while True:
        if low < high:
            steps = min((high - 1) // low, (count - high_at) // low_at)
            high, high_at = high - steps * low, high_at + steps * low_at
        else:
            steps = min((low - 1) // high, (count - low_at) // high_at)
            low, low_at = low - steps * high, low_at + steps * high_at
        if steps == 0 or high_at + low_at > count:
            return low, m - high


def check_extremes():
    for m in range(2, 60):
        for a in range(1, m):
            for count in range(1, 80):
                if Fraction(a, m).denominator == m:
                    residues = [a * i % m for i in range(1, count + 1) if a * i % m > 0]
                    assert extremes(a, m, count) == (min(residues), max(residues)), (a, m, count)


def distances():
    """Yields distances from the next lower and higher integer, of numbers that are not integers."""
    for q in range(MIN_EXPONENT, MAX_EXPONENT + 1):
        # 4c and 4c +- 2, for all c up to 2^53
        step = 2 * Fraction(2) ** q / Fraction(10) ** floor_log(10, Fraction(2) ** q)
        if step.denominator > 1:
            low, high = extremes(step.numerator, step.denominator, 2**54 + 1)
            yield Fraction(low, step.denominator), 1 - Fraction(high, step.denominator)
        # Powers of two: 4c - 1, 4c and 4c + 2
        unit = Fraction(2) ** q / Fraction(10) ** floor_log(10, Fraction(2) ** q * 3 / 4)
        for fours in (2**54 - 1, 2**54, 2**54 + 2):
            part = fours * unit % 1
            if part > 0:
                yield part, 1 - part


check_extremes()
check_header(sys.argv[1])
below, above = (min(found) for found in zip(*distances()))
assert below > LEAST_FRACTION > ERROR, below
assert above > ERROR, above
print(f'distances to integers: at least 2^-{-floor_log(2, below)} above one, 2^-{-floor_log(2, above)} below one')
