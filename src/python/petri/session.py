"""A session: a script that is run frame by frame."""

from __future__ import annotations

import errno
import os
import tempfile
import threading
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import count, islice
from typing import Any, Callable, Iterator, List, NamedTuple, Optional, Sequence, Union

from . import films, trajectories, values
from ._petri import ffi, lib
from .archive import Recording, _check, _file_name, _owned
from .errors import Diagnostic, ScriptError, finish
from .forces import Forces
from .functions import Functions
from .parameters import Parameters
from .picture import Picture
from .state import State
from .systems import Systems

_MAIN = threading.main_thread().ident


def _is_main_thread() -> bool:
    """Returns true in the thread that gets Ctrl-C."""
    return threading.get_ident() == _MAIN


@dataclass
class Options:
    """Options of a session: fields of PetriOptions in petri.h. None means the default."""

    fps: Optional[float] = None
    threads: int = 0
    memory_limit: Optional[int] = None
    work_limit: Optional[int] = None
    realtime: bool = False
    simplify: bool = True
    neighbours: str = "auto"  #: "auto", "never" or "always"
    keep_forces: bool = False
    no_files: bool = False
    read_folders: Sequence[Union[str, os.PathLike]] = ()
    write_folders: Sequence[Union[str, os.PathLike]] = ()
    spec: Optional[str] = None  #: version of the specification that frames follow, such as "0.3"; None: the present one


class Frame(NamedTuple):
    """The number of a frame (from 0), its clocks, and the time that it took to compute."""

    number: int
    time: float
    beat: float
    fps: float
    tempo: float
    physics_steps: int
    evaluation_seconds: float
    physics_seconds: float


class Trust(NamedTuple):
    """How far the value of an expression after a frame can be trusted (Session.trust). Times are in seconds."""

    frame: int
    time: float
    expression: str
    value: values.Value
    error: float  # bound of the distance from the value with infinitely short steps
    order: float  # of the error in the step, as observed; nan: the error is not regular
    spread: float  # by rounding
    digits: int  # decimal digits that are true; -1: the value is not a number
    lyapunov_time: float  # nan: runs do not separate exponentially
    lyapunov_error: float
    horizon: float  # after this time, a single run means nothing; nan: not before the end
    verdict: str


@ffi.def_extern()
def petri_python_trust(user_data: Any, trust: Any) -> None:
    expressions, found = ffi.from_handle(user_data)
    found.append(Trust(trust.frame, trust.time, expressions[trust.expression],
                       values.parse(ffi.string(trust.value).decode()), trust.error, trust.order, trust.spread,
                       trust.digits, trust.lyapunov_time, trust.lyapunov_error, trust.horizon,
                       ffi.string(trust.sentence).decode()))


class Snapshot:
    """The complete state of a session, for Session.rewind."""

    def __init__(self, session: Any, frame: int):
        pointer = lib.petri_snapshot(session)
        if not pointer:
            raise MemoryError("out of memory")
        # The snapshot must be freed before the session.
        self._c = _owned(pointer, lib.petri_snapshot_free, session)
        self._session = session
        self.frame = frame
        self.nbytes: int = lib.petri_snapshot_bytes(pointer)

    def __repr__(self) -> str:
        return f"<petri.Snapshot after frame {self.frame}>"


@ffi.def_extern(onerror=lambda *error: False)
def petri_python_write(user_data: Any, text: Any, length: int) -> bool:
    ffi.from_handle(user_data).append(ffi.buffer(text, length)[:])
    return True


