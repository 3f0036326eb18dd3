"""Parameter sweeps: runs of a script with many combinations of values."""

from __future__ import annotations

import itertools
import os
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Iterable, List, Mapping, Optional, Union

from .errors import PetriError
from .session import Options, Session


def sweep(source: Union[str, os.PathLike], defines: Mapping[str, Iterable[Any]], metrics: Mapping[str, str], *,
          frames: int = 600, until: Optional[str] = None, seeds: int = 0, jobs: Optional[int] = None,
          options: Optional[Options] = None) -> Mapping[str, List[Any]]:
    """Runs a script once per combination of values, several runs in parallel, and measures the results.

    `defines` maps names to lists of values, `metrics` maps column names to expressions, which are evaluated after the
    last frame. If `seeds` is positive, each combination is run with SEED from 1 to `seeds`. A run ends after `frames`
    frames, or after the first frame in which `until` is true. The result maps columns to lists with one element per
    run, in the order of `petri sweep`. The columns are the names, frame, the metrics, and error: None, or the reason
    for a failure, in which case the metrics are None. `pandas.DataFrame` converts the result to a table.
    """
    axes = {name: list(given) for name, given in defines.items()}
    if seeds > 0:
        axes["SEED"] = list(range(1, seeds + 1))
    taken = [*axes, "frame", "error"]
    double = [name for name in metrics if name in taken]
    if double:
        raise ValueError(f"the metric {double[0]!r} has the name of another column")
    runs = [dict(zip(axes, chosen)) for chosen in itertools.product(*axes.values())]

    def run(chosen: Mapping[str, Any]) -> dict:
        row = {**chosen, "frame": None, **dict.fromkeys(metrics), "error": None}
        try:
            with Session(source, options=options or Options(threads=1), **chosen) as session:
                for frame in session.frames(frames):
                    row["frame"] = frame.number
                    if until is not None and session.evaluate(until):
                        break
                row.update({name: session.evaluate(text) for name, text in metrics.items()})
        except PetriError as error:
            row["error"] = str(error)
        return row

    with ThreadPoolExecutor(jobs or os.cpu_count()) as pool:
        rows = list(pool.map(run, runs))
    return {name: [row[name] for row in rows] for name in [*axes, "frame", *metrics, "error"]}
