"""Parameter sweeps: runs of a script with many combinations of values."""

from __future__ import annotations

import itertools
import os
import re
import threading
import warnings
from collections.abc import Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, List, Optional, Union

from . import sweep_command
from .errors import Diagnostic, PetriError, PetriWarning, ScriptError
from .session import Options, Session

_UNREAD = ("unknown-parameter", "unread-definition", "unused-definition")
_UNUSED_VALUE = ("false-definition", "bad-definition")


class _Run(Session):
    """A session that stores what makes its results meaningless, and does not repeat the warnings of other runs."""

    issued: set[Diagnostic]  #: what the runs of the sweep have reported
    marked: Optional[Diagnostic] = None  #: reason why the run is unstable; None: it is not

    def _finish(self, status: int, message: Optional[str] = None) -> None:
        for diagnostic in self._told:
            if diagnostic.code in ("divergence", "unstable-force"):
                self.marked = diagnostic
        # _check has found that the metrics or `until` read these names.
        self._told[:] = [diagnostic for diagnostic in self._told if diagnostic.code not in _UNREAD]
        if not status:
            self._told[:] = [diagnostic for diagnostic in self._told if diagnostic not in self.issued]
            self.issued.update(self._told)
        super()._finish(status, message)


class _DryRun(Session):
    """A session that stores its warnings and does not issue them, because the runs do."""

    def _finish(self, status: int, message: Optional[str] = None) -> None:
        if not hasattr(self, "noted"):
            self.noted: List[Diagnostic] = []
        if not status and not (self._functions and self._functions.raised):
            self.noted += self._told
            self._told.clear()
        super()._finish(status, message)


def _may_be_refused(value: Any) -> bool:
    return not isinstance(value, (int, float)) or value == 0


def _refuse(diagnostics: Iterable[Diagnostic], reason: str) -> None:
    found = tuple(diagnostics)
    if found:
        raise ScriptError(f"{found[0].rendered.rstrip()}\ncannot start the sweep: {reason}", found)


def _check_values(axes: Mapping[str, List[Any]], runs: List[Mapping[str, Any]], dry_run: Callable) -> None:
    """Raises ScriptError if the script does not use a value."""
    for name, listed in axes.items():
        for value in filter(_may_be_refused, listed):
            chosen = next((run for run in runs if run[name] is value), None)
            try:
                if chosen is not None:
                    dry_run(chosen).close()
            except PetriError as error:
                _refuse((found for found in error.diagnostics if found.code in _UNUSED_VALUE),
                        f"the script does not accept {name}={value!r}")


def _check(axes: Mapping[str, List[Any]], runs: List[Mapping[str, Any]], expressions: List[str], dry_run: Callable) -> None:
    """Raises ScriptError if the script is invalid, or if a value, a name or an expression has no effect. Computes the
    first frame of a run."""
    _check_values(axes, runs, dry_run)
    try:
        session = dry_run(runs[0])
    except ScriptError:
        raise
    except PetriError:
        return  # the runs report it
    with session:
        noted = getattr(session, "noted", [])
        for name in axes:
            if not any(re.search(rf"(?<![\w:]){re.escape(name)}(?!\w)", text) for text in expressions):
                _refuse((found for found in noted if found.code in _UNREAD and found.text.startswith(f"unused definition '{name}':")),
                        f"the script does not read {name!r}, so all its values would give the same result")
        try:
            session.step()
            for text in expressions:
                noted = session.noted = []
                session.evaluate(text)
                _refuse((found for found in noted if found.code == "unbound-name"), f"cannot evaluate {text!r}")
        except ScriptError:
            raise
        except PetriError:
            pass


def _check_arguments(defines: Any, metrics: Any) -> None:
    for name, argument in (("defines", defines), ("metrics", metrics)):
        if not isinstance(argument, Mapping):
            raise TypeError(f"{name} must be a dict, not {argument!r}")
    for name, listed in defines.items():
        if not isinstance(listed, Iterable):
            raise TypeError(f"defines[{name!r}] must be a list of values, not {listed!r}")


