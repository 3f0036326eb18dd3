"""Conversion of values of the language to and from Python.

A vector is a tuple, but a vector of one element is that element, and null is None. Numbers are float, symbols such as
`:cells` are str, and strings are Text, a subclass of str, because `$:cells` and `$'cells'` are different keys.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Mapping, Set
from typing import Any, Iterable, List, Tuple, Union

import numpy

from ._petri import ffi, lib

# Symbols are represented by numbers below this value.
_SYMBOLS_BELOW = -8.98e307


class Text(str):
    """A string of the language, as opposed to a symbol."""

    __slots__ = ()

    def __repr__(self) -> str:
        return f"Text({super().__repr__()})"


Element = Union[float, int, str, Text]
Value = Union[None, Element, Tuple[Element, ...]]


def elements(value: Any) -> Iterable[Any]:
    """Yields the elements of a Python value: an iterable is a vector, row by row if it is nested."""
    if value is None:
        return
    if isinstance(value, (str, float, int)):
        yield value
    elif isinstance(value, (bytes, bytearray, complex, Mapping, Set)):
        raise TypeError(f"{value!r} is not a number, a string or a sequence of these")
    elif hasattr(value, "__iter__"):
        for part in value:
            yield from elements(part)
    else:
        yield value


def symbol(session: Any, name: str) -> float:
    """Returns the number that represents a symbol."""
    number = lib.petri_symbol(session, name.removeprefix(":").encode())
    if number != number:
        raise ValueError(f"{name!r} is not a valid symbol; use petri.Text for strings")
    return number


def encode(session: Any, value: Any) -> Tuple[Any, list]:
    """Returns a PetriValue, and the objects that must be kept alive with it."""
    if isinstance(value, numpy.ndarray) and value.dtype.kind in "fiub":
        numbers = ffi.from_buffer("double[]", numpy.ascontiguousarray(value, numpy.float64).reshape(-1))
        result = ffi.new("PetriValue *", {"length": len(numbers), "numbers": numbers})
        return result[0], [result, numbers]
    parts = [symbol(session, part) if isinstance(part, str) and not isinstance(part, Text) else part
             for part in elements(value)]
    result = ffi.new("PetriValue *", {"length": len(parts)})
    if not any(isinstance(part, Text) for part in parts):
        numbers = ffi.new("double[]", [float(part) for part in parts])
        result.numbers = numbers
        return result[0], [result, numbers]
    items, keep = ffi.new("PetriItem[]", len(parts)), [result]
    for item, part in zip(items, parts):
        if isinstance(part, Text):
            data = part.encode()
            text = ffi.new("char[]", data)
            string = ffi.new("PetriString *", {"bytes": text, "length": len(data)})
            keep += [text, string]
            item.type, getattr(item, "as").string = lib.PETRI_STRING, string
        else:
            item.type, getattr(item, "as").number = lib.PETRI_NUMBER, float(part)
    result.items = items
    return result[0], [*keep, items]


def number(session: Any, x: float) -> Element:
    if x < _SYMBOLS_BELOW:
        name = lib.petri_symbol_name(session, x)
        return ffi.string(name).decode() if name else x
    return x


def _item(session: Any, item: Any) -> Any:
    value = getattr(item, "as")
    if item.type == lib.PETRI_NUMBER:
        return number(session, value.number)
    if item.type == lib.PETRI_STRING:
        return Text(ffi.buffer(value.string.bytes, value.string.length)[:].decode("utf-8", "replace"))
    return None  # nodes and functions, which are never in the state


def decode(session: Any, value: Any) -> Value:
    """Returns the Python value of a PetriValue."""
    length = value.length
    if length == 0:
        return None
    if not value.numbers:
        result = tuple(_item(session, value.items[i]) for i in range(length))
    elif length == 1:
        return number(session, value.numbers[0])
    else:
        result = tuple(ffi.unpack(value.numbers, length))
        if min(result) < _SYMBOLS_BELOW:
            result = tuple(number(session, x) for x in result)
    return result[0] if length == 1 else result


def whole(value: Value) -> Value:
    """Converts integral floats to int, for keys. -0.0 remains, because it is another key than 0."""
    if isinstance(value, tuple):
        return tuple(whole(part) for part in value)  # type: ignore[misc]
    return int(value) if isinstance(value, float) and value.is_integer() and str(value) != "-0.0" else value


def whole_numbers(session: Any, data: Any, count: int) -> List[Element]:
    """Returns `count` doubles as whole() converts them, with the names of symbols."""
    numbers = numpy.frombuffer(ffi.buffer(data, 8 * count))
    negative_zero = (numbers == 0) & numpy.signbit(numbers)
    if numpy.all((numbers == numpy.floor(numbers)) & (abs(numbers) < 2**53) & ~negative_zero):
        return numbers.astype(numpy.int64).tolist()
    return [whole(number(session, x)) for x in numbers.tolist()]  # type: ignore[misc]


_TOKEN = re.compile(
    r"""\s*(?::(?P<symbol>\w+)|(?P<text>'(?:[^'\\]|\\.)*'|"(?:[^"\\]|\\.)*")|(?P<number>[^;'"\s]+))\s*(?:;|$)""")


def parse(printed: str) -> Value:
    """Parses a printed value. If it has elements other than numbers, symbols and strings, returns it as Text."""
    parts: List[Element] = []
    at = 0
    while at < len(printed) and printed != "null":
        match = _TOKEN.match(printed, at)
        if match is None:
            return Text(printed)
        if match["symbol"]:
            parts.append(match["symbol"])
        elif match["text"]:
            parts.append(Text(ast.literal_eval(match["text"])))  # strings are printed as in Python
        else:
            try:
                parts.append(float(match["number"]))
            except ValueError:
                return Text(printed)
        at = match.end()
    return None if not parts else parts[0] if len(parts) == 1 else tuple(parts)
