#!/usr/bin/env python3
"""Compares the errors that `petri trust` states with the true ones, for systems whose motion is known.

cases.py PETRI [--count N] [--case NAME] [--verbose] [--compare] prints a table, and exits with 1 if in one of the cases

- fewer than 95 of 100 stated errors contain the true one, or
- the stated digits are more than the true ones by more than one in five.

With --compare also if the table is not that of the page, src/manual/trust.md, which has the scripts. The exact motion
is a closed form, or else a run whose steps are 256 times shorter.
"""
import argparse
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../src/manual/trust.md")
FINE = 256  # steps of a reference in one step of the run

def kepler(p, t):
    """The planet starts in its aphelion, at distance 1 with speed sqrt(1 - e)."""
    e = p["E"]
    a = 1 / (1 + e)
    mean = math.pi + t / a**1.5
    anomaly = mean
    for _ in range(100):
        anomaly -= (anomaly - e * math.sin(anomaly) - mean) / (1 - e * math.cos(anomaly))
    x = a * (math.cos(anomaly) - e)
    y = a * math.sqrt(1 - e * e) * math.sin(anomaly)
    return [-x, -y]


def spring(p, t):
    return [2 + p["A"] * math.cos(math.sqrt(p["K"]) * t)]


def drag(p, t):
    """Quadratic drag: the speed tends to sqrt(g / S)."""
    g = 9.81
    return [0, 100 - math.log(math.cosh(math.sqrt(g * p["S"]) * t)) / p["S"]]


def charges(p, t):
    """Two charges that repel each other from rest at distance 1: r'' = 2 Q / r²."""
    k = 2 * p["Q"]

    def time(r):
        return (math.sqrt(r * (r - 1)) + math.log(math.sqrt(r) + math.sqrt(r - 1))) / math.sqrt(2 * k)

    low, high = 1, 2 + t * math.sqrt(2 * k)
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if time(middle) < t else (low, middle)
    return [low / 2]


def barriers(p, t):
    """A ball that bounces between the floor at 0.1 and the ceiling at 0.9, without loss."""
    y, v, g = 0.5, p["V"], p["G"]
    while True:
        floor_at = (v + math.sqrt(v * v + 2 * g * (y - 0.1))) / g
        up = v * v - 2 * g * (0.9 - y)
        ceiling_at = (v - math.sqrt(up)) / g if v > 0 and up > 0 else math.inf
        hit = min(floor_at, ceiling_at)
        if hit > t:
            return [y + v * t - g * t * t / 2]
        v = -(v - g * hit)
        y = 0.1 if hit == floor_at else 0.9
        t -= hit


def draw(**ranges):
    return lambda r: {name: r.uniform(*ends) for name, ends in ranges.items()}


def draw_discs(r):
    return {"SEED": r.randrange(1, 10**6), "RES": r.uniform(0.002, 0.016)}


# Name: script in the page, expression, seconds, how to draw the parameters, exact solution.
CASES = {
    "Kepler": ("kepler", "$(:k;:planet)", (1, 20), draw(E=(0.01, 0.6), RES=(0.0005, 0.016)), kepler),
    "spring": ("spring", "$(:s;:ball)", (1, 20), draw(K=(0.1, 100), A=(0.1, 1.5), RES=(0.0005, 0.016)), spring),
    "fall with drag": ("drag", "$(:d;:stone)", (0.5, 4), draw(S=(0.01, 1), RES=(0.0005, 0.016)), drag),
    "two charges": ("charges", "$(:c;1)", (0.5, 10), draw(Q=(0.1, 10), RES=(0.0005, 0.016)), charges),
    "ball between barriers": ("barriers", "$(:b;:ball)", (0.5, 10),
                              draw(V=(0.2, 2), G=(0.3, 3), RES=(0.0005, 0.016)), barriers),
    "double pendulum": ("pendulum", "$(:p;1)", (1, 15), draw(A=(0.01, 0.4), RES=(0.002, 0.016)), None),
    "Lorentz gas": ("lorentz", "$(:l;:ball)", (1, 40), draw(A=(0, 1), RES=(0.002, 0.016)), None),
    "soft discs": ("discs", "$(:d;4)", (1, 15), draw_discs, None),
}


