"""Trajectories: positions, velocities and energies of a system in many frames, as numpy arrays."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, List

import numpy
import numpy.typing

from .systems import _optional

if TYPE_CHECKING:
    from .session import Session

Array = numpy.typing.NDArray[numpy.float64]


@dataclass(frozen=True, repr=False)
class Trajectory:
    """T frames of a system with N particles, including anchors, in d dimensions. Particles that a frame does not have
    are NaN there."""

    name: str                 #: The state key of the system.
    ids: List[Any]            #: The ids of all particles, in the order in which they appeared.
    frame: numpy.typing.NDArray[numpy.int64]  #: Numbers of the frames: T.
    time: Array               #: Times of the frames in seconds: T.
    position: Array           #: T×N×d.
    velocity: Array           #: T×N×d.
    kinetic_energy: Array     #: T.
    potential_energy: Array   #: T; NaN if the trajectory was recorded without energies.

    def __repr__(self) -> str:
        frames, particles, dimensions = self.position.shape
        return f"<petri.Trajectory of {self.name!r}: {frames} frames, {particles} particles, {dimensions} dimensions>"

    def to_xarray(self) -> Any:
        """Returns an xarray Dataset with the dimensions time, particle and axis."""
        xarray = _optional("xarray", "to_xarray")
        shape = ("time", "particle", "axis")
        return xarray.Dataset(
            {"position": (shape, self.position), "velocity": (shape, self.velocity), "frame": ("time", self.frame),
             "kinetic_energy": ("time", self.kinetic_energy), "potential_energy": ("time", self.potential_energy)},
            coords={"time": self.time, "particle": [str(id) for id in self.ids]})

    def to_dataframe(self) -> Any:
        """Returns a pandas DataFrame with a row per frame and particle: frame, time, id, x1 … xd, v1 … vd."""
        pandas = _optional("pandas", "to_dataframe")
        frames, particles, axes = self.position.shape
        columns: dict[str, Any] = {"frame": numpy.repeat(self.frame, particles), "time": numpy.repeat(self.time, particles),
                                   "id": self.ids * frames}
        for letter, array in (("x", self.position), ("v", self.velocity)):
            for k in range(axes):
                columns[f"{letter}{k + 1}"] = array[:, :, k].ravel()
        return pandas.DataFrame(columns)


def record(session: Session, name: str, frames: int, every: int, energies: bool) -> Trajectory:
    """See Session.record."""
    rows: dict[Any, int] = {}
    number, time, kinetic, potential, parts = [], [], [], [], []
    for frame in session._every(frames, every):
        system = session.systems[name]
        ids = [rows.setdefault(id, len(rows)) for id in system.ids]
        parts.append((ids, system.position.copy(), system.velocity.copy()))
        number.append(frame.number)
        time.append(frame.time)
        kinetic.append(system.kinetic_energy)
        potential.append(system.potential_energy if energies else numpy.nan)
    position = numpy.full((len(parts), len(rows), parts[0][1].shape[1]), numpy.nan)
    velocity = position.copy()
    for t, (ids, x, v) in enumerate(parts):
        position[t, ids], velocity[t, ids] = x, v
    return Trajectory(name, list(rows), numpy.array(number), numpy.array(time), position, velocity,
                      numpy.array(kinetic), numpy.array(potential))
