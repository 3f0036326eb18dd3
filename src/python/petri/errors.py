"""Diagnostics of scripts, as exceptions and warnings."""

from __future__ import annotations

import warnings
from typing import NamedTuple, Optional

from ._petri import ffi, lib

_LEVELS = {lib.PETRI_ERROR: "error", lib.PETRI_WARNING: "warning", lib.PETRI_NOTE: "note"}


class Diagnostic(NamedTuple):
    """A message about a script. Lines and columns count from 1; `file` is None if there is no position."""

    level: str
    file: Optional[str]
    line: int
    column: int
    text: str
    code: Optional[str]
    rendered: str


class _ScriptMessage(Exception):
    """A message with all its diagnostics. The other attributes are those of the first diagnostic."""

    def __init__(self, message: str, diagnostics: tuple[Diagnostic, ...] = ()):
        super().__init__(message)
        self.diagnostics = diagnostics
        first = diagnostics[0] if diagnostics else Diagnostic("error", None, 0, 0, message, None, message)
        self.file, self.line, self.column = first.file, first.line, first.column
        self.code, self.text = first.code, first.text


class PetriError(_ScriptMessage):
    """A call failed. `diagnostics` has the reasons; the other attributes are those of the first diagnostic."""


class ScriptError(PetriError, ValueError):
    """The script or expression is invalid."""


class LimitError(PetriError):
    """A frame, load or picture exceeded the limit of work or memory. It was aborted and changed nothing."""


class OutOfMemoryError(PetriError, MemoryError):
    """The machine is out of memory."""


class MissingLibraryError(PetriError):
    """This build of libpetri-draw cannot draw."""


class InterruptedStep(PetriError):
    """The call was aborted by Session.interrupt() and changed nothing."""


class PetriWarning(_ScriptMessage, UserWarning):
    """A script does something that is unlikely to be intended. Has the attributes of PetriError."""


_ERRORS = {
    lib.PETRI_INVALID: (ScriptError, "the script does not exist, or an argument is invalid"),
    lib.PETRI_LIMIT_EXCEEDED: (LimitError, "limit exceeded"),
    lib.PETRI_OUT_OF_MEMORY: (OutOfMemoryError, "out of memory"),
    lib.PETRI_UNSUPPORTED: (MissingLibraryError, "petri was compiled without the libraries for pictures"),
    lib.PETRI_INTERRUPTED: (InterruptedStep, "interrupted"),
}


def _text(pointer) -> str:
    return ffi.string(pointer).decode("utf-8", "replace")


@ffi.def_extern()
def petri_python_diagnostic(user_data, diagnostic) -> None:
    ffi.from_handle(user_data).append(Diagnostic(
        _LEVELS[diagnostic.level],
        _text(diagnostic.file) if diagnostic.file else None,
        diagnostic.line,
        diagnostic.column,
        _text(diagnostic.text),
        _text(diagnostic.code) if diagnostic.code else None,
        _text(diagnostic.rendered),
    ))


def finish(status: int, reported: list[Diagnostic], message: Optional[str] = None) -> None:
    """Raises an exception if the status is not PETRI_OK; otherwise issues the diagnostics as warnings."""
    diagnostics = tuple(reported)
    reported.clear()
    if status != lib.PETRI_OK:
        kind, default = _ERRORS[status]
        reasons = tuple(d for d in diagnostics if d.level != "warning")
        raise kind("".join(d.rendered for d in reasons).rstrip() or message or default, reasons)
    for number, first in enumerate(diagnostics):
        if first.level == "note":
            continue
        notes = []
        for d in diagnostics[number + 1:]:
            if d.level != "note":
                break
            notes.append(d)
        warning = PetriWarning(first.text + (f" [{first.code}]" if first.code else ""), (first, *notes))
        warnings.warn_explicit(warning, None, first.file or "<petri>", first.line)
