"""Archives of runs, which anyone can replay and verify."""

from __future__ import annotations

import errno
import functools
import os
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Union

from ._petri import ffi, lib
from .errors import PetriError

if TYPE_CHECKING:
    from .session import Options, Session


class ArchiveError(PetriError):
    """An archive cannot be written or read, or is damaged."""


class ArchivedFile(NamedTuple):
    """A version of a file. `bytes` is None if, from this frame on, there was no such file."""

    name: str
    frame: int
    sha256: str
    bytes: Optional[bytes]


class Keyframe(NamedTuple):
    """A complete state in an archive. `given`: it was set by the host. `end`: the last frame that follows from it."""

    frame: int
    given: bool
    end: int


def _text(pointer: Any) -> str:
    return ffi.string(pointer).decode("utf-8", "replace")


def _file_name(path: Union[str, os.PathLike]) -> bytes:
    """Returns the name of a file for C, where a NUL character would end it."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError("embedded null character in the name of a file")
    return name


def _owned(pointer: Any, free: Callable[..., None], *keep: Any) -> Any:
    """Returns a pointer that `free`, a function of the library, frees. The objects `keep` live as long.

    `free` is not called by code in Python, in which a KeyboardInterrupt would be lost.
    """
    call = functools.partial(free)
    setattr(call, "keep", keep)
    return ffi.gc(pointer, call)


def _take(pointer: Any, session: Any = None) -> Any:
    """Returns the handle of an archive, which is closed before `session`."""
    if not pointer:
        raise MemoryError("out of memory")
    return ffi.gc(pointer, lambda p, session=session: lib.petri_archive_close(ffi.new("PetriArchive **", p)))


def _check(pointer: Any, intent: str = "") -> None:
    """Raises ArchiveError if the archive has a problem. `intent` is what the call wanted to do, such as "cannot read 'x': "."""
    problem = lib.petri_archive_problem(pointer)
    if problem:
        raise ArchiveError(intent + _text(problem))


class Recording:
    """An archive that is being written: the result of Session.archive. Use it in a `with` block, or call close."""

    def __init__(self, session: Any, path: Union[str, os.PathLike], keyframe_every: int, digest_every: int):
        create = lib.petri_archive_create
        options = ffi.new("PetriArchiveOptions *")
        lib.petri_archive_options_init(options, ffi.sizeof(options[0]))
        options.keyframe_every = keyframe_every
        options.digest_every = digest_every
        self._c = _take(create(session, _file_name(path), options), session)
        _check(self._c, f"cannot write {os.fspath(path)!r}: ")

    def note(self, text: str) -> None:
        """Adds a note to the archive."""
        if lib.petri_archive_add_note(self._c, text.encode()):
            _check(self._c)
            raise ValueError("the archive is closed")

    def close(self) -> None:
        """Completes the archive. Raises ArchiveError if it does not have all frames."""
        lib.petri_archive_complete(self._c)
        _check(self._c)

    def __enter__(self) -> "Recording":
        return self

    def __exit__(self, *error: Any) -> None:
        self.close()


class Archive:
    """An archive of a run: `petri.Archive("run.petri").session(100)` is a session in frame 100 of it."""

    def __init__(self, path: Union[str, os.PathLike], memory_limit: int = 0):
        name = _file_name(path)
        if not os.path.exists(path):
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT), os.fspath(path))
        self._c = _take(lib.petri_archive_open(name, memory_limit))
        _check(self._c, f"cannot read {os.fspath(path)!r}: ")

    @property
    def info(self) -> Dict[str, Any]:
        """The contents: fields of PetriArchiveInfo in petri-archive.h, such as `script` and `sha256`."""
        info = ffi.new("PetriArchiveInfo *")
        if not lib.petri_archive_info(self._c, info, ffi.sizeof(info[0])):
            _check(self._c)
        result = {}
        for name, field in ffi.typeof("PetriArchiveInfo").fields:
            if name != "size":
                value = getattr(info, name)
                result[name] = value if field.type.kind == "primitive" else _text(value)
        return result

    @property
    def parameters(self) -> Dict[str, str]:
        """The parameters of the script at the start, as text."""
        pair = ffi.new("const char *[2]")
        result: Dict[str, str] = {}
        while lib.petri_archive_parameter(self._c, len(result), pair, pair + 1):
            result[_text(pair[0])] = _text(pair[1])
        _check(self._c)
        return result

    @property
    def files(self) -> List[ArchivedFile]:
        """All versions of the files that the run has read."""
        file = ffi.new("PetriArchiveFile *")
        result: List[ArchivedFile] = []
        while lib.petri_archive_file(self._c, len(result), file, ffi.sizeof(file[0])):
            contents = ffi.buffer(file.bytes, file.length)[:] if file.bytes else None
            result.append(ArchivedFile(_text(file.name), file.frame, _text(file.sha256), contents))
        _check(self._c)
        return result

    @property
    def keyframes(self) -> List[Keyframe]:
        """The complete states in the archive."""
        keyframe = ffi.new("PetriArchiveKeyframe *")
        result: List[Keyframe] = []
        while lib.petri_archive_keyframe(self._c, len(result), keyframe, ffi.sizeof(keyframe[0])):
            result.append(Keyframe(keyframe.frame, keyframe.given, keyframe.end))
        _check(self._c)
        return result

    def digest(self, frame: int) -> Optional[bytes]:
        """Returns the recorded digest of a frame, or None."""
        digest = ffi.new("uint8_t[16]")
        found = lib.petri_archive_digest(self._c, frame, digest)
        _check(self._c)
        return bytes(digest) if found else None

    def check(self) -> None:
        """Raises ArchiveError if the archive is damaged. Does not compute its run again; see verify."""
        lib.petri_archive_check(self._c)
        _check(self._c)

    def session(self, frame: int = -1, *, options: Optional["Options"] = None) -> "Session":
        """Returns a session in a frame of the run; -1: before the first frame. Further steps replay the run. An
        archive can have only one session at a time."""
        from .session import Session
        return Session._replay(self._c, frame, options)

    def verify(self) -> Iterator[int]:
        """Computes the run again and yields the number of each frame that is verified. Raises ArchiveError if a frame
        differs."""
        from .session import Session
        self.check()
        digest = ffi.new("uint8_t[16]")
        for keyframe in self.keyframes:
            session = Session._replay(self._c, keyframe.frame, None, True)
            while session.frame.number < keyframe.end:
                session.step()
                number = session.frame.number
                recorded = self.digest(number)
                if recorded is not None:
                    lib.petri_digest(session._c, digest)
                if (recorded is not None and recorded != bytes(digest)) or lib.petri_archive_keyframe_differs(self._c):
                    raise ArchiveError(f"frame {number} differs from the archive")
                yield number