class Session:
    """A script and its state.

    `source` is the script's file, or its text if it contains a newline. Other keyword arguments set the script's
    parameters: `petri.Session("dish.fl", CELLS=20)` corresponds to `-D CELLS=20`. Errors in the script raise
    exceptions such as ScriptError; a missing file raises FileNotFoundError. A script that is probably wrong causes a
    PetriWarning. `given` contains globals for the script; set_global changes them between frames. Several threads may
    use a session, but not at the same time.

    The script can call `functions` like built-in functions. Arguments are numbers, Text, str (a symbol), None or tuples
    of these. Results have the same types except str. Functions must not use the session. If a function raises an
    exception, its result is null. After the frame is completed, step raises the exception.

    `forces` contains a function for each system that has a force of Python. The function is called in each physics
    step with a petri.Step, and returns the forces on the particles, an array N×d, or None. Other forces are added to
    them. Such functions must not use the session. If one raises an exception, step raises it, and the frame is undone.
    """

    def __init__(self, source: Union[str, os.PathLike], *, options: Optional[Options] = None,
                 given: Optional[Mapping[str, Any]] = None, functions: Optional[Mapping[str, Callable]] = None,
                 forces: Optional[Mapping[str, Callable]] = None, **defines: Any):
        for name, argument in (("given", given), ("functions", functions), ("forces", forces)):
            if not isinstance(argument or {}, Mapping):
                raise TypeError(f"{name} must be a dict, not {argument!r}")
        self._prepare(options)
        self._made_of = {"source": source, "options": options, "functions": dict(functions or {}),
                         "forces": dict(forces or {})}
        for name, value in defines.items():
            text = value if isinstance(value, str) else self._printed(value)
            self._call(lib.petri_define, f"{name}={text}".encode(),
                       message=f"cannot define {name!r}: the name or the value is invalid")
            self._defined[name] = text
        if functions or forces:
            self._functions = Functions(self, functions or {})
            self._stop = self._functions.stop
        if forces:
            self._forces = Forces(self, self._functions, forces)
        self._given = dict(given or {})
        for name, value in (given or {}).items():
            self.set_global(name, value)
        if isinstance(source, str) and "\n" in source:
            data = source.encode()
            self._call(lib.petri_load_text, b"<string>", data, len(data))
        else:
            name = _file_name(source)
            if not os.path.exists(source):
                raise FileNotFoundError(errno.ENOENT, "no such file (the text of a script must contain a newline)", os.fspath(source))
            self._call(lib.petri_load, name)

    def _prepare(self, options: Optional[Options], archive: Any = None) -> None:
        """Opens a session without a script, for the files of an archive if there is one."""
        self._lock = threading.RLock()
        self._told: List[Diagnostic] = []
        self._painter: Any = None
        self._functions: Optional[Functions] = None
        self._forces: Optional[Forces] = None
        self._stop: Any = ffi.NULL
        self._shown: List[None] = []  # one element per array that refers to the session's memory
        self._c = self._open(options or Options(), archive)
        self._made_of: dict[str, Any] = {}  # arguments of the session; empty if it replays an archive
        self._defined: dict[str, str] = {}
        self._given: dict[str, Any] = {}
        self.state = State(self._c, self._lock)
        self.systems = Systems(self)
        self.parameters = Parameters(self)

    @classmethod
    def _replay(cls, archive: Any, frame: int, options: Optional[Options], loads: bool = False) -> "Session":
        session = cls.__new__(cls)
        session._prepare(options, archive)
        with session._lock:
            status = (lib.petri_archive_load(archive, session._c, frame) if loads else
                      lib.petri_python_replay(archive, session._c, frame, _is_main_thread()))
        _check(archive)
        session._finish(status)
        return session

    def archive(self, path: Union[str, os.PathLike], *, keyframe_every: int = 1000, digest_every: int = 1) -> Recording:
        """Records all later frames in an archive, from which anyone can replay and verify them. Functions and
        forces of Python cannot be recorded."""
        with self._lock:
            return Recording(self._c, path, keyframe_every, digest_every)

    def _open(self, wanted: Options, archive: Any = None) -> Any:
        if not isinstance(wanted, Options):
            raise TypeError(f"options must be petri.Options(...), not {wanted!r}")
        options = ffi.new("PetriOptions *")
        lib.petri_options_init(options, ffi.sizeof("PetriOptions"))
        for name in ("fps", "threads", "memory_limit", "work_limit", "realtime", "keep_forces", "no_files"):
            value = getattr(wanted, name)
            if value is not None:
                setattr(options, name, value)
        tuning = ffi.new("PetriTuning *", {"size": ffi.sizeof("PetriTuning"), "no_simplify": not wanted.simplify})
        options.tuning = tuning
        try:
            tuning.neighbours = getattr(lib, f"PETRI_NEIGHBOURS_{wanted.neighbours.upper()}")
        except AttributeError:
            raise ValueError(f"neighbours must be 'auto', 'never' or 'always', not {wanted.neighbours!r}") from None
        keep = []
        for name in ("read_folders", "write_folders"):
            folders = [os.fsencode(folder) for folder in getattr(wanted, name)]
            if any(b"\0" in folder for folder in folders):
                raise ValueError(f"a path in {name} contains a NUL character")
            texts = [ffi.new("char[]", folder) for folder in folders]
            folders = ffi.new("const char *[]", [*texts, ffi.NULL])
            keep += [texts, folders]
            setattr(options, name, folders)
        if wanted.spec is not None:
            keep.append(ffi.new("char[]", wanted.spec.encode()))
            options.spec = keep[-1]
        if archive is not None:
            options.read_file = ffi.addressof(lib, "petri_archive_read")
            options.read_user_data = archive
        options.rollback_frames = True
        options.on_diagnostic = lib.petri_python_diagnostic
        options.user_data = handle = ffi.new_handle(self._told)
        pointer = lib.petri_open(options)
        if not pointer:
            problem = lib.petri_options_problem(options)
            if not problem:
                raise MemoryError
            raise ValueError(f"invalid options: {ffi.string(problem).decode()}: {wanted}")
        return _owned(pointer, lib.petri_python_close, handle, archive)

    def _printed(self, value: Any) -> str:
        with self._lock:
            encoded, keep = values.encode(self._c, value)
            text = lib.petri_format_value(self._c, encoded)
            if not text:
                raise ValueError(f"cannot convert {value!r} to a value of the language")
            return ffi.string(text).decode()

    def _call(self, function: Any, *arguments: Any, message: Optional[str] = None) -> None:
        with self._lock:
            status = function(self._c, *arguments)
        if status or self._told or self._stop and self._stop[0]:
            self._finish(status, message)

    def _open_c(self) -> Any:
        """Returns the C session. Raises ValueError if it is closed."""
        if not self._c:
            self._check_not_calling()
            raise ValueError("the session is closed")
        return self._c

    def _check_not_calling(self) -> None:
        if self._functions and self._functions.calling:
            raise RuntimeError("a Python function cannot use the session that is calling it")

    def _finish(self, status: int, message: Optional[str] = None) -> None:
        """Raises the error of a call, or the exception that a Python function raised during the call."""
        self._open_c()
        if self._functions and self._functions.raised:
            error = self._functions.raised[0]
            self._functions.raised.clear()
            self._functions.stop[0] = False
            self._told.clear()
            raise error
        finish(status, self._told, message)

    def _collect(self, function: Any, *arguments: Any, after: tuple = ()) -> str:
        pieces: List[bytes] = []
        handle = ffi.new_handle(pieces)
        self._call(function, *arguments, lib.petri_python_write, handle, *after)
        return b"".join(pieces).decode("utf-8", "replace")

    def step(self, n: int = 1) -> None:
        """Computes n frames without holding the GIL. Ctrl-C aborts the current frame."""
        if n < 0:
            raise ValueError(f"the number of frames must be at least 0, not {n}")
        with self._lock:
            status = lib.petri_python_step(self._c, n, _is_main_thread(), self._stop)
        if status or self._told or self._stop and self._stop[0]:
            self._finish(status)
        if self._forces:
            self._forces.check()

    def until(self, condition: str, limit: int = 1_000_000) -> bool:
        """Computes at least one frame, up to the first in which an expression is true. Returns False if none of `limit`
        frames was that frame. An invalid expression or an unbound name in it raises ScriptError after the first
        frame. In frame 0, the state has no positions yet, and null is less than every number: instead of
        "$(:sky;:drop)[1] < 0", write "-$(:sky;:drop)[1] > 0"."""
        data = condition.encode()
        result = ffi.new("PetriEvaluation *")
        for _ in range(limit):
            self.step()
            with self._lock:
                status = lib.petri_evaluate(self._c, data, len(data), result, ffi.sizeof(result[0]), ffi.NULL, ffi.NULL)
            unbound = tuple(found for found in self._told if found.code == "unbound-name")
            if unbound and not status:
                self._told.clear()
                raise ScriptError(unbound[0].rendered.rstrip(), unbound)
            self._finish(status)
            if result.is_true:
                return True
        return False

    def integrate(self, time: float) -> Frame:
        """Computes frames up to the first whose time is at least `time` seconds, and returns that frame. Computes none
        if the last frame has reached it. Frames keep their length, so the time of the frame can be later than `time`
        by less than 1/fps."""
        if not time < float("inf"):
            raise ValueError(f"the time to integrate to must be finite, not {time}")
        frame = self.frame
        while frame.number < 0 or frame.time < time:
            self.step()
            frame = self.frame
        return frame

    def __iter__(self) -> Iterator[Frame]:
        """Computes frames endlessly and yields each of them."""
        for _ in count():
            self.step()
            yield self.frame

    def frames(self, n: int) -> Iterator[Frame]:
        """Computes the next n frames and yields each of them."""
        for _ in range(n):
            self.step()
            yield self.frame

    def _every(self, n: int, every: int) -> Iterator[Frame]:
        """Computes the next n frames and yields the first and every `every`-th after it."""
        if n < 1 or every < 1:
            raise ValueError("frames and every must be at least 1")
        return islice(self.frames(n), 0, None, every)

    @property
    def spec(self) -> str:
        """The version of the specification by which frames are computed, such as "0.4"."""
        with self._lock:
            return ffi.string(lib.petri_spec(self._open_c())).decode()

    @property
    def frame(self) -> Frame:
        """The last computed frame. Before the first frame, its number is -1."""
        with self._lock:
            frame = ffi.new("PetriFrame *")
            lib.petri_frame(self._open_c(), frame, ffi.sizeof(frame[0]))
        return Frame(*(getattr(frame, name) for name in Frame._fields))

    def evaluate(self, text: str) -> values.Value:
        """Returns the value of an expression in the last frame."""
        data = text.encode()
        result = ffi.new("PetriEvaluation *")
        return values.parse(self._collect(lib.petri_evaluate, data, len(data), result, ffi.sizeof(result[0])))

    def trust(self, *expressions: str, frames: int = 0, every: int = 0) -> List[Trust]:
        """Runs the script again from frame 0, also with shorter steps and with other starting positions, and returns how
        many digits of each expression are true: after the last frame, and after each `every`-th. `frames` is the number
        of frames (default: those that the session has computed). The session stays where it is. Ctrl-C aborts the runs."""
        if not expressions:
            raise TypeError("trust needs at least one expression")
        texts = [ffi.new("char[]", text.encode()) for text in expressions]
        found: List[Trust] = []
        handle = ffi.new_handle((expressions, found))
        pointers = ffi.new("char *[]", texts)
        options = ffi.new("PetriTrustOptions *", {
            "size": ffi.sizeof("PetriTrustOptions"), "expressions": pointers, "count": len(texts),
            "frames": frames or self.frame.number + 1, "every": every, "report": lib.petri_python_trust,
            "user_data": handle})
        self._call(lib.petri_python_run_trust, options, _is_main_thread())
        return found

    def number(self, text: str) -> float:
        """Returns the value of an expression that is a single number."""
        value = self.evaluate(text)
        if not isinstance(value, (int, float)):
            raise ValueError(f"the value of {text!r} is not a number but {value!r}")
        return float(value)

    def interrupt(self) -> None:
        """Aborts the frame that another thread is computing; its step raises InterruptedStep. Thread-safe."""
        lib.petri_interrupt(self._c)

    def snapshot(self) -> Snapshot:
        """Returns a snapshot of the complete state."""
        with self._lock:
            return Snapshot(self._c, lib.petri_frame_number(self._c))

    def rewind(self, snapshot: Snapshot) -> None:
        """Returns to the end of the snapshot's frame. Recomputed frames are bit-identical."""
        if not isinstance(snapshot, Snapshot):
            raise TypeError(f"rewind needs a snapshot of this session, not {snapshot!r}")
        if snapshot._session is not self._c:
            raise ValueError("the snapshot belongs to another session")
        self._call(lib.petri_rewind, snapshot._c)

    def save(self, file: Union[str, os.PathLike]) -> None:
        """Writes the state to a file, for restore."""
        self._call(lib.petri_save, _file_name(file))

    def restore(self, file: Union[str, os.PathLike]) -> None:
        """Resumes from a saved state. The following frames are bit-identical to those of an uninterrupted run."""
        if not os.path.exists(file):
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), os.fspath(file))
        self._call(lib.petri_restore, _file_name(file))

    def reload(self) -> None:
        """Loads the script again after a change of its file. State, frame number and clocks continue."""
        source = self._made_of.get("source", "\n")
        if isinstance(source, str) and "\n" in source:
            raise ValueError("the script is not a file")
        self._call(lib.petri_reload, _file_name(source))

    def reset(self) -> None:
        """Clears the state. The next frame is frame 0."""
        with self._lock:
            lib.petri_reset(self._open_c())

    def set_parameter(self, name: str, value: Any) -> None:
        """Sets a parameter (`let SIZE=SIZE or 20`) from the next frame on. None restores its default."""
        text = None if value is None else value if isinstance(value, str) else self._printed(value)
        try:
            self._call(lib.petri_set_parameter, name.encode(), ffi.NULL if text is None else text.encode(),
                       message=f"cannot set {name!r}: the value is invalid")
        except ScriptError:
            names = list(self.parameters)
            if name in names:
                raise
            raise ScriptError(f"cannot set {name!r}: the script has the parameters {', '.join(names)}" if names else
                              f"cannot set {name!r}: the script has no parameters") from None
        if text is None:
            self._defined.pop(name, None)
        else:
            self._defined[name] = text

    def set_global(self, name: str, value: Any) -> None:
        """Changes the value of a global that was passed in `given`, from the next frame on."""
        if name not in self._given:
            raise KeyError(f"unknown global {name!r}; pass it to petri.Session(..., given={{{name!r}: ...}})")
        with self._lock:
            encoded, keep = values.encode(self._c, value)
        self._call(lib.petri_set_global, name.encode(), encoded, message=f"cannot set {name!r}: the name or the value is invalid")
        self._given[name] = value

    def __getstate__(self) -> dict:
        if not self._made_of:
            raise TypeError("cannot copy or pickle a session that replays an archive")
        with tempfile.TemporaryDirectory(prefix="petri-") as folder:
            file = os.path.join(folder, "state")
            self.save(file)
            with open(file, "rb") as saved:
                state = saved.read()
        return {**self._made_of, "given": dict(self._given), "defines": dict(self._defined), "state": state}

    def __setstate__(self, saved: dict) -> None:
        Session.__init__(self, saved["source"], options=saved["options"], given=saved["given"],
                         functions=saved["functions"], forces=saved["forces"], **saved["defines"])
        with tempfile.TemporaryDirectory(prefix="petri-") as folder:
            file = os.path.join(folder, "state")
            with open(file, "wb") as stored:
                stored.write(saved["state"])
            self.restore(file)

    def copy(self) -> Session:
        """Returns an independent session with the same script, parameters, globals, functions and state. Its frames are
        bit-identical to those of this session. The script is read again. pickle works in the same way, if the
        functions can be pickled."""
        other = Session.__new__(Session)
        other.__setstate__(self.__getstate__())
        return other

    __copy__ = copy

    def __deepcopy__(self, _: Any) -> Session:
        return self.copy()

    def record(self, name: str, frames: int, *, every: int = 1, energies: bool = True) -> trajectories.Trajectory:
        """Computes the next `frames` frames and returns positions, velocities and energies of a system, of the first
        frame and every `every`-th after it. Potential energies of forces of unlimited range take time that grows with
        N²; `energies=False` leaves them out."""
        return trajectories.record(self, name, frames, every, energies)

    def film(self, path: Union[str, os.PathLike], frames: int, *, fps: float = 0, every: int = 1, **picture: Any) -> None:
        """Computes the next `frames` frames and writes them to a film: .mp4, .webm, .gif, or another file that ffmpeg
        knows by its name. `fps` is the rate of the film; 0: that of the session. GIFs leave out frames beyond 50 per
        second. Other arguments are those of picture."""
        films.write(self, path, frames, fps, every, picture)

    def animate(self, frames: int, *, fps: float = 0, every: int = 1, **picture: Any) -> films.Animation:
        """Computes the next `frames` frames and returns an animation that notebooks play. Arguments as for film."""
        return films.animate(self, frames, fps, every, picture)

    def widget(self, frames: int = 10, **picture: Any) -> Any:
        """Returns an ipywidgets widget for notebooks: the picture, a button that computes `frames` frames, and a slider
        for each parameter with a range. Other arguments are those of picture."""
        return films.widget(self, frames, picture)

    def text(self, *sections: str) -> str:
        """Returns output like `petri run --print`. Sections are "tree", "state", "log", "error", "hash"
        and "digest"."""
        bits = 0
        for section in sections:
            if section not in ("tree", "state", "log", "error", "hash", "digest"):
                raise ValueError(f"no such section: {section!r}")
            bits |= getattr(lib, f"PETRI_PRINT_{section.upper()}")
        return self._collect(lib.petri_print, bits)

    def picture(self, width: int = 0, height: int = 0, *, scale: float = 1, window: int = -1,
                automatic: Optional[bool] = None) -> Picture:
        """Returns the picture of the last frame.

        The picture shows the window. If there is no window or `automatic` is True, it shows the particles. If only one
        of `width` and `height` is given, the other keeps the shape of the picture.
        """
        if (width > 0) != (height > 0):
            shape = self.picture(window=window, automatic=automatic)
            width = width or max(1, round(height * shape.width / shape.height))
            height = height or max(1, round(width * shape.height / shape.width))
        options = ffi.new("PetriPictureOptions *")
        lib.petri_python_picture_options(options)
        options.width, options.height, options.scale, options.window = width, height, scale, window
        if automatic is not None:
            options.automatic = lib.PETRI_AUTO_ALWAYS if automatic else lib.PETRI_AUTO_NEVER
        pointer = ffi.new("PetriPicture **")
        self._call(lib.petri_picture, options, pointer, message="cannot draw the last frame")
        return Picture(self, pointer[0])

    def _open_painter(self) -> Any:
        if self._painter is None:
            self._painter = ffi.gc(lib.petri_painter_open(), lib.petri_python_painter_close)
        return self._painter

    def close(self) -> None:
        """Ends the session. Its memory is freed when no array refers to it any more."""
        self._check_not_calling()
        with self._lock:
            self._c = self.state._session = ffi.NULL

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *error: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        return "<petri.Session, closed>" if not self._c else f"<petri.Session after frame {self.frame.number}>"
