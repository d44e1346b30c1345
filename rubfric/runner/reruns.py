"""Which jobs run again: the package files that a result depends on, found in import statements; Snakemake's records."""

from __future__ import annotations

import ast
import hashlib
import os
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from rubfric.errors import BrokenResult
from rubfric.files import whole

_PACKAGE = Path(__file__).resolve().parents[1]


@cache
def sources(*modules: str) -> tuple[Path, ...]:
    """Return the package's files that importing ``modules`` runs, sorted; absolute paths.

    Imports inside functions count. Files ``__init__.py`` do not: they hold a docstring only.

    Parameters
    ----------
    *modules : str
        Dotted names such as ``rubfric.simulation``.

    Raises
    ------
    ModuleNotFoundError
        For a name that is no module of the package.
    """
    found: set[Path] = set()
    waiting = [_file(module) for module in modules]
    while waiting:
        path = waiting.pop()
        if path in found:
            continue
        found.add(path)
        waiting.extend(_imported(path))
    return tuple(sorted(found))


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
    lines = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.relative_to(_PACKAGE.parent)}" for path in found]
    return _kept(Path(folder, name), "\n".join(lines) + "\n", found)


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


def _file(module: str) -> Path:
    path = _find(module)
    if path is None:
        raise ModuleNotFoundError(f"{module} is not a module of rubfric", name=module)
    return path


def _find(module: str) -> Path | None:
    """Return the file of a module of the package; None for any other name, packages among them."""
    first, *rest = module.split(".")
    if first != _PACKAGE.name or not rest:
        return None
    path = _PACKAGE.joinpath(*rest).with_suffix(".py")
    return path if path.is_file() else None


@cache
def _imported(path: Path) -> list[Path]:
    names: list[str] = []
    for node in _statements(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names += [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and node.module:
            # "from rubfric import dataset" names a module, "from rubfric.simulation import evaluate" does not.
            names += [node.module, *(f"{node.module}.{alias.name}" for alias in node.names)]
    return [found for found in map(_find, names) if found is not None]


def _statements(node: ast.AST) -> Iterator[ast.AST]:
    """Yield the statements below a node; not their expressions, which are many and import nothing."""
    for part in ("body", "orelse", "finalbody", "handlers", "cases"):
        for statement in getattr(node, part, ()):
            yield statement
            yield from _statements(statement)
