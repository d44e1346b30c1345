"""Snakemake's memory of what it ran: whether it can be read at all."""

from __future__ import annotations

import os
from pathlib import Path

from rubfric.errors import BrokenResult


def check_records(folder: str | os.PathLike[str]) -> None:
    """Raise BrokenResult if a file below ``folder``, where Snakemake keeps its records, holds no text.

    Snakemake passes over a record that is cut short, but ends without a sentence at bytes that are no text.
    """
    for path in sorted(Path(folder).rglob("*")):
        try:
            if path.is_file():
                path.read_bytes().decode()
        except FileNotFoundError:  # another run has just replaced it
            continue
        except UnicodeDecodeError as error:
            raise BrokenResult(
                f"Snakemake's record {path} is damaged: delete all of them (rm -r {os.fspath(folder)}) and run again; "
                "results stay, and are checked against the config when they are collected"
            ) from error
