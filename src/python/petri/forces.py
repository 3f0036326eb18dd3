"""Forces that Python computes in each physics step."""

from __future__ import annotations

import warnings
from typing import Any, Callable, Mapping

import numpy

from . import systems
from ._petri import ffi, lib
from .errors import PetriWarning
from .functions import Functions


class Step:
    """The next physics step, for functions in `forces` of Session.

    N particles in d dimensions, in the order of System.ids, including anchors. Arrays keep their values after the call.
    """

    name: str                 #: Name of the system.
    clock: float              #: Simulation clock of the system at the start of the step, in seconds.
    delta: float              #: Length of the step in seconds.
    position: systems.Array   #: Positions at the start of the step: float64, N×d.
    velocity: systems.Array   #: Velocities at the start of the step: float64, N×d.

    def __init__(self, name: str, system: Any, clock: float, delta: float):
        self.name, self.clock, self.delta = name, clock, delta
        self._system = system
        self.position = self._column("position", system.dimensions)
        self.velocity = self._column("velocity", system.dimensions)

    def _column(self, name: str, width: int = 0) -> systems.Array:
        if self._system is None:
            raise RuntimeError(f"{name} of a step is available only during the call")
        count, column = self._system.particle_count, getattr(self._system, name)
        shape = (count, width) if width else (count,)
        if column.stride == 0:
            return numpy.full(shape, column.data[0])
        numbers = ffi.buffer(column.data, 8 * (column.stride * (count - 1) + max(width, 1)))
        strides = (8 * column.stride, 8)[:len(shape)]
        return numpy.ndarray(shape, numpy.float64, numbers, 0, strides).copy()

    @property
    def mass(self) -> systems.Array:
        """Masses of the particles: float64, N. Available only during the call, like `charge` and `radius`."""
        return self._column("mass")

    @property
    def charge(self) -> systems.Array:
        """Charges of the particles: float64, N."""
        return self._column("charge")

    @property
    def radius(self) -> systems.Array:
        """Radii of the particles: float64, N."""
        return self._column("radius")

    def __repr__(self) -> str:
        return f"<petri.Step of {self.name!r} at {self.clock:g} s: {len(self.position)} particles>"


class Forces:
    """The forces of a session by system."""

    def __init__(self, session: Any, functions: Functions, forces: Mapping[str, Callable]):
        self._session = session
        self._functions = functions
        self._forces = {str(name).removeprefix(":"): function for name, function in forces.items()}
        for name, function in self._forces.items():
            if not callable(function):
                raise TypeError(f"forces[{name!r}] must be a function, not {function!r}")
        self._handle = ffi.new_handle(self)
        self._unchecked = True
        session._call(lib.petri_set_force_callback, ffi.addressof(lib, "petri_python_force"), self._handle)

    def check(self) -> None:
        """Warns once, after the first frame, of systems that do not exist."""
        if self._unchecked:
            self._unchecked = False
            known = list(self._session.systems)
            for name in self._forces.keys() - set(known):
                exist = ", ".join(map(repr, known)) or "none"
                warnings.warn(PetriWarning(f"forces[{name!r}] has no effect yet: there is no such system (systems: {exist})"),
                              stacklevel=3)

    def add(self, name: str, step: Step, out: Any) -> None:
        function = self._forces.get(name)
        if function is None:
            return
        self._functions.lend(True)
        force = function(step)
        step._system = None
        if force is not None and len(step.position):
            numpy.frombuffer(ffi.buffer(out, step.position.nbytes)).reshape(step.position.shape)[:] = force
        self._functions.lend(False)


def _failed(_: Any, error: BaseException, trace: Any) -> None:
    """Records an exception, which the call raises after the frame has been rolled back."""
    functions = ffi.from_handle(trace.tb_frame.f_locals["user_data"])._functions
    functions.raised.append(error.with_traceback(trace))
    functions.stop[0] = True
    functions.lend(False)


@ffi.def_extern(onerror=_failed)
def petri_python_force(user_data: Any, system: Any, clock: float, delta: float, force: Any) -> bool:
    name = systems._plain(ffi.string(system.name))
    ffi.from_handle(user_data).add(name, Step(name, system, clock, delta), force)
    return True
