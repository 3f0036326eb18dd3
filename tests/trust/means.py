#!/usr/bin/env python3
"""means.py PETRI COUNT: checks the intervals that `petri trust --seeds` states for a mean that is known.

A bead in a harmonic trap with noise and drag has the mean position 5, by symmetry. Its positions are correlated for
about a second. Each of COUNT groups of 10 runs has other random numbers. Exits with 1 if so few intervals
contain the mean that 95 % intervals would do so in less than one of 1000 attempts, or if they are wider than needed.
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


def main():
    petri, count = sys.argv[1], int(sys.argv[2])
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(os.cpu_count()) as pool:
        path = os.path.join(folder, "trap.fl")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SCRIPT)

        def group(number):
            words = ["trust", path, "$(:t;:bead)", "--seeds", "10", "--frames", "1200", "--json", "--jobs", "1", "-D", f"GROUP={number}"]
            return json.loads(subprocess.run([petri, *words], check=True, capture_output=True, text=True).stdout)[0]

        found = list(pool.map(group, range(1, count + 1)))
    contained = sum(abs(one["mean"] - MEAN) <= one["half_width"] for one in found)
    scatter = math.sqrt(sum((one["mean"] - MEAN) ** 2 for one in found) / count)
    width = sum(one["half_width"] for one in found) / count
    print(f"{contained} of {count} intervals contain the mean; their half width is {width / scatter:.2f} standard errors")
    chance = sum(math.comb(count, k) * 0.95**k * 0.05 ** (count - k) for k in range(contained + 1))
    sys.exit(chance < 0.001 or width > 3.5 * scatter)


if __name__ == "__main__":
    main()
