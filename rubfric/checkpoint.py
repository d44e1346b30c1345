"""Arrays in a file that belongs to one piece of work, to go on from."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from rubfric.arrays import Real
from rubfric.atomic import whole
from rubfric.errors import BrokenResult

_LABEL = "label"


def write(path: Path, label: str, arrays: Mapping[str, Real]) -> None:
    """Write arrays (an .npz) under a label that says what they belong to; the file appears whole or not at all."""
    given = {_LABEL: np.asarray(label), **arrays}
    with whole(path) as part, part.open("wb") as file:
        np.savez(file, allow_pickle=False, **given)


def read(path: Path, label: str) -> dict[str, Real]:
    """Return the arrays of a file.

    Raises
    ------
    BrokenResult
        Where the file cannot be read, or has another label.
    """
    try:
        with path.open("rb") as opened, np.load(opened, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
    except (OSError, EOFError, ValueError, TypeError, zipfile.BadZipFile) as error:
        raise BrokenResult(f"{path} cannot be read as what a march left; delete it to begin afresh") from error
    found = str(arrays.pop(_LABEL, ""))
    if found != label:
        raise BrokenResult(f"{path} belongs to other work: it has the label {found!r}, not {label!r}")
    return arrays
