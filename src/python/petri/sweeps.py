"""Parameter sweeps: runs of a script with many combinations of values."""

from __future__ import annotations

import itertools
import os
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Iterable, List, Mapping, Optional, Union

from . import sweep_command
from .errors import PetriError
from .session import Options, Session


def sweep(source: Union[None, str, os.PathLike] = None, defines: Mapping[str, Iterable[Any]] = {},
          metrics: Mapping[str, Optional[str]] = {}, *, frames: Optional[int] = None, until: Optional[str] = None,
          every: int = 0, seeds: int = 0, where: Union[None, str, Callable[[Mapping[str, Any]], bool]] = None,
          given: Optional[Mapping[str, Any]] = None, functions: Optional[Mapping[str, Callable]] = None,
          jobs: Optional[int] = None, options: Optional[Options] = None, sample: Union[None, int, str] = None,
          output: Union[None, str, os.PathLike] = None, summary: Union[None, str, os.PathLike] = None,
          plot: Union[None, str, os.PathLike] = None, plan: Union[None, str, os.PathLike] = None,
          cache: Union[None, str, os.PathLike] = None, verify_cache: Optional[float] = None,
          shard: Optional[str] = None) -> Mapping[str, List[Any]]:
    """Runs a script once per combination of values, several runs in parallel, and measures the results.

    `defines` maps names to lists of values, `metrics` maps column names to expressions, which are evaluated after the
    last frame, and with `every` also after every `every`-th frame. If `seeds` is positive, each combination is run with
    SEED from 1 to `seeds`. `where` selects combinations: it gets a dict of names and values. A run ends after `frames`
    frames (default: 600), or after the first frame in which `until` is true. `jobs` runs are executed in parallel
    (default: number of CPUs). `given` and `functions` are those of Session; functions are called by several threads.
    The result maps columns to lists with one element per row, in the order of `petri sweep`. The columns are the names,
    frame, the metrics, and error: None, or the reason for a failure, in which case the metrics are None.
    `pandas.DataFrame` converts the result to a table. Ctrl-C aborts the runs.

    The following need the command `petri` in PATH, which then executes the runs:
    `sample`: a number of runs, or "latin:N:SEED", for Latin hypercube sampling instead of all combinations.
    `output`: file for the table, .csv or .h5 (needs h5py). After Ctrl-C or a crash, the same call resumes the sweep.
    `summary`: file for mean, standard deviation and quartiles of each metric over the seeds.
    `plot`: file for a plot of each metric against each parameter: .svg, .png or .pdf.
    `plan`: YAML file with a script and options, which other arguments override; its `output` is not used.
    `cache`: folder in which results are stored and found; `verify_cache`: percentage of them to compute again.
    `shard`: "I/N", the part of the runs to execute; needs `output`. The result is empty if other shards have not
    finished.
    In `defines`, a str in the command's notation, such as "0..1|0.05". In `where`, a str with an expression.
    In `metrics`, None for a quantity of all systems: energy, kinetic_energy, potential_energy, momentum or
    angular_momentum. In these cases `given`, `functions` and a callable `where` raise ValueError, because the runs are
    in another process. If the command fails, PetriError has its messages.
    """
    chosen = {"sample": f"latin:{sample}" if isinstance(sample, int) else sample, "output": output, "summary": summary,
              "plot": plot, "plan": plan, "cache": cache, "verify-cache": verify_cache, "shard": shard,
              "where": where if isinstance(where, str) else None}
    chosen = {name: value for name, value in chosen.items() if value is not None}
    if chosen or any(isinstance(listed, str) for listed in defines.values()) or None in metrics.values():
        if given or functions or callable(where):
            raise ValueError("given, functions and a function as where cannot be used here, because the command petri "
                             "executes the runs")
        shared = {"frames": frames, "until": until, "every": every or None, "seeds": seeds or None, "jobs": jobs}
        chosen = {**{name: value for name, value in shared.items() if value is not None}, **chosen}
        with Session("\n") as printer:
            return sweep_command.run(printer, source, defines, metrics, chosen, sweep_command.option_words(options or Options()))
    if source is None:
        raise ValueError("a sweep needs a script or a plan")
    script, count = source, 600 if frames is None else frames
    select = where if callable(where) else None
    expressions = {name: text for name, text in metrics.items() if text is not None}
    axes = {name: list(values) for name, values in defines.items()}
    if seeds > 0:
        axes["SEED"] = list(range(1, seeds + 1))
    reserved = [*axes, "frame", "error"]
    double = [name for name in metrics if name in reserved]
    if double:
        raise ValueError(f"the metric {double[0]!r} has the name of another column")
    runs = [dict(zip(axes, chosen)) for chosen in itertools.product(*axes.values())]
    runs = [run for run in runs if select is None or select(run)]
    stopped = threading.Event()
    active: List[Session] = []

    def measure(session: Session, chosen: Mapping[str, Any], rows: List[dict]) -> None:
        for i in range(count):
            session.step()
            ends = i + 1 == count or until is not None and bool(session.evaluate(until))
            if ends or every > 0 and i % every == 0:
                rows.append({**chosen, "frame": session.frame.number, "error": None,
                             **{name: session.evaluate(text) for name, text in expressions.items()}})
            if ends or stopped.is_set():
                break

    def run(chosen: Mapping[str, Any]) -> List[dict]:
        rows: List[dict] = []
        frame = None
        try:
            with Session(script, options=options or Options(threads=1), given=given, functions=functions, **chosen) as session:
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
