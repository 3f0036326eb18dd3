"""Films of sessions: files, and animations in notebooks."""

from __future__ import annotations

import base64
import os
import shutil
import subprocess
from typing import TYPE_CHECKING, Any, List, Union

from .errors import MissingLibraryError
from .systems import _optional

if TYPE_CHECKING:
    from .session import Session


def write(session: Session, path: Union[str, os.PathLike], frames: int, fps: float, every: int, picture: dict) -> None:
    """See Session.film."""
    program = shutil.which("ffmpeg")
    if not program:
        raise MissingLibraryError("cannot write films: there is no program ffmpeg (Debian: ffmpeg)")
    name = os.fspath(path)
    # Delays in a GIF are whole hundredths of a second, and viewers show a hundredth as a tenth.
    filters = "fps='min(source_fps,50)',split[a][b];[a]palettegen[p];[b][p]paletteuse" if name.endswith(".gif") else \
        "crop=trunc(iw/2)*2:trunc(ih/2)*2,format=yuv420p"
    process = None
    try:
        for frame in session._every(frames, every):
            pixels = session.picture(**picture).pixels[..., :3]
            if process is None:
                rate = fps or frame.fps / every
                size = f"{pixels.shape[1]}x{pixels.shape[0]}"
                process = subprocess.Popen([program, "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size,
                                            "-r", str(rate), "-i", "-", "-vf", filters, f"file:{name}"],
                                           stdin=subprocess.PIPE, stderr=subprocess.PIPE)
            process.stdin.write(pixels.tobytes())
    except BrokenPipeError:
        pass  # ffmpeg reports why
    finally:
        if process is not None:
            message = process.communicate()[1].decode("utf-8", "replace").strip()
    if process.returncode:
        raise OSError(f"ffmpeg cannot write {name!r}: {message}")


_PLAYER = """<div><img alt="frame 0"><br><button type="button">Pause</button> <input type="range" min="0" value="0"><script>
(() => {{
    const box = document.currentScript.parentElement, pictures = {pictures};
    const [image, button, slider] = ['img', 'button', 'input'].map((name) => box.querySelector(name));
    let at = 0, runs = true;
    slider.max = pictures.length - 1;
    const show = (number) => {{
        at = slider.value = number;
        image.src = 'data:image/png;base64,' + pictures[number];
        image.alt = 'frame ' + number;
    }};
    button.onclick = () => {{ runs = !runs; button.textContent = runs ? 'Pause' : 'Play'; }};
    slider.oninput = () => {{ runs = false; button.textContent = 'Play'; show(Number(slider.value)); }};
    show(0);
    const timer = setInterval(() => {{
        if (!box.isConnected) clearInterval(timer);
        else if (runs) show((at + 1) % pictures.length);
    }}, {milliseconds});
}})();
</script></div>"""


class Animation:
    """Pictures of consecutive frames. Notebooks play them."""

    def __init__(self, pictures: List[bytes], fps: float):
        self.pictures = pictures  #: The pictures as PNG files.
        self.fps = fps

    def _repr_html_(self) -> str:
        texts = [base64.b64encode(picture).decode() for picture in self.pictures]
        return _PLAYER.format(pictures=texts, milliseconds=1000 / self.fps)

    def __repr__(self) -> str:
        return f"<petri.Animation of {len(self.pictures)} pictures>"


def animate(session: Session, frames: int, fps: float, every: int, picture: dict) -> Animation:
    """See Session.animate."""
    pictures: List[bytes] = []
    rate = fps
    for frame in session._every(frames, every):
        rate = rate or frame.fps / every
        pictures.append(session.picture(**picture)._repr_png_())
    return Animation(pictures, rate)


def widget(session: Session, frames: int, picture: dict) -> Any:
    """See Session.widget."""
    widgets = _optional("ipywidgets", "widget")
    image = widgets.Image(format="png")
    status = widgets.Label()

    def show() -> None:
        image.value = session.picture(**picture)._repr_png_()
        status.value = f"frame {session.frame.number}"

    def step(_: Any = None) -> None:
        session.step(frames)
        show()

    def slider(parameter: Any) -> Any:
        whole = parameter.step is not None and parameter.step == int(parameter.step) and parameter.number == int(parameter.number)
        kind = widgets.IntSlider if whole else widgets.FloatSlider
        number = int if whole else float
        control = kind(value=number(parameter.number), min=number(parameter.min), max=number(parameter.max),
                       step=parameter.step or (parameter.max - parameter.min) / 100, description=parameter.name,
                       continuous_update=False)
        control.observe(lambda change: session.set_parameter(parameter.name, change["new"]), "value")
        return control

    button = widgets.Button(description=f"{frames} frames")
    button.on_click(step)
    sliders = [slider(p) for p in session.parameters.values()
               if p.settable and p.number is not None and p.min is not None and p.max is not None]
    step()
    return widgets.VBox([image, widgets.HBox([button, status]), *sliders])
