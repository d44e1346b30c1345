"""Areal scans in ISO 25178-71 files (.sdf), of text (``aISO-1.0``) or binary (``bISO-1.0``)."""

from __future__ import annotations

import re
import struct

import numpy as np

from rubfric.arrays import Real
from rubfric.errors import InvalidInput
from rubfric.profile.scan import Scan

_MARK = re.compile(rb"^\s*([ab])(ISO|BCR|NIST)-1\.\d")
# Codes of the data types, and the integers that stand where nothing was measured.
_TYPES = {0: "u1", 1: "<u2", 2: "<u4", 3: "<f4", 4: "i1", 5: "<i2", 6: "<i4", 7: "<f8"}
_MISSING = {1: 2**16 - 1, 2: 2**32 - 1, 5: -(2**15), 6: -(2**31)}
_BINARY = struct.Struct("<8s10s12s12sHHddddBBB")
_NEEDED = ("NumPoints", "NumProfiles", "Xscale", "Yscale", "Zscale")
_BAD = ("BAD", "NAN", "*BAD*")
# Reals beyond this mean that nothing was measured.
_BEYOND = 1e30


def is_sdf(head: bytes) -> bool:
    """Return whether a file begins as one of ISO 25178-71."""
    return bool(_MARK.match(head))


def read_sdf(path: str) -> Scan:
    """Read an ISO 25178-71 file.

    Parameters
    ----------
    path : str

    Raises
    ------
    InvalidInput
        For a file that is compressed, cut short, or whose header is no header.
    """
    with open(path, "rb") as stream:
        content = stream.read()
    if content.lstrip()[:1] == b"b":
        header, values = _binary(path, content)
    else:
        header, values = _text(path, content)
    points, lines = int(header["NumPoints"]), int(header["NumProfiles"])
    if values.size < points * lines or points < 1 or lines < 1:
        raise InvalidInput(
            f"{path} holds {values.size} heights, but its header says {lines} lines of {points}: it was cut short"
        )
    # All scales are in m.
    x, y, z = (1e3 * float(header[name]) for name in ("Xscale", "Yscale", "Zscale"))
    if not x > 0.0 or (lines > 1 and not y > 0.0):
        raise InvalidInput(f"{path} has points {x:g} mm apart along x and {y:g} mm along y, but both must be above 0")
    return Scan(path, (x, y), z * values[: points * lines].reshape(lines, points))


def _binary(path: str, content: bytes) -> tuple[dict[str, float], Real]:
    if len(content) < _BINARY.size:
        raise InvalidInput(f"{path} has {len(content)} bytes, fewer than the header of an ISO 25178-71 file")
    _, _, _, _, points, lines, x, y, z, _, compression, kind, _ = _BINARY.unpack_from(content)
    _check(path, compression, kind)
    place = _BINARY.size
    held = np.dtype(_TYPES[kind])
    count = min(points * lines, (len(content) - place) // held.itemsize)
    values = np.frombuffer(content, held, count, place).astype(float)
    return dict(zip(_NEEDED, (points, lines, x, y, z), strict=True)), _known(values, kind)


def _text(path: str, content: bytes) -> tuple[dict[str, float], Real]:
    parts = content.decode("latin-1").split("*")
    header = {}
    for line in parts[0].splitlines()[1:]:
        name, equal, value = line.partition("=")
        if equal:
            header[name.strip()] = value.strip()
    try:
        found = {name: float(header[name]) for name in _NEEDED}
        codes = [int(float(header.get(name, default))) for name, default in (("Compression", "0"), ("DataType", "7"))]
    except (KeyError, ValueError) as error:
        raise InvalidInput(
            f"{path} lacks a number in its header ({error}), but an ISO 25178-71 file has {', '.join(_NEEDED)}"
        ) from None
    _check(path, *codes)
    words = parts[1].replace(";", " ").split() if len(parts) > 1 else []
    try:
        values = np.array([np.nan if word.upper() in _BAD else float(word) for word in words])
    except ValueError as error:
        raise InvalidInput(f"{path} holds a word among its heights that is no number: {error}") from None
    return found, _known(values, codes[1])


def _known(values: Real, kind: int) -> Real:
    """Return heights with NaN where nothing was measured."""
    return np.where((values == _MISSING.get(kind)) | ~(np.abs(values) < _BEYOND), np.nan, values)


def _check(path: str, compression: int, kind: int) -> None:
    if compression:
        raise InvalidInput(f"{path} is compressed (code {compression}): export it without compression")
    if kind not in _TYPES:
        raise InvalidInput(f"{path} has heights of the type {kind}, but must have one of {', '.join(map(str, _TYPES))}")
