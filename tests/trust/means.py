#!/usr/bin/env python3
"""means.py PETRI COUNT: checks the intervals that `petri trust` states for a mean that is known.

A bead in a harmonic trap with noise and drag has the mean position 5, by symmetry. Its positions are correlated for
about a second. Each of COUNT groups of runs has other random numbers: of 10 runs, or of as many as --within adds. Exits
with 1 if so few intervals contain the mean that chance explains it in less than one of 50 attempts, where 95 of 100 are
expected; if they are fewer than 93 of 100, for at least 200 groups; if they are wider than they need to be; or if more
than 6 of 100 groups are said to drift (2 are expected).
"""
import json
import math
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

MEAN = 5
SCRIPT = """\
let SEED=SEED or 1
    GROUP=GROUP or 1

!physics state=:t dimensions=1 run=SEED+1000*GROUP
    !anchor id=:wall
    !particle id=:bead position=5 radius=1
    !distance from=:wall to=:bead fixed=5
    !random strength=20
    !drag strength=2
"""


# Options of trust.
WAYS = {"10 runs": ["--seeds", "10", "--frames", "1200"], "--within 8%": ["--within", "8%", "--frames", "600"]}


def fewest(count):
    """Returns the smallest number of intervals that is not suspicious."""
    def chance(end):
        return sum(math.comb(count, k) * 0.95**k * 0.05 ** (count - k) for k in range(end))

    by_chance = max(k for k in range(count + 1) if chance(k) < 0.02)
    return max(by_chance, math.ceil(0.93 * count)) if count >= 190 else by_chance


def is_good(way, options, count, run):
    found = [one for one in run(options, range(1, count + 1)) if one["half_width"] is not None]
    contained = sum(abs(one["mean"] - MEAN) <= one["half_width"] for one in found)
    scatter = math.sqrt(sum((one["mean"] - MEAN) ** 2 for one in found) / len(found))
    width = sum(one["half_width"] for one in found) / len(found)
    runs = sum(one["runs"] for one in found) / len(found)
    print(f"{way}: {contained} of {len(found)} intervals contain the mean; {count - len(found)} groups drift; "
          f"the half width is {width / scatter:.2f} standard errors, with {runs:.1f} runs")
    return contained >= fewest(len(found)) and width < 3.5 * scatter and count - len(found) <= 0.06 * count


def main():
    petri, count = sys.argv[1], int(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        path = os.path.join(folder, "trap.fl")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SCRIPT)

        def group(options, number):
            words = [petri, "trust", path, "$(:t;:bead)", *options, "--json", "--jobs", "1", "-D", f"GROUP={number}"]
            output = subprocess.run(words, capture_output=True, text=True).stdout  # status 1: it drifts
            return json.loads(output)[0]

        def run(options, numbers):
            return list(pool.map(lambda number: group(options, number), numbers))

        good = [is_good(way, options, count, run) for way, options in WAYS.items()]
    sys.exit(not all(good))


if __name__ == "__main__":
    main()
