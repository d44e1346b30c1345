"""Checksums (SHA-256) over whole files, so that a damaged or exchanged one is noticed before anything is made from it.

A netCDF file carries its own, in the variable ``checksum``: over all its bytes, with zeros in place of the checksum. A
table keeps its own in a hidden file beside it, ``.name.csv.sha256``, in the format of ``sha256sum``, so that programs
which read tables find nothing but the table.
"""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Iterable
from pathlib import Path

from rubfric.errors import BrokenResult
from rubfric.files import whole

# What comes before the checksum of a netCDF file, and what holds its place until it is known.
_MARK = b"rubfric-sha256:"
PLACEHOLDER = _MARK + b"0" * 64
_FOUND = re.compile(re.escape(_MARK) + rb"([0-9a-f]{64})")
# What to do about a file that cannot be used.
AGAIN = "delete it and run again"
_DAMAGED = "its content does not match its checksum: it was damaged or changed after it was written"
_NONE = "it has no checksum, so that it is damaged, of an earlier version, or no file of rubfric"


def seal(path: str | os.PathLike[str]) -> None:
    """Replace ``PLACEHOLDER`` in a file by the checksum of the file.

    Raises
    ------
    ValueError
        Where the placeholder is not there, once and uncompressed.
    """
    content = Path(path).read_bytes()
    if content.count(PLACEHOLDER) != 1:
        raise ValueError(f"{os.fspath(path)} does not hold one placeholder of its checksum")
    with open(path, "r+b") as stream:
        stream.seek(content.index(PLACEHOLDER) + len(_MARK))
        stream.write(hashlib.sha256(content).hexdigest().encode())


def check_seal(path: str | os.PathLike[str]) -> None:
    """Check a file that carries its own checksum.

    Raises
    ------
    BrokenResult
        For a file that cannot be read, has no checksum, or is not what was written.
    """
    content = _content(path)
    found = list(_FOUND.finditer(content))
    if len(found) != 1:
        raise _unusable(path, _NONE)
    place = slice(found[0].start(), found[0].end())
    restored = content[: place.start] + PLACEHOLDER + content[place.stop :]
    if hashlib.sha256(restored).hexdigest().encode() != found[0].group(1):
        raise _unusable(path, _DAMAGED)


def sign(path: str | os.PathLike[str]) -> None:
    """Write the checksum of a file beside it.

    Raises
    ------
    NotWritten
        Where the disk is full or the place is not writable.
    """
    target = Path(path)
    with whole(_beside(target)) as part:
        part.write_text(f"{hashlib.sha256(target.read_bytes()).hexdigest()}  {target.name}\n", encoding="utf-8")


def check_signature(path: str | os.PathLike[str], required: bool = True) -> None:
    """Check a file whose checksum is beside it.

    Parameters
    ----------
    path : path-like
    required : bool
        Whether a file without a checksum is refused, as every file of a campaign; a table from elsewhere has none.

    Raises
    ------
    BrokenResult
        For a file that cannot be read or is not what was written.
    """
    content = _content(path)
    try:
        known = _beside(Path(path)).read_bytes()[:64]
    except OSError as error:
        if required:
            raise _unusable(path, _NONE) from error
        return
    if hashlib.sha256(content).hexdigest().encode() != known:
        raise _unusable(path, _DAMAGED)


def remove_signature(path: str | os.PathLike[str]) -> None:
    """Remove the checksum beside a file that is gone; there need be none."""
    _beside(Path(path)).unlink(missing_ok=True)


def fingerprint(words: Iterable[str]) -> str:
    """Return a short name for words, digests of scenes for one, in their order."""
    return hashlib.sha256(" ".join(words).encode()).hexdigest()[:16]


def _beside(path: Path) -> Path:
    return path.with_name(f".{path.name}.sha256")


def _content(path: str | os.PathLike[str]) -> bytes:
    try:
        return Path(path).read_bytes()
    except OSError as error:
        raise _unusable(path, error.strerror or str(error)) from error


def _unusable(path: str | os.PathLike[str], reason: str) -> BrokenResult:
    return BrokenResult(f"{os.fspath(path)} cannot be read: {reason}; {AGAIN}")
