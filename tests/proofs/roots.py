#!/usr/bin/env python3
"""roots.py: checks the proof that lib/physics/fused_roots.h rounds correctly (src/manual/physics-engine.md).

Gappa proves the bounds. A result can only be wrong if the exact one is closer to the middle between two doubles than
the bounds. There are few such cases, and number theory finds them all. For each, the last operations are computed from
all values that the bounds permit, in exact arithmetic. Only squares that root_is_exact_where excludes may then give a
wrong result.

roots.py: prints a line for each set of instructions and for inverses. roots.py --list: prints the hard squares of
tests/unit/physics/hard_roots.h.
"""
import itertools
import math
import pathlib
import shutil
import subprocess
import sys
from fractions import Fraction

U = Fraction(1, 2**53)
# By instruction set: steps of the iteration, bound of the approximation, and bounds that Gappa proves, in units of U:
# of g, h and 2 g h (relative), and of the root before its last rounding, in units of U^2.
SETS = {
    "avx512": (2, "0x1p-14", {"G": (-2.94, 2.56), "H": (-2.94, 2.56), "P": (-2.85, 2.01), "T": (-16, 11)}),
    "avx2": (3, "0x1.84p-12", {"G": (-3.53, 3.57), "H": (-3.53, 3.57), "P": (-2.01, 2.01), "T": (-23, 17)}),
}


def gappa_text(steps, start, bounds, g_error="0x1p-53", h_error="0x1p-53"):
    """Returns the bounds for Gappa. g_error, h_error: relative errors of the roundings of g and h."""
    lines = ["P0 = (1 + a) * (1 + a) * (1 + d0) - 1;"]
    for n in range(1, steps + 1):
        p, c = f"P{n - 1}", f"(1 + c{n})"
        lines += [
            f"Q{n} = {p} * {p} * {c} * ({c} / 4 - 1) + {p} * {p} * {p} * {c} * {c} / 4 - {p} * c{n};",
            f"P{n} = Q{n} + (1 + Q{n}) * (d{n} + k{n} + d{n} * k{n});",
        ]
    last = f"(1 + Q{steps})"
    before = " * ".join(f"(1 + d{n})" for n in range(steps))
    between = " * ".join(f"(1 + k{n})" for n in range(1, steps))
    lines += [
        f"G = sqrt({last} * (1 + d{steps}) * (1 + d{steps}) * {before} / ({between})) - 1;",
        f"H = sqrt({last} * (1 + k{steps}) * (1 + k{steps}) * {between} / ({before})) - 1;",
        "T = -(G * (H + r + H * r)) - G * G / 2 * (1 + H) * (1 + r);",
        "B = -(H + b + H * b);",
        "Y = 1 - (1 - B * B + B * e * (1 - B)) * (1 + f);",
    ]
    known = {"a": start, "r": "0x1p-53", "b": "0x1p-53", "e": "0x1p-53", "f": "0x1p-53", "d0": g_error}
    for n in range(1, steps + 1):
        known |= {f"c{n}": "0x1p-53", f"d{n}": g_error, f"k{n}": h_error}
    goals = []
    for name, (low, high) in bounds.items():
        unit = U * U if name == "T" else U
        numbers = [f"{math.floor(Fraction(v) * unit * 2**170)}b-170" for v in (low, high)]
        goals.append(f"{f'P{steps}' if name == 'P' else name} in [{numbers[0]},{numbers[1]}]")
    return "\n".join(lines) + "\n{ " + " /\\ ".join(f"|{k}| <= {v}" for k, v in known.items()) + "\n -> " + (
        " /\\ ".join(goals)) + " }\n"


def prove(text):
    """Returns whether Gappa proves all bounds. It ends with 1 if it does not."""
    return subprocess.run(["gappa", "-Eprecision=80"], input=text, text=True, capture_output=True).returncode == 0


def check_identity():
    """(1 + p) (1 - p (1 + c) / 2)^2 = 1 + Q. Both sides have degree 3 in p and 2 in c, so 4 times 3 points suffice."""
    for p, c in itertools.product(map(Fraction, range(4)), map(Fraction, range(3))):
        q = p * p * (1 + c) * ((1 + c) / 4 - 1) + p**3 * (1 + c) ** 2 / 4 - p * c
        assert (1 + p) * (1 - p * (1 + c) / 2) ** 2 == 1 + q


def rounded(value):
    """Returns value rounded to 53 bits, ties to even."""
    if value == 0:
        return Fraction(0)
    size = abs(value)
    exponent = size.numerator.bit_length() - size.denominator.bit_length() - 53
    if size >= Fraction(2) ** (exponent + 53):
        exponent += 1
    unit = Fraction(2) ** exponent
    return round(value / unit) * unit  # round() of a Fraction rounds ties to even


def doubles_near(centre, bounds):
    low, high = (centre * (1 + Fraction(bound) * U) for bound in bounds)
    unit = Fraction(2) ** (low.numerator.bit_length() - low.denominator.bit_length() - 54)
    numbers = (n * unit for n in range(math.ceil(low / unit), math.floor(high / unit) + 1))
    return [number for number in numbers if rounded(number) == number]


