"""Standard output that is closed, full, or read by nobody to its end."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import IO, Any

from rubfric.errors import NotWritten


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
