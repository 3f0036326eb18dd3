"""Overhead of the Python module. python.py SCRIPT [ROUNDS] prints microseconds, the minimum over the rounds.

With 200 cells, the first two rows must be below 5 and 1. The first row makes no frame, because the physics of a frame
takes hundreds of microseconds and varies by more than the overhead.
"""

import sys
import time

import petri


def min_time(function, rounds, calls=500):
    best = float("inf")
    for _ in range(rounds):
        start = time.perf_counter()
        for _ in range(calls):
            function()
        best = min(best, (time.perf_counter() - start) / calls)
    return 1e6 * best


def main(script, rounds=40):
    session = petri.Session(script, options=petri.Options(threads=1))
    session.step(100)
    state, systems, cells = session.state, session.systems, session.systems["cells"]

    def step_and_read():
        session.step(0)
        return systems["cells"].position

    for what, function in {
        "step and read all positions, without the frame": step_and_read,
        'state["cells", i]': lambda: state["cells", 7],
        "position": lambda: cells.position,
        "position.copy()": lambda: cells.position.copy(),
        "frame": lambda: session.frame,
        'evaluate("1")': lambda: session.evaluate("1"),
    }.items():
        print(f"{min_time(function, int(rounds)):8.2f} µs  {what}")
    start = time.perf_counter()
    session.step(200)
    print(f"{5e3 * (time.perf_counter() - start):8.0f} µs  per frame")


if __name__ == "__main__":
    main(*sys.argv[1:])
