"""Parameter sweeps: runs of a script with many combinations of values."""

from __future__ import annotations

import itertools
import os
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Iterable, List, Mapping, Optional, Union

from .errors import PetriError
from .session import Options, Session


def sweep(source: Union[str, os.PathLike], defines: Mapping[str, Iterable[Any]], metrics: Mapping[str, str], *,
          frames: int = 600, until: Optional[str] = None, every: int = 0, seeds: int = 0,
          where: Optional[Callable[[Mapping[str, Any]], bool]] = None, given: Optional[Mapping[str, Any]] = None,
          functions: Optional[Mapping[str, Callable]] = None, jobs: Optional[int] = None,
          options: Optional[Options] = None) -> Mapping[str, List[Any]]:
    """Runs a script once per combination of values, several runs in parallel, and measures the results.

    `defines` maps names to lists of values, `metrics` maps column names to expressions, which are evaluated after the
    last frame, and with `every` also after every `every`-th frame. If `seeds` is positive, each combination is run with
    SEED from 1 to `seeds`. `where` selects combinations: it gets a dict of names and values. A run ends after `frames`
    frames, or after the first frame in which `until` is true. `given` and `functions` are those of Session; functions
    are called by several threads. The result maps columns to lists with one element per row, in the order of `petri
    sweep`. The columns are the names, frame, the metrics, and error: None, or the reason for a failure, in which case
    the metrics are None. `pandas.DataFrame` converts the result to a table. Ctrl-C aborts the runs.
    """
    axes = {name: list(values) for name, values in defines.items()}
    if seeds > 0:
        axes["SEED"] = list(range(1, seeds + 1))
    taken = [*axes, "frame", "error"]
    double = [name for name in metrics if name in taken]
    if double:
        raise ValueError(f"the metric {double[0]!r} has the name of another column")
    runs = [dict(zip(axes, chosen)) for chosen in itertools.product(*axes.values())]
    runs = [chosen for chosen in runs if where is None or where(chosen)]
    stopped = threading.Event()
    active: List[Session] = []

    def measure(session: Session, chosen: Mapping[str, Any], rows: List[dict]) -> None:
        for i in range(frames):
            session.step()
            ends = i + 1 == frames or until is not None and bool(session.evaluate(until))
            if ends or every > 0 and i % every == 0:
                rows.append({**chosen, "frame": session.frame.number, "error": None,
                             **{name: session.evaluate(text) for name, text in metrics.items()}})
            if ends or stopped.is_set():
                break

    def run(chosen: Mapping[str, Any]) -> List[dict]:
        rows: List[dict] = []
        frame = None
        try:
            with Session(source, options=options or Options(threads=1), given=given, functions=functions, **chosen) as session:
                active.append(session)
                try:
                    if not stopped.is_set():
                        measure(session, chosen, rows)
                finally:
                    frame = session.frame.number if session.frame.number >= 0 else None
                    active.remove(session)
        except PetriError as error:
            rows.append({**chosen, "frame": frame, **dict.fromkeys(metrics), "error": str(error)})
        return rows

    with ThreadPoolExecutor(jobs or os.cpu_count()) as pool:
        results = [pool.submit(run, chosen) for chosen in runs]
        try:
            rows = [row for result in results for row in result.result()]
        except BaseException:
            stopped.set()
            for result in results:
                result.cancel()
            for session in list(active):
                session.interrupt()
            raise
    return {name: [row[name] for row in rows] for name in [*axes, "frame", *metrics, "error"]}
