"""Pictures of frames."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy

from ._petri import ffi, lib
from .errors import finish

if TYPE_CHECKING:
    from .session import Session


class Picture:
    """The picture of a frame. It does not change with later frames. Notebooks display it."""

    def __init__(self, session: Session, pointer: Any):
        self._owner = session
        self._c = ffi.gc(pointer, lib.petri_python_picture_free)
        width, height = ffi.new("int *"), ffi.new("int *")
        lib.petri_picture_size(self._c, width, height)
        self.width: int = width[0]
        self.height: int = height[0]
        self.frame: int = lib.petri_picture_frame(self._c)
        self.title: str = ffi.string(lib.petri_picture_title(self._c)).decode()

    def _draw(self, draw: Any) -> None:
        session = self._owner
        with session._lock:
            status = draw(session._open_painter())
            if session._c:
                lib.petri_picture_report(session._c, self._c)
        finish(status, session._told)

    @property
    def pixels(self) -> numpy.ndarray:
        """Red, green, blue and alpha of each pixel: uint8, height×width×4. Alpha is 255 except in an `!offscreen`."""
        argb = numpy.zeros((self.height, self.width), numpy.uint32)
        target = ffi.cast("uint32_t *", argb.ctypes.data)
        self._draw(lambda painter: lib.petri_picture_draw(self._c, painter, target, self.width, self.height,
                                                          4 * self.width))
        rgba = numpy.stack([argb >> shift & 255 for shift in (16, 8, 0, 24)], axis=-1)
        alpha = rgba[..., 3:]
        clear = (alpha > 0) & (alpha < 255)  # colours are premultiplied
        rgba[..., :3] = numpy.where(clear, rgba[..., :3] * 255 // numpy.maximum(alpha, 1), rgba[..., :3])
        return rgba.astype(numpy.uint8)

    def save(self, file: Union[str, os.PathLike]) -> None:
        """Writes a .png, .svg or .pdf file."""
        name = os.fsencode(file)
        self._draw(lambda painter: lib.petri_picture_save(self._c, painter, name))

    def _repr_png_(self) -> bytes:
        with tempfile.TemporaryDirectory(prefix="petri-") as folder:
            file = Path(folder) / "picture.png"
            self.save(file)
            return file.read_bytes()

    def __repr__(self) -> str:
        return f"<petri.Picture of frame {self.frame}, {self.width}×{self.height}>"
