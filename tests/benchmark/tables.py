"""Put a measured table between its markers in the README, with the machine that it was measured on."""

from __future__ import annotations

import argparse
import os
import platform
import re
from pathlib import Path

README = Path(__file__).resolve().parents[2] / "README.md"


def rounds(description: str | None) -> int:
    """Return how many rounds the command line asks for, 3 by default."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--rounds", type=int, default=3, metavar="N", help="rounds to measure (default: 3)")
    asked = int(parser.parse_args().rounds)
    if asked < 1:
        parser.error(f"--rounds is {asked}, but must be at least 1")
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


def markdown(rows: list[tuple[str, ...]]) -> str:
    """Return a table; the first row holds the headings."""
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    lines.insert(1, "|---" + "|---:" * (len(rows[0]) - 1) + "|")
    return "\n".join(lines)


def publish(marker: str, text: str) -> None:
    """Replace what stands between ``<!-- marker -->`` and ``<!-- /marker -->`` in the README."""
    begin, end = f"<!-- {marker} -->", f"<!-- /{marker} -->"
    page = README.read_text(encoding="utf-8")
    if begin not in page or end not in page:
        raise SystemExit(f"README.md lacks the markers {begin} and {end}")
    before, rest = page.split(begin, 1)
    after = rest.split(end, 1)[1]
    README.write_text(f"{before}{begin}\n{text}\n{end}{after}", encoding="utf-8")
