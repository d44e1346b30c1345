"""What a run of the workflow has made, and so which results it may speak of."""

from __future__ import annotations

import os
from collections.abc import Collection, Iterable

# Folders of the results, by what is in them.
_FOLDERS = {"tables": "tables", "figures": "figures", "fields": "scenes", "marches": "marches"}


class Made:
    """The files that the jobs of a run have made.

    Parameters
    ----------
    results : str
        Folder of the results.
    tables : iterable of str
        Tables of single scales and of totals.
    first : iterable of str
        Files to open first, the most important first.

    Attributes
    ----------
    everything : bool
        Whether all results were asked for: those that the run did not make are up to date then.
    """

    def __init__(self, results: str, tables: Iterable[str], first: Iterable[str]) -> None:
        self._results, self._tables, self._first = results, list(tables), list(first)
        self._running: dict[int, Collection[str]] = {}
        self._made: set[str] = set()
        self.everything = True

    def start(self, job: int, outputs: Collection[str]) -> None:
        """Note which files a job is to make.

        Parameters
        ----------
        job : int
            Its number in the run.
        outputs : collection of str
        """
        self._running[job] = outputs

    def finish(self, job: int) -> None:
        """Note that a job has made its files."""
        self._made.update(self._running.pop(job, ()))

    def tables(self) -> list[str]:
        """Return the tables that are of this run, or were found up to date by it."""
        return [path for path in self._tables if self._valid(path)]

    def places(self) -> list[str]:
        """Return in a line or two where the results are, and what to open first."""
        first = [path for path in self._first if self._valid(path)]
        folders = {what: f"{self._results}/{name}" for what, name in _FOLDERS.items()}
        within = {f"{os.path.dirname(path)}/" for path in self._made}
        places = [
            f"{what} in {folder}"
            for what, folder in folders.items()
            if self._valid(folder) or any(place.startswith(f"{folder}/") for place in within)
        ]
        return [
            *([", ".join(places).replace(" in ", " are in ", 1)] if places else []),
            *([f"open first: {', '.join(first)}"] if first else []),
        ]

    def _valid(self, path: str) -> bool:
        return os.path.exists(path) and (self.everything or path in self._made)
