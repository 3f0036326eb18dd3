"""The particle systems of a session, as numpy arrays that are views of the session's memory."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Iterator, List, Optional, Union

import numpy
import numpy.typing

from . import values
from ._petri import ffi, lib

if TYPE_CHECKING:
    from .session import Session


class _Memory:
    """The memory of an array, for numpy. Keeps the session and the columns alive as long as the array exists."""

    __slots__ = ("__array_interface__", "session", "shown")

    def __init__(self, address: int, shape: tuple, strides: tuple, owner: Session, kind: str = "<f8"):
        self.__array_interface__ = {"version": 3, "typestr": kind, "data": (address, True), "shape": shape,
                                    "strides": strides}
        self.session = owner._c
        self.shown = owner._shown
        self.shown.append(None)
        lib.petri_keep_columns(self.session, True)

    def __del__(self) -> None:
        self.shown.pop()


@dataclass(frozen=True)
class Contribution:
    """What one force adds to the force on a particle."""

    kind: str                #: Kind of the force's node, such as "gravity"; "" for the particle's attribute `force`.
    partner: Any             #: Id of the other particle of a pair force or `!distance`, else None.
    vector: numpy.ndarray    #: The contribution: float64, d.
    file: Optional[str]      #: File of the force's node; None if unknown.
    line: int                #: Line of the force's node, from 1; 0 if unknown.
    column: int              #: Column of the force's node in characters, from 1; 0 if unknown.


@dataclass(frozen=True)
class Explanation:
    """The forces on one particle in one step of the last frame."""

    contributions: List[Contribution]  #: In the order of summation. Zeros that cannot change the sum are left out.
    sum: numpy.ndarray                 #: The force on the particle: float64, d.
    clock: float                       #: Simulation clock at the start of the step.
    delta: float                       #: Length of the step in seconds.
    position: numpy.ndarray            #: Position at the start of the step: float64, d.
    velocity: numpy.ndarray            #: Velocity at the start of the step: float64, d.


Array = numpy.typing.NDArray[numpy.float64]


class System:
    """A particle system with N particles, including anchors, in d dimensions.

    Its arrays are read-only views of the session's memory. Get them again after each step: an older array may show an
    earlier frame or the last one, because the session may have moved its particles in memory. `.copy()` keeps the
    values.
    """

    def __init__(self, session: Session, number: int, name: bytes):
        self._owner = session
        self._number = number
        self._printed = name
        self._struct = ffi.new("PetriSystem *")
        self._view = ffi.new("PetriPythonView *")
        self._arrays: dict[str, tuple] = {}

    def _array(self, letter: str) -> Array:
        view = self._view
        with self._owner._lock:
            session = self._owner._c
            if not lib.petri_python_view(session, self._number, self._printed, letter.encode(), view):
                raise self._missing_error()
            place = address, count, width, stride = view.address, view.count, view.width, view.stride
            # The cached array already refers to this memory.
            if letter in self._arrays:
                if self._arrays[letter][0] == place:
                    return self._arrays[letter][1]
                self._owner.systems._clear_arrays()
            shape = (count, width) if letter in "pvf" else (count,)
            if address == 0:
                array = numpy.zeros(shape)
                if letter == "f" and count:
                    array[:] = numpy.nan
                array.flags.writeable = False
            else:
                strides = (8 * stride, 8) if letter in "pvf" else (8 * stride,)
                array = numpy.asarray(_Memory(address, shape, strides, self._owner))
        self._arrays[letter] = (place, array)
        return array

    def _fetch(self) -> Any:
        with self._owner._lock:
            number = lib.petri_python_system(self._owner._c, self._number, self._printed, self._struct)
        if number < 0:
            raise self._missing_error()
        self._number = number
        return self._struct

    def _missing_error(self) -> LookupError:
        return LookupError(f"no system {self.name!r} in the last frame")

    @property
    def position(self) -> Array:
        """Positions of the particles: float64, N×d, read-only."""
        return self._array("p")

    @property
    def velocity(self) -> Array:
        """Velocities of the particles: float64, N×d, read-only."""
        return self._array("v")

    @property
    def force(self) -> Array:
        """Total force on each particle in the frame's last step: float64, N×d, read-only; 0 for anchors. NaN if there was
        no step or without Options.keep_forces."""
        return self._array("f")

    @property
    def radius(self) -> Array:
        """Radii of the particles: float64, N, read-only."""
        return self._array("r")

    @property
    def mass(self) -> Array:
        """Masses of the particles: float64, N, read-only."""
        return self._array("m")

    @property
    def charge(self) -> Array:
        """Charges of the particles: float64, N, read-only."""
        return self._array("c")

    @property
    def anchor(self) -> numpy.typing.NDArray[numpy.bool_]:
        """True for particles that are anchors: bool, N, read-only."""
        struct = self._fetch()
        if struct.particle_count == 0:
            return numpy.zeros(0, bool)
        address = int(ffi.cast("uintptr_t", struct.anchor))
        with self._owner._lock:
            return numpy.asarray(_Memory(address, (struct.particle_count,), (struct.anchor_stride,), self._owner, "|b1"))

    @property
    def name(self) -> str:
        """The state key of the system: "cells" for `state=:cells`. Keys other than symbols are in printed form."""
        return _plain(self._printed)

    @property
    def dimensions(self) -> int:
        """The number of dimensions d."""
        return self._fetch().dimensions

    @property
    def steps(self) -> int:
        """Number of simulation steps in the last frame."""
        return self._fetch().steps

    @property
    def ids(self) -> List[Any]:
        """The N ids of the particles: int, float, str for symbols, Text for strings, or tuples of these."""
        count = self._fetch().particle_count
        with self._owner._lock:
            session = self._owner._c
            column = lib.petri_particle_ids(session, self._number)
            if count > 0 and column.data:
                return values.whole_numbers(session, column.data, count)
            return [values.whole(values.decode(session, lib.petri_particle_id(session, self._number, i))) for i in range(count)]

    def index(self, id: Any) -> int:
        """Returns the row of the particle with this id. Raises KeyError if there is none."""
        self._fetch()
        found = ffi.new("uint32_t *")
        with self._owner._lock:
            encoded, keep = values.encode(self._owner._c, id)
            if not lib.petri_find_particle(self._owner._c, self._number, encoded, found):
                raise KeyError(id)
        return found[0]

    @property
    def kinetic_energy(self) -> float:
        """Sum of mass * speed² / 2 over all particles except anchors."""
        moving = ~self.anchor
        return float(numpy.sum(self.mass[moving, None] * self.velocity[moving] ** 2) / 2)

    @property
    def potential_energies(self) -> List[float]:
        """Potential energy of each force applier and barrier, in the order of the script; NaN: the force has none.

        Its definition is in lib/spec/physics.md, section 4.5. For forces of unlimited range, time grows with N².
        """
        energy = ffi.new("double *")
        found = []
        for force in range(self._fetch().force_count):
            with self._owner._lock:
                self._owner._call(lib.petri_potential_energy, self._number, force, energy)
            found.append(energy[0])
        return found

    @property
    def potential_energy(self) -> float:
        """Sum of `potential_energies`, without forces that have none."""
        return float(numpy.nansum(self.potential_energies))

    @property
    def energy(self) -> float:
        """Sum of kinetic_energy and potential_energy."""
        return self.kinetic_energy + self.potential_energy

    @property
    def momentum(self) -> Array:
        """Sum of mass * velocity over all particles except anchors."""
        moving = ~self.anchor
        return numpy.asarray(numpy.sum(self.mass[moving, None] * self.velocity[moving], axis=0))

    @property
    def angular_momentum(self) -> Union[None, float, Array]:
        """Sum of mass * position × velocity over all particles except anchors: a number in two dimensions, a vector in
        three, and None otherwise."""
        moving, d = ~self.anchor, self.dimensions
        if d not in (2, 3):
            return None
        x, v = (numpy.pad(array[moving], ((0, 0), (0, 3 - d))) for array in (self.position, self.velocity))
        total = numpy.sum(self.mass[moving, None] * numpy.cross(x, v), axis=0)
        return float(total[2]) if d == 2 else numpy.asarray(total)

    def explain(self, id: Any, step: int = -1) -> Explanation:
        """Returns the contributions of all forces to the force on the particle with this id, in the order of summation.

        `step` counts from 0 within the last frame; -1 is its last step, whose sum is in `force`. Needs
        Options.keep_forces. Raises KeyError if there is no such particle, and IndexError if there is no such step.
        """
        row, struct, found = self.index(id), self._fetch(), ffi.new("PetriExplanation *")
        if step < 0:
            step += struct.steps
        with self._owner._lock:
            if not 0 <= step < struct.steps or struct.force.data == ffi.NULL:
                raise IndexError("no such step in the last frame, or no Options.keep_forces")
            self._owner._call(lib.petri_explain_force, self._number, row, step, found, ffi.sizeof(found[0]))
            n = struct.dimensions
            parts = [self._contribution(found, c, n) for c in range(found.count)]
            return Explanation(parts, _copy(found.sum, n), found.clock, found.delta, _copy(found.position, n),
                               _copy(found.velocity, n))

    def _contribution(self, found: Any, number: int, dimensions: int) -> Contribution:
        session, partner, force = self._owner._c, None, ffi.new("PetriForce *")
        if found.partner[number] != _NO_NUMBER:
            partner = values.whole(values.decode(session, lib.petri_particle_id(session, self._number, found.partner[number])))
        known = lib.petri_system_force(session, self._number, found.force[number], force, ffi.sizeof(force[0]))
        return Contribution(ffi.string(force.kind).decode() if known else "", partner,
                            _copy(found.vector + number * dimensions, dimensions),
                            ffi.string(force.file).decode() if force.file != ffi.NULL else None, force.line, force.column)

    def to_dataframe(self) -> Any:
        """Returns a pandas DataFrame with a row per particle: id, anchor, x1 … xd, v1 … vd, radius, mass, charge."""
        pandas = _optional("pandas", "to_dataframe")
        columns: dict[str, Any] = {"id": self.ids, "anchor": self.anchor.copy()}
        for letter, array in (("x", self.position), ("v", self.velocity)):
            for k in range(array.shape[1]):
                columns[f"{letter}{k + 1}"] = array[:, k].copy()
        for name in ("radius", "mass", "charge"):
            columns[name] = getattr(self, name).copy()
        return pandas.DataFrame(columns)

    def to_ase(self) -> Any:
        """Returns an ase.Atoms of element X with positions and velocities (at most 3 dimensions), masses, charges."""
        ase = _optional("ase", "to_ase")
        position, velocity = numpy.zeros((len(self), 3)), numpy.zeros((len(self), 3))
        width = min(3, self.dimensions)
        position[:, :width] = self.position[:, :width]
        velocity[:, :width] = self.velocity[:, :width]
        atoms = ase.Atoms(numbers=[0] * len(self), positions=position, masses=self.mass, charges=self.charge)
        atoms.set_velocities(velocity)
        atoms.set_array("radius", self.radius.copy())
        return atoms

    def __len__(self) -> int:
        return self._fetch().particle_count

    def __repr__(self) -> str:
        try:
            return f"<petri.System {self.name!r}: {len(self)} particles, {self.dimensions} dimensions>"
        except LookupError:
            return f"<petri.System {self.name!r}, not in the last frame>"


class Systems(Mapping):
    """The systems of the last frame by name, in the order of the script. There are none after rewind, restore or a frame
    that was undone, until the next frame; Session.state has the positions then."""

    def __init__(self, session: Session):
        self._session = session
        self._known: dict[str, System] = {}

    def _names(self) -> List[bytes]:
        names: List[bytes] = []
        struct = ffi.new("PetriSystem *")
        with self._session._lock:
            while lib.petri_python_system(self._session._open_c(), len(names), ffi.NULL, struct) >= 0:
                names.append(ffi.string(struct.name))
        return names

    def _clear_arrays(self) -> None:
        """Forgets the cached arrays. If the user has no arrays either, frees the old columns of the session."""
        for system in self._known.values():
            system._arrays.clear()
        if not self._session._shown:
            lib.petri_keep_columns(self._session._c, False)

    def __getitem__(self, name: str) -> System:
        system = self._known.get(name)
        if system is not None:
            return system
        for number, printed in enumerate(self._names()):
            if name == _plain(printed):
                self._known[name] = System(self._session, number, printed)
                return self._known[name]
        raise KeyError(f"no system {name!r} in the last frame; it has {', '.join(map(repr, self)) or 'none'}")

    def __iter__(self) -> Iterator[str]:
        return iter([_plain(name) for name in self._names()])

    def __len__(self) -> int:
        return len(self._names())

    def __repr__(self) -> str:
        return f"<petri.Systems: {', '.join(self) or 'none'}>"


_NO_NUMBER = 2**32 - 1  # PETRI_OWN_FORCE and PETRI_NO_PARTICLE


def _copy(numbers: Any, count: int) -> numpy.ndarray:
    return numpy.frombuffer(ffi.buffer(numbers, 8 * count), dtype=float).copy()


def _plain(printed: bytes) -> str:
    name = printed.decode()
    return name[1:] if name.startswith(":") and ";" not in name else name


def _optional(module: str, purpose: str) -> Any:
    try:
        return __import__(module)
    except ImportError as error:
        raise ImportError(f"{purpose}() needs {module}, which is not installed (Debian: python3-{module})") from error
