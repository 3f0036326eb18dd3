"""Runs Flitter scripts with particle physics, fast and reproducibly, bit for bit.

    import petri
    session = petri.Session('''
    !physics state=:sky dimensions=2
        !particle id=:drop position=0;10
        !constant acceleration=0;-9.81
    ''')                               # or a file: petri.Session("dish.fl", CELLS=200)
    session.step(60)                   # computes frames 0 to 59, 60 per second
    session.systems["sky"].position    # the particles: a numpy array, N×2
    session.state["sky", "drop"]       # one particle: (x, y)
    session.picture()                  # displayed in notebooks

Session     a script and its state: step, until, integrate, evaluate, snapshot, record, film, trust, archive
System      particles as numpy arrays, with energies and forces: session.systems["cells"]
State       the state of a script: session.state
Step        a physics step, for forces that Python computes: Session(..., forces={"cells": function})
Parameter   a parameter of a script, with its range: session.parameters["CELLS"]
sweep       runs a script with many values of its parameters
Archive     a recorded run, which can be replayed and verified
PetriError  an error, with its position in the script; PetriWarning: a script is probably wrong

help(petri.Session) explains scripts, parameters, functions and forces. The tutorial is src/python/TUTORIAL.md in the
source tree.
"""

from ._petri import ffi as _ffi, lib as _lib
from .archive import Archive, ArchivedFile, ArchiveError, Keyframe, Recording
from .errors import (Diagnostic, InterruptedStep, LimitError, MissingLibraryError, OutOfMemoryError, PetriError,
                     PetriWarning, ScriptError)
from .films import Animation
from .forces import Step
from .parameters import Parameter, Parameters
from .picture import Picture
from .session import Frame, Options, Session, Snapshot, Trust
from .state import State
from .sweeps import sweep
from .systems import Contribution, Explanation, System, Systems
from .trajectories import Trajectory
from .values import Text

__version__ = _ffi.string(_lib.petri_version()).decode()
__all__ = ["Animation", "Archive", "ArchiveError", "ArchivedFile", "Contribution", "Diagnostic", "Explanation",
           "Frame", "InterruptedStep", "Keyframe", "LimitError", "MissingLibraryError", "Options",
           "OutOfMemoryError", "Parameter", "Parameters", "PetriError", "PetriWarning", "Picture", "Recording",
           "ScriptError", "Session", "Snapshot", "State", "Step", "System", "Systems", "Text", "Trajectory", "Trust",
           "sweep"]
for _name in __all__:
    globals()[_name].__module__ = "petri"  # the public location