def call(petri, *words):
    done = subprocess.run([petri, *map(str, words)], capture_output=True, text=True, check=False)
    if done.returncode != 0 or done.stderr:
        sys.exit(f"{' '.join(map(str, words))}: status {done.returncode}\n{done.stderr}")
    return done.stdout


def numbers(value):
    return [float(x) for x in str(value).split(";")]


def compare(petri, folder, name, seed):
    """Returns the finding of `petri trust`, the true error and the true number of digits."""
    script, expression, seconds, parameters, exact = CASES[name]
    r = random.Random(f"{name} {seed}")
    path = os.path.join(folder, script + ".fl")
    values = {key: value if isinstance(value, int) else float(f"{value:.6g}") for key, value in parameters(r).items()}
    frames = 1 + int(r.uniform(*seconds) * 60)
    defines = [word for key, value in values.items() for word in ("-D", f"{key}={value}")]
    found = json.loads(call(petri, "trust", path, expression, "--frames", frames, "--json", "--quiet", *defines))[-1]
    if exact:
        truth = exact(values, (frames - 1) / 60)
    else:
        fine = values["RES"] / FINE
        table = call(petri, "sweep", path, "--metric", "x=" + expression, "--frames", frames, "--quiet", "--jobs", 1,
                     *defines[:-2], "-D", f"RES={fine}")
        truth = numbers(table.split("\n")[1].split(",")[-2])
    got = numbers(found["value"])
    size = math.hypot(*got)
    error = max(abs(a - b) for a, b in zip(got, truth))
    if not exact:
        error = max(0, error - size * frames / 60 / fine * 2**-53)  # roundings of the reference, one in each step
    digits = max(0, math.log10(size / error)) if error > 0 and size > 0 else 16
    return found, error, digits, values, frames


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("petri")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--case", choices=list(CASES), action="append")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--compare", action="store_true")
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    bad = False
    with open(PAGE, encoding="utf-8") as file:
        page = file.read()
    print("| system | runs | contained | too many | digits | stated / true error |")
    print("|---|--:|--:|--:|--:|--:|")
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(arguments.jobs) as pool:
        for script, text in re.findall(r"^```flitter (\w+\.fl)\n(.*?)^```$", page, re.M | re.S):
            with open(os.path.join(folder, script), "w", encoding="utf-8") as file:
                file.write(text)
        for name in CASES:
            if arguments.case and name not in arguments.case:
                continue
            done = list(pool.map(lambda seed, case=name: compare(arguments.petri, folder, case, seed),
                                 range(arguments.count)))
            contained = sum(error <= found["error"] for found, error, *_ in done)
            many = sum(found["digits"] - digits > found["digits"] / 5 for found, _, digits, *_ in done)
            stated = sorted(found["digits"] for found, *_ in done)
            ratios = sorted(found["error"] / error for found, error, *_ in done if error > 0)
            row = (f"| {name} | {len(done)} | {contained} | {many} | {stated[0]} to {stated[-1]} "
                   f"| {ratios[len(ratios) // 2]:.2f} |")
            print(row, flush=True)
            if arguments.compare and row not in page:
                print(f"{PAGE} has another row")
                bad = True
            for found, error, digits, values, frames in done:
                if arguments.verbose and (error > found["error"] or found["digits"] - digits > found["digits"] / 5):
                    print(f"  {values} --frames {frames}: error {error:.3g} digits {digits:.2f}: {found}")
            bad = bad or contained < 0.95 * len(done) or many > 0
    sys.exit(bad)


if __name__ == "__main__":
    main()