def sweep(source: Union[None, str, os.PathLike] = None, defines: Mapping[str, Iterable[Any]] = {},
          metrics: Mapping[str, Optional[str]] = {}, *, frames: Optional[int] = None, until: Optional[str] = None,
          every: int = 0, seeds: int = 0, where: Union[None, str, Callable[[Mapping[str, Any]], bool]] = None,
          given: Optional[Mapping[str, Any]] = None, functions: Optional[Mapping[str, Callable]] = None,
          jobs: Optional[int] = None, options: Optional[Options] = None, sample: Union[None, int, str] = None,
          output: Union[None, str, os.PathLike] = None, summary: Union[None, str, os.PathLike] = None,
          plot: Union[None, str, os.PathLike] = None, plan: Union[None, str, os.PathLike] = None,
          cache: Union[None, str, os.PathLike] = None, verify_cache: Optional[float] = None,
          shard: Optional[str] = None, trust: bool = False) -> Mapping[str, List[Any]]:
    """Runs a script once per combination of values, several runs in parallel, and measures the results.

    `defines` maps names to lists of values, `metrics` maps column names to expressions, which are evaluated after the
    last frame, and with `every` also after every `every`-th frame. If `seeds` is positive, each combination is run with
    SEED from 1 to `seeds`. `where` selects combinations: it gets a dict of names and values. A run ends after `frames`
    frames (default: 600), or after the first frame in which `until` is true. `jobs` runs are executed in parallel
    (default: number of CPUs). `given` and `functions` are those of Session; functions are called by several threads.
    The result maps columns to lists with one element per row, in the order of `petri sweep`. The columns are the names,
    frame, the metrics, and error: None, or the reason why the run is unstable or has failed. The metrics of a failed run
    are None. A PetriWarning counts such runs. Before the first run, ScriptError is raised if a metric or `until` has an
    unbound name, if neither the script nor these expressions read a name in `defines`, or if the script does not use
    one of its values.
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
    `trust`: if true, a column NAME_digits follows each metric: the number of its digits that are true.
    In `defines`, a str in the command's notation, such as "0..1|0.05". In `where`, a str with an expression.
    In `metrics`, None for a quantity of all systems: energy, kinetic_energy, potential_energy, momentum or
    angular_momentum. In these cases `given`, `functions` and a callable `where` raise ValueError, because the runs are
    in another process. If the command fails, PetriError has its messages.
    """
    _check_arguments(defines, metrics)
    chosen = {"sample": f"latin:{sample}" if isinstance(sample, int) else sample, "output": output, "summary": summary,
              "plot": plot, "plan": plan, "cache": cache, "verify-cache": verify_cache, "shard": shard, "trust": trust or None,
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
    run_type = type("_Run", (_Run,), {"issued": set()})
    stopped = threading.Event()
    active: List[Session] = []

    def measure(session: _Run, chosen: Mapping[str, Any], rows: List[dict]) -> None:
        for i in range(count):
            session.step()
            marked = session.marked and f"{session.marked.file}:{session.marked.line}:{session.marked.column}: {session.marked.text}"
            if session.marked and session.marked.code == "divergence":
                rows.append({**chosen, "frame": max(i - 1, 0), **dict.fromkeys(metrics), "error": marked})
                break
            ends = i + 1 == count or until is not None and bool(session.evaluate(until))
            if ends or every > 0 and i % every == 0:
                rows.append({**chosen, "frame": session.frame.number, "error": marked,
                             **{name: session.evaluate(text) for name, text in expressions.items()}})
            if ends or stopped.is_set():
                break

    def run(chosen: Mapping[str, Any]) -> List[dict]:
        rows: List[dict] = []
        frame = None
        try:
            with run_type(script, options=options or Options(threads=1), given=given, functions=functions, **chosen) as session:
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

    if runs:
        _check(axes, runs, [*expressions.values(), *([until] if until else [])],
               lambda chosen: _DryRun(script, options=options or Options(threads=1), given=given, functions=functions, **chosen))
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
    failed = sum(bool(result.result() and result.result()[-1]["error"]) for result in results)
    if failed:
        warnings.warn(PetriWarning(f"{failed} of {len(runs)} runs failed or are unstable; see the column 'error'"), stacklevel=2)
    return {name: [row[name] for row in rows] for name in [*axes, "frame", *metrics, "error"]}
