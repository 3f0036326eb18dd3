"""Build backend (PEP 517) for `pip install .` in the source tree, and for source distributions, which it makes.

It builds the libraries with meson in the folder `build-python`, and the module with setuptools. The setting `meson`
contains options for meson, as in `pip install --config-settings=meson=-Dauto_features=disabled .`
"""

import gzip
import io
import os
import shlex
import shutil
import subprocess
import tarfile
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / "build-python"
GENERATED = ("parser.c", "parser.h", "lexer.c")
# Folders of the source tree that a source distribution does not contain.
OMITTED = ("tests", ".ci", ".github")


def run(*words):
    subprocess.run(words, check=True, cwd=ROOT)


def fill(name):
    """Returns the text of a file with the names of people and the version."""
    return subprocess.run(["sh", str(ROOT / "src/packaging/fill.sh"), str(ROOT / name)], check=True,
                          stdout=subprocess.PIPE, text=True).stdout


def version():
    return subprocess.run(["sh", str(ROOT / "src/packaging/fill.sh"), "/dev/stdin"], check=True, input="@VERSION@",
                          stdout=subprocess.PIPE, text=True).stdout.strip()


def set_up(config_settings):
    if not (BUILD / "build.ninja").exists():
        run("meson", "setup", str(BUILD), "--buildtype=release", "-Dtests=false", "-Dpython=disabled",
            *shlex.split((config_settings or {}).get("meson", "")))


def get_requires_for_build_wheel(config_settings=None):
    return [name for name in ("meson", "ninja") if not shutil.which(name)]


get_requires_for_build_sdist = get_requires_for_build_wheel


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    set_up(config_settings)
    libraries = (BUILD / "src/python/libraries").read_text(encoding="utf-8").strip()
    targets = [word for word in shlex.split(libraries) if word.endswith(".a") and word.startswith(str(BUILD))]
    run("ninja", "-C", str(BUILD), *(os.path.relpath(word, BUILD) for word in targets))
    os.environ.update(PETRI_VERSION=version(), PETRI_HEADERS=str(ROOT / "lib/include"), PETRI_LIBRARIES=libraries)
    from setuptools import build_meta
    wheel_directory = os.path.abspath(wheel_directory)
    with tempfile.TemporaryDirectory() as folder:
        for name in ("build_petri.py", "helpers.c", "helpers.h", "setup.py"):
            shutil.copy(ROOT / "src/python" / name, folder)
        shutil.copytree(ROOT / "src/python/petri", Path(folder) / "petri")
        (Path(folder) / "pyproject.toml").write_text(fill("src/python/pyproject.toml"), encoding="utf-8")
        before = os.getcwd()
        os.chdir(folder)
        try:
            return build_meta.build_wheel(wheel_directory)
        finally:
            os.chdir(before)


def source_files():
    """Returns the files of a source distribution, relative to ROOT, sorted."""
    if (ROOT / ".git").exists():
        listed = subprocess.run(["git", "ls-files", "-z"], check=True, cwd=ROOT, stdout=subprocess.PIPE).stdout
        names = [os.fsdecode(name) for name in listed.split(b"\0") if name]
    else:
        names = [str(path.relative_to(ROOT)) for path in ROOT.rglob("*") if path.is_file() and "__pycache__" not in path.parts]
    return sorted(name for name in names if name.split("/")[0] not in OMITTED and not name.startswith("build")
                  and name != "PKG-INFO" and not name.startswith("grammar/generated/"))


def build_sdist(sdist_directory, config_settings=None):
    generated = ROOT / "grammar/generated"
    if not generated.exists():
        set_up(config_settings)
        run("ninja", "-C", str(BUILD), *(f"grammar/{name}" for name in GENERATED))
        generated = BUILD / "grammar"
    name = f"petri-{version()}"
    epoch = int(os.environ.get("SOURCE_DATE_EPOCH", 0))

    def add(archive, path, data, executable=False):
        info = tarfile.TarInfo(f"{name}/{path}")
        info.size, info.mtime, info.mode = len(data), epoch, 0o755 if executable else 0o644
        archive.addfile(info, io.BytesIO(data))

    target = Path(sdist_directory) / f"{name}.tar.gz"
    with open(target, "wb") as file, gzip.GzipFile("", "wb", fileobj=file, mtime=epoch) as packed, \
            tarfile.open(fileobj=packed, mode="w", format=tarfile.PAX_FORMAT) as archive:
        add(archive, "PKG-INFO", f"Metadata-Version: 2.1\nName: petri\nVersion: {version()}\n".encode())
        for path in source_files():
            add(archive, path, (ROOT / path).read_bytes(), os.access(ROOT / path, os.X_OK))
        for path in GENERATED:
            add(archive, f"grammar/generated/{path}", (generated / path).read_bytes())
    return target.name
