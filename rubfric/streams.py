"""Standard output that is closed, full, or read by nobody to its end; a line that says how far something is."""

from __future__ import annotations

import os
import shutil
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import IO, Any

from rubfric.errors import NotWritten

# Time between two lines that are not written over: a twentieth of the time so far, within these bounds, s.
_SHORTEST, _LONGEST = 5.0, 60.0


class _Patient:
    """A text stream that drops the rest once its reader is gone, as after ``| head``.

    Parameters
    ----------
    stream : text file
        Where the text goes.
    """

    def __init__(self, stream: IO[str]) -> None:
        self._stream = stream
        self.failure: NotWritten | None = None

    def write(self, text: str) -> int:
        self._try(lambda: self._stream.write(text))
        return len(text)

    def flush(self) -> None:
        self._try(self._stream.flush)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)

    def _try(self, write: Callable[[], object]) -> None:
        try:
            write()
        except OSError as error:
            # What is still buffered goes nowhere: Python would complain of it at its exit.
            nowhere = os.open(os.devnull, os.O_WRONLY)
            os.dup2(nowhere, self._stream.fileno())
            os.close(nowhere)
            if not isinstance(error, BrokenPipeError):
                self.failure = NotWritten(f"standard output could not be written ({error.strerror})")
                raise self.failure from error


@contextmanager
def patient_output() -> Iterator[None]:
    """Go on within the block though the reader of its output is gone; NotWritten where there is no room for output."""
    before = sys.stdout
    if before is None:  # closed before Python began, which then prints nowhere
        yield
        return
    patient: Any = _Patient(before)
    sys.stdout = patient
    try:
        yield
    except SystemExit:  # argparse ends so, and keeps failures of output to itself
        patient.flush()
        if patient.failure:
            raise patient.failure from None
        raise
    finally:
        sys.stdout = before
        patient.flush()


def pause(elapsed: float) -> float:
    """Return how long to wait, s, before the next line on how far something is, after so many seconds in all."""
    return min(max(_SHORTEST, 0.05 * elapsed), _LONGEST)


class OneLine:
    """A line that says how far something is: written over itself on a terminal or in a notebook, else now and then.

    Parameters
    ----------
    stream : text file or None
        None for nowhere.
    clock : callable, optional
        Returns the time, s.
    """

    def __init__(self, stream: IO[str] | None, clock: Callable[[], float] = time.monotonic) -> None:
        self._stream, self._clock = stream, clock
        self._over = stream is not None and (stream.isatty() or type(stream).__module__.startswith("ipykernel"))
        self._began = clock()
        self._next = self._began + _SHORTEST
        self._width = 0

    def show(self, text: str, last: bool = False) -> None:
        """Show a text; the last one stays, and is shown in any case.

        Parameters
        ----------
        text : str
        last : bool
        """
        now = self._clock()
        if self._stream is None or not (self._over or last or now >= self._next):
            return
        self._next = now + pause(now - self._began)
        with suppress(OSError, ValueError):  # a terminal that is gone
            if self._over:
                text = text if last else text[: shutil.get_terminal_size().columns - 1]
                self._stream.write("\r" + text.ljust(self._width))
                self._width = len(text)
            else:
                self._stream.write(text + "\n")
            if last and self._over:
                self._stream.write("\n")
            self._stream.flush()
