"""petri runs Flitter scripts that hold systems of particles: fast, and to the last bit the same each time.

    import petri
    session = petri.Session("dish.fl", CELLS=200)
    session.step(60)
    session.systems["cells"].position      # a numpy array, N×2
    session.state["cells", 3]              # (x, y)
    session.picture()                      # shown by notebooks

TUTORIAL.md in src/python of the sources goes on from here.
"""

from ._petri import ffi as _ffi, lib as _lib
from .errors import (Diagnostic, InterruptedStep, LimitError, MissingLibraryError, OutOfMemoryError, PetriError,
                     PetriWarning, ScriptError)
from .picture import Picture
from .session import Frame, Options, Session, Snapshot
from .state import State
from .sweeps import sweep
from .systems import System, Systems
from .values import Text

__version__ = _ffi.string(_lib.petri_version()).decode()
__all__ = ["Diagnostic", "Frame", "InterruptedStep", "LimitError", "MissingLibraryError", "Options", "OutOfMemoryError",
           "PetriError", "PetriWarning", "Picture", "ScriptError", "Session", "Snapshot", "State", "System", "Systems",
           "Text", "sweep"]
for _name in __all__:
    globals()[_name].__module__ = "petri"  # where people find them
