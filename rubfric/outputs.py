"""Files that a command writes beside a user's own: named after the input, and in place of nothing that is not ours."""

from __future__ import annotations

import difflib
import os
from pathlib import Path

from rubfric.errors import InvalidInput
from rubfric.rules import Word


def name_of(given: str | None, path: str) -> str:
    """Return the name of an entry: the one given, checked, or else that of the file it is made from.

    Parameters
    ----------
    given : str, optional
    path : str
    """
    if given is not None:
        return Word().check("--name", given)
    stem = "".join(c if c.isascii() and (c.isalnum() or c in "-_") else "_" for c in Path(path).stem)[:50].strip("_")
    return stem or "mine"


def check_output(output: Path, kind: str, ours: tuple[str, ...]) -> None:
    """Refuse to write over a folder, or over a file that a user may have written.

    Parameters
    ----------
    output : Path
    kind : str
        What is written, "rubber" say.
    ours : tuple of str
        Words in the first line of files that the command wrote, which it may write anew.
    """
    if output.is_dir():
        raise InvalidInput(f"--output is the folder {output}, but must be a file")
    if output.suffix in (".html", ".htm"):
        raise InvalidInput(f"--output is {output}, but must be the file of the {kind}; its page is written beside it")
    if output.exists():
        with output.open(encoding="utf-8", errors="replace") as stream:
            first = stream.readline()
        if not any(words in first for words in ours):
            raise InvalidInput(f"{output} exists and was not written by this command: name another with --output")


def no_file(path: str | os.PathLike[str]) -> str:
    """Say that a file is missing, and which one beside it, of a like name and the same suffix, may have been meant."""
    missing = Path(path)
    names = [one.stem for one in missing.parent.glob(f"*{missing.suffix}")] if missing.suffix else []
    close = difflib.get_close_matches(missing.stem, names, n=1)
    meant = f" (did you mean {missing.with_name(close[0] + missing.suffix)}?)" if close else ""
    return f"there is no file {missing}{meant}"
