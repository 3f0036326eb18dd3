"""What Python costs beside the C calls: python.py SCRIPT [ROUNDS] writes microseconds, the least of so many rounds.

The first two rows are to stay below 5 and 1 with 200 cells. The first asks for no frame: beside hundreds of
microseconds of physics, whose time varies by more, what Python takes could not be seen.
"""

import sys
import time

import petri


def least(function, rounds, calls=500):
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
        print(f"{least(function, int(rounds)):8.2f} µs  {what}")
    start = time.perf_counter()
    session.step(200)
    print(f"{5e3 * (time.perf_counter() - start):8.0f} µs  a frame")


if __name__ == "__main__":
    main(*sys.argv[1:])
