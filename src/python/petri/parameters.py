"""The parameters of a script (`let SIZE=SIZE or 20`), as a mapping."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, List, Optional

from ._petri import ffi, lib

if TYPE_CHECKING:
    from .session import Session


@dataclass(frozen=True)
class Parameter:
    """A parameter and its range, which the comment after its declaration gives: `-- 1..500 how many drops`."""

    name: str
    value: str               #: Current value in printed form.
    default: str             #: Source text of the default.
    number: Optional[float]  #: Current value; None if it is not known to be a single number.
    min: Optional[float]     #: Lower end of the range; None: no lower end.
    max: Optional[float]     #: Upper end of the range; None: no upper end.
    step: Optional[float]    #: Step of the range; None: any number.
    comment: str             #: Comment without the range.
    settable: bool           #: False: the parameter of an imported module, which cannot be set.


class Parameters(Mapping):
    """The parameters of a session by name, in the order of the script. `parameters["SIZE"] = 30` sets one from the next
    frame on, and None restores its default."""

    def __init__(self, session: Session):
        self._session = session

    def _list(self) -> List[Parameter]:
        found, struct = [], ffi.new("PetriParameter *")
        with self._session._lock:
            while lib.petri_parameter(self._session._open_c(), len(found), struct, ffi.sizeof(struct[0])):
                text = [ffi.string(getattr(struct, name)).decode() for name in ("name", "value", "default_value", "comment")]
                known = [x if math.isfinite(x) else None for x in (struct.number, struct.min, struct.max)]
                found.append(Parameter(*text[:3], *known, struct.step or None, text[3], struct.settable))
        return found

    def __getitem__(self, name: str) -> Parameter:
        for parameter in self._list():
            if parameter.name == name:
                return parameter
        raise KeyError(name)

    def __setitem__(self, name: str, value: Any) -> None:
        self._session.set_parameter(name, value)

    def __iter__(self) -> Iterator[str]:
        return iter([parameter.name for parameter in self._list()])

    def __len__(self) -> int:
        return len(self._list())

    def __repr__(self) -> str:
        return f"<petri.Parameters: {', '.join(f'{p.name}={p.value}' for p in self._list()) or 'none'}>"
