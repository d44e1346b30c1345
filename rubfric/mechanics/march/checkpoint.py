"""Arrays in a file that belongs to one piece of work, to go on from."""

from __future__ import annotations

import hashlib
import io
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import BrokenResult
from rubfric.files import whole

_LABEL = "label"
# Length of the checksum that the file begins with, bytes.
_CHECKSUM = 32


def write(path: Path, label: str, arrays: Mapping[str, Real]) -> None:
    """Write arrays under a label that says what they belong to; the file appears whole or not at all.

    It holds a checksum (SHA-256), then an .npz.

    Parameters
    ----------
    path : Path
    label : str
    arrays : mapping of str to ndarray
    """
    given = {_LABEL: np.asarray(label), **arrays}
    content = io.BytesIO()
    np.savez(content, allow_pickle=False, **given)
    with whole(path) as part:
        part.write_bytes(hashlib.sha256(content.getbuffer()).digest() + content.getbuffer())


def read(path: Path, label: str) -> dict[str, Real]:
    """Return the arrays of a file.

    Parameters
    ----------
    path : Path
    label : str
        That the file has to have.

    Raises
    ------
    BrokenResult
        Where the file cannot be read, is not what was written, or has another label.
    """
    unusable = f"{path} cannot be read as what a march left; delete it to begin afresh"
    try:
        stored = path.read_bytes()
    except OSError as error:
        raise BrokenResult(unusable) from error
    if hashlib.sha256(stored[_CHECKSUM:]).digest() != stored[:_CHECKSUM]:
        raise BrokenResult(unusable)
    with np.load(io.BytesIO(stored[_CHECKSUM:]), allow_pickle=False) as file:
        arrays = {name: file[name] for name in file.files}
    found = str(arrays.pop(_LABEL, ""))
    if found != label:
        raise BrokenResult(f"{path} belongs to other work: it has the label {found!r}, not {label!r}")
    return arrays
