"""Which jobs run again: one file for the package files that a result depends on; Snakemake's records."""

from __future__ import annotations

import os
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from rubfric.errors import BrokenResult
from rubfric.files import whole
from rubfric.sources import digests, sources


@cache
def stamp(folder: str | os.PathLike[str], *modules: str) -> str:
    """Keep a file in ``folder`` that represents all ``sources(*modules)``, and return its path.

    It holds their digests, and is written anew when one of them has changed: for Snakemake a single input that changes
    with any of them, so that it has one file per scene to check, not fifty. A file that was missing gets the age of the
    youngest source, so that results made since stay up to date.

    Parameters
    ----------
    folder : path-like
        Where the file is kept; made where it is missing.
    *modules : str
        Dotted names such as ``rubfric.simulation``.

    Raises
    ------
    ModuleNotFoundError
        For a name that is no module of the package.
    NotWritten
        Where the file cannot be written.
    """
    return stamp_files(folder, "+".join(modules), sources(*modules))


def stamp_files(folder: str | os.PathLike[str], name: str, paths: Iterable[Path]) -> str:
    """Keep a file ``name`` in ``folder`` that represents some files of the package, as ``stamp`` does.

    Parameters
    ----------
    folder : path-like
    name : str
    paths : iterable of Path
        Files of the package.
    """
    found = list(paths)
    return _kept(Path(folder, name), "".join(digests(found)), found)


def copy_of(folder: str | os.PathLike[str], path: str | os.PathLike[str]) -> str:
    """Keep a copy of a text file in ``folder``, as ``stamp`` keeps its own file, and return its path.

    Parameters
    ----------
    folder : path-like
    path : path-like
        The file to copy.
    """
    source = Path(path)
    return _kept(Path(folder, source.name), source.read_text(encoding="utf-8"), [source])


def _kept(place: Path, text: str, origins: list[Path]) -> str:
    """Write a text where a file does not hold it; a file that was missing gets the age of the youngest origin."""
    known = place.read_text(encoding="utf-8", errors="replace") if place.exists() else None
    if known != text:
        with whole(place) as part:
            part.write_text(text, encoding="utf-8")
            if known is None:
                age = max(path.stat().st_mtime_ns for path in origins)
                os.utime(part, ns=(age, age))
    return str(place)


def check_records(folder: str | os.PathLike[str]) -> None:
    """Raise BrokenResult if a file below ``folder``, where Snakemake keeps its records, is not text.

    Snakemake ignores a record that is cut short, but dies with a traceback on bytes that are not text.
    """
    for path in sorted(Path(folder).rglob("*")):
        try:
            if path.is_file():
                path.read_bytes().decode()
        except FileNotFoundError:  # just replaced by another run
            continue
        except UnicodeDecodeError as error:
            raise BrokenResult(
                f"Snakemake's record {path} is damaged: delete all of them (rm -r {os.fspath(folder)}) and run again; "
                "results stay, and are checked against the config when they are collected"
            ) from error
