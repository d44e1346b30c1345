"""Results of scenes that were solved without the workflow, kept in the folder of a campaign's results.

They are in ``.cache``, in a folder named after the code that made them, under digests of all that they depend on; the
workflow takes them up, and what it has made itself is known by the same digests.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

import netCDF4

from rubfric.checksums import check_seal, fingerprint
from rubfric.errors import BrokenResult, NotWritten
from rubfric.files import check_folder, remove_parts, whole
from rubfric.results.provenance import SOLVER
from rubfric.results.selection import NOT_NEEDED, REFUSAL
from rubfric.scene.scene import Scene
from rubfric.sources import code

_KEPT, _DEEPEST = ".cache", 5


def place(results: str | os.PathLike[str]) -> Path:
    """Return the folder of what this code has solved, given that of a campaign's results."""
    return Path(results, _KEPT, code(SOLVER))


@contextmanager
def opened(folder: Path) -> Iterator[Path]:
    """Give a folder, as from ``place``, to write to; where nothing can be written there, one for this time only."""
    try:
        check_folder(folder)
    except NotWritten:
        with TemporaryDirectory(prefix="rubfric-") as other:
            yield Path(other)
        return
    for old in folder.parent.iterdir():
        if old.name != folder.name and old.is_dir():
            shutil.rmtree(old, ignore_errors=True)  # of other code
    remove_parts(folder)
    yield folder


def path_of(folder: Path, scene: Scene, *depends: str) -> Path:
    """Return where the result of a scene is kept.

    Parameters
    ----------
    folder : Path
        As from ``place``.
    scene : Scene
    *depends : str
        What it depends on besides the scene.
    """
    return folder / f"{scene.name}-{fingerprint([scene.digest, *depends])}.nc"


def fits(path: Path, scene: Scene, solved: bool = True) -> bool:
    """Return whether a file is a whole result of a scene by this code.

    Parameters
    ----------
    path : Path
    scene : Scene
    solved : bool
        Whether a file that says that none is needed does not count.
    """
    if not path.is_file():
        return False
    try:
        check_seal(path)
        with netCDF4.Dataset(path) as stored:
            about = {name: str(stored.getncattr(name)) for name in stored.ncattrs()}
    except (BrokenResult, OSError, AttributeError):
        return False
    if (about.get("scene_digest"), about.get("code_digest")) != (scene.digest, code(SOLVER)):
        return False
    return not (solved and about.get(REFUSAL, "").startswith(NOT_NEEDED))


def copy(known: Path, path: str | os.PathLike[str]) -> None:
    """Copy a file, whole or not at all."""
    with whole(path) as part:
        shutil.copyfile(known, part)


def take_up(output: str | os.PathLike[str], scene: Scene) -> bool:
    """Copy what is kept of a scene to where the workflow wants it, and return whether there is any.

    Parameters
    ----------
    output : path-like
        In the folder of a campaign's results, at most so deep as ``whole/RUBBER/ROAD/draw1/NAME.nc``.
    scene : Scene
    """
    candidates = (path_of(place(results), scene) for results in Path(output).parents[:_DEEPEST])
    known = next((path for path in candidates if fits(path, scene)), None)
    if known is not None:
        copy(known, output)
    return known is not None
