"""Python functions that scripts can call."""

from __future__ import annotations

import inspect
from typing import Any, Callable, List, Mapping

from . import values
from ._petri import ffi, lib


class Functions:
    """The functions of a session, and the exceptions they have raised."""

    def __init__(self, session: Any, functions: Mapping[str, Callable]):
        self.pointer = session._c  # the session has no pointer while a function is called
        self._session = session
        self._keep: List[Any] = []
        self.raised: List[BaseException] = []
        self.stop = ffi.new("bool *")
        self.calling = False
        for name, function in functions.items():
            self._add(name, function)

    def lend(self, calling: bool) -> None:
        """Makes the session unusable while a function is called (`calling` is True), or usable again."""
        self.calling = calling
        self._session._c = self._session.state._session = ffi.NULL if calling else self.pointer

    def _add(self, name: str, function: Callable) -> None:
        if not callable(function):
            raise TypeError(f"functions[{name!r}] must be a function, not {function!r}")
        defaults = [parameter.default for parameter in inspect.signature(function).parameters.values()
                    if parameter.kind is not parameter.VAR_POSITIONAL]
        handle = ffi.new_handle((self, function, defaults))
        texts = [ffi.new("char[]", text.encode())
                 for text in (name, self._parameters(function), (inspect.getdoc(function) or "").split("\n")[0])]
        made = ffi.new("PetriFunction *", {
            "size": ffi.sizeof("PetriFunction"), "name": texts[0], "parameters": texts[1], "help": texts[2],
            "call": ffi.addressof(lib, "petri_python_call"), "user_data": handle})
        self._keep.append(handle)
        self._session._call(lib.petri_add_function, made,
                            message=f"cannot add the function {name!r}: the name is invalid or already in use")

    def _parameters(self, function: Callable) -> str:
        words = []
        for parameter in inspect.signature(function).parameters.values():
            if parameter.kind is parameter.VAR_POSITIONAL:
                words.append("...")
            elif parameter.kind not in (parameter.POSITIONAL_ONLY, parameter.POSITIONAL_OR_KEYWORD):
                raise TypeError(f"cannot use the parameter {parameter}: scripts pass arguments by position only")
            elif parameter.default is parameter.empty:
                words.append(parameter.name)
            else:
                default = parameter.default
                words.append(f"{parameter.name}={'null' if default is None else self._session._printed(default)}")
        return ", ".join(words)


def _result(given: Any) -> tuple:
    for part in values.elements(given):
        if isinstance(part, str) and not isinstance(part, values.Text):
            raise TypeError(f"cannot return the str {part!r} to a script; use petri.Text for strings")
    return values.encode(None, given)


def _failed(_: Any, error: BaseException, trace: Any) -> None:
    """Records an exception, which step raises later. Also handles a Ctrl-C just before or after the function."""
    arguments = trace.tb_frame.f_locals
    owner = ffi.from_handle(arguments["user_data"])[0]
    lib.petri_call_error(arguments["call"], f"{type(error).__name__}: {error}".encode())
    owner.raised.append(error.with_traceback(trace))
    owner.stop[0] = True
    owner.lend(False)


@ffi.def_extern(onerror=_failed)
def petri_python_called(call: Any, user_data: Any, arguments: Any, count: int, out: Any) -> None:
    owner, function, defaults = ffi.from_handle(user_data)
    owner.lend(True)
    given = [values.decode(owner.pointer, arguments[i]) for i in range(count)]
    for i, default in enumerate(defaults):  # scripts pass null for omitted arguments
        given[i] = default if given[i] is None and default is not inspect.Parameter.empty else given[i]
    out[0], owner.result = _result(function(*given))
    owner.lend(False)
