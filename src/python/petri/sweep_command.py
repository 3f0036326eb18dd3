"""Sweeps that the command `petri sweep` executes."""

from __future__ import annotations

import csv
import glob
import os
import re
import shutil
import signal
import subprocess
import tempfile
import warnings
from typing import TYPE_CHECKING, Any, Dict, Iterable, List, Mapping, Optional, Union

from . import values
from .errors import MissingLibraryError, PetriError, PetriWarning
from .systems import _optional

if TYPE_CHECKING:
    from .session import Options, Session

# What the command says, with status 1, about a table some of whose runs have errors.
_FAILURES = re.compile(r"petri: \d+ of \d+ runs failed or are unstable")


def option_words(options: Options) -> List[str]:
    """Returns the command's options for the options of a session."""
    numbers = {"fps": options.fps, "threads": options.threads or None, "memory": options.memory_limit, "work": options.work_limit,
               "neighbours": options.neighbours}
    words = [f"--{name}={number}" for name, number in numbers.items() if number is not None]
    words += [f"--allow-read={os.fspath(folder)}" for folder in options.read_folders]
    return words + ["--no-files"] * options.no_files + ["--nosimplify"] * (not options.simplify)


def _execute(words: List[str]) -> str:
    """Runs the command and returns its output. Ctrl-C stops the command, which stores its finished runs."""
    program = shutil.which("petri")
    if not program:
        raise MissingLibraryError("cannot run this sweep: there is no command petri in PATH")
    process = subprocess.Popen([program, "sweep", *words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    try:
        output, messages = process.communicate()
    except BaseException:
        process.send_signal(signal.SIGINT)
        process.communicate()
        raise
    if process.returncode == 128 + signal.SIGINT:
        raise KeyboardInterrupt
    lines = messages.splitlines(True)
    failures = [line for line in lines if _FAILURES.match(line)]
    if process.returncode and (process.returncode != 1 or not failures or "runs differ from their results" in messages):
        raise PetriError(messages.rstrip())
    about_runs = "".join([line for line in lines if not line.startswith("petri: ")] + failures).rstrip()
    if about_runs:
        warnings.warn(PetriWarning(about_runs), stacklevel=4)
    return output


def _cells(cell: Any) -> Any:
    """Returns the text of a table's cell, or its number."""
    return cell.decode() if isinstance(cell, bytes) else cell if isinstance(cell, str) else float(cell)


def _rows(text: str, output: Optional[str]) -> List[Mapping[str, Any]]:
    if output and output.endswith((".h5", ".hdf5")):
        with _optional("h5py", "sweep").File(output) as file:
            table = file["table"][:]
        return [dict(zip(table.dtype.names, map(_cells, row))) for row in table]
    if output:
        with open(output, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))
    return list(csv.DictReader(text.splitlines(True)))


def _value(cell: Union[str, float]) -> values.Value:
    return values.parse(cell) if isinstance(cell, str) else None if cell != cell else cell


def run(printer: Session, source: Union[None, str, os.PathLike], defines: Mapping[str, Iterable[Any]],
        metrics: Mapping[str, Optional[str]], given: Mapping[str, Any], words: List[str]) -> Mapping[str, List[Any]]:
    """Runs the command with options `given` by name, and other `words`. Returns the columns of the table."""
    texts: Dict[str, Dict[str, Any]] = {}
    words = list(words)
    for name, listed in defines.items():
        if not isinstance(listed, str):
            listed = list(listed)
            texts[name] = {value if isinstance(value, str) else printer._printed(value): value for value in listed}
            listed = ";".join(f"({text})" if ";" in text else text for text in texts[name])
        words += ["-D", f"{name}={listed}"]
    for name, expression in metrics.items():
        words += ["--metric", name if expression is None else f"{name}={expression}"]
    words += [f"--{name}" if value is True else f"--{name}={os.fspath(value) if isinstance(value, os.PathLike) else value}"
              for name, value in given.items()]
    if "output" not in given:
        words.append("--output=-")
    with tempfile.TemporaryDirectory(prefix="petri-") as folder:
        if isinstance(source, str) and "\n" in source:
            text, source = source, os.path.join(folder, "script.fl")
            with open(source, "w", encoding="utf-8") as file:
                file.write(text)
        printed = _execute([*words, *([] if source is None else ["--", os.fspath(source)])])
    output = os.fspath(given["output"]) if "output" in given else None
    if output and (not os.path.exists(output) or glob.glob(glob.escape(output) + ".part*")):
        return {}  # the last shard to finish writes the table
    table: Dict[str, List[Any]] = {}
    for row in _rows(printed, output):
        for name, cell in row.items():
            if name == "error":
                value = cell or None
            else:
                value = texts.get(name, {}).get(cell, values.whole(_value(cell)) if name not in metrics else _value(cell))
            table.setdefault(name, []).append(value)
    table.pop("run", None)
    return table