def root_of(square):
    """Returns a root to 200 bits, the last of which is set if it is not exact, so that it is rounded like the root."""
    scaled = int(square * 2**400)
    root = math.isqrt(scaled)
    return Fraction(2 * root + (root * root != scaled), 2**201)


def square_roots(residue, bits):
    """Returns the odd numbers below 2^bits whose squares are congruent to `residue` modulo 2^bits (Hensel)."""
    found = {1, 3, 5, 7} if residue % 8 == 1 else set()
    for n in range(3, bits):
        found = {c for r in found for c in (r, r + 2**n) if (c * c - residue) % 2 ** (n + 1) == 0}
    return found


def hard_squares(limit):
    """Returns all X so that x = X / 2^52 in [1, 4) is a double and |x - m^2| <= limit 2^-106 for a middle m."""
    found = set()
    for j in range(-limit, limit + 1):
        for m in square_roots(j, 54):
            x = (m * m - j) >> 54
            if 2**53 < m < 2**54 and 2**52 <= x < 2**54 and (x < 2**53 or x % 2 == 0):
                found.add(x)
    return sorted(found)


def rounds_correctly(x, bounds):
    """Returns whether the root of X / 2^52 is rounded correctly from all g and h within the bounds."""
    square = Fraction(x, 2**52)
    root = root_of(square)
    right = rounded(root)
    low, high = (Fraction(bound) * U for bound in bounds["P"])
    return all(
        rounded(g + rounded(square - g * g) * h) == right
        for g in doubles_near(root, bounds["G"])
        for h in doubles_near(1 / (2 * root), bounds["H"])
        if low <= 2 * g * h - 1 <= high
    )


def is_excluded(x):
    """root_is_exact_where. The exponent of 1 is odd, that of 2 is even."""
    lowest_bits = x if x < 2**53 else (x - 2**53) // 2
    return (lowest_bits + 8 - 2**52) % 2**53 < 16


def closer_bounds(x, steps, start):
    """Returns bounds for one square that is not near 1 or 4. They are closer, because the last place of g, between 1 and
    2, and of h, between 1/4 and 1/2, is known."""
    root = float(root_of(Fraction(x, 2**52)))
    assert 1.01 < root < 1.99
    g, h = 1.0001 / root, 1.0001 * root / 2  # in units of U
    middle = (steps * g + (steps - 1) * h) / 2 + (0.44 if steps == 2 else 0.01)
    bounds = {"G": (-middle - g, middle + g), "H": (-middle - h, middle + h), "P": (-0.85 - g - h, 0.01 + g + h)}
    text = gappa_text(steps, start, bounds, *(f"{math.ceil(v * 2**20)}b-73" for v in (g, h)))
    assert prove(text), f"Gappa does not prove the closer bounds of {x}"
    return bounds


def check_roots(name, steps, start, bounds):
    assert prove(gappa_text(steps, start, bounds | {"Y": (-1.04, 1.04)})), f"Gappa does not prove the bounds of {name}"
    squares = hard_squares(8 * max(map(abs, bounds["T"])) + 1)
    wrong = [x for x in squares if not rounds_correctly(x, bounds)]
    inner = [x for x in wrong if not is_excluded(x)]
    for x in inner:
        assert rounds_correctly(x, closer_bounds(x, steps, start)), f"{name}: the root of {x} can be wrong"
    print(f"{name}: bounds proven; {len(squares)} hard squares; {len(wrong) - len(inner)} excluded, "
          f"{len(inner)} with closer bounds")
    return squares


def prime_factors(number):
    factors, divisor = [], 2
    while divisor * divisor <= number:
        while number % divisor == 0:
            factors.append(divisor)
            number //= divisor
        divisor += 1
    return factors + [number]


def check_inverses():
    """A wrong inverse of B / 2^52 needs a middle M / 2^54 with B M = 2^106 - 1. The only B is 2^53 - 1."""
    divisors = {1}
    for prime in prime_factors(2**53 - 1) + prime_factors(2**53 + 1):  # their product is 2^106 - 1
        divisors |= {divisor * prime for divisor in divisors}
    found = [b for b in divisors if 2**52 <= b < 2**53 and 2**53 < (2**106 - 1) // b < 2**54]
    assert found == [2**53 - 1]
    # This root belongs to excluded squares.
    for x in range(2**54 - 64, 2**54, 2):
        assert rounded(root_of(Fraction(x, 2**52))) != Fraction(2**53 - 1, 2**52) or is_excluded(x)
    print("inverses: the only hard root is 2 - 2^-52, whose squares are excluded")


def main():
    if sys.argv[1:] == ["--list"]:
        for x in hard_squares(8 * 23 + 1):
            print(f"    {(x / 2**52).hex()},")
        return
    if not shutil.which("gappa"):
        print("skipped: gappa is not installed")
        sys.exit(77)
    check_identity()
    tested = (pathlib.Path(__file__).parents[1] / "unit/physics/hard_roots.h").read_text()
    for name, (steps, start, bounds) in SETS.items():
        squares = check_roots(name, steps, start, bounds)
        assert all((x / 2**52).hex() in tested for x in squares), "test_roots misses hard squares"
    check_inverses()


main()
