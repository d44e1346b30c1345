"""Lines on a terminal and in a file; neither a full disk nor a terminal that is gone stops what they tell of."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TextIO


class Lines:
    """Where lines go.

    Parameters
    ----------
    path : Path
        File to append them to; made with its folder where it is missing.
    stream : text file or None
        Where they are shown; None for nowhere.
    """

    def __init__(self, path: Path, stream: TextIO | None) -> None:
        self._path, self._stream = path, stream

    def report(self, lines: Sequence[str]) -> None:
        """Show lines, and append them to the file."""
        self.show(lines)
        self.append([f"  {line}" for line in lines])

    def show(self, lines: Iterable[str]) -> None:
        """Show lines, indented by two blanks."""
        if self._stream is not None:
            with suppress(OSError, ValueError):  # a terminal that is gone
                self._stream.write("".join(f"  {line}\n" for line in lines))
                self._stream.flush()

    def append(self, lines: Iterable[str]) -> None:
        """Append lines to the file as they are."""
        with suppress(OSError):  # the jobs report a full disk
            self._path.parent.mkdir(parents=True, exist_ok=True)
            with self._path.open("a", encoding="utf-8") as stream:
                stream.write("".join(f"{line}\n" for line in lines))
