"""Files that appear whole or not at all, and why one could not be written."""

from __future__ import annotations

import errno
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from rubfric.errors import NotWritten, RubfricError

_FULL = "the disk is full: make room there, then run again"
_FORBIDDEN = "nothing can be written there: make that place writable, or choose another one, then run again"
_NO_FOLDER = "a file stands where a folder belongs: move it away, or choose another place, then run again"
_REASONS = {
    errno.ENOSPC: _FULL,
    errno.EDQUOT: "your quota of the disk is used up: make room there, then run again",
    errno.EFBIG: "files may not grow so large: raise that limit (ulimit -f unlimited), then run again",
    errno.EROFS: _FORBIDDEN,
    errno.EACCES: _FORBIDDEN,
    errno.EPERM: _FORBIDDEN,
    errno.ENOTDIR: _NO_FOLDER,
    errno.EEXIST: _NO_FOLDER,
    errno.EISDIR: "a folder stands where a file belongs: move it away, or choose another place, then run again",
    errno.EIO: "the disk failed: check it, then run again",
}


@contextmanager
def whole(path: str | os.PathLike[str]) -> Iterator[Path]:
    """Give a hidden path beside ``path`` to write to; it takes the name ``path`` only when the block has ended well.

    Missing folders are made. The file is on the disk before it has its name. An interrupted run leaves at most a file
    whose name begins with a dot.

    Raises
    ------
    NotWritten
        Where the system does not let the file be written: what is the matter, and what to do about it.
    """
    target = Path(path)
    part = target.with_name(f".{target.name}.{os.getpid()}.part")
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
        yield part
        _settle(part)
        os.replace(part, target)
    except OSError as error:
        raise why_not(target, error) from error
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)


def why_not(path: str | os.PathLike[str], error: OSError) -> OSError:
    """Return the error that says why ``path`` could not be written and what to do, or ``error`` if that is unknown."""
    if isinstance(error, RubfricError) or error.errno not in _REASONS:
        return error
    return NotWritten(f"{os.fspath(path)} could not be written, since {_REASONS[error.errno]} ({error.strerror})")


def check_folder(path: str | os.PathLike[str]) -> None:
    """Make a folder where it is missing, and raise NotWritten if nothing can be written to it."""
    try:
        Path(path).mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path) as probe:
            probe.write(b"\0" * 4096)
            probe.flush()
    except OSError as error:
        raise why_not(path, error) from error


def check_place(path: str | os.PathLike[str]) -> None:
    """Raise NotWritten if ``path`` is not a folder and cannot become one, since a file stands in the way."""
    place = Path(path)
    while not os.path.lexists(place) and place != place.parent:
        place = place.parent
    if not place.is_dir():
        raise NotWritten(f"{os.fspath(path)} could not be written, since {_NO_FOLDER} ({place} is no folder)")


def _settle(part: Path) -> None:
    """Have a file stored: a disk may say only then that it is full."""
    descriptor = os.open(part, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
