"""The state, which scripts read with `$`, as a mapping."""

from __future__ import annotations

from collections.abc import MutableMapping
from typing import Any, Iterator

from . import values
from ._petri import ffi, lib


class State(MutableMapping):
    """`session.state["cells", 3]` is `$(:cells;3)`: a float, a str, a Text, or a tuple of these.

    A key is a str (a symbol), a number, a `Text` (a string) or a tuple of these. Scripts read new values from the next
    frame on. Missing keys raise KeyError.
    """

    __slots__ = ("_session", "_lock", "_symbols", "_value")

    def __init__(self, session: Any, lock: Any):
        self._session = session  # NULL: closed
        self._lock = lock
        self._symbols: dict[str, float] = {}
        self._value = ffi.new("PetriValue *")

    def _check(self) -> None:
        """Raises ValueError if the session is closed."""
        if not self._session:
            raise ValueError("the session is closed, or is calling this function")

    def _symbol(self, name: str) -> float:
        if name not in self._symbols:
            self._symbols[name] = values.symbol(self._session, name)
        return self._symbols[name]

    def __getitem__(self, key: Any) -> values.Value:
        value = self._value
        with self._lock:
            self._check()
            # Fast path for the most common keys: a symbol and a number.
            if type(key) is tuple and len(key) == 2 and type(key[0]) is str and type(key[1]) in (int, float):
                plain = lib.petri_python_pair(self._session, self._symbols.get(key[0]) or self._symbol(key[0]), key[1],
                                              value)
            else:
                encoded, keep = values.encode(self._session, key)
                value[0] = lib.petri_state_get(self._session, encoded)
                plain = False
            length = value.length
            if plain and length > 1:
                numbers = tuple(ffi.unpack(value.numbers, length))
                if min(numbers) > -8e307:  # numbers that represent symbols are below this value
                    return numbers
            result = values.decode(self._session, value)
        if result is None:
            raise KeyError(key)
        return result

    def __setitem__(self, key: Any, value: Any) -> None:
        with self._lock:
            self._check()
            encoded_key, keep_key = values.encode(self._session, key)
            encoded, keep = values.encode(self._session, value)
            if lib.petri_state_set(self._session, encoded_key, encoded) != lib.PETRI_OK:
                raise ValueError(f"cannot store {value!r} as {key!r}: only finite numbers, symbols and strings")

    def __delitem__(self, key: Any) -> None:
        self[key]  # raises KeyError if the key is missing
        self[key] = None

    def __iter__(self) -> Iterator[Any]:
        return iter(self._keys())

    def _keys(self) -> list:
        cursor, key, value, keys = ffi.new("uint32_t *"), ffi.new("PetriValue *"), ffi.new("PetriValue *"), []
        with self._lock:
            self._check()
            while lib.petri_state_next(self._session, cursor, key, value):
                keys.append(values.whole(values.decode(self._session, key)))
        return keys

    def __len__(self) -> int:
        return len(self._keys())

    def __repr__(self) -> str:
        return f"<petri.State with {len(self)} keys>" if self._session else "<petri.State, closed>"
