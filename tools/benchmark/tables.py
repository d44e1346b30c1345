"""Put a measured table between its markers in a page, with the machine that it was measured on."""

from __future__ import annotations

import argparse
import os
import platform
import re
from pathlib import Path

DOCS = Path(__file__).resolve().parents[2] / "docs"


def options(description: str | None, **more: tuple[int, str]) -> argparse.Namespace:
    """Return what the command line asks for: ``rounds``, 3 by default, and more whole numbers with their help."""
    parser = argparse.ArgumentParser(description=description)
    for name, (usual, what) in {"rounds": (3, "rounds to measure"), **more}.items():
        parser.add_argument(f"--{name}", type=int, default=usual, metavar="N", help=f"{what} (default: {usual})")
    asked = parser.parse_args()
    for name, value in vars(asked).items():
        if value < 1:
            parser.error(f"--{name} is {value}, but must be at least 1")
    return asked


def times(number: int) -> str:
    """Return a number of rounds in words."""
    return "one round" if number == 1 else f"the median of {number} rounds"


def machine() -> str:
    """Return what a reader needs to know of this machine."""
    model = platform.machine()
    cpuinfo = Path("/proc/cpuinfo")
    if cpuinfo.exists():
        names = re.findall(r"model name\s*: (.*)", cpuinfo.read_text(encoding="utf-8"))
        model = names[0] if names else model
    return f"{os.cpu_count()} cores ({model}), Python {platform.python_version()}"


def publish(marker: str, text: str, page: str) -> None:
    """Replace what is between ``<!-- marker -->`` and ``<!-- /marker -->`` in a page of docs.

    Parameters
    ----------
    marker : str
        Name of the pair of markers.
    text : str
        Markdown.
    page : str
        Name of the file.
    """
    begin, end = f"<!-- {marker} -->", f"<!-- /{marker} -->"
    old = (DOCS / page).read_text(encoding="utf-8")
    if begin not in old or end not in old:
        raise SystemExit(f"docs/{page} lacks the markers {begin} and {end}")
    before, rest = old.split(begin, 1)
    after = rest.split(end, 1)[1]
    (DOCS / page).write_text(f"{before}{begin}\n{text}\n{end}{after}", encoding="utf-8")
