"""Files that appear whole or not at all, what killed runs leave of them, and why one could not be written."""

from __future__ import annotations

import errno
import hashlib
import os
import platform
import re
import tempfile
import time
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
# Which machine a process is of, for the names of files that are being written; where it is another one, a file that has
# not grown for so many seconds is one of a killed run.
_HOST = hashlib.sha256(platform.node().encode()).hexdigest()[:6]
_PART = re.compile(r"\..+?(?:\.(?P<host>[0-9a-f]{6}))?\.(?P<process>\d+)\.part")
_STALE = 86400.0
_MARK = re.compile(r"[0-9a-f]{16}")


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
    part = target.with_name(f".{target.name}.{_HOST}.{os.getpid()}.part")
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


def remove_parts(folder: str | os.PathLike[str]) -> None:
    """Remove what killed runs have left of files, anywhere in a folder; what a process still writes stays."""
    for place, _, names in os.walk(folder):
        for name in names:
            found = _PART.fullmatch(name)
            if found and _is_left(Path(place, name), found["host"], int(found["process"])):
                with suppress(OSError):
                    Path(place, name).unlink()


def _is_left(part: Path, host: str | None, process: int) -> bool:
    """Return whether the process that wrote a file is gone."""
    try:
        if host != _HOST:
            return time.time() - part.lstat().st_mtime > _STALE
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    except (OSError, OverflowError):
        return False
    return False


def mark(path: str | os.PathLike[str]) -> None:
    """Make an empty file whose name, 16 hexadecimal digits, stands for what was made; such files beside it go."""
    kept = Path(path)
    for other in kept.parent.iterdir():
        if other != kept and _MARK.fullmatch(other.name) and other.is_file() and not other.stat().st_size:
            other.unlink()
    kept.touch()


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
